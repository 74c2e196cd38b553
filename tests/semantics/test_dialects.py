"""Extensions of other systems: what each means on every engine, and that strict refuses it and names the dialects."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import pytest

from iec2mpy.backends.target import ENGINE_TARGETS
from iec2mpy.project.compile import check_files, compile_files
from iec2mpy.simulator.session import Simulation
from iec2mpy.source.diagnostics import CompileError, Diagnostic
from iec2mpy.source.dialects import DIALECTS, EXTENSIONS
from iec2mpy.source.spans import STRICT, SourceFile


@dataclass(frozen=True)
class Program:
    """A program with one extension; strict refuses it with `code` on `line`; `values` are those after two scans."""

    extension: str
    code: str
    line: int
    text: str
    values: Mapping[str, object]


PROGRAMS = (
    Program(
        "end-without-semicolon", "E0113", 4,
        """PROGRAM main
VAR n, i : INT; END_VAR
FOR i := 1 TO 3 DO
  IF i > 1 THEN n := n + 1; END_IF
END_FOR;
CASE n OF 1: n := 7; END_CASE;
END_PROGRAM""",
        {"n": 4},
    ),
    Program(
        "end-without-semicolon", "E0113", 1,
        """TYPE Pair : STRUCT a, b : INT; END_STRUCT END_TYPE
PROGRAM main
VAR p : Pair; END_VAR
p.b := p.b + 2;
END_PROGRAM""",
        {"p.b": 4},
    ),
    Program(
        "string-in-parentheses", "E0121", 2,
        """PROGRAM main
VAR s : STRING(3); END_VAR
s := 'abcdef';
END_PROGRAM""",
        {"s": "abc"},
    ),
    Program(
        "constant-input", "E0702", 2,
        """FUNCTION_BLOCK Scale
VAR_INPUT CONSTANT k : INT := 3; END_VAR
VAR_OUTPUT y : INT; END_VAR
y := y + k;
END_FUNCTION_BLOCK
PROGRAM main
VAR plain, other : Scale; END_VAR
plain();
other(k := 5);
END_PROGRAM""",
        {"plain.y": 6, "other.y": 10},
    ),
    Program(
        "short-circuit", "E0129", 6,
        """PROGRAM main
VAR a : ARRAY[1..3] OF BOOL := [TRUE, FALSE, TRUE]; i, met, missed : INT; END_VAR
i := 0;
REPEAT
  i := i + 1;
  IF i <= 3 AND_THEN a[i] THEN met := met + 1; END_IF;
  IF i > 3 OR_ELSE NOT a[i] THEN missed := missed + 1; END_IF;
UNTIL i > 4 END_REPEAT;
END_PROGRAM""",
        {"met": 4, "missed": 6},
    ),
    Program(
        "short-circuit", "E0129", 8,
        """FUNCTION counted : BOOL
VAR_INPUT x : BOOL; END_VAR
VAR_IN_OUT calls : INT; END_VAR
calls := calls + 1; counted := x;
END_FUNCTION
PROGRAM main
VAR n, m : INT; x, y, z, c, e : BOOL; f : BOOL := TRUE; END_VAR
x := c AND_THEN counted(TRUE, n);
y := f OR_ELSE counted(TRUE, m);
z := f AND_THEN (c OR_ELSE counted(TRUE, n));
e := TRUE AND_THEN f;
END_PROGRAM""",
        {"n": 2, "m": 0, "x": False, "y": True, "z": True, "e": True},
    ),
    Program(
        "time-call", "E0129", 3,
        """PROGRAM main
VAR t, span : TIME; END_VAR
span := TIME() - t;
t := TIME ( );
END_PROGRAM""",
        {"span": "T#10ms", "t": "T#10ms"},
    ),
    Program(
        "static-variables", "E0129", 2,
        """FUNCTION count : INT
VAR_STAT n : INT := 40; END_VAR
n := n + 1; count := n;
END_FUNCTION
PROGRAM main
VAR x : INT; END_VAR
VAR_STAT y : INT := 2; END_VAR
x := count(); y := y * 2;
END_PROGRAM""",
        {"x": 42, "y": 8},
    ),
    Program(
        "set-reset-assignment", "E0129", 3,
        """PROGRAM main
VAR a, b : BOOL; on : BOOL := TRUE; off : BOOL; c : ARRAY[1..2] OF BOOL; END_VAR
a S= on; a S= off;
b := TRUE; b R= off; b R= on;
c[2] S= on OR off;
END_PROGRAM""",
        {"a": True, "b": False, "c": [False, True]},
    ),
    Program(
        "bare-array", "E0129", 2,
        """PROGRAM main
