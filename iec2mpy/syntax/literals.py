"""Literals: what they mean, and what is wrong with those that mean nothing (6.3.2, 6.3.3; tables 5 to 7).

Each reader gives a token with a `Literal`; a malformed one is reported, and still gives a token, marked `bad`, so that
parsing goes on as if it were right.
"""

from __future__ import annotations

import re
from dataclasses import replace

from iec2mpy.source.diagnostics import Diagnostics
from iec2mpy.source.dialects import accepts, with_dialects
from iec2mpy.source.spans import SourceFile, Span
from iec2mpy.syntax import time_literals
from iec2mpy.syntax.keywords import ELEMENTARY_TYPES, KEYWORDS
from iec2mpy.syntax.tokens import Token
from iec2mpy.syntax.tree import Literal

_INTEGER_TYPES = frozenset({"SINT", "INT", "DINT", "LINT", "USINT", "UINT", "UDINT", "ULINT"})
_BIT_STRING_TYPES = frozenset({"BYTE", "WORD", "DWORD", "LWORD"})
_REAL_TYPES = frozenset({"REAL", "LREAL"})
_STRING_TYPES = {"STRING": "'", "CHAR": "'", "WSTRING": '"', "WCHAR": '"'}

_DECIMAL = re.compile(r"\d+(?:_\d+)*\Z")
_REAL = re.compile(r"\d+(?:_\d+)*\.\d+(?:_\d+)*(?:[eE][+-]?\d+(?:_\d+)*)?\Z")
_BASED = re.compile(r"(\d+)#(?:_?[0-9A-Fa-f])+\Z")
_DIGITS = {2: "0 and 1", 8: "0 to 7", 16: "0 to 9 and A to F"}

_LONGEST = 400
"""Characters of the longest number that is read: Python refuses to convert numbers of some thousand digits."""

_NUMBER_CHUNK = re.compile(r"[+-]?\d+#[+-]?\w*|[+-]?\w+(?:\.\d\w*(?:(?<=[eE])[+-]\d\w*)?)?")
_NAME_CHUNK = re.compile(r"[A-Za-z_]\w*")
_STRINGS = {"'": re.compile(r"'(?:[^'$\n]|\$[^\n])*('?)"), '"': re.compile(r'"(?:[^"$\n]|\$[^\n])*("?)')}

_ESCAPES = {"$": "$", "L": "\n", "N": "\n", "P": "\f", "R": "\r", "T": "\t"}
"""Table 7. `$L` and `$N` are both a line feed: it is what ends a line wherever this runs."""


def _literal(
    kind: str,
    value: bool | int | float | str,
    prefix: str | None,
    file: SourceFile,
    start: int,
    end: int,
    bad: bool = False,
) -> Token:
    text = file.text[start:end]
    return Token("LITERAL", text, start, end, file, Literal(kind, value, prefix, Span(file, start, end)), bad)


# ------------------------------------------------------------------------------------------------- numbers


_POINTLESS = re.compile(r"\d+[eE][+-]?\d+\Z", re.ASCII)


def read_number(file: SourceFile, start: int, end: int, diagnostics: Diagnostics) -> Token:
    """An unsigned decimal number without a prefix: INTEGER, or LITERAL for a real one."""
    text = file.text[start:end]
    span = Span(file, start, end)
    if len(text) > _LONGEST:
        diagnostics.add("E0106", f"This number has {len(text)} characters: no type can hold it.", span)
        return Token("INTEGER", text, start, end, file, Literal("int", 0, None, span), True)
    if _DECIMAL.match(text) and text.isascii():
        return Token("INTEGER", text, start, end, file, Literal("int", int(text), None, span))
    if _REAL.match(text) or (_POINTLESS.match(text) and accepts(file, "exponent-without-point")):
        return _literal("real", float(text.replace("_", "")), None, file, start, end)
    _report_number(text, span, diagnostics)
    return Token("INTEGER", text, start, end, file, Literal("int", 0, None, span), True)


def read_based(file: SourceFile, start: int, end: int, diagnostics: Diagnostics) -> Token:
    """`2#1010`, `8#17`, `16#FF`."""
    value = _based_value(file.text[start:end], Span(file, start, end), diagnostics)
    return _literal("int", value or 0, None, file, start, end, value is None)


def _based_value(text: str, span: Span, diagnostics: Diagnostics) -> int | None:
    """The value, or None with a diagnostic."""
    base_text, digits = text.split("#")
    base = int(base_text) if len(base_text) < 3 else 0
    if base not in _DIGITS:
        diagnostics.add("E0106", f"`{text}`: there are numbers of base 2, 8 and 16, not {base_text}.", span)
        return None
    if _BASED.match(text):
        try:
            return int(digits, base)
        except ValueError:
            pass
    if not digits.lstrip("+-"):
        message = f"`{text}`: digits are missing behind `#`."
    elif digits[0] in "+-":
        message = f"`{text}`: no sign can stand behind `{base}#`."
    elif "__" in digits or digits.endswith("_"):
        message = f"`{text}`: one `_` can stand between two digits, not more, and not at the end."
    else:
        message = f"`{text}`: numbers of base {base} have the digits {_DIGITS[base]}."
    diagnostics.add("E0106", message, span)
    return None


