"""`--dialect`, and the same in the project file, reach each command that compiles."""

from __future__ import annotations

from pathlib import Path

import pytest

from iec2mpy.cli import main

_PROGRAM = """PROGRAM main
VAR lamp : BOOL; END_VAR
lamp S= TRUE;
END_PROGRAM
"""
_CASES = """[[case]]
id = "lit"
files = ["../src/main.st"]
steps = [ { expect = { "main.lamp" = true } } ]
"""


@pytest.fixture
def project(tmp_path: Path) -> Path:
    for name, text in (
        ("src/main.st", _PROGRAM),
        ("tests/main.toml", _CASES),
        ("iec2mpy.toml", '[project]\nname = "lamp"\nboard = "pico"\n'),
    ):
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return tmp_path


COMMANDS = (["check"], ["build"], ["run", "--scans", "1"], ["test"])


@pytest.mark.parametrize("command", COMMANDS, ids=lambda words: words[0])
def test_option(command: list[str], project: Path) -> None:
    name, *options = command
    assert main([name, str(project), *options]) == 1
    assert main([name, str(project), *options, "--dialect", "codesys"]) == 0


@pytest.mark.parametrize("command", COMMANDS, ids=lambda words: words[0])
def test_project_file(command: list[str], project: Path) -> None:
    with (project / "iec2mpy.toml").open("a", encoding="utf-8") as file:
        file.write('dialect = "codesys"\n')
    name, *options = command
    assert main([name, str(project), *options]) == 0
    assert main([name, str(project), *options, "--dialect", "strict"]) == 1


def test_source_files(project: Path) -> None:
    source = str(project / "src" / "main.st")
    for name, *options in COMMANDS[0], COMMANDS[2]:
        assert main([name, source, *options]) == 1
        assert main([name, source, *options, "--dialect", "twincat"]) == 0


def test_unknown_dialect(project: Path) -> None:
    assert main(["check", str(project), "--dialect", "step7"]) == 2
