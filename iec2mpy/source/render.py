"""Prints diagnostics as text for people: the message, the line with the place marked, and what to do."""

from __future__ import annotations

import unicodedata
from collections.abc import Callable, Iterable

from iec2mpy.source.diagnostics import Diagnostic, Severity
from iec2mpy.source.spans import Span

_TAB = 4
_Style = Callable[[str, str], str]


def render_text(diagnostics: Iterable[Diagnostic], colour: bool = False) -> str:
    """All diagnostics, one after another with an empty line between; without a final line end.

    `colour` puts in ANSI sequences, as terminals take them.
    """
    style = _ansi if colour else _plain
    return "\n\n".join(_render(diagnostic, style) for diagnostic in diagnostics)


def _plain(text: str, _role: str) -> str:
    return text


def _ansi(text: str, role: str) -> str:
    from click import style

    colours = {
        "error": "bright_red",
        "warning": "bright_yellow",
        "margin": "bright_blue",
        "related": "bright_blue",
        "help": "bright_cyan",
    }
    return style(text, fg=colours[role], bold=role != "margin")


def _render(diagnostic: Diagnostic, style: _Style) -> str:
    role = "error" if diagnostic.severity is Severity.ERROR else "warning"
    lines = [f"{style(f'{role}[{diagnostic.code}]', role)}: {diagnostic.message}"]
    spans = [diagnostic.span, *(related.span for related in diagnostic.related)]
    # one width for the line numbers of all excerpts, so that their margins are in one column
    width = max((len(str(span.line)) for span in spans if span is not None), default=0)
    if diagnostic.span is not None:
        lines += _excerpt(diagnostic.span, "^", "", width, role, style)
    for related in diagnostic.related:
        lines += _excerpt(related.span, "-", related.message, width, "related", style)
    if diagnostic.hint is not None:
        lines.append(f"{' ' * (width + 1)}{style('= help', 'help')}: {diagnostic.hint}")
    return "\n".join(lines)


def _excerpt(span: Span, mark: str, label: str, width: int, role: str, style: _Style) -> list[str]:
    """The place, its line, and marks under it; where the place has several lines, under its first one."""
    line, column = span.file.line_column(span.start)
    margin = " " * width
    bar = style("|", "margin")
    location = f"{margin}{style('-->', 'margin')} {span.file.path}:{line}:{column}"
    text = span.file.line_text(line)
    if not text.strip():
        return [location]
    end = min(column - 1 + span.end - span.start, len(text))
    before = _cells(text[: column - 1])
    marked = max(_cells(text[:end]) - before, 1)
    marks = style(mark * marked + (f" {label}" if label else ""), role)
    return [
        location,
        f"{margin} {bar}",
        f"{style(f'{line:>{width}}', 'margin')} {bar} {_expand(text)}",
        f"{margin} {bar} {' ' * before}{marks}",
    ]


def _expand(text: str) -> str:
    """Text with tabs as spaces, and without characters that would move the cursor."""
    shown: list[str] = []
    cells = 0
    for character in text:
        if character == "\t":
            piece = " " * (_TAB - cells % _TAB)
        elif unicodedata.category(character) == "Cc":
            piece = "\N{REPLACEMENT CHARACTER}"
        else:
            piece = character
        shown.append(piece)
        cells += _width(piece)
    return "".join(shown)


def _cells(text: str) -> int:
    """Columns that text takes on a terminal."""
    return _width(_expand(text))


def _width(text: str) -> int:
    return sum(
        0 if unicodedata.combining(character) or unicodedata.category(character) == "Cf"
        else 2 if unicodedata.east_asian_width(character) in "WF"
        else 1
        for character in text
    )  # fmt: skip
