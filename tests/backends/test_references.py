"""References (6.4.4.10) on every engine: what they refer to, in all places where they can stand."""

from __future__ import annotations

import pytest

from iec2mpy.backends.target import ENGINE_TARGETS
from iec2mpy.project.compile import compile_files
from iec2mpy.simulator.session import Simulation
from iec2mpy.source.spans import SourceFile

_TYPES = """
TYPE
  Pair : STRUCT n : INT; x : REAL; s : STRING[8]; END_STRUCT;
  Node : STRUCT pair : REF_TO Pair; list : ARRAY[0..1] OF REF_TO INT; END_STRUCT;
END_TYPE
FUNCTION_BLOCK Counter
VAR_INPUT inc : INT := 1; END_VAR
VAR_OUTPUT n : INT; own : REF_TO INT; END_VAR
VAR hidden : INT := 5; r : REF_TO INT := REF(hidden); w : REAL; END_VAR
n := n + inc; r^ := r^ + n; own := r; w := w + 0.5;
END_FUNCTION_BLOCK
"""

_PROGRAMS = {
    "structures, strings and reals": (
        """
VAR p, q : Pair; r : REF_TO Pair; x : REF_TO REAL; s : REF_TO STRING[8]; same : BOOL; t : STRING; END_VAR
r := REF(p); r^.n := 7; r^.x := 1.5; r^.s := 'far too long';
x := REF(r^.x); x^ := x^ * 2.0;
s := REF(p.s); t := CONCAT(s^, '!'); s^ := 'b';
q := r^; same := r^ = q; r := REF(q); r^.n := -1;
""",
        {"p.n": 7, "p.x": 3.0, "p.s": "b", "q.n": -1, "q.x": 3.0, "q.s": "b", "same": True, "t": "far too !"},
    ),
    "elements, and references to references": (
        """
VAR a : ARRAY[1..3, 0..1] OF INT; i : INT; r : REF_TO INT; rr : REF_TO REF_TO INT; list : ARRAY[1..6] OF REF_TO INT;
  sum : INT; row : ARRAY[0..2] OF REAL; whole : REF_TO ARRAY[0..2] OF REAL; END_VAR
FOR i := 1 TO 6 DO list[i] := REF(a[(i + 1) / 2, (i + 1) MOD 2]); list[i]^ := i * 10; END_FOR;
rr := REF(r); r := list[4]; rr^^ := 41; rr^ := list[5];
sum := a[1, 0] + rr^^;
whole := REF(row); whole^[i - 5] := 2.5; i := 1;
""",
        {"a": [[10, 20], [30, 41], [50, 60]], "sum": 60, "row": [0.0, 0.0, 2.5]},
    ),
    "instances": (
        """
VAR c, d : Counter; many : ARRAY[1..3] OF Counter; r : REF_TO Counter; n1, n2, i : INT; own : REF_TO INT; END_VAR
r := REF(c); r^(inc := 2, n => n1); r^(); r^.inc := 30; r^();
r := REF(d); r^(n => n2, own => own); own^ := own^ + 100;
FOR i := 1 TO 3 DO r := REF(many[i]); r^(inc := i, own => own); END_FOR;
""",
        {"c.n": 34, "n1": 2, "n2": 1, "c.hidden": 45, "d.hidden": 106, "many[3].hidden": 8, "many[1].w": 0.5},
    ),
    "initial values": (
        """
VAR p : Pair := (n := 3); a : ARRAY[0..2] OF INT := [1, 2, 3]; first : REF_TO INT := REF(a[0]);
  node : Node := (pair := REF(p), list := [REF(a[2]), NULL]); END_VAR
VAR_TEMP t : REF_TO INT := REF(a[1]); m : Node := (list := [NULL, REF(p.n)]); none : BOOL; END_VAR
VAR n0, n1, n2 : INT; empty : BOOL; END_VAR
n0 := first^ + node.pair^.n; n1 := node.list[0]^ + t^; t := NULL; n2 := m.list[1]^; m.list[1] := NULL;
empty := node.list[1] = NULL AND m.pair = NULL AND node.pair <> NULL;
""",
        {"n0": 4, "n1": 5, "n2": 3, "empty": True},
    ),
    "functions": (
        """
VAR a, b : INT; r : REF_TO INT; c : Counter; p : Pair; same : BOOL; END_VAR
a := 5; b := 9; Bump(REF(a)); Bump(r := REF(b)); larger(x := REF(a), y := REF(b))^ := 1;
r := larger(REF(a), REF(b)); r^ := r^ * 2; same := r = REF(a) AND REF(a) <> REF(b) AND SEL(b = 1, NULL_OF(), r)^ = a;
swap(a := r^, b := b);
""",
        {"a": 1, "b": 12, "same": True},
    ),
    "what is read before a call stays": (
        """
VAR a, b : INT; r : REF_TO INT; ra : ARRAY[0..1] OF INT; END_VAR
VAR_EXTERNAL shared : REF_TO INT; END_VAR
shared := REF(a); shared^ := forget(5);
shared := REF(b); ra[forget(1)] := 3; r := REF(ra[1]); b := r^ + forget(10) + r^;
""",
        {"a": 5, "b": 16, "ra": [0, 3]},
    ),
    "a loop whose counter has a reference": (
        """
VAR i, passes, seen : INT; r : REF_TO INT := REF(i); END_VAR
passes := 0;
FOR i := 1 TO 5 DO passes := passes + 1; r^ := 40; seen := i; END_FOR;
""",
        {"passes": 5, "seen": 40},
    ),
    "stores through a reference are seen": (
        """
VAR x : INT := 1; y, z : INT; r : REF_TO INT := REF(x); END_VAR
x := 1; r^ := 1000; y := x * 20; IF x < 10 THEN z := 1; ELSE z := 2; END_IF;
""",
        {"y": 20000, "z": 2},
    ),
    "globals": (
        """
VAR n : INT; END_VAR
VAR_EXTERNAL g : INT; rg : REF_TO INT; END_VAR
g := 3; rg^ := rg^ + 4; n := g;
""",
        {"n": 7},
    ),
}

