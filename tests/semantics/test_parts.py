"""Which parts of which variables there are (6.6.1.3)."""

from __future__ import annotations

import pytest

from iec2mpy.semantics.typed import Constant, PartRef
from iec2mpy.semantics.types import BOOL, BYTE, WORD
from tests.semantics.checking import check_text, codes_of, program, value_of


@pytest.mark.parametrize(
    ("expression", "low", "of"),
    [("d.%X31", 31, BOOL), ("d.0", 0, BOOL), ("d.%5", 5, BOOL), ("d.%B3", 24, BYTE), ("d.%w1", 16, WORD)],
)
def test_parts(expression: str, low: int, of: object) -> None:
    part = value_of("d : DWORD;", expression, str(of))
    assert isinstance(part, PartRef)
    assert (part.low, part.type) == (low, of)


def test_a_part_of_a_constant_is_one() -> None:
    value = value_of("END_VAR VAR CONSTANT c : WORD := 16#A1B2; END_VAR VAR", "c.%B1", "BYTE")
    assert isinstance(value, Constant)
    assert value.value == 0xA1


@pytest.mark.parametrize(
    ("body", "code"),
    [
        ("flag := w.%X16;", "E0513"),
        ("b := w.%B2;", "E0513"),
        ("w := w.%W0;", "E0513"),
        ("b := b.%B0;", "E0513"),
        ("flag := i.%X0;", "E0307"),
        ("flag := flag.0;", "E0307"),
        ("flag := %MW10.%X1;", "E0607"),
        ("flag := w.%B1;", "E0301"),
        ("c.%X0 := TRUE;", "E0507"),
        ("flag := nothing.%X0;", "E0201"),
    ],
)
def test_no_parts(body: str, code: str) -> None:
    variables = "flag : BOOL; b : BYTE; w : WORD; i : INT; END_VAR VAR CONSTANT c : BYTE := 3;"
    assert codes_of(variables, body) == [code]


def test_a_part_is_no_in_out() -> None:
    text = """FUNCTION toggle : BOOL
VAR_IN_OUT what : BOOL; END_VAR
what := NOT what;
toggle := what;
END_FUNCTION
"""
    diagnostics = check_text(text + program("w : WORD; x : BOOL;", "x := toggle(w.%X3);"))[1]
    assert [d.code for d in diagnostics.items] == ["E0606"]
