"""Splits a file into its declarations, and each POU into its head, its sections of variables and its body.

So each part is read by the grammar that it needs, whichever language a body is in, and an error in one part does not
touch another.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from iec2mpy.source.diagnostics import Diagnostics, Related
from iec2mpy.syntax import pou_head, sections
from iec2mpy.syntax.cursor import NAMES, POU_END_WORDS, SECTION_STARTS, TOP_WORDS, Cursor
from iec2mpy.syntax.keywords import CLASS_WORDS, CONFIGURATION_WORDS, FOREIGN_ENDS, POU_ENDS
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


_DECLARATION_STARTS = TOP_WORDS | SECTION_STARTS | {"$END"}
_POU_STOPS = TOP_WORDS | POU_END_WORDS | {"$END", "VAR_GLOBAL"}


def split(tokens: list[Token], diagnostics: Diagnostics) -> Iterator[Part | PouPart]:
    """The parts of a file, in their order; what is wrong with its outline goes to `diagnostics`."""
    return _parts(Cursor(tokens, diagnostics))


def _parts(cursor: Cursor) -> Iterator[Part | PouPart]:
    while cursor.token.type != "$END":
        kind = cursor.token.type
        if kind in POU_ENDS:
            yield _pou(cursor)
        elif kind == "TYPE":
            yield Part("type_block", sections.types(cursor))
        elif kind == "CONFIGURATION":
            yield Part("configuration", _configuration(cursor))
        elif kind == "VAR_GLOBAL":
            yield Part("section", sections.section(cursor))
        elif kind in ("VAR_ACCESS", "VAR_CONFIG"):
            sections.foreign_section(cursor)
        elif kind in FOREIGN_ENDS:
            sections.foreign_declaration(cursor)
        elif kind == "USING":
            sections.using(cursor)
        elif cursor.token.text.upper() in CLASS_WORDS and cursor.peek().type in FOREIGN_ENDS:
            cursor.take()
        else:
            _stray(cursor)


def _stray(cursor: Cursor) -> None:
    """What stands between declarations."""
    token = cursor.token
    if token.type == "SEMICOLON" and cursor.at:
        cursor.report("E0121", f"No `;` stands after `{cursor.last().text}`.", token.span)
    elif token.type.startswith("END_"):
        cursor.report("E0115", f"`{token.text}` closes nothing here.", token.span)
    elif token.type in SECTION_STARTS:
        _report_outside(cursor, "Only VAR_GLOBAL can stand here.")
        sections.section(cursor)
        return
    elif not token.bad:
        _report_outside(cursor, "Statements stand between PROGRAM and END_PROGRAM.")
    cursor.take()
    while cursor.token.type not in _DECLARATION_STARTS and cursor.token.type not in POU_END_WORDS:
        cursor.take()
    if cursor.token.type in POU_END_WORDS and token.type not in POU_END_WORDS and token.type != "SEMICOLON":
        cursor.take()  # the end of what was stray


def _report_outside(cursor: Cursor, hint: str) -> None:
    message = f"`{cursor.token.text}` stands outside of any program or block."
    cursor.report("E0128", message, cursor.token.span, hint)


def _configuration(cursor: Cursor) -> list[Token]:
    """A configuration, without the sections in it that are not supported."""
    opener = cursor.token
    tokens: list[Token] = [cursor.take()]
    stops = (TOP_WORDS - {"PROGRAM"}) | POU_END_WORDS | {"$END", "END_CONFIGURATION"}
    while cursor.token.type not in stops or cursor.is_name(cursor.at):
        token = cursor.token
        if token.type in ("VAR_ACCESS", "VAR_CONFIG"):
            sections.foreign_section(cursor)
            continue
        if token.type == "PROGRAM" and cursor.peek().type in NAMES and cursor.peek(2).type in SECTION_STARTS:
            break
        if token.type in SECTION_STARTS:
            tokens += sections.section(cursor)[:-1]
            continue
        tokens.append(_configuration_word(cursor.take(), tokens[-1]))
    if cursor.token.type == "END_CONFIGURATION":
        tokens.append(cursor.take())
    else:
        cursor.report_missing("END_CONFIGURATION", opener, cursor.token)
        tokens.append(tokens[-1].inserted_after("END_CONFIGURATION", "END_CONFIGURATION"))
    tokens.append(tokens[-1].inserted_after("$END", tokens[-1].text))
    return tokens


def _configuration_word(token: Token, before: Token) -> Token:
    """TASK, ON and WITH are keywords between the names of a configuration, and names elsewhere."""
    word = token.text.upper()
    if token.type != "NAME" or word not in CONFIGURATION_WORDS:
        return token
    if word == "TASK":
        is_word = before.type not in ("TASK", "PROGRAM", "RESOURCE", "COLON", "ASSIGN", "DOT", "WITH")
    else:
        is_word = before.type == "NAME"
    return token.as_type(word) if is_word else token


def _pou(cursor: Cursor) -> PouPart:
    word = cursor.take()
    name = pou_head.name(cursor, word)
    result = pou_head.result_type(cursor, word)
    pou_head.inheritance(cursor)
    variables: list[list[Token]] = []
    body: list[Token] = []
    while True:
        kind = cursor.token.type
        if kind in SECTION_STARTS and not (body and kind == "VAR_GLOBAL") and not cursor.is_name(cursor.at):
            if body:
                hint = "All sections of variables stand before the first statement."
                cursor.report("E0122", f"`{cursor.token.text}` stands behind statements.", cursor.token.span, hint)
            if kind in ("VAR_ACCESS", "VAR_CONFIG"):
                sections.foreign_section(cursor)
            else:
                variables.append(sections.section(cursor))
        elif kind == "METHOD":
            sections.method(cursor)
        elif kind == "USING":
            sections.using(cursor)
        elif kind == "SEMICOLON" and cursor.last().type == "END_VAR" and cursor.peek().type in SECTION_STARTS:
            cursor.report("E0121", "No `;` stands after `END_VAR`.", cursor.take().span)
        elif kind in _POU_STOPS and not cursor.is_name(cursor.at):
            break
        else:
            body.append(cursor.take())
    end = _pou_end(cursor, word)
    body.append(Token("$END", end.text, end.start, end.end, end.file, None, end.bad))
    return PouPart(word, name, result, variables, body, end)


def _pou_end(cursor: Cursor, word: Token) -> Token:
    """The END_ word of a POU, or a token in its place."""
    expected = POU_ENDS[word.type]
    token = cursor.token
    if token.type == expected:
        return cursor.take()
    if token.type in POU_END_WORDS:
        message = f"A {word.type} ends with `{expected}`, not with `{token.text}`."
        related = [Related(word.span, f"the {word.type} starts here")]
        cursor.report("E0115", message, token.span, f"Write `{expected}`.", related)
        return cursor.take()
    cursor.report_missing(expected, word, token)
    return cursor.last().inserted_after(expected, expected)
