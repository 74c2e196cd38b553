"""Literals: their values, and what is said about malformed ones (6.3)."""

from __future__ import annotations

import pytest

from iec2mpy.syntax import tree
from tests.syntax.trees import errors, pou

MS = 1_000_000
S = 1000 * MS
H = 3600 * S
DAY = 24 * H


def _literal(text: str) -> tree.Literal:
    statement = pou(f"PROGRAM p\nx := {text};\nEND_PROGRAM").body[0]
    assert isinstance(statement, tree.AssignStmt) and isinstance(statement.value, tree.Literal)
    assert statement.value.span.text == text
    return statement.value


@pytest.mark.parametrize(
    ("text", "kind", "value", "prefix"),
    [
        ("0", "int", 0, None),
        ("123_456", "int", 123456, None),
        ("007", "int", 7, None),
        ("2#1111_0000", "int", 0xF0, None),
        ("8#377", "int", 0o377, None),
        ("16#ff_FF", "int", 0xFFFF, None),
        ("INT#-123", "int", -123, "INT"),
        ("uint#16#89AF", "int", 0x89AF, "uint"),
        ("WORD#2#101", "int", 5, "WORD"),
        ("12.0", "real", 12.0, None),
        ("1_000.5", "real", 1000.5, None),
        ("-1.34E-12"[1:], "real", 1.34e-12, None),
        ("1.0e+6", "real", 1e6, None),
        ("REAL#-6.25", "real", -6.25, "REAL"),
        ("TRUE", "bool", True, None),
        ("false", "bool", False, None),
        ("BOOL#1", "bool", True, "BOOL"),
        ("BOOL#FALSE", "bool", False, "BOOL"),
        ("''", "string", "", None),
        ("'it'", "string", "it", None),
        ("'$'$$$0A$N$r$T$p$L\"'", "string", "'$\n\n\r\t\f\n\"", None),
        ("\"$\"$00e4'\"", "wstring", "\"ä'", None),
        ("STRING#'OK'", "string", "OK", "STRING"),
        ('WSTRING#"OK"', "wstring", "OK", "WSTRING"),
        ("WCHAR#'Y'", "wstring", "Y", "WCHAR"),
        ("CHAR#16#41", "string", "A", "CHAR"),
        ("'ä'", "string", "ä", None),
        ("T#14ms", "duration", 14 * MS, "T"),
        ("T#-14ms", "duration", -14 * MS, "T"),
        ("t#14.7s", "duration", 14_700 * MS, "t"),
        ("T#25h15m", "duration", 25 * H + 900 * S, "T"),
        ("TIME#5d_14h_12m_18s_3.5ms", "duration", 5 * DAY + 14 * H + 738 * S + 3_500_000, "TIME"),
        ("LT#5m_30s_500ms_100.1us", "duration", 330 * S + 500 * MS + 100_100, "LT"),
        ("LTIME#34s_345ns", "duration", 34 * S + 345, "LTIME"),
        ("T#1_000ms", "duration", S, "T"),
        ("D#1970-01-02", "date", DAY, "D"),
        ("DATE#2024-02-29", "date", 19782 * DAY, "DATE"),
        ("LD#1969-12-31", "date", -DAY, "LD"),
        ("TOD#15:36:55.36", "tod", 15 * H + (36 * 60 + 55) * S + 360 * MS, "TOD"),
        ("TIME_OF_DAY#00:00:00", "tod", 0, "TIME_OF_DAY"),
        ("DT#1970-01-02-00:00:01.5", "dt", DAY + 1500 * MS, "DT"),
        ("LDATE_AND_TIME#1970-01-01-12:00:00", "dt", 12 * H, "LDATE_AND_TIME"),
    ],
)
def test_value(text: str, kind: str, value: object, prefix: str | None) -> None:
    literal = _literal(text)
    assert (literal.kind, literal.value, literal.prefix) == (kind, value, prefix)
    assert type(literal.value) is type(value)


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("1__000", "E0106"),
        ("1000_", "E0106"),
        ("10 000", "E0106"),
        ("5.", "E0106"),
        (".5", "E0106"),
        ("1e5", "E0106"),
        ("0x1F", "E0106"),
        ("3#12", "E0106"),
        ("2#1012", "E0106"),
        ("8#18", "E0106"),
        ("16#1G", "E0106"),
        ("16#", "E0106"),
        ("16#-1", "E0106"),
        ("16#1__0", "E0106"),
        ("INT#", "E0106"),
        ("INT#5.5", "E0106"),
        ("BYTE#-1", "E0106"),
        ("BOOL#2", "E0106"),
        ("REAL#5", "E0106"),
        ("Colour#", "E0106"),
        ("Colour#IF", "E0106"),
        ("9" * 5000, "E0106"),
        ("INT#" + "9" * 5000, "E0106"),
        ("'abc", "E0103"),
        ("'cost 5$'", "E0103"),
        ("'a$Zb'", "E0107"),
        ("'a$4'", "E0107"),
        ('"a$41"', "E0107"),
        ("\"a$'b\"", "E0107"),
        ("'a$\"b'", "E0107"),
        ("'Привет'", "E0107"),
        ("CHAR#16#141", "E0107"),
        ("STRING#abc", "E0107"),
        ("T#", "E0108"),
        ("T#5", "E0108"),
        ("T#5x", "E0108"),
        ("T#1.5h30m", "E0108"),
        ("T#30m1h", "E0108"),
        ("T#1h1h", "E0108"),
        ("T#1__0s", "E0108"),
        ("T#5s_", "E0108"),
        ("T#" + "9" * 5000 + "s", "E0108"),
        ("D#2024-1", "E0109"),
        ("D#", "E0109"),
        ("TOD#15:36", "E0109"),
        ("DT#2024-01-01", "E0109"),
        ("DT#2024-01-01 12:00:00", "E0109"),
        ("D#2024-13-01", "E0110"),
        ("D#2023-02-29", "E0110"),
        ("D#0000-01-01", "E0110"),
        ("TOD#24:00:00", "E0110"),
        ("TOD#23:60:00", "E0110"),
        ("TOD#23:59:60", "E0110"),
        ("DT#2024-04-31-12:00:00", "E0110"),
    ],
)
def test_malformed_literal_is_reported_once(text: str, code: str) -> None:
    found = errors(f"PROGRAM p\nx := {text};\ny := ;\nEND_PROGRAM")
    assert found[:1] == [(code, 2)]
    assert ("E0119", 3) in found, "what follows is still read"
    assert [line for _, line in found].count(2) == 1


@pytest.mark.parametrize("address", ["%IX0.0", "%i0.1", "%QW3", "%MD48", "%ML1.2.3", "%qx7.5"])
def test_address(address: str) -> None:
    statement = pou(f"PROGRAM p\n{address} := 1;\nEND_PROGRAM").body[0]
    assert isinstance(statement, tree.AssignStmt) and isinstance(statement.target, tree.DirectVariable)
    assert statement.target.text == {"%i0.1": "%IX0.1"}.get(address, address.upper())


@pytest.mark.parametrize("address", ["%KX0", "%QZ3", "%IX", "%MW", "%IXX0"])
def test_malformed_address(address: str) -> None:
    assert ("E0111", 2) in errors(f"PROGRAM p\nx := {address};\nEND_PROGRAM")


@pytest.mark.parametrize(
    ("name", "wrong"),
    [("_MAIN_12V7", False), ("a_b", False), ("LIM__SW5", True), ("LIM_SW5_", True), ("_", True), ("größe", True)],
)
def test_name(name: str, wrong: bool) -> None:
    text = f"PROGRAM p\nVAR\n  {name} : INT;\nEND_VAR\nEND_PROGRAM"
    assert errors(text) == ([("E0105", 3)] if wrong else [])
