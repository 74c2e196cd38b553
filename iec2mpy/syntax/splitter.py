"""Splits a file into its declarations, and each POU into its head, its sections of variables and its body.

So each part is read by the grammar that it needs, whichever language a body is in, and an error in one part does not
touch another.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from iec2mpy.source.diagnostics import Diagnostics, Related
from iec2mpy.source.spans import Span
from iec2mpy.syntax.keywords import (
    ACCESS_WORDS,
    CLASS_WORDS,
    CONFIGURATION_WORDS,
    FOREIGN_ENDS,
    KEYWORDS,
    POU_ENDS,
    SECTION_WORDS,
    STATEMENT_WORDS,
)
from iec2mpy.syntax.tokens import Token


@dataclass(frozen=True, slots=True)
class Part:
    """Tokens, ended by `$END`, for one start rule of the grammar: `type_block`, `section`, `configuration`."""

    rule: str
    tokens: list[Token]


@dataclass(frozen=True, slots=True)
class PouPart:
    """A POU: `word` is its first keyword, `end` its last, `result` the tokens of a function's type, if any."""

    word: Token
    name: Token
    result: list[Token] | None
    sections: list[list[Token]]
    body: list[Token]
    end: Token


_POU_END_WORDS = frozenset({*POU_ENDS.values(), "END_METHOD", *FOREIGN_ENDS.values()})
_TOP_WORDS = frozenset({*POU_ENDS, *FOREIGN_ENDS, "TYPE", "CONFIGURATION", "USING"})
_SECTION_STARTS = frozenset(SECTION_WORDS)
_POU_STOPS = _TOP_WORDS | _POU_END_WORDS | {"$END", "VAR_GLOBAL"}
_SECTION_STOPS = (
    _TOP_WORDS
    | _POU_END_WORDS
    | _SECTION_STARTS
    | {"END_TYPE", "METHOD", "RESOURCE", "END_RESOURCE", "END_CONFIGURATION", "$END"}
)
_AFTER_NAME = frozenset({"COLON", "COMMA", "AT", "ASSIGN"})
"""What follows a name where it is declared or assigned to: a keyword before these was meant as a name."""
_AFTER_TARGET = frozenset({"ASSIGN", "LPAR", "DOT", "LSQB", "CARET"})
_NAMES = ("NAME", "MISSPELT")


def split(tokens: list[Token], diagnostics: Diagnostics) -> Iterator[Part | PouPart]:
    """The parts of a file, in their order; what is wrong with its outline goes to `diagnostics`."""
    return _Splitter(tokens, diagnostics).parts()


