"""Types, variables, POUs and configurations as trees (6.4 to 6.8)."""

from __future__ import annotations

import pytest

from iec2mpy.syntax import tree
from tests.syntax.trees import first, parse_text, pou, show


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("Speed : INT := 5", "Speed: INT = 5"),
        ("Name : STRING[20] := 'a'", "Name: STRING[20] = 'a'"),
        ("Wide : WSTRING", "Wide: WSTRING"),
        ("Level : INT (-10..MAX + 1) := 0", "Level: INT((- 10)..(+ MAX 1)) = 0"),
        ("Part : Level (0..5)", "Part: Level(0..5)"),
        ("Mode : (idle, heating) := idle", "Mode: (idle heating) = idle"),
        ("Mode : (idle := 1, heating := 2 * 3) := Mode#idle", "Mode: (idle=1 heating=(* 2 3)) = Mode#idle"),
        ("Mode : BYTE (idle := 16#1)", "Mode: BYTE(idle=1)"),
        ("List : ARRAY[1..10, 0..N] OF INT := [1, 2, 3(0), 2()]", "List: array[1..10 0..N] INT = [1 2 3(0) 2()]"),
        ("List : ARRAY[1..6] OF INT := [2(1, 2, 3)]", "List: array[1..6] INT = [2(1 2 3)]"),
        ("List : ARRAY[1..2] OF ARRAY[1..2] OF P := [[(x := 1)], 2(2(0))]",
         "List: array[1..2] array[1..2] P = [[(x=1)] 2(2(0))]"),
        ("Timers : ARRAY[1..50] OF TON := [50(PT := T#1ms)]", "Timers: array[1..50] TON = [50((PT=T#1000000))]"),
        ("Point : STRUCT x, y : INT := 1; name : STRING; END_STRUCT", "Point: struct([x y INT = 1] [name STRING])"),
        ("Line : STRUCT a : Point := (x := 1, y := 2); b : STRUCT c : INT; END_STRUCT; END_STRUCT",
         "Line: struct([a Point = (x=1 y=2)] [b struct([c INT])])"),
    ],
)  # fmt: skip
def test_type(text: str, shown: str) -> None:
    declaration = first(f"TYPE {text}; END_TYPE")
    assert show(declaration) == shown


def test_types_of_one_block_are_declarations_of_their_own() -> None:
    unit, found = parse_text("TYPE A : INT; B : A; END_TYPE")
    assert found == []
    assert [show(declaration) for declaration in unit.declarations] == ["A: INT", "B: A"]


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("VAR END_VAR", "VAR"),
        ("VAR a, b : INT := 1; c : TON; END_VAR", "VAR [a b: INT = 1] [c: TON]"),
        ("VAR CONSTANT a : REAL := 1.0; END_VAR", "VAR CONSTANT [a: REAL = 1.0]"),
        ("VAR RETAIN a : INT; END_VAR", "VAR RETAIN [a: INT]"),
        ("VAR_OUTPUT NON_RETAIN a : INT; END_VAR", "VAR_OUTPUT NON_RETAIN [a: INT]"),
        ("VAR_INPUT a : ARRAY[1..2] OF INT; END_VAR", "VAR_INPUT [a: array[1..2] INT]"),
        ("VAR_IN_OUT a : INT; END_VAR", "VAR_IN_OUT [a: INT]"),
        ("VAR_TEMP a : INT; END_VAR", "VAR_TEMP [a: INT]"),
        ("VAR_EXTERNAL CONSTANT a : INT; END_VAR", "VAR_EXTERNAL CONSTANT [a: INT]"),
        ("VAR a AT %IX0.0 : BOOL; AT %QW5 : WORD := 16#FF00; END_VAR",
         "VAR [a at %IX0.0: BOOL] [ at %QW5: WORD = 65280]"),
        ("VAR c : CTU := (PV := 5); s : STRING[10] := 'x'; m : (on, off) := off; END_VAR",
         "VAR [c: CTU = (PV=5)] [s: STRING[10] = 'x'] [m: (on off) = off]"),
        ("VAR public : INT; overlap, step, task, break : INT; END_VAR",
         "VAR [public: INT] [overlap step task break: INT]"),
    ],
)  # fmt: skip
def test_section(text: str, shown: str) -> None:
    assert show(pou(f"PROGRAM p\n{text}\nEND_PROGRAM").sections[0]) == shown


