"""References: what REF takes, what `^` follows, what goes where (6.4.4.10)."""

from __future__ import annotations

import pytest

from tests.semantics.checking import check_text, codes, codes_of, program

_TYPES = "TYPE Pair : STRUCT n : INT; x : REAL; END_STRUCT; Speed : INT; END_TYPE\n"
_BLOCK = "FUNCTION_BLOCK F\nVAR_INPUT i : INT; END_VAR\nVAR_OUTPUT q : INT; END_VAR\nq := i;\nEND_FUNCTION_BLOCK\n"


@pytest.mark.parametrize(
    ("variables", "body"),
    [
        ("x : INT; r : REF_TO INT := REF(x);", "r := REF(x); r := NULL; r^ := 1; x := r^;"),
        ("x : Speed; r : REF_TO INT;", "r := REF(x);"),
        ("x : INT; r : REF_TO Speed; s : REF_TO INT;", "r := REF(x); s := r; s ?= r;"),
        ("p : Pair; r : REF_TO REAL;", "r := REF(p.x);"),
        ("a : ARRAY[0..3] OF INT; r : REF_TO INT; i : INT;", "r := REF(a[i]);"),
        ("f : F; r : REF_TO F;", "r := REF(f); r^(i := 1); r^.i := r^.q;"),
        ("a, b : REF_TO INT; e : BOOL;", "e := a = b OR a <> NULL OR NULL = b;"),
        ("x : INT; r : REF_TO INT := REF(x); rr : REF_TO REF_TO INT := REF(r);", "rr^^ := 1;"),
    ],
)
def test_right(variables: str, body: str) -> None:
    _, diagnostics = check_text(_TYPES + _BLOCK + program(variables, body))
    assert [d.message for d in diagnostics.items] == []


@pytest.mark.parametrize(
    ("variables", "body", "expected"),
    [
        ("d : DINT; r : REF_TO INT;", "r := REF(d);", "E0301"),
        ("x : INT (0..5); r : REF_TO INT;", "r := REF(x);", "E0301"),
        ("s : STRING[5]; r : REF_TO STRING;", "r := REF(s);", "E0301"),
        ("r : REF_TO INT; x : INT;", "x := r;", "E0301"),
        ("r : REF_TO INT; x : INT;", "r := x;", "E0301"),
        ("x : INT;", "x := NULL;", "E0301"),
        ("a : REF_TO INT; b : REF_TO DINT; e : BOOL;", "e := a = b;", "E0303"),
        ("a, b : REF_TO INT; e : BOOL;", "e := a < b;", "E0302"),
        ("a : REF_TO INT; e : BOOL;", "e := a = 0;", "E0303"),
        ("x : INT;", "x := x^;", "E0315"),
        ("x : INT;", "x^ := 1;", "E0315"),
        ("x : INT;", "x ?= x;", "E0316"),
        ("a : REF_TO INT; b : REF_TO DINT;", "a ?= b;", "E0301"),
        ("r : REF_TO INT;", "r := REF(5);", "E0119"),
        ("r : REF_TO INT;", "r := REF(%MW3);", "E0608"),
        ("w : WORD; r : REF_TO BOOL;", "r := REF(w.%X0);", "E0608"),
        ("s : STRING; r : REF_TO CHAR;", "r := REF(s[1]);", "E0608"),
        ("f : F; r : REF_TO INT;", "r := REF(f.q);", "E0608"),
        ("f : F; r : REF_TO INT;", "r := REF(f.i);", "E0608"),
        ("i : INT; r : REF_TO INT;", "FOR i := 1 TO 2 DO r := REF(i); END_FOR;", "E0602"),
        ("x : INT; r : REF_TO INT := x;", ";", "E0505"),
        ("x : INT; y : INT := REF(x);", ";", "E0301"),
        ("r : REF_TO INT := REF(x); x : INT;", ";", "E0201"),
        ("i : INT; a : ARRAY[0..1] OF INT; r : REF_TO INT := REF(a[i]);", ";", "E0505"),
        ("r AT %MD0 : REF_TO INT;", ";", "E0704"),
        ("r : REF_TO NoSuch;", ";", "E0203"),
    ],
)
def test_wrong(variables: str, body: str, expected: str) -> None:
    found = codes(_TYPES + _BLOCK + program(variables, body))
    assert [code for code, _ in found] == [expected]


def test_constants_are_not_referred_to() -> None:
    text = "PROGRAM main\nVAR CONSTANT c : INT := 1; END_VAR\nVAR r : REF_TO INT; END_VAR\nr := REF(c);\nEND_PROGRAM\n"
    assert codes(text) == [("E0507", 4)]


@pytest.mark.parametrize("section", ["VAR", "VAR_TEMP", "VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT"])
def test_nothing_of_a_function_is_referred_to(section: str) -> None:
    text = f"FUNCTION f\n{section} x : INT; END_VAR\nVAR r : REF_TO INT; END_VAR\nr := REF(x);\nEND_FUNCTION\n"
    assert codes(text) == [("E0608", 4)]


def test_global_variables_are_referred_to_from_functions() -> None:
    text = """VAR_GLOBAL g : INT; END_VAR
FUNCTION f : REF_TO INT
VAR_EXTERNAL g : INT; END_VAR
f := REF(g);
END_FUNCTION
"""
    assert codes(text) == []


@pytest.mark.parametrize(
    ("section", "expected"), [("VAR_TEMP", ["E0608"]), ("VAR_INPUT", ["E0608"]), ("VAR_IN_OUT", [])]
)
def test_sections_of_a_block(section: str, expected: list[str]) -> None:
    variables = f"{section} x : INT; END_VAR\nVAR r : REF_TO INT; END_VAR"
    text = f"FUNCTION_BLOCK f\n{variables}\nr := REF(x);\nEND_FUNCTION_BLOCK\n"
    assert [code for code, _ in codes(text)] == expected


def test_what_shares_its_storage_is_not_referred_to() -> None:
    text = program("a AT %MW2 : WORD; b AT %MB4 : BYTE; r : REF_TO WORD;", "r := REF(a); b := 1;")
    assert [code for code, _ in codes(text)] == ["E0608"]


def test_no_reference_in_var_in_out() -> None:
    text = "FUNCTION_BLOCK f\nVAR_IN_OUT\nr : REF_TO INT;\nEND_VAR\n;\nEND_FUNCTION_BLOCK\n"
    assert codes(text) == [("E0712", 3)]


def test_hints_say_what_to_write() -> None:
    _, diagnostics = check_text(program("x : INT; r : REF_TO INT;", "x := r; r := x;"))
    assert [d.hint for d in diagnostics.items] == ["Write r^ for what it refers to.", "Write REF(x)."]


def test_a_type_cannot_refer_to_itself() -> None:
    """6.4.4.10.1: what is referred to is declared before."""
    assert codes_of("", "") == []
    assert codes("TYPE Node : STRUCT next : REF_TO Node; END_STRUCT; END_TYPE\n") == [("E0705", 1)]
