"""Declarations: types, initial values, sections, globals, addresses."""

from __future__ import annotations

import pytest

from iec2mpy.semantics.types import INT, AliasType, EnumType, SubrangeType, value_range
from tests.semantics.checking import check_text, checked, codes, program

TYPES = """TYPE
  Speed : INT := 5;
  Percent : INT (0..100) := 50;
  Mode : (idle, heating) := heating;
  Point : STRUCT x : Speed; y : REAL := 2.5; END_STRUCT;
  Line : STRUCT a : Point; b : Point := (x := 9); END_STRUCT;
  Row : ARRAY[1..3] OF Speed := [1, 2(7)];
  Start : Point := (y := 1.0);
END_TYPE
"""


def initial_values(declarations: str) -> dict[str, object]:
    application = checked(TYPES + program(declarations, ";"))
    return {v.name: v.initial for v in application.pous[0].variables.values()}


@pytest.mark.parametrize(
    ("declaration", "value"),
    [
        ("v : INT;", 0),
        ("v : REAL;", 0.0),
        ("v : STRING;", ""),
        ("v : REAL := 3;", 3.0),
        ("v : TIME := T#1s;", 1000),
        ("v : BOOL := 1;", 1),
        ("v : Speed;", 5),
        ("v : Speed := 6;", 6),
        ("v : Percent;", 50),
        ("v : INT (3..9);", 3),
        ("v : Mode;", 1),
        ("v : Mode := idle;", 0),
        ("v : (red, green);", 0),
        ("v : Point;", {"x": 5, "y": 2.5}),
        ("v : Point := (y := 1.5);", {"x": 5, "y": 1.5}),
        ("v : Start;", {"x": 5, "y": 1.0}),
        ("v : Line;", {"a": {"x": 5, "y": 2.5}, "b": {"x": 9, "y": 2.5}}),
        ("v : Line := (a := (x := 1));", {"a": {"x": 1, "y": 2.5}, "b": {"x": 9, "y": 2.5}}),
        ("v : Row;", (1, 7, 7)),
        ("v : ARRAY[0..1] OF Point := [(x := 1), (x := 2)];", ({"x": 1, "y": 2.5}, {"x": 2, "y": 2.5})),
        ("v : ARRAY[0..1, 0..2] OF INT := [1, 2, 3, 3(4)];", ((1, 2, 3), (4, 4, 4))),
        ("v : ARRAY[0..5] OF INT := [2(1, 2(0))];", (1, 0, 0, 1, 0, 0)),
        ("v : ARRAY[0..2] OF Percent := [1, 2()];", (1, 50, 50)),
        ("v : TON := (PT := T#5s);", {"pt": 5000}),
        ("v : ARRAY[0..1] OF TON := [2((PT := T#1s))];", ({"pt": 1000}, {"pt": 1000})),
    ],
)
def test_initial_values_are_complete(declaration: str, value: object) -> None:
    assert initial_values(declaration)["v"] == value


def test_constants_may_be_used_by_later_declarations() -> None:
    text = """VAR_GLOBAL CONSTANT size : INT := 4; END_VAR
TYPE Buffer : ARRAY[1..size] OF INT; END_TYPE
PROGRAM main
VAR CONSTANT n : INT := 2; m : INT := n * 3; END_VAR
VAR a : ARRAY[1..m] OF INT; b : Buffer; END_VAR
a[6] := b[4];
END_PROGRAM
"""
    variables = checked(text).pous[0].variables
    assert variables["m"].initial == 6
    assert len(variables["b"].initial) == 4  # type: ignore[arg-type]


def test_types() -> None:
    variables = checked(TYPES + program("s : Speed; p : Percent; m : Mode;", ";")).pous[0].variables
    assert isinstance(variables["s"].type, AliasType)
    percent = variables["p"].type
    assert isinstance(percent, SubrangeType)
    assert (percent.name, percent.base, value_range(percent)) == ("Percent", INT, (0, 100))
    mode = variables["m"].type
    assert isinstance(mode, EnumType)
    assert (dict(mode.values), mode.default, mode.open) == ({"idle": 0, "heating": 1}, 1, False)


def test_warnings_of_lists_that_do_not_fit() -> None:
    text = program("a : ARRAY[1..2] OF INT := [1, 2, 3]; b : ARRAY[1..3] OF INT := [1];", ";")
    application, diagnostics = check_text(text)
    assert [d.code for d in diagnostics.items] == ["W0501", "W0501"]
    assert application is not None
    values = application.pous[0].variables
    assert (values["a"].initial, values["b"].initial) == ((1, 2), (1, 0, 0))


@pytest.mark.parametrize(
    ("declaration", "code"),
    [
        ("v : INT := 32768;", "E0501"),
        ("v : INT := 'OK';", "E0301"),
        ("v : Percent := 101;", "E0504"),
        ("v : Mode := cooling;", "E0206"),
        ("v : INT := w; w : INT;", "E0201"),
        ("w : INT; v : INT := w;", "E0505"),
        ("w : INT; v : ARRAY[1..w] OF INT;", "E0505"),
        ("v : ARRAY[3..1] OF INT;", "E0506"),
        ("v : ARRAY[1..2] OF INT := 5;", "E0709"),
        ("v : INT := [1];", "E0709"),
        ("v : Point := (z := 1);", "E0204"),
        ("v : Point := (x := 1, x := 2);", "E0202"),
        ("v : TON := (START := T#0s);", "E0604"),
        ("v : STRING[0];", "E0509"),
        ("v : REAL (0..1);", "E0310"),
        ("v : Pont;", "E0203"),
        ("v : INT; V : INT;", "E0202"),
        ("v : RTC;", "E0916"),
        ("v : main;", "E0707"),
        ("v : ARRAY[0..40000] OF INT;", "E0512"),
    ],
)
def test_wrong_declarations(declaration: str, code: str) -> None:
    assert [found for found, _ in codes(TYPES + program(declaration, ";"))] == [code]


