"""Makes brackets and blocks pair up before the grammar sees them.

What is closed wrongly, or never, is reported here with the place where it was opened, and mended in the list of tokens:
so a missing END_IF costs one message, and the rest is read as it was meant.
"""

from __future__ import annotations

from collections.abc import Iterator

from iec2mpy.source.diagnostics import Diagnostics, Related
from iec2mpy.source.suggest import suggest
from iec2mpy.syntax.keywords import BLOCK_ENDS, KEYWORDS, MISSPELLINGS, SECTION_WORDS
from iec2mpy.syntax.tokens import Token

_DECLARATION_ENDS = dict.fromkeys(SECTION_WORDS, "END_VAR") | {
    "STRUCT": "END_STRUCT", "TYPE": "END_TYPE", "RESOURCE": "END_RESOURCE", "CONFIGURATION": "END_CONFIGURATION",
}  # fmt: skip
_ENDS = BLOCK_ENDS | _DECLARATION_ENDS
_END_WORDS = frozenset(_ENDS.values())
_OPENER_OF = {end: word for word, end in _ENDS.items()} | {"END_VAR": "VAR"}
_CLOSING = {"LPAR": "RPAR", "LSQB": "RSQB"}
_BRACKETS = {"RPAR": ")", "RSQB": "]"}
_BREAKS = frozenset({"SEMICOLON", "THEN", "DO", "OF", "ELSE", "ELSIF", "UNTIL", "$END", *_ENDS, *_END_WORDS})
"""What cannot stand inside of brackets."""

_DEEPENING = frozenset({
    "PLUS", "MINUS", "TIMES", "DIVIDE", "MOD", "POWER", "AND", "OR", "XOR", "EQ", "NE", "LT", "GT", "LE", "GE",
    "DOT", "CARET", "REF_TO",
})  # fmt: skip
_RELEVANT = {"ARRAY"} | _BREAKS | _DEEPENING | {"LPAR", "RPAR", "LSQB", "RSQB", "MISSPELT", "COMMA"}
_STATEMENT_BOUNDARY = frozenset({"SEMICOLON", "THEN", "DO", "ELSE", "REPEAT", "COLON"})
_OPERAND_START = frozenset({"NAME", "LITERAL", "INTEGER", "ENUM_VALUE", "NOT"})
_USED_AS_NAME = frozenset({"ASSIGN", "COLON", "COMMA", "AT", "RPAR"})

DEEPEST_EXPRESSION = 200
"""Operators, brackets and members of one expression that may be nested or chained; later stages are recursive."""
DEEPEST_BLOCK = 50


def join_split_words(tokens: list[Token], diagnostics: Diagnostics) -> list[Token]:
    """`END IF` and `END _IF` become END_IF (6.1.3: keywords have no spaces inside), with a message."""
    if not any(token.type == "MISSPELT" and token.text.upper() == "END" for token in tokens):
        return tokens
    joined: list[Token] = []
    for token in tokens:
        last = joined[-1] if joined else None
        if last is not None and last.type == "MISSPELT" and last.text.upper() == "END":
            word = f"END_{token.text.upper().lstrip('_')}"
            if word in KEYWORDS and last.line == token.line:
                span = last.span.to(token.span)
                diagnostics.add("E0127", f"A keyword has no space inside: `{span.text}`.", span, f"Write `{word}`.")
                joined[-1] = Token(word, span.text, span.start, span.end, span.file)
                continue
        joined.append(token)
    return joined


def balance(tokens: list[Token], diagnostics: Diagnostics, is_body: bool = False) -> list[Token] | None:
    """The tokens, which end with `$END`, with all brackets and blocks closed; None where they nest too deeply."""
    return _Balancer(tokens, diagnostics, is_body).run()


