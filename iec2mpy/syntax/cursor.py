"""A place in the tokens of a file, for whoever splits it into parts."""

from __future__ import annotations

from collections.abc import Iterable

from iec2mpy.source.diagnostics import Diagnostics, Related
from iec2mpy.source.spans import Span
from iec2mpy.syntax.keywords import FOREIGN_ENDS, POU_ENDS, SECTION_WORDS
from iec2mpy.syntax.tokens import Token

POU_END_WORDS = frozenset({*POU_ENDS.values(), "END_METHOD", *FOREIGN_ENDS.values()})
TOP_WORDS = frozenset({*POU_ENDS, *FOREIGN_ENDS, "TYPE", "CONFIGURATION", "USING"})
"""What a declaration starts with."""
SECTION_STARTS = frozenset(SECTION_WORDS)
SECTION_STOPS = (
    TOP_WORDS
    | POU_END_WORDS
    | SECTION_STARTS
    | {"END_TYPE", "METHOD", "RESOURCE", "END_RESOURCE", "END_CONFIGURATION", "$END"}
)
"""What cannot stand in a section of variables."""
AFTER_NAME = frozenset({"COLON", "COMMA", "AT", "ASSIGN"})
"""What follows a name where it is declared or assigned to: a keyword before these was meant as a name."""
AFTER_TARGET = frozenset({"ASSIGN", "LPAR", "DOT", "LSQB", "CARET"})
NAMES = ("NAME", "MISSPELT")


class Cursor:
    def __init__(self, tokens: list[Token], diagnostics: Diagnostics) -> None:
        self.tokens = tokens
        self.at = 0
        self._diagnostics = diagnostics

    @property
    def token(self) -> Token:
        """The token that was not taken yet."""
        return self.tokens[self.at]

    def peek(self, distance: int = 1) -> Token:
        return self.tokens[min(self.at + distance, len(self.tokens) - 1)]

    def take(self) -> Token:
        """The current token; the next one is current then. The end is never passed."""
        token = self.tokens[self.at]
        if token.type != "$END":
            self.at += 1
        return token

    def last(self) -> Token:
        """The last token that was taken."""
        return self.tokens[max(self.at - 1, 0)]

    def report(
        self, code: str, message: str, span: Span, hint: str | None = None, related: Iterable[Related] = ()
    ) -> None:
        self._diagnostics.add(code, message, span, hint, related)

    def is_name(self, at: int) -> bool:
        """Whether the keyword at this index is used as a name."""
        following = self.tokens[min(at + 1, len(self.tokens) - 1)].type
        # `VAR AT %QW5 : WORD` is a variable without a name
        return following in AFTER_NAME and not (following == "AT" and self.tokens[at].type in SECTION_STARTS)

    def find(self, end: str, stops: frozenset[str]) -> int:
        """The index of the first `end`, or of the first of `stops` behind the current token."""
        at = self.at + 1
        tokens = self.tokens
        while True:
            kind = tokens[at].type
            if kind == end or kind == "$END" or (kind in stops and not self.is_name(at)):
                return at
            at += 1

    def slice(self, at: int, end: str) -> list[Token]:
        """The tokens from here to index `at`, with the word `end`, which is reported where it is missing there."""
        opener = self.token
        tokens = self.tokens[self.at : at]
        closing = self.tokens[at]
        self.at = at
        if closing.type == end:
            tokens.append(self.take())
        else:
            self.report_missing(end, opener, closing)
            tokens.append(tokens[-1].inserted_after(end, end))
        tokens.append(tokens[-1].inserted_after("$END", tokens[-1].text))
        return tokens

    def report_missing(self, end: str, opener: Token, found: Token) -> None:
        if found.bad:
            return
        span = found.span if found.text else self.tokens[-2].span
        self.report(
            "E0114", f"`{end}` is missing: this `{opener.text}` of line {opener.line} is never closed.", span,
            related=[Related(opener.span, "opened here")],
        )  # fmt: skip
