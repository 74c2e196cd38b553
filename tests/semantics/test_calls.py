"""Calls of functions, blocks and standard functions."""

from __future__ import annotations

import pytest

from iec2mpy.semantics.typed import (
    Assign,
    Binary,
    BuiltinCall,
    CallBlock,
    CallFunction,
    Constant,
    Convert,
    FieldRef,
    FunctionCall,
    InOutArgument,
    InputArgument,
    OutputArgument,
    StandardCall,
    Unary,
    VariableRef,
)
from iec2mpy.semantics.types import BOOL, DINT, INT, NO_RESULT, REAL, StringType
from tests.semantics.checking import body_of, check_text, checked, codes, program, value_of

FUNCTIONS = """FUNCTION blend : INT
VAR_INPUT a : INT; b : INT := 7; END_VAR
VAR_OUTPUT low : BOOL; END_VAR
blend := a - b; low := a < b;
END_FUNCTION
FUNCTION note
VAR_INPUT x : INT; END_VAR
VAR_IN_OUT v : INT; END_VAR
v := v + x;
END_FUNCTION
"""
AFTER = FUNCTIONS.count("\n")


def main_body(variables: str, body: str):
    application = checked(FUNCTIONS + program(variables, body))
    return next(pou.body for pou in application.pous if pou.name == "main")


def found(variables: str, body: str) -> list[str]:
    return [code for code, line in codes(FUNCTIONS + program(variables, body)) if line > AFTER]


def test_formal_call() -> None:
    (assign,) = main_body("r : INT; q : BOOL;", "r := blend(low => q, a := 3);")
    call = assign.value
    assert isinstance(call, FunctionCall)
    output, given = call.arguments  # in the order written
    assert isinstance(output, OutputArgument)
    assert isinstance(output.value, VariableRef)
    assert output.value.variable is call.function.variables["low"]
    assert isinstance(given, InputArgument)
    assert given.parameter.name == "a"


def test_non_formal_call_takes_outputs_in_their_place() -> None:
    (assign,) = main_body("r : INT; q : BOOL;", "r := blend(3, 4, q);")
    assert [type(a) for a in assign.value.arguments] == [InputArgument, InputArgument, OutputArgument]


def test_function_as_statement() -> None:
    (statement,) = main_body("n : INT;", "note(x := 5, v := n);")
    assert isinstance(statement, CallFunction)
    assert statement.call.type is NO_RESULT
    assert isinstance(statement.call.arguments[1], InOutArgument)


def test_block_call() -> None:
    (statement,) = body_of("t : TON; q : BOOL; u : USINT;", "t(IN := u > 3, NOT Q => q);")
    assert isinstance(statement, CallBlock)
    assert statement.block.name == "TON"
    output = statement.arguments[1]
    assert isinstance(output, OutputArgument)
    assert isinstance(output.value, Unary)
    assert isinstance(output.value.operand, FieldRef)


def test_output_is_widened_to_its_variable() -> None:
    (statement,) = body_of("c : CTU; d : DINT;", "c(CV => d);")
    output = statement.arguments[0]  # type: ignore[union-attr]
    assert isinstance(output, OutputArgument)
    assert isinstance(output.value, Convert)
    assert output.value.type is DINT


def test_other_names_of_standard_blocks_and_parameters() -> None:
    (statement,) = body_of("f : SR; c : CTU_INT;", "f(SET1 := TRUE, RESET := FALSE);")
    assert isinstance(statement, CallBlock)
    assert [a.parameter.name for a in statement.arguments] == ["S1", "R"]


@pytest.mark.parametrize(
    ("variables", "body", "code"),
    [
        ("r : INT;", "r := blend(c := 4);", "E0401"),
        ("r : INT;", "r := blend(a := 4, a := 5);", "E0402"),
        ("r : INT; q : BOOL;", "r := blend(1, 2, q, 3);", "E0403"),
        ("r : INT;", "r := blend(1);", "E0404"),
        ("n : INT;", "note(x := 5);", "E0405"),
        ("n : INT;", "note(x := 5, v := n + 1);", "E0406"),
        ("n : SINT;", "note(x := 5, v := n);", "E0314"),
        ("r : INT; q : BOOL;", "r := blend(a := 4, low := q);", "E0407"),
        ("r, k : INT;", "r := blend(a => k);", "E0408"),
        ("r, n : INT;", "r := note(1, n);", "E0409"),
        ("t : TON; q : BOOL;", "q := t(IN := TRUE);", "E0409"),
        ("r : INT;", "r();", "E0411"),
        ("r : INT;", "r := blend(1, b := 2);", "E0412"),
        ("r : INT; f : REAL;", "r := blend(a := f);", "E0312"),
        ("r : INT;", "r := blned(1);", "E0207"),
        ("r : INT;", "r := blend.low;", "E0204"),
        ("c : CTU; n : INT;", "c(NOT CV => n);", "E0312"),
        ("c : CTU; n : SINT;", "c(CV => n);", "E0312"),
        ("c : CTU; n : INT;", "n := c.PV;", "E0605"),
        ("c : CTU;", "c.CV := 0;", "E0604"),
        ("c : CTU; n : INT;", "note(1, c.CV);", "E0606"),
        ("t : TON; q : BOOL;", "q := t.M;", "E0204"),
    ],
)
def test_wrong_calls(variables: str, body: str, code: str) -> None:
    assert found(variables, body) == [code]


