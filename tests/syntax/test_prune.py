"""What could not be read whole is not in the tree, so that no later stage finds fault with it."""

from __future__ import annotations

import pytest

from iec2mpy.syntax import tree
from tests.syntax.trees import parse_text, show


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("a := 1; b := ; c := 2;", "a := 1|c := 2"),
        ("a := b ? 1 : 2; c := 2;", "c := 2"),
        ("a := 5m; b := 'x\n; c := 2;", "c := 2"),
        ("a := %KX0; c := 2;", "c := 2"),
        ("IF a THEN b := 1 + ; c := 2; ELSE d := ; END_IF;", "(if [a: c := 2] [else: ])"),
        ("IF a > THEN b := 1; END_IF; c := 2;", "c := 2"),
        ("CASE n OF 1: a := ; b := 1; ELSE c := ; d := 2; END_CASE;", "(case n [1: b := 1] [else: d := 2])"),
        ("FOR i := 1 TO 2 DO WHILE a DO REPEAT b := ; c := 2; UNTIL d END_REPEAT; END_WHILE; END_FOR;",
         "(for i 1 2 -: (while a: (repeat c := 2 until d)))"),
    ],
)  # fmt: skip
def test_statements(text: str, shown: str) -> None:
    unit, found = parse_text(f"PROGRAM p\n{text}\nEND_PROGRAM")
    assert found != []
    program = unit.declarations[0]
    assert isinstance(program, tree.PouDecl)
    assert "|".join(show(statement) for statement in program.body) == shown


def test_declarations() -> None:
    unit, _ = parse_text(
        "TYPE A : INT := ; B : INT; END_TYPE PROGRAM p VAR a : ; b : INT; c : INT := 5x; END_VAR END_PROGRAM"
    )
    declared, program = unit.declarations
    assert isinstance(program, tree.PouDecl)
    assert [show(declared), show(program.sections[0])] == ["B: INT", "VAR [b: INT]"]


def test_configuration() -> None:
    unit, _ = parse_text("CONFIGURATION c TASK t(INTERVAL := T#5, PRIORITY := 1); PROGRAM p : m; END_CONFIGURATION")
    assert unit.declarations == ()
