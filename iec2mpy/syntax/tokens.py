"""Tokens: what the lexer makes of text, and what the parsers read."""

from __future__ import annotations

from iec2mpy.source.spans import SourceFile, Span
from iec2mpy.syntax.tree import Literal


class Token:
    """One token. `type` is the name of its terminal in `st.lark`.

    `value` is what a literal means. `bad`: something was already reported about it; errors that follow from it stay
    silent. (A plain class: one is made for each word of a program, and frozen dataclasses cost twice as much.)
    """

    __slots__ = ("bad", "end", "file", "start", "text", "type", "value")

    def __init__(
        self,
        type: str,
        text: str,
        start: int,
        end: int,
        file: SourceFile,
        value: Literal | None = None,
        bad: bool = False,
    ) -> None:
        self.type = type
        self.text = text
        self.start = start
        self.end = end
        self.file = file
        self.value = value
        self.bad = bad

    def __repr__(self) -> str:
        return f"Token({self.type}, {self.text!r}, {self.start})"

    @property
    def span(self) -> Span:
        return Span(self.file, self.start, self.end)

    @property
    def line(self) -> int:
        return self.file.line_column(self.start)[0]

    def as_type(self, type: str, bad: bool = False) -> Token:
        """The same text, read as another kind of token."""
        return Token(type, self.text, self.start, self.end, self.file, self.value, bad or self.bad)

    def inserted_after(self, type: str, text: str) -> Token:
        """A token that the program lacks, with no width, directly after this one."""
        return Token(type, text, self.end, self.end, self.file, None, True)