VAR a : ARRAY[1..4] OF INT := 1, 2(5), 3; b : ARRAY[1..2] OF INT := 2(7); n : INT := 3; END_VAR
END_PROGRAM""",
        {"a": [1, 5, 5, 3], "b": [7, 7], "n": 3},
    ),
    Program(
        "global-without-external", "E0201", 4,
        """VAR_GLOBAL n : INT := 5; END_VAR
VAR_GLOBAL CONSTANT step : INT := 2; END_VAR
PROGRAM main
n := n + step;
END_PROGRAM""",
        {"..n": 9},
    ),
    Program(
        "qualified-global", "E0201", 3,
        """VAR_GLOBAL n : INT := 5; END_VAR
PROGRAM main
gvl.n := GVL.n + 1;
END_PROGRAM""",
        {"..n": 7},
    ),
    Program(
        "bits-are-numbers", "E0302", 5,
        """PROGRAM main
VAR w : WORD := 65535; b : BYTE := 200; d : DWORD := 4294967295; i : INT := -2; u : UDINT; r, s : REAL;
x : DINT; a : ARRAY[0..255] OF INT; below, same : BOOL; low : INT; n, e : DWORD; m : DINT; wide : WORD; END_VAR
IF x = 0 THEN
w := w + 2;
x := b * 2 + i;
u := i;
low := i AND 16#FF;
r := d; s := WORD_TO_REAL(w) + b;
a[b] := w - 3;
below := i < b; same := w = 1;
n := SHL(i, 4); m := -b; d := d / 2; e := REAL_TO_DWORD(2.5E9); wide := MAX(b, i);
END_IF;
END_PROGRAM""",
        {
            "w": 1, "x": 142, "u": 4294967294, "low": 254, "r": 4294967296.0, "s": 201.0, "a[200]": -2, "below": True,
            "same": True, "n": 65504, "m": -200, "d": 2147483647, "e": 2500000000, "wide": 200,
        },
    ),
    Program(
        "exponent-without-point", "E0106", 3,
        """PROGRAM main
VAR x, y : REAL; END_VAR
x := 2E-3; y := 25e1;
END_PROGRAM""",
        {"x": 0.0020000000949949026, "y": 250.0},
    ),
    Program(
        "written-input", "E0604", 3,
        """FUNCTION size : INT
VAR_INPUT x : INT; END_VAR
IF x < 0 THEN x := -x; END_IF;
size := x;
END_FUNCTION
FUNCTION_BLOCK Down
VAR_INPUT n : INT := 9; END_VAR
n := n - 1;
END_FUNCTION_BLOCK
PROGRAM main
VAR a, b : INT; d : Down; END_VAR
a := -4; b := size(a); d();
END_PROGRAM""",
        {"a": -4, "b": 4, "d.n": 7},
    ),
)  # fmt: skip
_NAMES = [f"{program.extension}-{number}" for number, program in enumerate(PROGRAMS)]


def _file(program: Program, dialect: str) -> SourceFile:
    return SourceFile("GVL.st", program.text, dialect=dialect)


@pytest.mark.parametrize("engine", ENGINE_TARGETS)
@pytest.mark.parametrize("program", PROGRAMS, ids=_NAMES)
def test_dialects_accept_it(program: Program, engine: str) -> None:
    dialect = EXTENSIONS[program.extension].dialects[0]
    generated = compile_files([_file(program, dialect)], ENGINE_TARGETS[engine])
    with Simulation(generated, engine) as running:
        assert running.scan(2) is None
        found = {path: running.get(path[2:] if path.startswith("..") else f"main.{path}") for path in program.values}
    assert found == program.values


def _errors(program: Program, dialect: str) -> list[Diagnostic]:
    try:
        check_files([_file(program, dialect)])
    except CompileError as error:
        return error.diagnostics
    return []


@pytest.mark.parametrize("program", PROGRAMS, ids=_NAMES)
def test_others_refuse_it_and_name_them(program: Program) -> None:
    having = EXTENSIONS[program.extension].dialects
    for dialect in DIALECTS:
        if dialect in having:
            assert _errors(program, dialect) == []
            continue
        first = _errors(program, dialect)[0]
        assert first.span is not None
        assert (first.code, first.span.line) == (program.code, program.line)
        assert first.hint is not None and f"`--dialect {having[0]}`" in first.hint


def test_every_extension_is_shown() -> None:
    assert {program.extension for program in PROGRAMS} == set(EXTENSIONS)


def test_the_words_of_dialects_are_names_in_the_standard() -> None:
    text = """PROGRAM main
VAR and_then, or_else, var_stat, S, R : INT; x : BOOL; END_VAR
and_then := or_else + 1;
var_stat := and_then * or_else;
x := S=R OR and_then=1;
IF s=1 THEN r := 1; END_IF;
END_PROGRAM"""
    check_files([SourceFile("names.st", text, dialect=STRICT)])
