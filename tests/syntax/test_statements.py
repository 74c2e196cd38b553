"""Expressions and statements as trees (7.3.2, 7.3.3)."""

from __future__ import annotations

import pytest

from iec2mpy.syntax import tree
from tests.syntax.trees import body, expression, pou


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("a + b * c", "(+ a (* b c))"),
        ("(a + b) * c", "(* (+ a b) c)"),
        ("a - b - c", "(- (- a b) c)"),
        ("a / b MOD c", "(MOD (/ a b) c)"),
        ("-2 ** 2", "(** (- 2) 2)"),
        ("2 ** -1", "(** 2 (- 1))"),
        ("a ** b ** c", "(** (** a b) c)"),
        ("a OR b XOR c AND d", "(OR a (XOR b (AND c d)))"),
        ("a & b and c", "(AND (AND a b) c)"),
        ("NOT a AND NOT (b)", "(AND (NOT a) (NOT b))"),
        ("a < b = c >= d", "(= (< a b) (>= c d))"),
        ("a <> b OR a <= b", "(OR (<> a b) (<= a b))"),
        ("a + -b", "(+ a (- b))"),
        ("NOT (a OR b)", "(NOT (OR a b))"),
        ("NOT(IN := a)", "NOT(IN:=a)"),
        ("AND(a, b, c) OR XOR(d, e)", "(OR AND(a b c) XOR(d e))"),
        ("MOD(IN1 := a, IN2 := b)", "MOD(IN1:=a IN2:=b)"),
        ("a AND (b)", "(AND a b)"),
        ("f()", "f()"),
        ("a.b[i + 1, j].c", "a.b[(+ i 1) j].c"),
        ("a[1][2].f(x, y).z", "a[1][2].f(x y).z"),
        ("w.3", "w.%X3"),
        ("w.%X3 = s.w.%b1", "(= w.%X3 s.w.%B1)"),
        ("w.%3", "w.%X3"),
        ("Colour#red", "Colour#red"),
        ("%IX0.0 AND NOT %i1.7", "(AND %IX0.0 (NOT %IX1.7))"),
        ("16#FF - T#1s", "(- 255 T#1000000000)"),
    ],
)
def test_expression(text: str, shown: str) -> None:
    assert expression(text) == shown


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("", ""),
        (";;", ""),
        ("x := 1; y[2].z := x;", "x := 1\ny[2].z := x"),
        ("t1(IN := a, PT := T#1s, Q => q, NOT ET => %QW0);", "t1(IN:=a PT:=T#1000000000 Q=>q NOT ET=>%QW0)"),
        ("t1(IN :=, Q =>); a.b();", "t1(IN:= Q=>)\na.b()"),
        ("IF a THEN b := 1; END_IF;", "(if [a: b := 1])"),
        (
            "IF a THEN b := 1; ELSIF c THEN ELSIF d THEN b := 2; c := 3; ELSE b := 4; END_IF;",
            "(if [a: b := 1] [c: ] [d: b := 2 c := 3] [else: b := 4])",
        ),
        ("IF a THEN ELSE END_IF;", "(if [a: ] [else: ])"),
        (
            "CASE n OF 1: a := 1; 2, 4..6, -1: b := 1; c := 2; red: ; Colour#blue, N + 1: f(); ELSE d := 1; END_CASE;",
            "(case n [1: a := 1] [2 4..6 (- 1): b := 1 c := 2] [red: ] [Colour#blue (+ N 1): f()] [else: d := 1])",
        ),
        ("CASE n OF 1: 2: a[1].b := 1; a.b: END_CASE;", "(case n [1: ] [2: a[1].b := 1] [a.b: ])"),
        ("CASE n OF 1: CASE m OF 2: x := 1; END_CASE; 3: x := 2; END_CASE;",
         "(case n [1: (case m [2: x := 1])] [3: x := 2])"),
        ("FOR i := 1 TO n - 1 DO x := i; END_FOR;", "(for i 1 (- n 1) -: x := i)"),
        ("FOR i := 10 TO 0 BY -2 DO EXIT; CONTINUE; END_FOR;", "(for i 10 0 (- 2): exit continue)"),
        ("WHILE a < b DO a := a + 1; END_WHILE;", "(while (< a b): a := (+ a 1))"),
        ("REPEAT a := 1; UNTIL a > b END_REPEAT; RETURN;", "(repeat a := 1 until (> a b))\nreturn"),
        ("if A then B := 1; End_If;", "(if [A: B := 1])"),
        ("step := ld; action := st; task := with; on := priority;",
         "step := ld\naction := st\ntask := with\non := priority"),
        ("x (* a (* nested *) comment *) := /* b /* c */ */ 1 // d\n;", "x := 1"),
        ("{pragma} x := 1; {another one}", "x := 1"),
    ],
)  # fmt: skip
def test_statements(text: str, shown: str) -> None:
    assert body(text) == shown


def test_spans_are_those_of_the_text() -> None:
    unit = pou("PROGRAM p\nx := (a + b) * f(c, -d);\nEND_PROGRAM")
    statement = unit.body[0]
    assert isinstance(statement, tree.AssignStmt) and isinstance(statement.value, tree.BinaryExpr)
    product = statement.value
    assert statement.span.text == "x := (a + b) * f(c, -d)"
    assert (product.left.span.text, product.operator_span.text, product.right.span.text) == ("(a + b)", "*", "f(c, -d)")
    assert (unit.span.text[:9], unit.span.text[-11:], unit.end.line) == ("PROGRAM p", "END_PROGRAM", 3)


def test_parts_of_statements_have_spans() -> None:
    text = "IF a THEN\n  x := 1;\nELSIF b THEN\n  CASE n OF\n    1, 2: y := 2;\n  END_CASE;\nEND_IF;"
    unit = pou(f"PROGRAM p\n{text}\nEND_PROGRAM")
    statement = unit.body[0]
    assert isinstance(statement, tree.IfStmt)
    assert [branch.span.line for branch in statement.branches] == [2, 4]
    case = statement.branches[1].body[0]
    assert isinstance(case, tree.CaseStmt) and case.groups[0].span.text == "1, 2: y := 2"
    assert case.span.text.endswith("END_CASE")
