"""`iec2mpy check`: what it looks at, and the three forms of its answer."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from iec2mpy.cli import main

_WRONG = "PROGRAM main\nVAR motor : BOOL; END_VAR\nmoter := TRUE;\nother := 1;\nEND_PROGRAM\n"


@pytest.fixture
def wrong(tmp_path: Path) -> str:
    path = tmp_path / "wrong.st"
    path.write_text(_WRONG, encoding="utf-8")
    return str(path)


def test_text(wrong: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", wrong]) == 1
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.count("error[E0201]") == 2
    assert f"--> {wrong}:3:1" in captured.err
    assert "moter := TRUE;" in captured.err
    assert "^^^^^" in captured.err
    assert "motor" in captured.err.partition("= help:")[2]
    assert "\x1b[" not in captured.err


def test_json(wrong: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", wrong, "--format", "json"]) == 1
    captured = capsys.readouterr()
    assert captured.err == ""
    found = json.loads(captured.out)
    assert [(d["file"], d["line"], d["column"], d["code"], d["about"]) for d in found] == [
        (wrong, 3, 1, "E0201", "name"),
        (wrong, 4, 1, "E0201", "name"),
    ]


def test_sarif(wrong: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", wrong, "--format", "sarif"]) == 1
    log = json.loads(capsys.readouterr().out)
    assert log["version"] == "2.1.0"
    assert [r["ruleId"] for r in log["runs"][0]["results"]] == ["E0201", "E0201"]


def test_files_together_are_one_program(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    block, program = tmp_path / "block.st", tmp_path / "program.st"
    block.write_text("FUNCTION_BLOCK Twice VAR_INPUT x : INT; END_VAR END_FUNCTION_BLOCK\n", encoding="utf-8")
    program.write_text("PROGRAM main VAR t : Twice; END_VAR t(x := 1); END_PROGRAM\n", encoding="utf-8")
    assert main(["check", str(program)]) == 1
    assert "Twice" in capsys.readouterr().err
    assert main(["check", str(program), str(block)]) == 0
    assert capsys.readouterr().out == "No errors.\n"


def test_projects_are_programs_of_their_own(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name in ("one", "two"):
        main(["new", str(tmp_path / name), "--board", "pico"])
    source = tmp_path / "two" / "src" / "main.st"
    source.write_text(source.read_text(encoding="utf-8").replace("%QX0.0", "%QX7.0"), encoding="utf-8")
    capsys.readouterr()
    assert main(["check", str(tmp_path / "one"), str(tmp_path / "two"), "--format", "json"]) == 1
    (found,) = json.loads(capsys.readouterr().out)
    assert found["file"] == str(source)
    assert "has no channel %QX7.0" in found["message"]


def test_warnings_are_no_failure(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "labels.st"
    text = "PROGRAM main\nVAR x, y : INT; END_VAR\nCASE x OF\n1..5: y := 1;\n3: y := 2;\nEND_CASE;\nEND_PROGRAM\n"
    path.write_text(text, encoding="utf-8")
    assert main(["check", str(path)]) == 0
    captured = capsys.readouterr()
    assert "warning[W" in captured.err
    assert captured.out == "No errors, only warnings.\n"


@pytest.mark.parametrize(
    ("content", "code", "said"),
    [
        (None, 2, "There is no file"),
        (b"", 1, "error["),
        (b"PROGRAM main (* never closed", 1, "error[E0102]"),
        (b"PROGRAM main VAR s : STRING := 'open; END_VAR END_PROGRAM", 1, "error[E0103]"),
        (b"PROGRAM main (* gr\xf6\xdfe *) END_PROGRAM", 1, "is not UTF-8"),
        ("PROGRAM main END_PROGRAM".encode("utf-16"), 1, "is UTF-16, not UTF-8"),
        (bytes(range(256)), 1, "error[E0002]"),
    ],
)
def test_unusable_file(content: bytes | None, code: int, said: str, tmp_path: Path, capsys) -> None:
    path = tmp_path / "program.st"
    if content is not None:
        path.write_bytes(content)
    assert main(["check", str(path)]) == code
    assert said in capsys.readouterr().err
