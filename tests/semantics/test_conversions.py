"""Figures 11 and 12: which conversions are implicit, and which types have one in common."""

from __future__ import annotations

import pytest

from iec2mpy.semantics.conversions import common_type, conversion_name, converts_implicitly, joined_type, same_type
from iec2mpy.semantics.types import (
    CHAR,
    DINT,
    ELEMENTARY,
    INT,
    REAL,
    TIME,
    WCHAR,
    AliasType,
    ArrayType,
    ElementaryType,
    Kind,
    StringType,
    StructType,
    SubrangeType,
)

IMPLICIT = {
    "SINT": "INT DINT LINT REAL LREAL",
    "INT": "DINT LINT REAL LREAL",
    "DINT": "LINT LREAL",
    "USINT": "UINT INT UDINT DINT ULINT LINT REAL LREAL",
    "UINT": "UDINT DINT ULINT LINT REAL LREAL",
    "UDINT": "ULINT LINT LREAL",
    "REAL": "LREAL",
    "BOOL": "BYTE WORD DWORD LWORD",
    "BYTE": "WORD DWORD LWORD",
    "WORD": "DWORD LWORD",
    "DWORD": "LWORD",
    "TIME": "LTIME",
    "TOD": "LTOD",
}


@pytest.mark.parametrize("source", ELEMENTARY.values(), ids=str)
def test_figure_12(source: ElementaryType) -> None:
    reached = {t.name for t in ELEMENTARY.values() if converts_implicitly(source, t)}
    assert reached == {source.name, *IMPLICIT.get(source.name, "").split()}


def test_characters_become_strings_of_their_width() -> None:
    assert converts_implicitly(CHAR, StringType(1))
    assert converts_implicitly(WCHAR, StringType(wide=True))
    assert not converts_implicitly(CHAR, StringType(wide=True))
    assert not converts_implicitly(CHAR, WCHAR)
    assert not converts_implicitly(StringType(1), CHAR)
    assert not converts_implicitly(StringType(), StringType(wide=True))
    assert joined_type(CHAR, StringType(3)) == StringType(3)
    assert joined_type(StringType(3), StringType(5)) == StringType(5)
    assert joined_type(StringType(wide=True), CHAR) is None


def test_implicit_conversions_of_integers_keep_every_value() -> None:
    whole = [t for t in ELEMENTARY.values() if t.kind is not Kind.REAL]
    for source in whole:
        for target in whole:
            if converts_implicitly(source, target):
                assert target.low <= source.low
                assert source.high <= target.high


@pytest.mark.parametrize(
    ("a", "b", "common"),
    [
        ("INT", "DINT", "DINT"),
        ("USINT", "SINT", "INT"),
        ("UINT", "INT", "DINT"),
        ("INT", "REAL", "REAL"),
        ("BYTE", "WORD", "WORD"),
        ("DINT", "UDINT", "LINT"),
        ("DINT", "REAL", "LREAL"),
        ("UINT", "ULINT", "ULINT"),
        ("TIME", "LTIME", "LTIME"),
        ("LINT", "ULINT", None),
        ("LINT", "LREAL", None),
        ("TIME", "INT", None),
        ("BOOL", "INT", None),
    ],
)
def test_common_type(a: str, b: str, common: str | None) -> None:
    for left, right in ((a, b), (b, a)):
        found = common_type(ELEMENTARY[left], ELEMENTARY[right])
        assert (found.name if found else None) == common


def test_sameness() -> None:
    speed = AliasType("speed", INT, 5)
    assert same_type(speed, INT)
    assert same_type(ArrayType(speed, ((1, 3),)), ArrayType(INT, ((1, 3),)))
    assert not same_type(ArrayType(INT, ((0, 2),)), ArrayType(INT, ((1, 3),)))
    assert not same_type(SubrangeType("s", INT, 0, 5, 0), INT)
    assert not same_type(StructType("a"), StructType("a"))
    assert not same_type(StringType(5), StringType(6))


def test_names_of_conversions() -> None:
    assert conversion_name(REAL, SubrangeType("percent", INT, 0, 100, 0)) == "REAL_TO_INT"
    assert conversion_name(StringType(10), INT) == "STRING_TO_INT"
    assert conversion_name(TIME, DINT) == "TIME_TO_DINT"
    assert conversion_name(REAL, ELEMENTARY["BYTE"]) is None
    assert conversion_name(StructType("a"), INT) is None
