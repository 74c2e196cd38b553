"""Expressions: types, literals, folding, and what is said about wrong ones."""

from __future__ import annotations

import pytest

from iec2mpy.semantics.typed import Binary, Constant, Convert, DirectRef, ElementRef, FieldRef, Unary, VariableRef
from iec2mpy.semantics.types import BOOL, DINT, DWORD, INT, REAL, TIME, WORD, StringType, SubrangeType
from tests.semantics.checking import body_of, check_text, codes, codes_of, program, value_of


@pytest.mark.parametrize(
    ("target", "expression", "value"),
    [
        ("SINT", "60 + 60", 120),
        ("DINT", "60 * 1000", 60000),
        ("REAL", "1 / 2", 0.0),
        ("REAL", "1.0 / 4", 0.25),
        ("INT", "7 / -2", -3),
        ("INT", "-7 MOD 3", -1),
        ("INT", "INT#32767 + 1", -32768),
        ("BOOL", "1", 1),
        ("BOOL", "NOT FALSE", 1),
        ("BYTE", "NOT 16#0F", 0xF0),
        ("WORD", "16#F0 OR 16#0F", 0xFF),
        ("BOOL", "3 > 2", 1),
        ("REAL", "0.1", 0.10000000149011612),
        ("TIME", "T#1s500ms", 1500),
        ("TIME", "T#10ms * 3", 30),
        ("DINT", "SINT#-5", -5),
        ("INT", "REAL_TO_INT(2.5)", 2),
        ("STRING", "CONCAT('ab', 'c')", "abc"),
        ("INT", "LEN('four')", 4),
        ("DWORD", "SHL(DWORD#1, 31)", 0x80000000),
        ("REAL", "2.0 ** 3", 8.0),
        ("INT", "MAX(3, 9, 4)", 9),
        ("SINT", "SEL(TRUE, 1, 2)", 2),
    ],
)
def test_constants_are_folded(target: str, expression: str, value: object) -> None:
    folded = value_of("", expression, target)
    assert isinstance(folded, Constant)
    assert folded.value == value
    assert type(folded.value) is type(value)


def test_operands_get_their_common_type() -> None:
    total = value_of("i : INT; d : DINT;", "i + d", "DINT")
    assert isinstance(total, Binary)
    assert total.type is DINT
    assert isinstance(total.left, Convert)
    assert total.left.type is DINT
    assert isinstance(total.right, VariableRef)


def test_conversion_follows_evaluation() -> None:
    # 6.6.1.6, example 3: the product of two INT is an INT, and is then widened
    product = value_of("i, k : INT;", "i * k", "DINT")
    assert isinstance(product, Convert)
    assert product.operand.type is INT


def test_literals_take_the_type_of_the_other_operand() -> None:
    total = value_of("r : REAL;", "r + 1", "REAL")
    assert isinstance(total, Binary)
    assert total.right == Constant(1.0, REAL, total.right.span)
    wide = value_of("i : INT;", "i + 100000", "DINT")
    assert isinstance(wide, Binary)
    assert wide.type is DINT


def test_time_by_number_keeps_the_number() -> None:
    product = value_of("k : INT;", "T#1s * k", "TIME")
    assert isinstance(product, Binary)
    assert (product.left.type, product.right.type, product.type) == (TIME, INT, TIME)


def test_power_is_calculated_as_real() -> None:
    power = value_of("r : REAL; k : INT;", "r ** k", "REAL")
    assert isinstance(power, Binary)
    assert (power.left.type, power.right.type) == (REAL, REAL)


def test_not_of_a_bit_string() -> None:
    complement = value_of("w : WORD;", "NOT w", "WORD")
    assert isinstance(complement, Unary)
    assert complement.type is WORD


def test_parts() -> None:
    (assign,) = body_of("a : ARRAY[1..3, 0..1] OF TON; t : TIME; i : INT;", "t := a[i, 1].ET;")
    value = assign.value  # type: ignore[union-attr]
    assert isinstance(value, FieldRef)
    assert value.field.name == "ET"
    assert isinstance(value.base, ElementRef)
    assert [index.type for index in value.base.indices] == [INT, INT]


def test_a_subrange_is_used_as_its_base() -> None:
    total = value_of("p : INT (0..9);", "p + 1", "INT")
    assert isinstance(total, Binary)
    assert total.type is INT
    assert isinstance(total.left.type, SubrangeType)


def test_strings_are_cut_where_they_are_stored() -> None:
    cut = value_of("s : STRING[20];", "s", "STRING[5]")
    assert isinstance(cut, Convert)
    assert cut.type == StringType(5)


def test_direct_addresses_are_one_variable_each() -> None:
    first, second = body_of("q, p : BOOL;", "q := %IX0.0; p := %I0.0;")
    assert isinstance(first.value, DirectRef)  # type: ignore[union-attr]
    assert first.value.variable is second.value.variable  # type: ignore[union-attr]
    assert first.value.type is BOOL  # type: ignore[union-attr]
    (word,) = body_of("d : DWORD;", "d := %MD4;")
    assert word.value.type is DWORD  # type: ignore[union-attr]


