"""Statements: loops, selections, and who may write what."""

from __future__ import annotations

import pytest

from iec2mpy.semantics.typed import Assign, Case, Constant, For, If, Repeat, While
from iec2mpy.semantics.types import SINT, USINT
from tests.semantics.checking import body_of, check_text, codes, codes_of, program


def test_if() -> None:
    (statement,) = body_of("b : BOOL; i : INT;", "IF b THEN i := 1; ELSIF i > 3 THEN ; ELSE i := 2; END_IF;")
    assert isinstance(statement, If)
    assert len(statement.branches) == 2
    assert len(statement.otherwise) == 1


def test_case_labels_are_numbers() -> None:
    text = "TYPE Mode : (idle := 4, heating, off := 9); END_TYPE\n"
    application, diagnostics = check_text(
        text + program("m : Mode; i : INT;", "CASE m OF idle, off: i := 1; heating: i := 2; END_CASE;")
    )
    assert diagnostics.items == []
    assert application is not None
    (statement,) = application.pous[0].body
    assert isinstance(statement, Case)
    assert [labels for labels, _ in statement.groups] == [((4, 4), (9, 9)), ((5, 5),)]


def test_case_ranges_and_constants() -> None:
    (statement,) = body_of("i : INT;", "CASE i OF -2..3 + 4: i := 1; 9: ; ELSE i := 2; END_CASE;")
    assert isinstance(statement, Case)
    assert [labels for labels, _ in statement.groups] == [((-2, 7),), ((9, 9),)]


def test_for_is_in_the_type_of_its_control_variable() -> None:
    (statement,) = body_of("s : SINT; n : INT;", "FOR s := 1 TO 10 BY 2 DO n := n + s; END_FOR;")
    assert isinstance(statement, For)
    assert {e.type for e in (statement.start, statement.end, statement.step)} == {SINT}
    (plain,) = body_of("u : USINT;", "FOR u := 1 TO 10 DO ; END_FOR;")
    assert isinstance(plain, For)
    assert isinstance(plain.step, Constant)
    assert (plain.step.value, plain.step.type) == (1, USINT)


def test_loops() -> None:
    loop, until = body_of(
        "i : INT;", "WHILE i < 3 DO i := i + 1; EXIT; END_WHILE; REPEAT CONTINUE; UNTIL TRUE END_REPEAT;"
    )
    assert isinstance(loop, While)
    assert isinstance(until, Repeat)


@pytest.mark.parametrize(
    ("variables", "body", "expected"),
    [
        ("i : INT;", "IF i THEN ; END_IF;", ["E0304"]),
        ("i : INT;", "WHILE i DO ; END_WHILE;", ["E0304"]),
        ("i : INT;", "REPEAT ; UNTIL i END_REPEAT;", ["E0304"]),
        ("r : REAL;", "CASE r OF 1: ; END_CASE;", ["E0308"]),
        ("i : INT;", "CASE i OF 'a': ; END_CASE;", ["E0308"]),
        ("i, k : INT;", "CASE i OF k: ; END_CASE;", ["E0505"]),
        ("i : SINT;", "CASE i OF 200: ; END_CASE;", ["E0501"]),
        ("i : INT;", "CASE i OF 5..1: ; END_CASE;", ["E0506"]),
        ("i : INT;", "CASE i OF 1..3: ; 3: ; END_CASE;", ["W0601"]),
        ("r : REAL;", "FOR r := 0.0 TO 1.0 DO ; END_FOR;", ["E0309"]),
        ("i : INT; d : DINT;", "FOR i := 1 TO d DO ; END_FOR;", ["E0309"]),
        ("i : INT;", "FOR i := 1 TO 9 BY 0 DO ; END_FOR;", ["E0510"]),
        ("i, k : INT;", "FOR i := 1 TO 9 DO FOR k := 1 TO 2 DO i := k; END_FOR; END_FOR;", ["E0602"]),
        ("i : INT;", "FOR i := 1 TO 9 DO FOR i := 1 TO 2 DO ; END_FOR; END_FOR;", ["E0602"]),
        ("i : INT;", "FOR i := 1 TO 9 DO ; END_FOR; i := 3;", []),
        ("i : INT;", "IF TRUE THEN EXIT; END_IF;", ["E0601"]),
        ("i : INT;", "CONTINUE;", ["E0601"]),
        ("i : INT;", "RETURN; i := 2;", ["W0602"]),
        ("q AT %IX0.0 : BOOL;", "q := TRUE;", ["E0604"]),
        ("q : BOOL;", "%IX0.0 := q;", ["E0604"]),
        ("t : TON;", "t.IN := TRUE; t();", []),
        ("a, b : TON;", "a := b;", []),
    ],
)
def test_diagnostics(variables: str, body: str, expected: list[str]) -> None:
    assert codes_of(variables, body) == expected


def test_inputs_are_not_written_inside() -> None:
    block = "FUNCTION_BLOCK B\nVAR_INPUT x : INT; a : ARRAY[0..1] OF INT; END_VAR\nx := 1;\na[0] := 2;\n"
    block += "END_FUNCTION_BLOCK\n"
    assert codes(block + program("b1 : B;", "b1();")) == [("E0604", 3), ("E0604", 4)]


def test_constants_are_not_written() -> None:
    text = "PROGRAM main\nVAR CONSTANT k : ARRAY[0..1] OF INT := [1, 2]; END_VAR\nk[1] := 3;\nEND_PROGRAM\n"
    assert codes(text) == [("E0507", 3)]


def test_a_constant_array_is_read_as_a_variable() -> None:
    text = "PROGRAM main\nVAR CONSTANT k : ARRAY[0..1] OF INT := [1, 2]; END_VAR\n"
    text += "VAR i : INT; END_VAR\ni := k[1];\nEND_PROGRAM\n"
    assert codes(text) == []


def test_unqualified_values_take_the_type_of_their_place() -> None:
    text = "TYPE A : (red, green); B : (blue, red); END_TYPE\n"
    assert codes(text + program("a1 : A; b1 : B;", "a1 := red;\nb1 := red;\nIF a1 = green THEN ; END_IF;")) == []
    assert codes(text + program("a1 : A; b : BOOL;", "b := a1 = red;")) == [("E0205", 4)]
    application, _ = check_text(text + program("a1 : A; b1 : B;", "a1 := red; b1 := red;"))
    assert application is not None
    values = [s.value for s in application.pous[0].body if isinstance(s, Assign)]
    assert [v.value for v in values if isinstance(v, Constant)] == [0, 1]


def test_named_values_are_numbers() -> None:
    text = "TYPE Light : INT (red := 1, amber := 2); END_TYPE\n"
    assert codes(text + program("a : Light; i : INT;", "a := 7;\ni := a + amber;\na := i;")) == []


def test_a_function_that_never_sets_its_result_is_warned_of() -> None:
    text = "FUNCTION f : INT\nVAR_INPUT x : INT; END_VAR\nRETURN;\nEND_FUNCTION\n"
    assert codes(text + program("i : INT;", "i := f(1);")) == [("W0701", 1)]
