"""Diagnostics are kept once, in the order of files and lines; places have lines and columns."""

from __future__ import annotations

from iec2mpy.source.diagnostics import Diagnostics
from iec2mpy.source.spans import SourceFile, Span


def test_same_code_at_the_same_place_is_kept_once() -> None:
    file = SourceFile("a.st", "abc")
    diagnostics = Diagnostics()
    for message in ("first", "second"):
        diagnostics.add("E0201", message, Span(file, 1, 2))
    diagnostics.add("E0202", "other", Span(file, 1, 2))
    assert [item.message for item in diagnostics.items] == ["first", "other"]


def test_order_is_that_of_files_and_places() -> None:
    a, b = SourceFile("a.st", "abc"), SourceFile("b.st", "abc")
    diagnostics = Diagnostics()
    for span in (Span(b, 0, 1), Span(a, 2, 3), Span(a, 0, 1)):
        diagnostics.add("E0201", "x", span)
    diagnostics.add("E0001", "no place")
    assert [item.span and (item.span.file.path, item.span.start) for item in diagnostics.items] == [
        None,
        ("a.st", 0),
        ("a.st", 2),
        ("b.st", 0),
    ]


def test_warnings_are_no_errors() -> None:
    diagnostics = Diagnostics()
    diagnostics.add("W0831", "careful")
    assert not diagnostics.has_errors
    diagnostics.add("E0001", "wrong")
    assert diagnostics.has_errors


def test_lines_and_columns() -> None:
    file = SourceFile("a.st", "ab\n\ncd")
    assert [file.line_column(offset) for offset in (0, 2, 3, 4, 6)] == [(1, 1), (1, 3), (2, 1), (3, 1), (3, 3)]
    assert [file.line_text(line) for line in (1, 2, 3)] == ["ab", "", "cd"]
    assert Span(file, 0, 1).to(Span(file, 4, 5)).text == "ab\n\nc"
