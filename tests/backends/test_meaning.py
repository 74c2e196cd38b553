"""Programs whose parts work together: order of evaluation, copies, instances, loops at their limits, on all engines."""

from __future__ import annotations

from collections.abc import Mapping

import pytest

from iec2mpy.backends.target import ENGINE_TARGETS
from iec2mpy.project.compile import compile_files
from iec2mpy.simulator.session import Simulation
from iec2mpy.source.spans import SourceFile

_STEP = """
VAR_GLOBAL n : INT; END_VAR
FUNCTION Step : INT
VAR_EXTERNAL n : INT; END_VAR
n := n + 1;
Step := n;
END_FUNCTION
FUNCTION_BLOCK Keep
VAR_INPUT x : INT; END_VAR
VAR_OUTPUT q : INT; END_VAR
q := x;
END_FUNCTION_BLOCK
"""
_NESTED_CALLS = """
TYPE Pair : ARRAY[0..1] OF INT; END_TYPE
FUNCTION F : INT VAR_INPUT x : INT; y : INT := 5; END_VAR F := x * 10 + y; END_FUNCTION
FUNCTION G : INT VAR_INPUT a : Pair; x : INT; END_VAR G := a[0] * 100 + x; END_FUNCTION
PROGRAM main
VAR r, t : INT; p : Pair := [1, 1]; q : Pair := [0, 0]; END_VAR
r := F(x := F(x := 1, y := 2));
t := G(a := p, x := G(a := q, x := 12));
END_PROGRAM
"""
_RESULTS = """
TYPE T : ARRAY[0..2] OF INT; S : STRUCT a : INT; b : REAL; c : T; s : STRING[5]; END_STRUCT; END_TYPE
FUNCTION F : T VAR_INPUT x : INT; END_VAR F[0] := x; F[1] := x + 1; F[2] := F[0] + F[1]; END_FUNCTION
FUNCTION G : S VAR_INPUT t : T; r : REAL; END_VAR
G.c := t; G.b := r; G.a := t[2]; G.s := 'abcdefg';
END_FUNCTION
PROGRAM main
VAR s : S; e, d : BOOL; u : ARRAY[0..1] OF S; END_VAR
s := G(F(3), 1.5);
u[1] := G(t := F(5), r := s.b);
e := F(2) = F(2);
d := F(2) <> F(1);
END_PROGRAM
"""
_REFERENCES = """
TYPE S : STRUCT a : INT; b : REAL; END_STRUCT; END_TYPE
FUNCTION_BLOCK C VAR_INPUT i : INT; END_VAR VAR_OUTPUT q : REAL; n : INT; END_VAR
q := q + INT_TO_REAL(i); n := n + 1;
END_FUNCTION_BLOCK
FUNCTION_BLOCK D VAR_IN_OUT c : C; s : S; r : REAL; z : INT; END_VAR
c(i := 2); s.a := s.a + c.n; s.b := s.b + c.q; r := r + 1.0; z := z + 1;
END_FUNCTION_BLOCK
FUNCTION_BLOCK E VAR_IN_OUT c : C; s : ARRAY[0..1] OF S; END_VAR VAR d : D; k : INT := 1; END_VAR
d(c := c, s := s[k], r := s[0].b, z := s[0].a);
END_FUNCTION_BLOCK
PROGRAM main
VAR cs : ARRAY[1..3] OF C; ss : ARRAY[0..2] OF ARRAY[0..1] OF S; e, f : E; k : INT := 2; END_VAR
e(c := cs[k], s := ss[k]);
f(c := cs[1], s := ss[0]);
f(c := cs[1], s := ss[0]);
END_PROGRAM
"""
_PROGRAMS = """
PROGRAM P
VAR n : INT; row : ARRAY[0..2] OF INT; f : REAL; t : TON; END_VAR
n := n + 1;
row[n MOD 3] := n;
f := f + 0.5;
t(IN := TRUE, PT := T#20ms);
END_PROGRAM
CONFIGURATION c
  RESOURCE r ON board
    TASK fast (INTERVAL := T#10ms, PRIORITY := 1);
    TASK slow (INTERVAL := T#20ms, PRIORITY := 2);
    PROGRAM p1 WITH fast : P;
    PROGRAM p2 WITH slow : P;
  END_RESOURCE
END_CONFIGURATION
"""
_FUNCTIONS = """
FUNCTION A : INT VAR_INPUT x : INT; END_VAR VAR t : INT; END_VAR t := x * 2; A := t; END_FUNCTION
FUNCTION B : INT VAR_INPUT x : INT; END_VAR VAR t : INT; END_VAR
t := A(x) + A(x + 1) * A(A(x));
B := t + A(1);
END_FUNCTION
PROGRAM main
VAR r : INT; END_VAR
r := B(A(B(1)) + A(2)) + B(x := B(1));
END_PROGRAM
"""
_STRINGS = """
TYPE S : STRUCT f : STRING[3]; END_STRUCT; END_TYPE
FUNCTION F : STRING[4] VAR_INPUT s : STRING[3]; END_VAR VAR_OUTPUT o : STRING[2]; END_VAR
F := CONCAT(s, s); o := s;
END_FUNCTION
FUNCTION_BLOCK B VAR_INPUT s : STRING[3]; END_VAR VAR_OUTPUT q : STRING[10]; n : INT; END_VAR
n := LEN(s); q := CONCAT(s, '123456789');
END_FUNCTION_BLOCK
PROGRAM main
VAR
  b : B; a : ARRAY[0..1] OF STRING[3]; s : S;
  t : STRING := 'abcdef'; r : STRING; o : STRING[1]; y : STRING[2];
END_VAR
a[1] := t;
s.f := t;
r := F(s := t, o => o);
b(s := t, q => y);
END_PROGRAM
"""