def _report_number(text: str, span: Span, diagnostics: Diagnostics) -> None:
    digits = re.match(r"\d+", text)
    assert digits is not None
    rest = text[digits.end() :]
    if text.lower().startswith("0x") or text.lower().startswith("0b"):
        base = "16#" if text[1] in "xX" else "2#"
        diagnostics.add("E0106", f"`{text}` is not how numbers are written here.", span, f"Write `{base}{text[2:]}`.")
    elif "__" in text or text.endswith("_") or "_." in text:
        diagnostics.add("E0106", f"`{text}`: one `_` can stand between two digits, not more, and not at the end.", span)
    elif _POINTLESS.match(text):
        hint = with_dialects("exponent-without-point", f"Write `{digits.group()}.0{rest}`.")
        diagnostics.add("E0106", f"`{text}`: a number with an exponent has a decimal point.", span, hint)
    elif "." in text:
        diagnostics.add("E0106", f"`{text}` is no number of the form `12.5` or `1.5E-3`.", span)
    elif re.fullmatch(r"(?i)d|h|m|s|ms|us|ns", rest):
        diagnostics.add(
            "E0106",
            f"`{text}` is neither a number nor a name.",
            span,
            f"A duration is written `T#{text}`, without spaces.",
        )
    else:
        diagnostics.add("E0106", f"`{text}` is neither a number nor a name: a name starts with a letter or `_`.", span)


# -------------------------------------------------------------------------------------------- with a prefix


def read_prefixed(file: SourceFile, start: int, end: int, diagnostics: Diagnostics) -> tuple[Token, int]:
    """What starts with a name and `#` (which ends at `end`): the token, and where it ends."""
    prefix = file.text[start : end - 1]
    kind = prefix.upper()
    if kind in time_literals.PREFIXES:
        return time_literals.read(file, start, end, prefix, diagnostics)
    if kind in _STRING_TYPES:
        token = _prefixed_string(file, start, end, prefix, diagnostics)
    elif kind in ELEMENTARY_TYPES:
        token = _prefixed_number(file, start, end, prefix, diagnostics)
    else:
        token = _enumerated_value(file, start, end, prefix, diagnostics)
    return token, token.end


def _prefixed_string(file: SourceFile, start: int, at: int, prefix: str, diagnostics: Diagnostics) -> Token:
    """`STRING#'OK'`, `CHAR#'X'`, and by number `CHAR#16#41` (tables 5 and 6)."""
    kind = prefix.upper()
    quote = _STRING_TYPES[kind]
    if file.text[at : at + 1] == quote or (quote == '"' and file.text[at : at + 1] == "'"):
        token = read_string(file, start, at, prefix, diagnostics)
        assert token.value is not None
        if quote == '"':
            token.value = replace(token.value, kind="wstring")
        return token
    number = _NUMBER_CHUNK.match(file.text, at)
    if number and "#" in number.group() and kind.endswith("CHAR"):
        return _character_by_number(file, start, at, number.end(), prefix, diagnostics)
    diagnostics.add(
        "E0107",
        f"Behind `{prefix}#` stands text between {quote} and {quote}.",
        Span(file, start, at),
        f"Write `{prefix}#{quote}…{quote}`.",
    )
    return _literal("string", "", prefix, file, start, at, True)


def _character_by_number(
    file: SourceFile, start: int, at: int, end: int, prefix: str, diagnostics: Diagnostics
) -> Token:
    wide = prefix.upper() == "WCHAR"
    span = Span(file, start, end)
    value = _based_value(file.text[at:end], span, diagnostics)
    bad = value is None
    if value is not None and value > (0xFFFF if wide else 0xFF):
        diagnostics.add("E0107", f"`{span.text}`: no {prefix.upper()} has this number.", span)
        bad = True
    return _literal("wstring" if wide else "string", "" if bad else chr(value or 0), prefix, file, start, end, bad)


