"""Diagnostics as people see them."""

from __future__ import annotations

from iec2mpy.source.diagnostics import Diagnostic, Related
from iec2mpy.source.render import render_text
from iec2mpy.source.spans import SourceFile, Span


def _span(file: SourceFile, text: str) -> Span:
    start = file.text.index(text)
    return Span(file, start, start + len(text))


def test_place_hint_and_related_place() -> None:
    file = SourceFile("src/main.st", "PROGRAM main\n" + ";\n" * 8 + "  motor := moter;\nEND_PROGRAM\n")
    related = Related(_span(file, "PROGRAM main"), "declared here")
    diagnostic = Diagnostic(
        "E0201", "`moter` is not declared.", _span(file, "moter"), "Did you mean `motor`?", (related,)
    )
    assert render_text([diagnostic]) == """\
error[E0201]: `moter` is not declared.
  --> src/main.st:10:12
   |
10 |   motor := moter;
   |            ^^^^^
  --> src/main.st:1:1
   |
 1 | PROGRAM main
   | ------------ declared here
   = help: Did you mean `motor`?"""


def test_warning_without_a_place() -> None:
    assert render_text([Diagnostic("W0831", "Pin 0 decides how the chip starts.")]) == (
        "warning[W0831]: Pin 0 decides how the chip starts."
    )


def test_several_are_separated_by_an_empty_line() -> None:
    diagnostics = [Diagnostic("E0001", "There is no file `a.st`."), Diagnostic("E0001", "There is no file `b.st`.")]
    assert render_text(diagnostics).count("\n\n") == 1


def test_tabs_and_wide_characters_keep_the_marks_in_place() -> None:
    file = SourceFile("m.st", "\ts := '日本' + x;\ne\u0301 := y;")
    shown = render_text([Diagnostic("E0201", "a", _span(file, "x")), Diagnostic("E0201", "b", _span(file, "y"))])
    lines = shown.splitlines()
    assert lines[3] == "1 |     s := '日本' + x;"
    assert lines[4] == "  |" + " " * 19 + "^"
    assert lines[10] == "  |" + " " * 6 + "^"


def test_control_characters_are_not_printed() -> None:
    file = SourceFile("m.st", "a \x1b[31m b")
    assert "\x1b" not in render_text([Diagnostic("E0101", "a", _span(file, "b"))])


def test_place_of_several_lines_is_marked_on_its_first() -> None:
    file = SourceFile("m.st", "ab (* c\nd *)\n")
    assert render_text([Diagnostic("E0102", "a", _span(file, "(* c\nd *)"))]).endswith("|    ^^^^")


def test_place_at_the_end_of_an_empty_file() -> None:
    file = SourceFile("m.st", "")
    assert render_text([Diagnostic("E0003", "Empty.", Span(file, 0, 0))]) == "error[E0003]: Empty.\n --> m.st:1:1"


def test_colour_only_when_asked() -> None:
    file = SourceFile("m.st", "x")
    diagnostic = Diagnostic("E0201", "a", _span(file, "x"), "b")
    assert "\x1b[" not in render_text([diagnostic])
    assert "\x1b[" in render_text([diagnostic], colour=True)