def test_constants_of_the_program_are_folded() -> None:
    text = "PROGRAM main\nVAR CONSTANT k : INT := 5; END_VAR\nVAR x : INT; END_VAR\nx := k * 2;\nEND_PROGRAM\n"
    application, _ = check_text(text)
    assert application is not None
    assert application.pous[0].body[0].value.value == 10  # type: ignore[union-attr]


@pytest.mark.parametrize(
    ("variables", "body", "code"),
    [
        ("s : SINT;", "s := 200;", "E0501"),
        ("b : BOOL;", "b := 2;", "E0301"),
        ("i : INT; b : BOOL;", "i := b;", "E0301"),
        ("i : INT;", "i := 2.0;", "E0301"),
        ("u : UINT; i : INT;", "u := i;", "E0301"),
        ("w : WORD;", "w := -1;", "E0301"),
        ("t : TIME;", "t := 5;", "E0301"),
        ("i : INT;", "i := i / 0;", "E0503"),
        ("r : REAL;", "r := r / 0;", "E0503"),
        ("r : REAL;", "r := LN(0.0);", "E0508"),
        ("i : SINT;", "i := INT_TO_SINT(300);", "E0508"),
        ("r : REAL;", "r := 1.0E39;", "E0501"),
        ("t : TIME;", "t := T#30d;", "E0501"),
        ("a : ARRAY[1..4] OF INT;", "a[0] := 1;", "E0502"),
        ("p : INT (0..9);", "p := 10;", "E0504"),
        ("b, c : BYTE;", "c := b + b;", "E0302"),
        ("b : BOOL;", "b := -b;", "E0302"),
        ("s : STRING;", "s := s + 'x';", "E0302"),
        ("i : INT; b : BOOL;", "b := i < i < i;", "E0303"),
        ("i : INT; s : STRING; b : BOOL;", "b := s = i;", "E0303"),
        ("l : LINT; r : REAL; b : BOOL;", "b := l > r;", "E0303"),
        ("d : DINT; r : REAL;", "r := d ** 2.0;", "E0301"),
        ("l : LINT; r : LREAL;", "r := l ** 2.0;", "E0302"),
        ("l : ULINT;", "l := -1;", "E0501"),
        ("l : LINT;", "l := 9_223_372_036_854_775_808;", "E0501"),
        ("l : LREAL;", "l := 1.0E309;", "E0501"),
        ("r : REAL; l : LREAL;", "r := l;", "E0301"),
        ("t : TIME; l : LTIME;", "t := l;", "E0301"),
        ("t : TIME;", "t := LT#1s;", "E0301"),
        ("l : LTIME;", "l := LT#300000d;", "E0501"),
        ("w : WORD; b : BOOL;", "b := w = NOT 0;", "E0313"),
        ("i : INT;", "i := i.x;", "E0307"),
        ("t : TON; i : INT;", "i := t;", "E0301"),
    ],
)
def test_wrong_expressions(variables: str, body: str, code: str) -> None:
    assert codes_of(variables, body) == [code]


def test_a_message_names_both_types_and_the_function() -> None:
    _, diagnostics = check_text(program("narrow : SINT; wide : INT;", "narrow := wide;"))
    (found,) = diagnostics.items
    assert found.message == "`narrow` is SINT, but this is INT."
    assert found.hint == "Write INT_TO_SINT(wide)."
    assert found.span is not None
    assert found.span.text == "wide"


def test_one_cause_is_told_once() -> None:
    # what is unknown has no type, so nothing that is done with it is an error of its own
    assert codes_of("a : INT;", "a := (unknown + 1) * 2.5 OR ABS(-unknown);") == ["E0201", "E0201"]
    assert codes_of("a : Sped; b : INT;", "a := 1;\nb := a.x[3] + TRUE;\na(x := 5);") == ["E0203"]


def test_several_errors_in_one_run() -> None:
    text = program("a : INT; b : BOOL;", "a := b;\nb := unknwn;\nEXIT;\nb(1);")
    assert codes(text) == [("E0301", 3), ("E0201", 4), ("E0601", 5), ("E0411", 6)]


def test_suggestions() -> None:
    _, diagnostics = check_text(program("motor_on : BOOL;", "motr_on := TRUE;"))
    assert diagnostics.items[0].hint == "Did you mean `motor_on`?"


def test_a_long_chain_of_operators_is_no_problem() -> None:
    assert codes_of("a : INT;", f"a := {' + '.join(['a'] * 120)};") == []


def test_a_type_that_could_not_be_read_is_no_further_error() -> None:
    assert {c[:3] for c, _ in codes(program("a : ARRAY[0..2]( OF INT; n : INT;", "a[n] := n;"))} == {"E01"}


def test_errors_of_syntax_hide_what_may_follow_from_them() -> None:
    text = "PROGRAM main\nVAR a : INT b : INT; END_VAR\na := 1;\nb := c;\na := TRUE;\nEND_PROGRAM\n"
    found = codes(text)
    assert [code for code, _ in found if code.startswith("E01")] != []
    assert [code for code, _ in found if code in ("E0201", "E0203")] == []
    assert ("E0301", 5) in found
