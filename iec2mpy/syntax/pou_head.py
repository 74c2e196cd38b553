"""The head of a POU: its name, the type of a function's result, and what it inherits from."""

from __future__ import annotations

from iec2mpy.syntax.cursor import AFTER_TARGET, NAMES, SECTION_STARTS, SECTION_STOPS, Cursor
from iec2mpy.syntax.keywords import CLASS_WORDS, KEYWORDS
from iec2mpy.syntax.tokens import Token


def name(cursor: Cursor, word: Token) -> Token:
    """The name behind a POU's first word; an empty one, with a message, where there is none."""
    while cursor.token.text.upper() in CLASS_WORDS and cursor.peek().type in NAMES:
        cursor.report("E0904", f"Classes and methods (`{cursor.token.text}`) are not supported yet.", cursor.token.span)
        cursor.take()
    token = cursor.token
    if token.type in NAMES:
        return cursor.take()
    if token.text.upper() in KEYWORDS and token.line == word.line and not token.type.startswith(("VAR", "END")):
        cursor.report("E0112", f"`{token.text}` is a keyword and cannot be a name.", token.span)
        return cursor.take()
    if not token.bad:
        cursor.report("E0119", f"A name is missing after `{word.text}`.", word.span)
    elif token.line == word.line:
        cursor.take()
    return word.inserted_after("NAME", "")


def result_type(cursor: Cursor, word: Token) -> list[Token] | None:
    """The tokens of the type behind a function's `:`, if one is written; what is wrong with this line is reported."""
    tokens: list[Token] | None = None
    if cursor.token.type == "COLON":
        colon = cursor.take()
        if word.type != "FUNCTION":
            message = f"Only a FUNCTION has a type; this is a {word.type}."
            cursor.report("E0121", message, colon.span, "Values go out by VAR_OUTPUT.")
        tokens = _type_tokens(cursor)
        if tokens is None:
            cursor.report("E0119", "The type of the function's result is missing after `:`.", colon.span)
    elif word.type == "FUNCTION" and cursor.token.type in ("ELEMENTARY", "STRING"):
        message = f"`:` is missing before the function's type `{cursor.token.text}`."
        cursor.report("E0119", message, cursor.token.span)
        tokens = _type_tokens(cursor)
    if cursor.token.type == "SEMICOLON" and cursor.peek().type in SECTION_STARTS:
        cursor.report("E0121", f"No `;` stands at the end of a line that starts a {word.text}.", cursor.token.span)
        cursor.take()
    return tokens


_LENGTH = {"LSQB": "RSQB", "LPAR": "RPAR"}


def _type_tokens(cursor: Cursor) -> list[Token] | None:
    """The tokens of a type, ended by `$END`, or None where none is written; the grammar finds what is wrong inside."""
    tokens: list[Token] = []
    while cursor.token.type == "REF_TO":
        tokens.append(cursor.take())
    if cursor.token.type == "ARRAY":
        _take_up_to(cursor, "OF", tokens)
    while cursor.token.type in ("ELEMENTARY", "STRING", *NAMES) and (
        cursor.token.type == "STRING" or cursor.peek().type not in ("ASSIGN", "LPAR")
    ):
        tokens.append(cursor.take())
        if cursor.token.type != "DOT":
            break
        tokens.append(cursor.take())
    if tokens and tokens[-1].type == "STRING" and cursor.token.type in _LENGTH:
        _take_up_to(cursor, _LENGTH[cursor.token.type], tokens)
    return [*tokens, tokens[-1].inserted_after("$END", cursor.token.text)] if tokens else None


def _take_up_to(cursor: Cursor, last: str, tokens: list[Token]) -> None:
    while cursor.token.type not in (last, "SEMICOLON", *SECTION_STOPS):
        tokens.append(cursor.take())
    if cursor.token.type == last:
        tokens.append(cursor.take())


def inheritance(cursor: Cursor) -> None:
    """Skips EXTENDS and IMPLEMENTS with their names."""
    while cursor.token.type in ("EXTENDS", "IMPLEMENTS"):
        word = cursor.take()
        cursor.report("E0904", f"Inheritance (`{word.text}`) is not supported yet.", word.span)
        while cursor.token.type in (*NAMES, "DOT", "COMMA") and cursor.peek().type not in AFTER_TARGET - {"DOT"}:
            cursor.take()