def test_recursion_names_the_way() -> None:
    text = """FUNCTION a : INT
VAR_INPUT n : INT; END_VAR
a := b(n);
END_FUNCTION
FUNCTION b : INT
VAR_INPUT n : INT; END_VAR
b := a(n);
END_FUNCTION
"""
    _, diagnostics = check_text(text + program("x : INT;", "x := a(1);"))
    assert [(d.code, d.span.line if d.span else 0, d.message) for d in diagnostics.items] == [
        ("E0410", 7, "`a` calls itself through `b`.")
    ]


# ------------------------------------------------------------------------------------------ standard functions


def test_operators_as_functions_are_operators() -> None:
    total = value_of("a, b, c : INT;", "ADD(a, b, c)", "INT")
    assert isinstance(total, Binary)
    assert isinstance(total.left, Binary)
    assert (total.operator, total.left.operator) == ("+", "+")


def test_comparison_of_several() -> None:
    both = value_of("a, b, c : INT;", "GT(a, b, c)", "BOOL")
    assert isinstance(both, Binary)
    assert (both.operator, both.type) == ("AND", BOOL)
    assert isinstance(both.left, Binary)
    assert both.left.operator == ">"


def test_typed_names() -> None:
    quotient = value_of("a, b : INT;", "DIV_REAL(a, b)", "REAL")
    assert isinstance(quotient, Binary)
    assert quotient.type is REAL
    assert isinstance(quotient.left, Convert)
    shift = value_of("w : WORD; n : SINT;", "SHL_WORD(w, n)", "WORD")
    assert isinstance(shift, BuiltinCall)
    assert shift.name == "SHL"
    chosen = value_of("k : INT; r : REAL;", "MUX_INT_REAL(k, 1.0, r)", "REAL")
    assert isinstance(chosen, BuiltinCall)
    assert (chosen.name, chosen.type) == ("MUX", REAL)


def test_arguments_get_a_common_type() -> None:
    largest = value_of("i : INT; d : DINT;", "MAX(i, d, 5)", "DINT")
    assert isinstance(largest, BuiltinCall)
    assert [a.type for a in largest.arguments] == [DINT, DINT, DINT]


def test_left_out_arguments_are_the_default() -> None:
    limited = value_of("i : INT;", "LIMIT(IN := i, MX := 5)", "INT")
    assert isinstance(limited, BuiltinCall)
    assert isinstance(limited.arguments[0], Constant)
    assert [getattr(a, "value", None) for a in limited.arguments] == [0, None, 5]
    gap = value_of("", "MUX_INT(K := 3, IN0 := 1, IN2 := 2, IN4 := 3)", "INT")  # 6.6.2.5.1
    assert isinstance(gap, Constant)
    assert gap.value == 0


def test_move_and_identical_conversions_vanish() -> None:
    assert isinstance(value_of("i : INT;", "MOVE(i)", "INT"), VariableRef)
    assert isinstance(value_of("i : INT;", "INT_TO_INT(i)", "INT"), VariableRef)
    assert isinstance(value_of("i : INT;", "TO_INT(i)", "INT"), VariableRef)


def test_conversions() -> None:
    truncated = value_of("r : REAL;", "TRUNC_INT(r)", "INT")
    assert isinstance(truncated, Convert)
    assert truncated.truncate
    rounded = value_of("r : REAL;", "REAL_TO_INT(r)", "INT")
    assert isinstance(rounded, Convert)
    assert (rounded.type, rounded.truncate) == (INT, False)
    text = value_of("d : DINT;", "DINT_TO_STRING(d)", "STRING")
    assert isinstance(text, Convert)
    assert text.type == StringType()


def test_results_of_strings() -> None:
    part = value_of("s : STRING[10];", "LEFT(s, 3)", "STRING")
    assert isinstance(part, BuiltinCall)
    assert part.type == StringType()
    chosen = value_of("a : STRING[10]; b : STRING[20];", "SEL(TRUE, a, b)", "STRING")
    assert isinstance(chosen, BuiltinCall)
    assert chosen.type == StringType(20)


