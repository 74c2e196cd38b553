"""The pages about errors in project files show what is said of them."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from iec2mpy.project.boards import read_board
from iec2mpy.project.config import load_project
from iec2mpy.source.diagnostics import CompileError

_PAGES = Path(__file__).parents[2] / "docs" / "errors"
_EXAMPLE = re.compile(r"## (Wrong|Right)\n\n```toml\n(.*?)```", re.DOTALL)
_EXAMPLES = [
    (page.stem, match[1], match[2])
    for page in sorted(_PAGES.glob("*.md"))
    for match in _EXAMPLE.finditer(page.read_text(encoding="utf-8"))
]


@pytest.mark.parametrize(("code", "which", "text"), _EXAMPLES, ids=[f"{c}-{w}" for c, w, _ in _EXAMPLES])
def test_example(code: str, which: str, text: str, tmp_path: Path) -> None:
    (tmp_path / "src").mkdir()
    (tmp_path / "src" / "main.st").write_text("")
    (tmp_path / "iec2mpy.toml").write_text(text)
    try:
        found = [d.code for d in load_project(tmp_path).warnings]
    except CompileError as error:
        found = [d.code for d in error.diagnostics]
    assert found == ([code] if which == "Wrong" else [])


def test_there_are_examples() -> None:
    assert len(_EXAMPLES) >= 20


def test_example_of_the_page_about_boards(tmp_path: Path) -> None:
    page = (_PAGES.parent / "boards.md").read_text(encoding="utf-8")
    (text,) = re.findall(r"```toml\n(\[project\].*?)```", page, re.DOTALL)
    (tmp_path / "src").mkdir()
    (tmp_path / "src" / "main.st").write_text("")
    (tmp_path / "iec2mpy.toml").write_text(text)
    assert load_project(tmp_path).board.channels["%QX1.0"].label == "pump relay"


def test_board_of_the_page_about_boards(tmp_path: Path) -> None:
    page = (_PAGES.parent / "boards.md").read_text(encoding="utf-8")
    (text,) = re.findall(r"```toml\n(\[board\].*?)```", page, re.DOTALL)
    path = tmp_path / "my_board.toml"
    path.write_text(text)
    assert read_board(path).channels["%QX0.0"].pin == 25