_FUNCTIONS = """
VAR_GLOBAL g : INT; rg : REF_TO INT := REF(g); shared : REF_TO INT; END_VAR
FUNCTION Bump
VAR_INPUT r : REF_TO INT; END_VAR
r^ := r^ + 1;
END_FUNCTION
FUNCTION larger : REF_TO INT
VAR_INPUT x, y : REF_TO INT; END_VAR
IF x^ > y^ THEN larger := x; ELSE larger := y; END_IF;
END_FUNCTION
FUNCTION NULL_OF : REF_TO INT
NULL_OF := NULL;
END_FUNCTION
FUNCTION swap
VAR_IN_OUT a, b : INT; END_VAR
VAR t : INT; END_VAR
t := a; a := b; b := t;
END_FUNCTION
FUNCTION forget : INT
VAR_INPUT n : INT; END_VAR
VAR_EXTERNAL shared : REF_TO INT; END_VAR
shared := NULL; forget := n;
END_FUNCTION
"""


@pytest.mark.parametrize("engine", ENGINE_TARGETS)
@pytest.mark.parametrize("name", _PROGRAMS)
def test_references(name: str, engine: str) -> None:
    body, expected = _PROGRAMS[name]
    text = f"{_TYPES}{_FUNCTIONS}PROGRAM main\n{body}\nEND_PROGRAM\n"
    generated = compile_files([SourceFile("main.st", text)], ENGINE_TARGETS[engine])
    with Simulation(generated, engine) as simulation:
        assert simulation.scan() is None
        assert {path: simulation.get(f"main.{path}") for path in expected} == expected


_NULL = {
    "read": "x := r^;",
    "written": "r^ := x;",
    "a member": "x := p^.n;",
    "an element": "x := a^[x];",
    "an instance": "c^(inc := 1);",
    "an output": "x := c^.n;",
    "an in-out": "swap(r^, x);",
    "a reference to a part": "r := REF(p^.n);",
    "a whole": "pair := p^;",
}


@pytest.mark.parametrize("engine", ENGINE_TARGETS)
@pytest.mark.parametrize("use", _NULL)
def test_null_faults(use: str, engine: str) -> None:
    variables = "r : REF_TO INT; p : REF_TO Pair; pair : Pair; a : REF_TO ARRAY[0..2] OF INT; c : REF_TO Counter;"
    text = f"{_TYPES}{_FUNCTIONS}PROGRAM main\nVAR {variables} x : INT; END_VAR\n{_NULL[use]}\nEND_PROGRAM\n"
    generated = compile_files([SourceFile("main.st", text)], ENGINE_TARGETS[engine])
    with Simulation(generated, engine) as simulation:
        fault = simulation.scan()
        assert fault is not None and fault.kind == "NULL"


def test_map_shows_null_or_not() -> None:
    text = "PROGRAM main\nVAR x : INT; r : REF_TO INT; on : BOOL; END_VAR\nIF on THEN r := REF(x); END_IF;\nEND_PROGRAM"
    with Simulation(compile_files([SourceFile("main.st", text)], ENGINE_TARGETS["cpython"]), "cpython") as simulation:
        assert simulation.get("main.r") == "NULL"
        simulation.set("main.on", True)
        simulation.scan()
        assert simulation.get("main.r") == "not NULL"
        simulation.set("main.on", False)
        simulation.set("main.r", "null")
        simulation.scan()
        assert simulation.get("main.r") == "NULL"


def test_restart_gives_references_their_initial_value() -> None:
    text = """PROGRAM main
VAR RETAIN x, y : INT; s : ARRAY[0..1] OF Kept; r : REF_TO INT := REF(x); END_VAR
r^ := r^ + 1; s[1].n := s[1].n + 1; r := REF(y); s[1].r := r;
END_PROGRAM
TYPE Kept : STRUCT n : INT; r : REF_TO INT; END_STRUCT; END_TYPE
"""
    with Simulation(compile_files([SourceFile("main.st", text)], ENGINE_TARGETS["cpython"]), "cpython") as simulation:
        simulation.scan()
        simulation.restart(cold=False)
        assert simulation.get("main.s[1].r") == "NULL"
        assert simulation.get("main.s[1].n") == 1
        simulation.scan()
        assert (simulation.get("main.x"), simulation.get("main.y")) == (2, 0)