@pytest.mark.parametrize(
    ("variables", "body", "code"),
    [
        ("i : INT;", "i := SHL(i, 3);", "E0312"),
        ("w : WORD; r : REAL;", "w := SHR(w, r);", "E0312"),
        ("s : STRING; r : REAL;", "r := SQRT(s);", "E0312"),
        ("i : INT; s : STRING;", "i := MAX(i, s);", "E0303"),
        ("i : INT; r : REAL;", "i := ADD_INT(i, r);", "E0312"),
        ("i : INT;", "i := SUB(i, i, i);", "E0403"),
        ("r : REAL;", "r := SIN(r, r);", "E0403"),
        ("s : STRING;", "s := MID(s, 1);", "E0404"),
        ("i : INT;", "i := LIMIT(MIN := 0, IN := i, MX := 5);", "E0401"),
        ("i : INT; r : REAL; k : INT;", "i := MUX(k, r, r);", "E0301"),
        ("i : INT; r : REAL;", "i := INT_TO_DINT(r);", "E0312"),
        ("i : INT;", "i := INT_TO_QINT(i);", "E0207"),
        ("b : BYTE; r : REAL;", "b := TO_BYTE(r);", "E0312"),
        ("s : STRING; r : REAL;", "s := REAL_TO_STRING(r);", "E0916"),
        ("i : INT; d : INT;", "i := INT_TO_WCHAR(d);", "E0301"),
        ("d : DATE; t : TOD;", "t := DATE_TO_TOD(d);", "E0312"),
        ("d : DATE; r : REAL;", "r := DATE_TO_REAL(d);", "E0312"),
        ("d : DATE; b : BOOL;", "b := DATE_TO_BOOL(d);", "E0312"),
        ("d : DATE; y : INT;", "SPLIT_DATE(d, y);", "E0404"),
        ("y, m, d : INT;", "SPLIT_DATE(YEAR => y, MONTH => m);", "E0404"),
        ("d : DATE; r : REAL;", "SPLIT_DATE(IN := d, YEAR => r);", "E0312"),
        ("d : DATE; y : INT;", "SPLIT_DATE(IN := d, YEAR := y);", "E0407"),
        ("d : DATE; y : INT;", "y := SPLIT_DATE(d);", "E0409"),
        ("d : DATE;", "d := CONCAT_DATE(2023, 2, 29);", "E0508"),
        ("d : DATE;", "d := CONCAT_DATE(2023, 2, 'x');", "E0312"),
        ("t : TIME;", "t := __NOW();", "E0105"),
        ("i : INT;", "i := LIMT(0, i, 5);", "E0207"),
    ],
)
def test_wrong_calls_of_standard_functions(variables: str, body: str, code: str) -> None:
    assert [c for c, _ in codes(program(variables, body))][:1] == [code]


def test_a_call_without_effect_is_warned_of() -> None:
    assert codes(program("i : INT;", "ABS(i);")) == [("W0603", 3)]


def test_a_user_function_hides_a_standard_one() -> None:
    text = "FUNCTION LIMIT : INT\nVAR_INPUT x : INT; END_VAR\nLIMIT := x;\nEND_FUNCTION\n"
    application = checked(text + program("i : INT;", "i := LIMIT(5);"))
    assign = application.pous[1].body[0]
    assert isinstance(assign, Assign)
    assert isinstance(assign.value, FunctionCall)


@pytest.mark.parametrize(
    ("call", "code"),
    [
        ("y := ADD(EN := x, IN1 := 1, IN2 := x);", "E0312"),
        ("y := ADD(EN => b, IN1 := 1, IN2 := x);", "E0408"),
        ("y := ADD(ENO := b, IN1 := 1, IN2 := x);", "E0407"),
        ("y := ADD(ENO => b, ENO => c, IN1 := 1, IN2 := x);", "E0402"),
        ("y := ADD(EN := b, EN := b, IN1 := 1, IN2 := x);", "E0402"),
        ("y := ADD(1, x, ENO => b);", "E0412"),
        ("y := blend(1, x, b, EN := b);", "E0412"),
        ("y := ADD(IN1 := 1, IN2 := x, ENO => y);", "E0312"),
        ("y := ADD(IN1 := 1, ENO => b);", "E0404"),
    ],
)
def test_en_and_eno_of_the_wrong_kind(call: str, code: str) -> None:
    text = FUNCTIONS + program("x, y : INT; b, c : BOOL;", call)
    assert codes(text) == [(code, AFTER + 3)]


@pytest.mark.parametrize(
    "declaration",
    ["VAR_INPUT EN : INT; END_VAR", "VAR_OUTPUT en : BOOL; END_VAR", "VAR_INPUT\nENO : BOOL; END_VAR"],
)
def test_en_and_eno_are_declared_in_one_way(declaration: str) -> None:
    text = f"FUNCTION_BLOCK a\n{declaration}\nEND_FUNCTION_BLOCK"
    assert codes(text) == [("E0713", 2 + declaration.count("\n"))]


def test_declared_en_and_eno_take_no_position() -> None:
    text = """FUNCTION f : INT
VAR_INPUT EN : BOOL := TRUE; a : INT; END_VAR
VAR_OUTPUT ENO : BOOL; END_VAR
f := a;
END_FUNCTION
"""
    assert codes(text + program("x : INT;", "x := f(3);")) == []


def test_a_standard_function_for_its_eno_alone() -> None:
    call = body_of("x : INT; b : BOOL;", "DIV(IN1 := 1, IN2 := x, ENO => b);")[0]
    assert isinstance(call, CallFunction) and isinstance(call.call, StandardCall)
    assert codes(program("x : INT; b : BOOL;", "DIV(EN := b, IN1 := 1, IN2 := x);")) == [("W0603", 3)]
