"""Characters and strings of both widths (6.3.3, 6.4.2.2)."""

from __future__ import annotations

import pytest

from iec2mpy.semantics.arithmetic import convert
from iec2mpy.semantics.typed import Binary, CharacterRef, Constant, Convert
from iec2mpy.semantics.types import CHAR, INT, WCHAR, WORD, StringType
from tests.semantics.checking import codes, codes_of, value_of

WIDE = StringType(wide=True)


def test_the_place_of_a_literal_tells_what_it_is() -> None:
    character, text = value_of("", "'A'", "CHAR"), value_of("", "'A'", "STRING")
    assert isinstance(character, Constant)
    assert isinstance(text, Constant)
    assert (character.value, character.type) == (65, CHAR)
    assert (text.value, text.type) == ("A", StringType(1))
    wide = value_of("", "WCHAR#'A'", "WCHAR")
    assert isinstance(wide, Constant)
    assert (wide.value, wide.type) == (65, WCHAR)


def test_a_character_in_a_string() -> None:
    read = value_of("s : STRING[5];", "s[2]", "CHAR")
    assert isinstance(read, CharacterRef)
    assert read.type is CHAR
    converted = value_of("s : STRING[5];", "s[2]", "STRING")
    assert isinstance(converted, Convert)
    assert isinstance(converted.operand, CharacterRef)


def test_characters_are_compared_as_characters() -> None:
    compared = value_of("c : CHAR;", "'x' = c", "BOOL")
    assert isinstance(compared, Binary)
    assert (compared.left.type, compared.right.type) == (CHAR, CHAR)
    as_strings = value_of("c : CHAR;", "c = 'xy'", "BOOL")
    assert isinstance(as_strings, Binary)
    assert isinstance(as_strings.left, Convert)


@pytest.mark.parametrize(
    ("variables", "body", "code"),
    [
        ("c : CHAR;", "c := 'AB';", "E0301"),
        ("c : CHAR;", "c := '';", "E0301"),
        ("c : CHAR;", "c := CHAR#'AB';", "E0301"),
        ("c : CHAR;", 'c := "A";', "E0301"),
        ("c : CHAR; w : WCHAR;", "w := c;", "E0301"),
        ("c : CHAR;", "c := c + 1;", "E0302"),
        ("c : CHAR; n : INT;", "n := c;", "E0301"),
        ("c : CHAR; r : REAL;", "r := CHAR_TO_REAL(c);", "E0312"),
        ("s : STRING[5];", "s[0] := 'A';", "E0502"),
        ("s : STRING[5];", "s[6] := 'A';", "E0502"),
        ("s : STRING[5];", "s[1, 2] := 'A';", "E0306"),
        ("s : STRING[5];", "s[1.5] := 'A';", "E0305"),
        ("s : STRING[5]; w : WCHAR;", "s[1] := w;", "E0301"),
        ("s : STRING; w : WSTRING; b : BOOL;", "b := s = w;", "E0303"),
        ("s : STRING; w : WSTRING;", "w := MAX(w, s);", "E0303"),
        ("c : CHAR;", "c[1] := 'A';", "E0307"),
    ],
)
def test_wrong(variables: str, body: str, code: str) -> None:
    assert codes_of(variables, body) == [code]


def test_an_in_out_takes_no_character() -> None:
    text = "FUNCTION_BLOCK fb VAR_IN_OUT c : CHAR; END_VAR c := 'x'; END_FUNCTION_BLOCK\n"
    text += "PROGRAM main VAR s : STRING; f : fb; END_VAR f(c := s[1]); END_PROGRAM"
    assert [code for code, _ in codes(text)] == ["E0406"]


def test_conversions() -> None:
    assert convert(0x3A9, WCHAR, CHAR) == ord("?")
    assert convert(0x3A9, WCHAR, WORD) == 0x3A9
    assert convert("aΩ", WIDE, StringType()) == "a?"
    assert convert("Ω", WIDE, WCHAR) == 0x3A9
    assert convert("", StringType(), CHAR) == 0
    assert convert(65, CHAR, StringType()) == "A"
    assert convert(65, INT, CHAR) == 65
    assert convert("12", WIDE, INT) == 12
