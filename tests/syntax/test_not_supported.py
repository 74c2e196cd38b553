"""What the language has and this compiler not yet: one diagnostic that says so, and no other."""

from __future__ import annotations

import pytest

from tests.syntax.trees import errors


def _body(text: str) -> str:
    return f"PROGRAM p\n{text}\nEND_PROGRAM"


@pytest.mark.parametrize(
    ("text", "found"),
    [
        (_body("LD a\nAND b\nST c"), [("E0901", 2)]),
        (_body("start: LDN %IX0.0\nST? c"), [("E0901", 2)]),
        (_body("CAL t1(IN := a)\nRET"), [("E0901", 2)]),
        (_body("INITIAL_STEP s:\nEND_STEP\nTRANSITION FROM s TO s := a; END_TRANSITION"), [("E0902", 2)]),
        (_body("{LD}\n|  a     q  |\n+--| |--( )-+"), [("E0903", 2)]),
        (_body("{ fbd }\n a ---[?'\"--- b"), [("E0903", 2)]),
        ("CLASS A\nMETHOD f\nEND_METHOD\nEND_CLASS", [("E0904", 1)]),
        ("FINAL CLASS A EXTENDS B\nEND_CLASS", [("E0904", 1)]),
        ("INTERFACE A\nMETHOD f\nEND_METHOD\nEND_INTERFACE", [("E0904", 1)]),
        ("FUNCTION_BLOCK a EXTENDS b IMPLEMENTS c, d\nEND_FUNCTION_BLOCK", [("E0904", 1), ("E0904", 1)]),
        ("FUNCTION_BLOCK ABSTRACT a\nVAR x : INT; END_VAR\nEND_FUNCTION_BLOCK", [("E0904", 1)]),
        ("FUNCTION_BLOCK a\nMETHOD f : INT\nVAR x : INT; END_VAR\nf := x;\nEND_METHOD\nx := 1;\nEND_FUNCTION_BLOCK",
         [("E0904", 2)]),
        ("FUNCTION_BLOCK a\nVAR PUBLIC x : INT; END_VAR\nEND_FUNCTION_BLOCK", [("E0904", 2)]),
        (_body("THIS.f();"), [("E0904", 2)]),
        ("NAMESPACE a\nNAMESPACE b\nPROGRAM p\nEND_PROGRAM\nEND_NAMESPACE\nEND_NAMESPACE", [("E0905", 1)]),
        ("USING a.b, c;\nPROGRAM p\nUSING d;\nEND_PROGRAM", [("E0905", 1), ("E0905", 3)]),
        (_body("VAR_ACCESS a : b.c : INT READ_WRITE; END_VAR"), [("E0907", 2)]),
        (_body("VAR a AT %I* : BOOL; END_VAR"), [("E0908", 2)]),
        ("CONFIGURATION c\nPROGRAM p : m;\nVAR_CONFIG\nr.p.x AT %IX0.0 : BOOL;\nEND_VAR\nEND_CONFIGURATION",
         [("E0908", 3)]),
        ("CONFIGURATION c\nPROGRAM p : m(b WITH t);\nEND_CONFIGURATION", [("E0913", 2)]),
    ],
)  # fmt: skip
def test_says_so(text: str, found: list[tuple[str, int]]) -> None:
    assert errors(text) == found
