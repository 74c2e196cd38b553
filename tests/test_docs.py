"""The programs in the user's guide compile, and the files that it links to exist."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from iec2mpy.backends.target import VIPER32
from iec2mpy.project.compile import compile_files
from iec2mpy.source.spans import SourceFile

ROOT = Path(__file__).parent.parent
_PAGES = [*ROOT.glob("*.md"), *ROOT.glob("docs/*.md"), *ROOT.glob("examples/*/*.md")]
_PROGRAM = re.compile(r"^```iec\n(.*?)^```", re.MULTILINE | re.DOTALL)
_LINK = re.compile(r"\]\((?!https?:)([^)#]+)[^)]*\)")
_PROGRAMS = [(page, text) for page in _PAGES for text in _PROGRAM.findall(page.read_text(encoding="utf-8"))]


def _name(value: object) -> str:
    return value.name if isinstance(value, Path) else ""


@pytest.mark.parametrize(("page", "text"), _PROGRAMS, ids=_name)
def test_program_compiles(page: Path, text: str) -> None:
    compile_files([SourceFile(page.name, text)], VIPER32)


@pytest.mark.parametrize("page", _PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_links_lead_somewhere(page: Path) -> None:
    for target in _LINK.findall(page.read_text(encoding="utf-8")):
        assert (page.parent / target).exists(), target
