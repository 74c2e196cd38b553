"""Relative addresses and OVERLAP (6.4.4.7)."""

from __future__ import annotations

import pytest

from iec2mpy.semantics.packing import bit_size, field_offsets
from iec2mpy.semantics.types import StructType
from tests.semantics.checking import checked, codes, program


def _type(fields: str) -> str:
    return f"TYPE S : STRUCT {fields} END_STRUCT; END_TYPE\n"


def test_where_fields_are() -> None:
    fields = "a AT %B2 : INT; b AT %X4.3 : BOOL; c : BOOL; d : DINT; e AT %D12 : REAL; f : BOOL;"
    application = checked(_type(fields) + program("s : S;", ";"))
    t = application.pous[0].variables["s"].type
    assert isinstance(t, StructType)
    assert {f.name: offset for f, offset in field_offsets(t).items()} == {
        "a": 16,
        "b": 35,
        "c": 36,
        "d": 40,
        "e": 96,
        "f": 128,
    }
    assert bit_size(t) == 129
    assert t.storage is None


@pytest.mark.parametrize(
    ("fields", "code"),
    [
        ("a AT %B0 : INT; b AT %B1 : BYTE;", "E0719"),
        ("a AT %X0.3 : ARRAY[0..3] OF BOOL; b AT %X0.6 : BOOL;", "E0719"),
        ("a, b AT %B0 : BYTE;", "E0719"),
        ("a AT %X0.8 : BOOL;", "E0514"),
        ("a AT %X0.1 : BYTE;", "E0711"),
        ("a AT %B0 : STRING[3];", "E0711"),
        ("OVERLAP a AT %B0 : INT; b AT %B0 : STRING[3];", "E0711"),
        ("OVERLAP a AT %B0 : DINT; b AT %B0 : REF_TO INT;", "E0711"),
        ("OVERLAP a AT %B0 : INT := 1; b AT %B0 : WORD;", "E0701"),
        ("a AT %IX0.0 : BOOL;", "E0704"),
        ("a AT %X3 : BOOL;", "E0111"),
        ("a AT %B3.1 : BOOL;", "E0111"),
    ],
)
def test_wrong_structures(fields: str, code: str) -> None:
    assert codes(_type(fields) + program("s : S;", ";")) == [(code, 1)]


@pytest.mark.parametrize("initial", ["S := (i := 1)", "ARRAY[1..2] OF S := [2((i := 1))]"])
def test_no_initial_values_with_overlap(initial: str) -> None:
    text = _type("OVERLAP i AT %B0 : INT; w AT %B0 : WORD;")
    assert codes(text + program(f"s : {initial};", ";")) == [("E0701", 3)]


def test_members_that_overlap_cannot_be_referred_to() -> None:
    text = _type("OVERLAP i AT %B0 : INT; w AT %B0 : WORD;")
    assert codes(text + program("s : S; r : REF_TO INT;", "r := REF(s.i);")) == [("E0608", 4)]
    assert codes(text + program("s : S; r : REF_TO S;", "r := REF(s);")) == []


def test_a_relative_address_is_for_members_only() -> None:
    assert codes(program("a AT %B2 : BYTE;", ";")) == [("E0111", 2)]
    assert codes(program("AT %B2 : BYTE;", ";")) == [("E0111", 2)]