class _Splitter:
    def __init__(self, tokens: list[Token], diagnostics: Diagnostics) -> None:
        self._tokens = tokens
        self._at = 0
        self._diagnostics = diagnostics

    @property
    def _token(self) -> Token:
        return self._tokens[self._at]

    def _peek(self, distance: int = 1) -> Token:
        return self._tokens[min(self._at + distance, len(self._tokens) - 1)]

    def _take(self) -> Token:
        token = self._tokens[self._at]
        if token.type != "$END":
            self._at += 1
        return token

    def _last(self) -> Token:
        """The last token that was taken."""
        return self._tokens[max(self._at - 1, 0)]

    def parts(self) -> Iterator[Part | PouPart]:
        while self._token.type != "$END":
            kind = self._token.type
            if kind in POU_ENDS:
                yield self._pou()
            elif kind == "TYPE":
                yield Part("type_block", self._types())
            elif kind == "CONFIGURATION":
                yield from self._configuration()
            elif kind == "VAR_GLOBAL":
                yield Part("section", self._section())
            elif kind in ("VAR_ACCESS", "VAR_CONFIG"):
                self._foreign_section()
            elif kind in FOREIGN_ENDS:
                self._foreign_declaration()
            elif kind == "USING":
                self._using()
            elif self._token.text.upper() in CLASS_WORDS and self._peek().type in FOREIGN_ENDS:
                self._take()
            else:
                self._stray()

    # ------------------------------------------------------------------------------- what stands outside

    def _stray(self) -> None:
        """What stands between declarations."""
        token = self._token
        if token.type == "SEMICOLON" and self._at:
            self._report("E0121", f"No `;` stands after `{self._last().text}`.", token.span)
        elif token.type.startswith("END_"):
            self._report("E0115", f"`{token.text}` closes nothing here.", token.span)
        elif token.type in _SECTION_STARTS:
            self._report(
                "E0128",
                f"`{token.text}` stands outside of any program or block.",
                token.span,
                "Only VAR_GLOBAL can stand here.",
            )
            self._section()
            return
        elif not token.bad:
            self._report(
                "E0128",
                f"`{token.text}` stands outside of any program or block.",
                token.span,
                "Statements stand between PROGRAM and END_PROGRAM.",
            )
        self._take()
        while (
            self._token.type not in _TOP_WORDS
            and self._token.type not in _SECTION_STARTS
            and self._token.type != "$END"
        ):
            if self._token.type in _POU_END_WORDS and token.type not in _POU_END_WORDS and token.type != "SEMICOLON":
                self._take()  # the end of what was stray
                return
            if self._token.type in _POU_END_WORDS or token.type == "SEMICOLON":
                return
            self._take()

    def _using(self) -> None:
        self._report("E0905", "Namespaces (`USING`) are not supported yet.", self._token.span)
        while self._token.type not in ("SEMICOLON", "$END") and (
            self._token.type not in _SECTION_STOPS or self._token.type == "USING"
        ):
            self._take()
        if self._token.type == "SEMICOLON":
            self._take()

    def _foreign_declaration(self) -> None:
        """A class, an interface or a namespace: skipped whole."""
        word = self._take()
        if word.type == "NAMESPACE":
            self._report("E0905", "Namespaces are not supported yet.", word.span)
        else:
            what = "Classes" if word.type == "CLASS" else "Interfaces"
            self._report("E0904", f"{what} are not supported yet.", word.span)
        depth = 1
        while depth and self._token.type != "$END":
            kind = self._take().type
            depth += (kind == word.type) - (kind == FOREIGN_ENDS[word.type])

    def _foreign_section(self) -> None:
        word = self._token
        code, what = (
            ("E0907", "Access paths") if word.type == "VAR_ACCESS" else ("E0908", "Addresses that are given later")
        )
        self._report(code, f"{what} (`{word.text}`) are not supported yet.", word.span)
        self._section()

    def _method(self) -> None:
        self._report("E0904", "Methods are not supported yet.", self._token.span)
        while self._token.type not in ("END_METHOD", *POU_ENDS.values(), "$END"):
            self._take()
        if self._token.type == "END_METHOD":
            self._take()

    # ---------------------------------------------------------------------- types, sections, configurations

    def _is_name(self, at: int) -> bool:
        """Whether the keyword at this index is used as a name."""
        following = self._tokens[min(at + 1, len(self._tokens) - 1)].type
        # `VAR AT %QW5 : WORD` is a variable without a name
        return following in _AFTER_NAME and not (following == "AT" and self._tokens[at].type in _SECTION_STARTS)

    def _find(self, end: str, stops: frozenset[str]) -> int:
        """The index of the first `end`, or of the first of `stops` behind the current token."""
        at = self._at + 1
        tokens = self._tokens
        while True:
            kind = tokens[at].type
            if kind == end or kind == "$END" or (kind in stops and not self._is_name(at)):
                return at
            at += 1

    def _slice(self, at: int, end: str) -> list[Token]:
        """The tokens from here to index `at`, with the word `end`, which is reported where it is missing there."""
        opener = self._token
        tokens = self._tokens[self._at : at]
        closing = self._tokens[at]
        self._at = at
        if closing.type == end:
            tokens.append(self._take())
        else:
            self._report_missing(end, opener, closing)
            tokens.append(tokens[-1].inserted_after(end, end))
        tokens.append(tokens[-1].inserted_after("$END", tokens[-1].text))
        return tokens

    def _report_missing(self, end: str, opener: Token, found: Token) -> None:
        if found.bad:
            return
        span = found.span if found.text else self._tokens[-2].span
        self._report(
            "E0114", f"`{end}` is missing: this `{opener.text}` of line {opener.line} is never closed.", span,
            related=[Related(opener.span, "opened here")],
        )  # fmt: skip

    def _types(self) -> list[Token]:
        tokens = self._slice(self._find("END_TYPE", _SECTION_STOPS | {"END_VAR"}), "END_TYPE")
        return _mark_overlap(tokens)

    def _section(self) -> list[Token]:
        at = self._find("END_VAR", _SECTION_STOPS)
        if self._tokens[at].type != "END_VAR":
            at = self._first_statement(at)
        tokens = _mark_overlap(self._slice(at, "END_VAR"))
        for index in range(1, len(tokens) - 1):
            if tokens[index].type not in ("NAME", "CONSTANT", "RETAIN", "NON_RETAIN"):
                break
            if tokens[index].text.upper() in ACCESS_WORDS and tokens[index + 1].type not in _AFTER_NAME:
                tokens[index] = tokens[index].as_type("ACCESS")
        return tokens

    def _first_statement(self, limit: int) -> int:
        """The index of what reads as a statement in a section without END_VAR; at most `limit`."""
        starts = True
        for at in range(self._at + 1, limit):
            token, following = self._tokens[at], self._tokens[at + 1]
            if token.type in STATEMENT_WORDS and following.type not in _AFTER_NAME:
                return at
            if starts and token.type in _NAMES and following.type in _AFTER_TARGET:
                return at
            starts = token.type in ("SEMICOLON", "CONSTANT", "RETAIN", "NON_RETAIN")
        return limit

    def _configuration(self) -> Iterator[Part]:
        """A configuration, without the sections in it that are not supported."""
        opener = self._token
        tokens: list[Token] = [self._take()]
        stops = (_TOP_WORDS - {"PROGRAM"}) | _POU_END_WORDS | {"$END", "END_CONFIGURATION"}
        while self._token.type not in stops or self._is_name(self._at):
            token = self._token
            if token.type in ("VAR_ACCESS", "VAR_CONFIG"):
                self._foreign_section()
                continue
            if token.type == "PROGRAM" and self._peek().type in _NAMES and self._peek(2).type in _SECTION_STARTS:
                break
            if token.type in _SECTION_STARTS:
                tokens += self._section()[:-1]
                continue
            tokens.append(self._configuration_word(self._take(), tokens[-1]))
        if self._token.type == "END_CONFIGURATION":
            tokens.append(self._take())
        else:
            self._report_missing("END_CONFIGURATION", opener, self._token)
            tokens.append(tokens[-1].inserted_after("END_CONFIGURATION", "END_CONFIGURATION"))
        tokens.append(tokens[-1].inserted_after("$END", tokens[-1].text))
        yield Part("configuration", tokens)

    def _configuration_word(self, token: Token, before: Token) -> Token:
        """TASK, ON and WITH are keywords between the names of a configuration, and names elsewhere."""
        word = token.text.upper()
        if token.type != "NAME" or word not in CONFIGURATION_WORDS:
            return token
        if word == "TASK":
            is_word = before.type not in ("TASK", "PROGRAM", "RESOURCE", "COLON", "ASSIGN", "DOT", "WITH")
        else:
            is_word = before.type == "NAME"
        return token.as_type(word) if is_word else token

    # -------------------------------------------------------------------------------------------------- POUs

    def _pou(self) -> PouPart:
        word = self._take()
        name = self._pou_name(word)
        result = self._result(word)
        self._inheritance()
        sections: list[list[Token]] = []
        body: list[Token] = []
        while True:
            kind = self._token.type
            if kind in _SECTION_STARTS and not (body and kind == "VAR_GLOBAL") and not self._is_name(self._at):
                if body:
                    hint = "All sections of variables stand before the first statement."
                    self._report("E0122", f"`{self._token.text}` stands behind statements.", self._token.span, hint)
                if kind in ("VAR_ACCESS", "VAR_CONFIG"):
                    self._foreign_section()
                else:
                    sections.append(self._section())
            elif kind == "METHOD":
                self._method()
            elif kind == "USING":
                self._using()
            elif kind == "SEMICOLON" and self._last().type == "END_VAR" and self._peek().type in _SECTION_STARTS:
                self._report("E0121", "No `;` stands after `END_VAR`.", self._take().span)
            elif kind in _POU_STOPS and not self._is_name(self._at):
                break
            else:
                body.append(self._take())
        end = self._pou_end(word)
        body.append(Token("$END", end.text, end.start, end.end, end.file, None, end.bad))
        return PouPart(word, name, result, sections, body, end)

    def _pou_name(self, word: Token) -> Token:
        while self._token.text.upper() in CLASS_WORDS and self._peek().type in _NAMES:
            self._report(
                "E0904", f"Classes and methods (`{self._token.text}`) are not supported yet.", self._token.span
            )
            self._take()
        token = self._token
        if token.type in _NAMES:
            return self._take()
        if token.text.upper() in KEYWORDS and token.line == word.line and not token.type.startswith(("VAR", "END")):
            self._report("E0112", f"`{token.text}` is a keyword and cannot be a name.", token.span)
            return self._take()
        if not token.bad:
            self._report("E0119", f"A name is missing after `{word.text}`.", word.span)
        elif token.line == word.line:
            self._take()
        return word.inserted_after("NAME", "")

    def _result(self, word: Token) -> list[Token] | None:
        """The tokens of the type behind a function's `:`, if one is written."""
        if self._token.type != "COLON":
            if word.type == "FUNCTION" and self._token.type in ("ELEMENTARY", "STRING"):
                self._report(
                    "E0119", f"`:` is missing before the function's type `{self._token.text}`.", self._token.span
                )
            elif self._token.type == "SEMICOLON" and (
                self._peek().type in _SECTION_STARTS or self._peek().line > self._token.line
            ):
                self._report(
                    "E0121", f"No `;` stands at the end of a line that starts a {word.text}.", self._token.span
                )
                self._take()
                return None
            else:
                return None
        else:
            colon = self._take()
            if word.type != "FUNCTION":
                self._report(
                    "E0121",
                    f"Only a FUNCTION has a type; this is a {word.type}.",
                    colon.span,
                    "Values go out by VAR_OUTPUT.",
                )
        tokens: list[Token] = []
        while self._token.type == "REF_TO":
            tokens.append(self._take())
        if self._token.type == "ARRAY":
            while self._token.type not in ("OF", "SEMICOLON", *_SECTION_STOPS):
                tokens.append(self._take())
            if self._token.type == "OF":
                tokens.append(self._take())
        while self._token.type in ("ELEMENTARY", "STRING", *_NAMES) and self._peek().type not in ("ASSIGN", "LPAR"):
            tokens.append(self._take())
            if self._token.type != "DOT":
                break
            tokens.append(self._take())
        if tokens and tokens[-1].type == "STRING" and self._token.type == "LSQB":
            while self._token.type not in ("RSQB", "SEMICOLON", *_SECTION_STOPS):
                tokens.append(self._take())
            if self._token.type == "RSQB":
                tokens.append(self._take())
        if not tokens:
            self._report("E0119", "The type of the function's result is missing after `:`.", self._last().span)
            return None
        if self._token.type == "SEMICOLON" and self._peek().type in _SECTION_STARTS:
            self._report("E0121", f"No `;` stands at the end of a line that starts a {word.text}.", self._token.span)
            self._take()
        tokens.append(tokens[-1].inserted_after("$END", self._token.text))
        return tokens

    def _inheritance(self) -> None:
        while self._token.type in ("EXTENDS", "IMPLEMENTS"):
            word = self._take()
            self._report("E0904", f"Inheritance (`{word.text}`) is not supported yet.", word.span)
            while self._token.type in (*_NAMES, "DOT", "COMMA") and self._peek().type not in _AFTER_TARGET - {"DOT"}:
                self._take()

    def _pou_end(self, word: Token) -> Token:
        """The END_ word of a POU, or a token in its place."""
        expected = POU_ENDS[word.type]
        token = self._token
        if token.type == expected:
            return self._take()
        if token.type in _POU_END_WORDS:
            message = f"A {word.type} ends with `{expected}`, not with `{token.text}`."
            related = [Related(word.span, f"the {word.type} starts here")]
            self._report("E0115", message, token.span, f"Write `{expected}`.", related)
            return self._take()
        self._report_missing(expected, word, token)
        return self._last().inserted_after(expected, expected)

    def _report(
        self, code: str, message: str, span: Span, hint: str | None = None, related: list[Related] | None = None
    ) -> None:
        self._diagnostics.add(code, message, span, hint, related or ())


def _mark_overlap(tokens: list[Token]) -> list[Token]:
    """OVERLAP is a keyword directly behind STRUCT (table 11), and a name elsewhere."""
    for at in range(1, len(tokens) - 1):
        if (
            tokens[at - 1].type == "STRUCT"
            and tokens[at].text.upper() == "OVERLAP"
            and tokens[at + 1].type not in _AFTER_NAME
        ):
            tokens[at] = tokens[at].as_type("OVERLAP")
    return tokens
