"""`iec2mpy new`: what it makes works at once."""

from __future__ import annotations

from pathlib import Path

import pytest

from iec2mpy.cli import main
from iec2mpy.project.boards import board_names


@pytest.mark.parametrize("board", board_names())
def test_project_works_at_once(board: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys) -> None:
    folder = tmp_path / "hello"
    assert main(["new", str(folder), "--board", board]) == 0
    assert sorted(str(p.relative_to(folder)) for p in folder.rglob("*") if p.is_file()) == [
        ".gitignore",
        "README.md",
        "iec2mpy.toml",
        "src/main.st",
        "tests/main.toml",
    ]
    monkeypatch.chdir(folder)
    assert main(["check"]) == 0
    assert main(["build"]) == 0
    assert main(["run", "--for", "T#510ms"]) == 0
    assert main(["test", "--engine", "all"]) == 0
    captured = capsys.readouterr()
    assert captured.err == ""
    assert captured.out.splitlines()[-1] == "2 passed, 0 failed"


def test_empty_folder_is_taken(tmp_path: Path) -> None:
    (tmp_path / "hello").mkdir()
    assert main(["new", str(tmp_path / "hello"), "--board", "pico"]) == 0


def test_folder_that_holds_something_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    kept = tmp_path / "hello" / "thesis.txt"
    kept.parent.mkdir()
    kept.write_text("mine", encoding="utf-8")
    assert main(["new", str(kept.parent), "--board", "pico"]) == 2
    assert "hello is not empty" in capsys.readouterr().err
    assert [p.name for p in kept.parent.iterdir()] == ["thesis.txt"]


def test_file_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "hello").write_text("", encoding="utf-8")
    assert main(["new", str(tmp_path / "hello"), "--board", "pico"]) == 2
    assert "hello is a file" in capsys.readouterr().err


@pytest.mark.parametrize("name", ["my project", "1st", "größe", "a.b"])
def test_name(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new", str(tmp_path / name), "--board", "pico"]) == 2
    assert f"`{name}` cannot be the name of a project" in capsys.readouterr().err
    assert not (tmp_path / name).exists()


@pytest.mark.parametrize(("board", "said"), [("pcio", "did you mean `pico`?"), ("zzz", "the boards are")])
def test_unknown_board(board: str, said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new", str(tmp_path / "hello"), "--board", board]) == 2
    assert said in capsys.readouterr().err
    assert not (tmp_path / "hello").exists()