def _prefixed_number(file: SourceFile, start: int, at: int, prefix: str, diagnostics: Diagnostics) -> Token:
    found = _NUMBER_CHUNK.match(file.text, at)
    end = found.end() if found else at
    text = file.text[at:end]
    kind = prefix.upper()
    span = Span(file, start, end)
    sign = -1 if text.startswith("-") else 1
    digits = text.lstrip("+-")
    if kind == "BOOL" and digits == text and text.upper() in ("0", "1", "TRUE", "FALSE"):
        return _literal("bool", text.upper() in ("1", "TRUE"), prefix, file, start, end)
    if kind in _REAL_TYPES and _REAL.match(digits):
        return _literal("real", sign * float(digits.replace("_", "")), prefix, file, start, end)
    if kind in _INTEGER_TYPES or (kind in _BIT_STRING_TYPES and digits == text):
        if _DECIMAL.match(digits) and len(digits) < _LONGEST:
            return _literal("int", sign * int(digits), prefix, file, start, end)
        if "#" in digits and digits == text:
            value = _based_value(digits, span, diagnostics)
            return _literal("int", value or 0, prefix, file, start, end, value is None)
    message = f"`{prefix}#{text}` is no {kind} literal." if text else f"The value is missing behind `{prefix}#`."
    hint = None
    if kind == "BOOL":
        hint = "Write `BOOL#TRUE`, `BOOL#FALSE`, `BOOL#1` or `BOOL#0`."
    elif kind in _REAL_TYPES and _DECIMAL.match(digits):
        hint = f"A {kind} literal has a decimal point: `{prefix}#{text}.0`."
    elif kind in _BIT_STRING_TYPES and digits != text:
        hint = "Bit strings have no sign."
    diagnostics.add("E0106", message, span, hint)
    return _literal("int", 0, prefix, file, start, end, True)


def _enumerated_value(file: SourceFile, start: int, at: int, prefix: str, diagnostics: Diagnostics) -> Token:
    """`Colour#red` (6.4.4.2)."""
    found = _NAME_CHUNK.match(file.text, at)
    if found and found.group().upper() not in KEYWORDS:
        return Token("ENUM_VALUE", file.text[start : found.end()], start, found.end(), file)
    end = found.end() if found else at
    if found:
        message = f"`{found.group()}` is a keyword and cannot be a value's name."
    else:
        message = f"The name of a value is missing behind `{prefix}#`."
    diagnostics.add(
        "E0106", message, Span(file, start, end), "A value of an enumeration is written `Colour#red`, without spaces."
    )
    return _literal("int", 0, None, file, start, end, True)


# ------------------------------------------------------------------------------------------------- strings


def read_string(file: SourceFile, start: int, quote_at: int, prefix: str | None, diagnostics: Diagnostics) -> Token:
    """The string whose first quote is at `quote_at`; `start` is that of the literal, prefix included."""
    quote = file.text[quote_at]
    kind = "wstring" if quote == '"' else "string"
    found = _STRINGS[quote].match(file.text, quote_at)
    assert found is not None
    end = found.end()
    if not found.group(1):
        last_line = file.text[quote_at:end]
        hint = (
            f"`${quote}` stands for a quote inside of the string and does not close it."
            if f"${quote}" in last_line
            else None
        )
        diagnostics.add("E0103", f"This string is not closed: `{quote}` is missing.", Span(file, quote_at, end), hint)
        return _literal(kind, "", prefix, file, start, end, True)
    body = file.text[quote_at + 1 : end - 1]
    if "$" not in body and body.isascii():
        return _literal(kind, body, prefix, file, start, end)
    value = _decode(body, quote, Span(file, quote_at + 1, end - 1), diagnostics)
    return _literal(kind, value or "", prefix, file, start, end, value is None)


def _decode(body: str, quote: str, span: Span, diagnostics: Diagnostics) -> str | None:
    """The characters of a string; None, with a diagnostic at the place, where something is wrong (table 7)."""
    width, digits, limit = (4, "four", 0xFFFF) if quote == '"' else (2, "two", 0xFF)
    characters: list[str] = []
    at = 0
    while at < len(body):
        character = body[at]
        if character != "$":
            if ord(character) > limit:
                hint = None if quote == '"' else 'WSTRING, written with `"`, takes characters up to U+FFFF.'
                place = Span(span.file, span.start + at, span.start + at + 1)
                diagnostics.add(
                    "E0107",
                    f"`{character}` does not fit into one character of a {'WSTRING' if width == 4 else 'STRING'}.",
                    place,
                    hint,
                )
                return None
            characters.append(character)
            at += 1
            continue
        following = body[at + 1 : at + 2]
        code = body[at + 1 : at + 1 + width]
        if following == quote:
            characters.append(quote)
            at += 2
        elif following.upper() in _ESCAPES and following:
            characters.append(_ESCAPES[following.upper()])
            at += 2
        elif len(code) == width and re.fullmatch(r"[0-9A-Fa-f]+", code):
            characters.append(chr(int(code, 16)))
            at += 1 + width
        else:
            shown = body[at : at + 2]
            place = Span(span.file, span.start + at, span.start + at + len(shown))
            fitting = f"`$`, `{quote}`, L, N, P, R, T or {digits} hexadecimal digits"
            hint = f"Behind `$` stand {fitting}; a dollar sign itself is `$$`."
            diagnostics.add("E0107", f"`{shown}` means nothing in a string.", place, hint)
            return None
    return "".join(characters)