class _Balancer:
    def __init__(self, tokens: list[Token], diagnostics: Diagnostics, is_body: bool) -> None:
        self._tokens = tokens
        self._diagnostics = diagnostics
        self._is_body = is_body
        self._ends = BLOCK_ENDS if is_body else _DECLARATION_ENDS
        self._out: list[Token] = []
        self._brackets: list[Token] = []
        self._blocks: list[Token] = []
        # Operators so far at this level of brackets, and the greatest depth inside of brackets already closed.
        self._depths: list[tuple[int, int]] = []
        self._operators = 0
        self._inner = 0
        self._pairs: list[tuple[Token, Token]] = []  # blocks that were closed, with their END_ word
        self._with_else_if: set[int] = set()  # where those IFs start that have an `ELSE IF`

    def run(self) -> list[Token] | None:
        out, tokens = self._out, self._tokens
        skip = -1
        for at, token in enumerate(tokens):
            kind = token.type
            if kind not in _RELEVANT:
                if kind == "NAME" and self._is_body and tokens[at + 1].type in _OPERAND_START:
                    token = self._misspelt_keyword(token)
                    if token.type in _RELEVANT:
                        self._enter(token, at)
                        continue
                out.append(token)
            elif at != skip:
                if kind == "MISSPELT":
                    token = self._misspelling(token, tokens[at + 1])
                elif kind.isalpha() and kind in KEYWORDS and tokens[at + 1].type == "ASSIGN" and kind != "ELSE":
                    token = self._keyword_as_name(token)
                if not self._enter(token, at) and tokens[at + 1].type == "SEMICOLON":
                    skip = at + 1
            if self._operators + self._inner + len(self._brackets) > DEEPEST_EXPRESSION:
                message = f"This expression has more than {DEEPEST_EXPRESSION} operators or brackets in a row."
                self._diagnostics.add("E0125", message, token.span, "Split it, with a variable for each part.")
                return None
            if len(self._blocks) > DEEPEST_BLOCK:
                self._diagnostics.add(
                    "E0125",
                    f"More than {DEEPEST_BLOCK} statements are nested here.",
                    token.span,
                    "Move inner ones into a function.",
                )
                return None
        return out

    def _enter(self, token: Token, at: int) -> bool:
        """Take one token over, with what must stand before it; False where it is left out."""
        kind = token.type
        if kind in _CLOSING:
            self._brackets.append(token)
            self._depths.append((self._operators + 1, self._inner))
            self._operators = self._inner = 0
        elif kind in _BRACKETS:
            token_or_none = self._close_bracket(token)
            if token_or_none is None:
                return True
            token = token_or_none
        elif kind in _DEEPENING:
            self._operators += 1
        elif kind == "ARRAY" and self._tokens[at + 1].type in ("INTEGER", "NAME", "MINUS"):
            self._out.append(token)
            token = token.inserted_after("LSQB", "[")
            self._diagnostics.add(
                "E0116",
                f"`[` is missing after `{self._out[-1].text}`.",
                self._out[-1].span,
                "Such as `ARRAY[1..5] OF INT`.",
            )
            self._brackets.append(token)
            self._depths.append((self._operators, self._inner))
        elif kind == "COMMA":
            self._inner = max(self._inner, self._operators)
            self._operators = 0
        elif kind in _BREAKS:
            if kind == "SEMICOLON" and self._brackets and self._is_meant_as_comma(at):
                message = f"`;` cannot stand between `{self._brackets[-1].text}` and its partner."
                self._diagnostics.add("E0116", message, token.span, "`,` separates what stands in brackets.")
                self._out.append(token.as_type("COMMA", bad=True))
                return True
            self._close_open_brackets()
            if kind != "OF":
                self._operators = self._inner = 0
            if kind in self._ends:
                if kind == "IF" and self._blocks and self._out[-1].type == "ELSE" and self._out[-1].line == token.line:
                    self._with_else_if |= {self._blocks[-1].start, token.start}
                self._blocks.append(token)
            elif kind in _END_WORDS:
                return self._close_block(token, at)
            elif kind == "$END":
                self._close_blocks_above(0, token)
        self._out.append(token)
        return True

    # ------------------------------------------------------------------------------------------ brackets

    def _close_bracket(self, token: Token) -> Token | None:
        if not self._brackets:
            self._diagnostics.add("E0116", f"`{token.text}` closes a bracket that was never opened.", token.span)
            return None
        opening = self._brackets.pop()
        operators, inner = self._depths.pop()
        self._inner = max(inner, self._operators + self._inner)
        self._operators = operators
        expected = _CLOSING[opening.type]
        if token.type != expected:
            self._diagnostics.add(
                "E0116",
                f"`{opening.text}` is closed by `{_BRACKETS[expected]}`, not by `{token.text}`.",
                token.span,
                related=[Related(opening.span, "opened here")],
            )
            return token.as_type(expected)
        return token

    def _is_meant_as_comma(self, at: int) -> bool:
        """Whether the open brackets of the `;` at this index are closed before the next `;` or keyword."""
        open_brackets = len(self._brackets)
        for token in self._behind(at):
            if token.type in _BREAKS:
                return False
            open_brackets += (token.type in _CLOSING) - (token.type in _BRACKETS)
            if open_brackets == 0:
                return True
        return False

    def _close_open_brackets(self) -> None:
        while self._brackets:
            opening = self._brackets.pop()
            self._depths.pop()
            closing = _BRACKETS[_CLOSING[opening.type]]
            self._diagnostics.add(
                "E0116", f"This `{opening.text}` is never closed: `{closing}` is missing.", opening.span
            )
            self._out.append(self._out[-1].inserted_after(_CLOSING[opening.type], closing))

    # -------------------------------------------------------------------------------------------- blocks

    def _close_block(self, token: Token, at: int) -> bool:
        blocks = self._blocks
        for depth in range(len(blocks) - 1, -1, -1):
            if _ENDS[blocks[depth].type] == token.type:
                self._close_blocks_above(depth + 1, token)
                self._pairs.append((blocks.pop(), token))
                self._out.append(token)
                return True
        if blocks and self._next_end(at) != _ENDS[blocks[-1].type]:
            opener = blocks.pop()
            expected = _ENDS[opener.type]
            message = f"`{opener.text}` is closed by `{expected}`, not by `{token.text}`."
            related = [Related(opener.span, "opened here")]
            self._diagnostics.add("E0115", message, token.span, f"Write `{expected}`.", related)
            self._out.append(token.as_type(expected))
            return True
        self._diagnostics.add(
            "E0115", f"`{token.text}` closes nothing: no `{_OPENER_OF[token.type]}` is open here.", token.span
        )
        return False

    def _behind(self, at: int) -> Iterator[Token]:
        """The tokens behind index `at`, without a copy of them."""
        return (self._tokens[index] for index in range(at + 1, len(self._tokens)))

    def _next_end(self, at: int) -> str | None:
        return next((token.type for token in self._behind(at) if token.type in _END_WORDS), None)

    def _close_blocks_above(self, depth: int, token: Token) -> None:
        """Report and close all blocks that are open above `depth` where `token` stands."""
        while len(self._blocks) > depth:
            opener = self._blocks.pop()
            end = _ENDS[opener.type]
            if not token.bad:
                meant = self._probably_open(opener)
                hint = None
                if meant.start in self._with_else_if:
                    hint = "`ELSE IF` starts a second IF, which needs an END_IF of its own; `ELSIF` does not."
                message = f"`{end}` is missing: this `{meant.text}` of line {meant.line} is never closed."
                self._diagnostics.add("E0114", message, token.span, hint, [Related(meant.span, "opened here")])
            last = self._out[-1]
            self._out.append(last.inserted_after(end, end))
            if end in BLOCK_ENDS.values() or end == "END_STRUCT":
                self._out.append(last.inserted_after("SEMICOLON", ";"))

    def _probably_open(self, opener: Token) -> Token:
        """Which block lacks its end: an inner one of the same kind took the outer one's, if indentation says so."""
        column = opener.span.column
        for inner, end in self._pairs:
            same_kind = inner.start > opener.start and inner.type == opener.type and inner.line < end.line
            if same_kind and end.span.column == column and inner.span.column > column:
                return inner
        return opener

    # ---------------------------------------------------------------------------------------------- words

    def _misspelling(self, token: Token, following: Token) -> Token:
        meant = MISSPELLINGS[token.text.upper()]
        at_start = not self._out or self._out[-1].type in _STATEMENT_BOUNDARY
        fits = following.type in (_OPERAND_START | {"LPAR", "SEMICOLON"}) or following.type in _BREAKS
        if not (self._is_body and meant and at_start and fits) or (
            meant.startswith("END") and following.type == "LPAR"
        ):
            return token.as_type("NAME")
        self._diagnostics.add(
            "E0127", f"`{token.text}` is not a word of this language.", token.span, f"Write `{meant}`."
        )
        return token.as_type(meant)

    def _misspelt_keyword(self, token: Token) -> Token:
        """A name directly before a value, at the start of a statement, can only be a misspelt keyword."""
        if self._out and self._out[-1].type not in _STATEMENT_BOUNDARY:
            return token
        meant = suggest(token.text, (*BLOCK_ENDS, "ELSIF", "ELSE", "RETURN", "UNTIL"))
        if meant is None:
            return token
        self._diagnostics.add(
            "E0127", f"`{token.text}` is not a word of this language.", token.span, f"Did you mean `{meant}`?"
        )
        return token.as_type(meant)

    def _keyword_as_name(self, token: Token) -> Token:
        self._diagnostics.add("E0112", f"`{token.text}` is a keyword and cannot be a name.", token.span)
        return token.as_type("NAME")
