"""`iec2mpy build`: what it writes, and what it says of it."""

from __future__ import annotations

import ast
import json
from pathlib import Path

import pytest

from iec2mpy.cli import main


@pytest.fixture
def project(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Path:
    folder = tmp_path / "hello"
    main(["new", str(folder), "--board", "pico"])
    capsys.readouterr()
    return folder


def test_files(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["build", str(project)]) == 0
    out = capsys.readouterr().out
    built = project / "build"
    for name in ("program.py", "program.mpy", "program.names", "program.map.json", "board.py"):
        size = (built / name).stat().st_size
        assert any(name in line and f"{size:,} bytes" in line for line in out.splitlines()), name
    text = (built / "program.py").read_text(encoding="utf-8")
    ast.parse(text)
    assert "@micropython.viper" in text
    assert (built / "program.mpy").read_bytes()[:2] == b"M\x06"
    paths = [v["path"] for v in json.loads((built / "program.map.json").read_text(encoding="utf-8"))["variables"]]
    assert "main.lamp" in paths
    assert "hello for Raspberry Pi Pico (RP2040), viper code" in out
    assert "slots of V" in out


def test_portable_form_for_another_board(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["build", str(project), "--emitter", "portable", "--board", "esp32_devkit"]) == 0
    assert "(ESP32), portable code" in capsys.readouterr().out
    assert "viper" not in (project / "build" / "program.py").read_text(encoding="utf-8").partition('"""\n')[2]


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("n := n + 1;", "A scan allocates nothing"),
        ("n := n + 1;\nr := r * 2.0;", "first at {source}:4: r := r * 2.0;"),
    ],
)
def test_allocation(body: str, said: str, project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    source = project / "src" / "main.st"
    source.write_text(f"PROGRAM main\nVAR n : INT; r : REAL; END_VAR\n{body}\nEND_PROGRAM\n", encoding="utf-8")
    assert main(["build", str(project)]) == 0
    assert said.format(source=source) in capsys.readouterr().out


def test_error_leaves_no_files(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (project / "src" / "main.st").write_text("PROGRAM main x := 1; END_PROGRAM", encoding="utf-8")
    assert main(["build", str(project)]) == 1
    assert "error[E0201]" in capsys.readouterr().err
    assert not (project / "build").exists()


def test_no_project(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["build", str(tmp_path)]) == 2
    assert "There is no project file" in capsys.readouterr().err


def test_folder_that_cannot_be_written(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (project / "build").write_text("a file is in the way", encoding="utf-8")
    assert main(["build", str(project)]) == 2
    assert "build: File exists" in capsys.readouterr().err
