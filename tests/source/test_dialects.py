"""The table of dialects, and its page in the user's guide."""

from __future__ import annotations

from pathlib import Path

from iec2mpy.source.dialects import DIALECTS, EXTENSIONS, accepts, with_dialects
from iec2mpy.source.spans import SourceFile

PAGE = Path(__file__).parents[2] / "docs" / "dialects.md"


def test_the_page_lists_each_extension() -> None:
    rows = [line for line in PAGE.read_text(encoding="utf-8").splitlines() if line.startswith("| ")][2:]
    assert rows == [f"| {e.what} | `{e.example}` | {', '.join(e.dialects)} |" for e in EXTENSIONS.values()]


def test_the_standard_has_no_extension() -> None:
    file = SourceFile("a.st", "")
    assert [name for name in EXTENSIONS if accepts(file, name)] == []


def test_each_extension_belongs_to_known_dialects() -> None:
    assert all(extension.dialects and set(extension.dialects) <= set(DIALECTS) for extension in EXTENSIONS.values())


def test_hint() -> None:
    expected = "Write VAR. The dialects codesys and twincat accept it: `--dialect codesys`."
    assert with_dialects("static-variables", "Write VAR.") == expected