def test_types_that_contain_themselves() -> None:
    assert [c for c, _ in codes("TYPE A : STRUCT b : B; END_STRUCT; B : STRUCT a : A; END_STRUCT; END_TYPE\n")] == [
        "E0705"
    ]
    assert [c for c, _ in codes("FUNCTION_BLOCK F\nVAR a : ARRAY[0..1] OF F; END_VAR\n;\nEND_FUNCTION_BLOCK\n")] == [
        "E0705"
    ]
    assert [c for c, _ in codes("VAR_GLOBAL CONSTANT a : INT := b; b : INT := a; END_VAR\n")] == ["E0705"]


def test_externals_are_their_globals() -> None:
    text = """VAR_GLOBAL level : INT := 4; END_VAR
PROGRAM main
VAR_EXTERNAL level : INT; END_VAR
level := 5;
END_PROGRAM
"""
    application = checked(text)
    assign = application.pous[0].body[0]
    assert assign.target.variable is application.globals["level"]  # type: ignore[union-attr]
    assert application.pous[0].variables["level"].target is application.globals["level"]


def test_retention() -> None:
    text = """FUNCTION_BLOCK B
VAR RETAIN kept : INT; END_VAR
VAR NON_RETAIN lost : INT; END_VAR
VAR plain : INT; END_VAR
;
END_FUNCTION_BLOCK
"""
    variables = checked(text + program("b1 : B;", "b1();")).pous[0].variables
    assert [v.retain for v in variables.values()] == [True, False, None]


@pytest.mark.parametrize(
    ("section", "code"),
    [
        ("VAR_TEMP RETAIN n : INT; END_VAR", "E0702"),
        ("VAR_INPUT CONSTANT n : INT; END_VAR", "E0702"),
        ("VAR_TEMP t : TON; END_VAR", "E0703"),
        ("VAR_IN_OUT n : INT := 5; END_VAR", "E0701"),
        ("VAR_EXTERNAL g : INT := 5; END_VAR", "E0701"),
        ("VAR_EXTERNAL h : INT; END_VAR", "E0209"),
        ("VAR_EXTERNAL g : DINT; END_VAR", "E0311"),
        ("VAR_EXTERNAL k : INT; END_VAR", "E0511"),
        ("VAR n AT %MW0 : INT; END_VAR", "E0704"),
        ("VAR_INPUT t : TON; END_VAR", "E0915"),
        ("VAR twice : TON; END_VAR", "E0706"),
    ],
)
def test_sections_of_a_block(section: str, code: str) -> None:
    text = f"""VAR_GLOBAL g : INT; END_VAR
VAR_GLOBAL CONSTANT k : INT := 1; END_VAR
FUNCTION twice : INT
VAR_INPUT x : INT; END_VAR
twice := 2 * x;
END_FUNCTION
FUNCTION_BLOCK B
{section}
;
END_FUNCTION_BLOCK
"""
    found = codes(text)
    assert (code, 8) in found
    assert len(found) == 1


def test_located_variables() -> None:
    text = program("a AT %QW2 : INT := 7; AT %QW5 : WORD := 16#FF; w : WORD;", "w := %QW5; a := %QW2;")
    application = checked(text)
    variables = application.pous[0].variables
    assert variables["a"].address == "%QW2"
    assert {v.address: v.initial for v in application.direct.values()} == {"%QW5": 0xFF, "%QW2": 0}
    # an address has the type that its declaration says
    assert application.direct["%QW2"].type is INT


def test_globals_need_external() -> None:
    text = "VAR_GLOBAL g : INT; END_VAR\n" + program("x : INT;", "x := g;")
    _, diagnostics = check_text(text)
    assert [d.code for d in diagnostics.items] == ["E0201"]
    assert "VAR_EXTERNAL" in (diagnostics.items[0].hint or "")


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("FUNCTION_BLOCK b\nVAR_INPUT x : INT R_EDGE; END_VAR\nEND_FUNCTION_BLOCK", 2),
        ("FUNCTION_BLOCK b\nVAR_OUTPUT x : BOOL F_EDGE; END_VAR\nEND_FUNCTION_BLOCK", 2),
        ("FUNCTION_BLOCK b\nVAR x : BOOL F_EDGE; END_VAR\nEND_FUNCTION_BLOCK", 2),
        ("FUNCTION f\nVAR_INPUT x : BOOL R_EDGE; END_VAR\nEND_FUNCTION", 2),
    ],
)
def test_edges_belong_to_inputs_of_blocks_and_programs(text: str, line: int) -> None:
    assert codes(text) == [("E0710", line)]


def test_one_edge_for_each_name() -> None:
    block = checked("FUNCTION_BLOCK b\nVAR_INPUT x, y : BOOL R_EDGE; END_VAR\nEND_FUNCTION_BLOCK").pous[0]
    assert [(edge.input.name, edge.memory.owner) for edge in block.edges] == [("x", block), ("y", block)]
