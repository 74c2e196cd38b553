"""Each code has a page in `docs/errors/`; its wrong program gives that code, and its right one does not."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from iec2mpy.project.compile import check_files
from iec2mpy.source.codes import CODES
from iec2mpy.source.diagnostics import CompileError
from iec2mpy.source.spans import SourceFile

_FOLDER = Path(__file__).parent.parent / "docs" / "errors"
_PAGES = sorted(_FOLDER.glob("*.md"))
_INTERVAL_US = 10_000


def _programs(page: Path) -> dict[str, str]:
    """The program under each heading of a page, `Wrong` and `Right`."""
    return dict(re.findall(r"^## (Wrong|Right)\n\n```iec\n(.*?)^```$", page.read_text(encoding="utf-8"), re.M | re.S))


_WITH_PROGRAMS = [page for page in _PAGES if _programs(page)]


def _codes(text: str) -> list[str]:
    try:
        found = check_files([SourceFile("main.st", text)], _INTERVAL_US).warnings
    except CompileError as error:
        found = error.diagnostics
    return [diagnostic.code for diagnostic in found]


def test_every_code_has_a_page() -> None:
    assert [page.stem for page in _PAGES] == sorted(CODES)


@pytest.mark.parametrize("page", _PAGES, ids=lambda page: page.stem)
def test_page_has_the_title_of_its_code(page: Path) -> None:
    assert page.read_text(encoding="utf-8").splitlines()[0] == f"# {page.stem}: {CODES[page.stem].title}"


@pytest.mark.parametrize("page", _WITH_PROGRAMS, ids=lambda page: page.stem)
def test_wrong_program_gives_the_code(page: Path) -> None:
    assert page.stem in _codes(_programs(page)["Wrong"])


@pytest.mark.parametrize("page", _WITH_PROGRAMS, ids=lambda page: page.stem)
def test_right_program_is_right(page: Path) -> None:
    """Only what the language has and this compiler does not, such as DATE, may be wrong with it."""
    codes = _codes(_programs(page)["Right"])
    assert page.stem not in codes
    assert [code for code in codes if code.startswith("E") and not code.startswith("E09")] == []