def test_function() -> None:
    function = pou("FUNCTION f : STRING[20] VAR_INPUT a : INT; END_VAR VAR b : INT; END_VAR f := 'x'; END_FUNCTION")
    assert (function.kind, function.name.text, show(function.result)) == (tree.PouKind.FUNCTION, "f", "STRING[20]")
    assert [section.section.value for section in function.sections] == ["VAR_INPUT", "VAR"]
    assert show(function.body[0]) == "f := 'x'"


def test_function_without_a_result_or_variables() -> None:
    function = pou("FUNCTION f x := 1; END_FUNCTION")
    assert function.result is None and function.sections == () and len(function.body) == 1


def test_all_pous_of_a_file_in_their_order() -> None:
    text = (
        "VAR_GLOBAL g : INT; END_VAR FUNCTION_BLOCK b END_FUNCTION_BLOCK PROGRAM p END_PROGRAM TYPE T : INT; END_TYPE"
    )
    unit, found = parse_text(text)
    assert found == []
    assert [type(item).__name__ for item in unit.declarations] == ["VarSection", "PouDecl", "PouDecl", "TypeDecl"]


def test_configuration() -> None:
    configuration = first("""
CONFIGURATION plant
  VAR_GLOBAL task : INT; END_VAR
  RESOURCE cpu ON PLC
    VAR_GLOBAL CONSTANT limit : INT := 5; END_VAR
    TASK fast(INTERVAL := T#10ms, PRIORITY := 1);
    TASK event(SINGLE := trigger, PRIORITY := 0);
    PROGRAM p1 WITH fast : main(start := %IX0.0, lamp => %QX0.0, b.x := 5);
    PROGRAM RETAIN p2 : other;
  END_RESOURCE
  RESOURCE second ON PLC
    PROGRAM p3 : main;
  END_RESOURCE
END_CONFIGURATION""")
    assert isinstance(configuration, tree.ConfigurationDecl)
    assert [show(section) for section in configuration.sections] == ["VAR_GLOBAL [task: INT]"]
    cpu, second = configuration.resources
    assert cpu.name and cpu.type and second.name
    assert (cpu.name.text, cpu.type.text, second.name.text) == ("cpu", "PLC", "second")
    assert [show(section) for section in cpu.sections] == ["VAR_GLOBAL CONSTANT [limit: INT = 5]"]
    assert [[show(argument) for argument in task.arguments] for task in cpu.tasks] == [
        ["INTERVAL:=T#10000000", "PRIORITY:=1"],
        ["SINGLE:=trigger", "PRIORITY:=0"],
    ]
    p1, p2 = cpu.programs
    assert p1.task and (p1.name.text, p1.task.text, p1.type.text) == ("p1", "fast", "main")
    assert [show(item) for item in p1.connections] == ["start:=%IX0.0", "lamp=>%QX0.0", "b.x:=5"]
    assert (p2.task, p2.retention, p2.type.text) == (None, tree.Retention.RETAIN, "other")


def test_configuration_without_a_resource() -> None:
    configuration = first(
        "CONFIGURATION c TASK t(INTERVAL := T#1s, PRIORITY := 1); PROGRAM p WITH t : main; END_CONFIGURATION"
    )
    assert isinstance(configuration, tree.ConfigurationDecl)
    (resource,) = configuration.resources
    assert (resource.name, resource.type, len(resource.tasks), len(resource.programs)) == (None, None, 1, 1)