def _loop(declared: str, bounds: str) -> str:
    return f"PROGRAM main\nVAR {declared}; n : INT; END_VAR\nFOR i := {bounds} DO\nn := n + 1;\nEND_FOR;\nEND_PROGRAM\n"


_LOW, _HIGH = -(1 << 31), (1 << 32) - 1
_CASES: dict[str, tuple[str, Mapping[str, object]]] = {
    "a call inside of an argument of the same function": (_NESTED_CALLS, {"main.r": 125, "main.t": 112}),
    "an instance in an array is found once": (
        f"{_STEP}PROGRAM main\nVAR_EXTERNAL n : INT; END_VAR\nVAR a : ARRAY[0..5] OF Keep; y, z : INT; END_VAR\n"
        "a[Step()](x := 7, q => y);\na[n](x := Step(), q => z);\nEND_PROGRAM\n",
        {"n": 2, "main.y": 7, "main.z": 2, "main.a[1].q": 2, "main.a[2].q": 0},
    ),
    "results that are arrays and structures": (
        _RESULTS,
        {
            "main.s": {"a": 7, "b": 1.5, "c": [3, 4, 7], "s": "abcde"},
            "main.u[1]": {"a": 11, "b": 1.5, "c": [5, 6, 11], "s": "abcde"},
            "main.e": True,
            "main.d": True,
        },
    ),
    "in-outs of instances and of elements, with parts in both arrays": (
        _REFERENCES,
        {
            "main.cs": [{"i": 2, "q": 8.0, "n": 4}, {"i": 2, "q": 4.0, "n": 2}, {"i": 0, "q": 0.0, "n": 0}],
            "main.ss[0]": [{"a": 4, "b": 4.0}, {"a": 10, "b": 20.0}],
            "main.ss[1]": [{"a": 0, "b": 0.0}, {"a": 0, "b": 0.0}],
            "main.ss[2]": [{"a": 2, "b": 2.0}, {"a": 3, "b": 6.0}],
        },
    ),
    "functions that call functions": (_FUNCTIONS, {"main.r": 19332}),
    "strings are cut wherever they go": (
        _STRINGS,
        {"main.a[1]": "abc", "main.s.f": "abc", "main.r": "abca", "main.o": "a", "main.y": "ab", "main.b.n": 3},
    ),
    "for over a whole subrange": (_loop("i : INT (0..5)", "0 TO 5"), {"main.i": 5, "main.n": 12}),
    "for up to the highest UDINT": (_loop("i : UDINT", f"{_HIGH - 5} TO {_HIGH}"), {"main.i": 0, "main.n": 12}),
    "for down to the lowest DINT": (
        _loop("i : DINT", f"{_LOW + 8} TO {_LOW} BY -1"),
        {"main.i": -_LOW - 1, "main.n": 18},
    ),
    "for to a variable at the top": (
        _loop(f"i : UDINT; e : UDINT := {_HIGH}; s : UDINT := 3", "e - 7 TO e BY s"),
        {"main.i": 1, "main.n": 6},
    ),
    "for to a variable at the bottom": (
        _loop(f"i : DINT; e : DINT := {_LOW}; s : DINT := -3", "e + 7 TO e BY s"),
        {"main.i": -_LOW - 2, "main.n": 6},
    ),
    "a case with many groups": (
        "PROGRAM main\nVAR k : INT := 77; n : INT; END_VAR\nk := k + 1;\nCASE k OF\n"
        + "".join(f"{group}: n := {group}; k := 5;\n" for group in range(200))
        + "ELSE n := -1;\nEND_CASE;\nEND_PROGRAM\n",
        {"main.n": 6, "main.k": 5},
    ),
    "an if with many branches": (
        "PROGRAM main\nVAR k : INT := 77; n : INT; END_VAR\nk := k + 1;\nIF FALSE THEN ;\n"
        + "".join(f"ELSIF k = {group} THEN n := {group}; k := 5;\n" for group in range(70))
        + "ELSE n := -1;\nEND_IF;\nEND_PROGRAM\n",
        {"main.n": -1, "main.k": 79},
    ),
    "a deep expression": (
        f"PROGRAM main\nVAR a, b : DINT; c : INT := 1; END_VAR\na := {'(' * 60}c{' / 3 + 2)' * 60};\n"
        f"b := {'(' * 100}c{' + c)' * 100};\nEND_PROGRAM\n",
        {"main.a": 2, "main.b": 101},
    ),
}


