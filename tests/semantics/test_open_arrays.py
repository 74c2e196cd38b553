"""ARRAY[*]: where it may stand, what it takes, and its limits (6.5.3)."""

from __future__ import annotations

import pytest

from iec2mpy.semantics.typed import Constant
from tests.semantics.checking import codes, codes_of, value_of


def _function(section: str, spec: str, body: str = ";") -> str:
    return f"FUNCTION f\n{section} a : {spec}; END_VAR\n{body}\nEND_FUNCTION\n"


def _program(variables: str, body: str) -> str:
    return f"PROGRAM main\nVAR {variables} END_VAR\n{body}\nEND_PROGRAM\n"


@pytest.mark.parametrize("section", ["VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT"])
def test_functions_have_them_as_parameters(section: str) -> None:
    assert codes(_function(section, "ARRAY[*, *] OF INT")) == []


@pytest.mark.parametrize("section", ["VAR", "VAR_TEMP"])
def test_functions_have_them_nowhere_else(section: str) -> None:
    assert codes(_function(section, "ARRAY[*] OF INT")) == [("E0714", 2)]


@pytest.mark.parametrize(
    ("section", "expected"),
    [("VAR_IN_OUT", []), ("VAR_INPUT", ["E0714"]), ("VAR_OUTPUT", ["E0714"]), ("VAR", ["E0714"])],
)
def test_blocks_have_them_as_in_outs(section: str, expected: list[str]) -> None:
    text = f"FUNCTION_BLOCK f\n{section} a : ARRAY[*] OF INT; END_VAR\n;\nEND_FUNCTION_BLOCK\n"
    assert [code for code, _ in codes(text)] == expected


@pytest.mark.parametrize(
    "text",
    [
        "TYPE T : ARRAY[*] OF INT; END_TYPE\n",
        "TYPE S : STRUCT a : ARRAY[*] OF INT; END_STRUCT; END_TYPE\n",
        "FUNCTION f : ARRAY[*] OF INT\n;\nEND_FUNCTION\n",
        "FUNCTION f VAR_IN_OUT a : ARRAY[*, 1..2] OF INT; END_VAR ; END_FUNCTION\n",
        "FUNCTION f VAR_IN_OUT a : ARRAY[1..2] OF ARRAY[*] OF INT; END_VAR ; END_FUNCTION\n",
        "FUNCTION f VAR_INPUT a : REF_TO ARRAY[*] OF INT; END_VAR ; END_FUNCTION\n",
        "VAR_GLOBAL a : ARRAY[*] OF INT; END_VAR\n",
    ],
)
def test_no_other_array_is_without_limits(text: str) -> None:
    assert codes(text) == [("E0714", 1)]


@pytest.mark.parametrize(
    ("variables", "call", "expected"),
    [
        ("x : ARRAY[1..4] OF INT;", "f(x);", []),
        ("x : ARRAY[0..1] OF ARRAY[2..4] OF INT;", "f(x[1]);", []),
        ("x : ARRAY[1..2, 1..2] OF INT;", "f(x);", ["E0314"]),
        ("x : ARRAY[1..4] OF DINT;", "f(x);", ["E0314"]),
        ("x : INT;", "f(x);", ["E0314"]),
        ("", "f(5);", ["E0406"]),
        ("", "f();", ["E0405"]),
    ],
)
def test_what_they_take(variables: str, call: str, expected: list[str]) -> None:
    text = _function("VAR_IN_OUT", "ARRAY[*] OF INT") + _program(f"{variables} y : INT;", call)
    assert [code for code, _ in codes(text)] == expected


@pytest.mark.parametrize("section", ["VAR_INPUT", "VAR_OUTPUT"])
def test_inputs_and_outputs_are_not_left_out(section: str) -> None:
    text = _function(section, "ARRAY[*] OF INT") + _program("y : INT;", "f();")
    assert [code for code, _ in codes(text)] == ["E0405"]


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("a[1] := 2;", []),
        ("a[1, 2] := 2;", ["E0306"]),
        ("b := a;", ["E0301"]),
        ("a := b;", ["E0301"]),
        ("e := a = b;", ["E0303"]),
        ("i := UPPER_BOUND(a, 1); b[LOWER_BOUND(a, 1)] := 1; s := UPPER_BOUND(a, 1) - i;", []),
        ("i := UPPER_BOUND(a, 2);", ["E0502"]),
        ("i := UPPER_BOUND(a, 0);", ["E0502"]),
        ("i := UPPER_BOUND(i, 1);", ["E0312"]),
        ("i := UPPER_BOUND(a);", ["E0404"]),
        ("i := UPPER_BOUND(a, 1.5);", ["E0312"]),
    ],
)
def test_in_the_body(body: str, expected: list[str]) -> None:
    variables = "VAR b : ARRAY[1..2] OF INT; e : BOOL; i : DINT; s : DINT; END_VAR"
    text = f"FUNCTION f\nVAR_IN_OUT a : ARRAY[*] OF INT; END_VAR\n{variables}\n{body}\nEND_FUNCTION\n"
    assert [code for code, _ in codes(text)] == expected


def test_limits_of_other_arrays_are_constants() -> None:
    value = value_of("a : ARRAY[1..2, -5..7] OF INT;", "LOWER_BOUND(ARR := a, DIM := 2)", "INT")
    assert isinstance(value, Constant) and value.value == -5
    assert codes_of("a : ARRAY[1..300] OF INT; s : SINT;", "s := UPPER_BOUND(a, 1);") == ["E0501"]
