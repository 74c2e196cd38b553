"""Cuts sections of variables and TYPE blocks out of the tokens, and skips what is not supported yet."""

from __future__ import annotations

from iec2mpy.syntax.cursor import AFTER_NAME, AFTER_TARGET, NAMES, SECTION_STOPS, Cursor
from iec2mpy.syntax.keywords import ACCESS_WORDS, FOREIGN_ENDS, POU_ENDS, STATEMENT_WORDS
from iec2mpy.syntax.tokens import Token


def types(cursor: Cursor) -> list[Token]:
    """The tokens of a TYPE block, ended by END_TYPE and `$END`."""
    tokens = cursor.slice(cursor.find("END_TYPE", SECTION_STOPS | {"END_VAR"}), "END_TYPE")
    return _mark_overlap(tokens)


def section(cursor: Cursor) -> list[Token]:
    """The tokens of a section of variables, ended by END_VAR and `$END`. A missing END_VAR is put where statements,
    or whatever cannot stand in a section, start."""
    at = cursor.find("END_VAR", SECTION_STOPS)
    if cursor.tokens[at].type != "END_VAR":
        at = _first_statement(cursor, at)
    tokens = _mark_overlap(cursor.slice(at, "END_VAR"))
    for index in range(1, len(tokens) - 1):
        if tokens[index].type not in ("NAME", "CONSTANT", "RETAIN", "NON_RETAIN"):
            break
        if tokens[index].text.upper() in ACCESS_WORDS and tokens[index + 1].type not in AFTER_NAME:
            tokens[index] = tokens[index].as_type("ACCESS")
    return tokens


def _first_statement(cursor: Cursor, limit: int) -> int:
    """The index of what reads as a statement in a section without END_VAR; at most `limit`."""
    starts = True
    for at in range(cursor.at + 1, limit):
        token, following = cursor.tokens[at], cursor.tokens[at + 1]
        if token.type in STATEMENT_WORDS and following.type not in AFTER_NAME:
            return at
        if starts and token.type in NAMES and following.type in AFTER_TARGET:
            return at
        starts = token.type in ("SEMICOLON", "CONSTANT", "RETAIN", "NON_RETAIN")
    return limit


def _mark_overlap(tokens: list[Token]) -> list[Token]:
    """OVERLAP is a keyword directly behind STRUCT (table 11), and a name elsewhere."""
    for at in range(1, len(tokens) - 1):
        is_first = tokens[at - 1].type == "STRUCT" and tokens[at + 1].type not in AFTER_NAME
        if is_first and tokens[at].text.upper() == "OVERLAP":
            tokens[at] = tokens[at].as_type("OVERLAP")
    return tokens


def using(cursor: Cursor) -> None:
    """Skips a USING directive."""
    cursor.report("E0905", "Namespaces (`USING`) are not supported yet.", cursor.token.span)
    while cursor.token.type not in ("SEMICOLON", "$END") and (
        cursor.token.type not in SECTION_STOPS or cursor.token.type == "USING"
    ):
        cursor.take()
    if cursor.token.type == "SEMICOLON":
        cursor.take()


def foreign_declaration(cursor: Cursor) -> None:
    """A class, an interface or a namespace: skipped whole."""
    word = cursor.take()
    if word.type == "NAMESPACE":
        cursor.report("E0905", "Namespaces are not supported yet.", word.span)
    else:
        what = "Classes" if word.type == "CLASS" else "Interfaces"
        cursor.report("E0904", f"{what} are not supported yet.", word.span)
    depth = 1
    while depth and cursor.token.type != "$END":
        kind = cursor.take().type
        depth += (kind == word.type) - (kind == FOREIGN_ENDS[word.type])


def foreign_section(cursor: Cursor) -> None:
    """Skips VAR_ACCESS or VAR_CONFIG."""
    word = cursor.token
    code, what = ("E0907", "Access paths") if word.type == "VAR_ACCESS" else ("E0908", "Addresses that are given later")
    cursor.report(code, f"{what} (`{word.text}`) are not supported yet.", word.span)
    section(cursor)


def method(cursor: Cursor) -> None:
    """Skips a method."""
    cursor.report("E0904", "Methods are not supported yet.", cursor.token.span)
    while cursor.token.type not in ("END_METHOD", *POU_ENDS.values(), "$END"):
        cursor.take()
    if cursor.token.type == "END_METHOD":
        cursor.take()