@pytest.mark.parametrize("engine", ENGINE_TARGETS)
@pytest.mark.parametrize("name", _CASES)
def test_two_scans(name: str, engine: str) -> None:
    text, expected = _CASES[name]
    with Simulation(compile_files([SourceFile("main.st", text)], ENGINE_TARGETS[engine]), engine) as simulation:
        assert simulation.scan(1 if name.startswith("an instance in an array") else 2) is None
        assert {path: simulation.get(path) for path in expected} == expected


@pytest.mark.parametrize("engine", ENGINE_TARGETS)
def test_two_instances_of_a_program_under_two_tasks(engine: str) -> None:
    with Simulation(compile_files([SourceFile("main.st", _PROGRAMS)], ENGINE_TARGETS[engine]), engine) as simulation:
        assert simulation.scan(3) is None
        assert [simulation.get("p1.n"), simulation.get("p2.n")] == [3, 2]
        assert [simulation.get("p1.row"), simulation.get("p2.row")] == [[3, 1, 2], [0, 1, 2]]
        assert [simulation.get("p1.f"), simulation.get("p2.f")] == [1.5, 1.0]
        assert [simulation.get("p1.t.ET"), simulation.get("p2.t.ET")] == ["T#20ms", "T#20ms"]


_FAULTS = {
    "b(x := k);": 13,
    "y := F(x := k);": 13,
    "y := F(x := 1, o => s);": 13,
    "b(o => s);": 13,
    "y := G(x := 7);": 7,
    "a[2] := k;": 13,
    "FOR s := 0 TO 8 DO y := y + 1; END_FOR;": 13,
    "FOR s := k TO 0 DO y := y + 1; END_FOR; s := k;": 13,
}
_SUBRANGES = """TYPE R : INT (0..5); END_TYPE
FUNCTION F : INT
VAR_INPUT x : R; END_VAR VAR_OUTPUT o : INT; END_VAR
F := x; o := 99;
END_FUNCTION
FUNCTION G : R VAR_INPUT x : INT; END_VAR
G := x;
END_FUNCTION
FUNCTION_BLOCK B VAR_INPUT x : R; END_VAR VAR_OUTPUT o : INT := 99; END_VAR ;
END_FUNCTION_BLOCK
PROGRAM main
VAR b : B; k : INT := 6; y : INT; s : R; a : ARRAY[0..3] OF R; END_VAR
"""


@pytest.mark.parametrize("statement", _FAULTS)
def test_a_subrange_is_checked_on_every_way_in(statement: str) -> None:
    text = f"{_SUBRANGES}{statement}\nEND_PROGRAM\n"
    with Simulation(compile_files([SourceFile("main.st", text)], ENGINE_TARGETS["cpython"]), "cpython") as simulation:
        fault = simulation.scan()
        assert fault is not None
        assert (fault.kind, fault.line) == ("range", _FAULTS[statement])
        value = simulation.get("main.s")
        assert isinstance(value, int) and 0 <= value <= 5


@pytest.mark.parametrize("engine", ENGINE_TARGETS)
def test_a_loop_that_does_not_end(engine: str) -> None:
    text = "PROGRAM main\nVAR n : DINT; END_VAR\nWHILE n >= 0 DO\n  n := (n + 1) MOD 5;\nEND_WHILE;\nEND_PROGRAM\n"
    with Simulation(compile_files([SourceFile("main.st", text)], ENGINE_TARGETS[engine]), engine) as simulation:
        fault = simulation.scan()
        assert fault is not None
        assert (fault.kind, fault.line) == ("loop", 3)
