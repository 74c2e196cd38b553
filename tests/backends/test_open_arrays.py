"""Arrays of variable length (6.5.3) on every engine: their limits, their elements, and what they are given."""

from __future__ import annotations

import pytest

from iec2mpy.backends.target import ENGINE_TARGETS
from iec2mpy.project.compile import compile_files
from iec2mpy.simulator.session import Simulation
from iec2mpy.source.spans import SourceFile

_POUS = """
TYPE Pair : STRUCT n : INT := 3; x : REAL; END_STRUCT; END_TYPE
FUNCTION MATRIX_MUL
VAR_INPUT A, B : ARRAY[*, *] OF INT; END_VAR
VAR_OUTPUT C : ARRAY[*, *] OF INT; END_VAR
VAR i, j, k, s : INT; END_VAR
FOR i := LOWER_BOUND(A, 1) TO UPPER_BOUND(A, 1) DO
  FOR j := LOWER_BOUND(B, 2) TO UPPER_BOUND(B, 2) DO
    s := 0;
    FOR k := LOWER_BOUND(A, 2) TO UPPER_BOUND(A, 2) DO s := s + A[i, k] * B[k, j]; END_FOR;
    C[i, j] := s;
  END_FOR;
END_FOR;
END_FUNCTION
FUNCTION total : REAL
VAR_INPUT a : ARRAY[*] OF Pair; END_VAR
VAR i : DINT; END_VAR
FOR i := LOWER_BOUND(a, 1) TO UPPER_BOUND(a, 1) DO total := total + a[i].x; END_FOR;
END_FUNCTION
FUNCTION blank
VAR_OUTPUT a : ARRAY[*] OF Pair; n : ARRAY[*] OF INT; END_VAR
n[UPPER_BOUND(n, 1)] := 7;
END_FUNCTION
FUNCTION set
VAR_INPUT i, j : DINT; v : INT; END_VAR
VAR_IN_OUT a : ARRAY[*, *] OF INT; END_VAR
a[i, j] := v;
END_FUNCTION
FUNCTION pass_on : DINT
VAR_IN_OUT a : ARRAY[*, *] OF INT; END_VAR
VAR_INPUT d : INT; END_VAR
set(LOWER_BOUND(a, 1), UPPER_BOUND(a, 2), 9, a);
pass_on := UPPER_BOUND(a, d) - LOWER_BOUND(a, d);
END_FUNCTION
FUNCTION_BLOCK Turn
VAR_IN_OUT a : ARRAY[*] OF REAL; END_VAR
VAR_OUTPUT pos : INT; END_VAR
VAR u : UDINT := 1; END_VAR
pos := pos + 1; a[pos] := a[pos] + 1.5; a[u] := 0.5;
END_FUNCTION_BLOCK
"""

_PROGRAMS = {
    "inputs and outputs": (
        """
VAR a : ARRAY[1..2, 1..3] OF INT := [1, 2, 3, 4, 5, 6]; b : ARRAY[1..3, 0..1] OF INT := [1, 0, 0, 1, 2, 2];
  c : ARRAY[1..2, 0..1] OF INT := [4(99)]; END_VAR
MATRIX_MUL(a, b, c);
""",
        {"c": [[7, 8], [16, 17]]},
    ),
    "outputs start anew": (
        """
VAR p : ARRAY[-1..1] OF Pair := [3(n := 8, x := 2.5)]; n : ARRAY[5..8] OF INT := [4(1)]; before, after : REAL; END_VAR
before := total(p); blank(a => p, n => n); after := total(a := p);
""",
        {"before": 7.5, "after": 0.0, "n": [0, 0, 0, 7], "p[0].n": 3},
    ),
    "from one to the next": (
        """
VAR m : ARRAY[1..2, -3..0] OF INT; rows, columns : DINT; r : REF_TO ARRAY[0..1, 0..1] OF INT;
  q : ARRAY[0..1, 0..1] OF INT; END_VAR
rows := pass_on(m, 1); columns := pass_on(a := m, d := 2); set(i := 2, j := -3, v := 4, a := m);
r := REF(q); set(1, 0, 5, r^);
""",
        {"m": [[0, 0, 0, 9], [4, 0, 0, 0]], "rows": 1, "columns": 3, "q": [[0, 0], [5, 0]]},
    ),
    "blocks": (
        """
VAR x : ARRAY[1..3] OF REAL; y : ARRAY[0..2] OF REAL; t, u : Turn; END_VAR
t(a := x); t(a := x); u(a := y); u(a := y);
""",
        {"x": [0.5, 1.5, 0.0], "y": [0.0, 0.5, 1.5], "t.pos": 2},
    ),
}


@pytest.mark.parametrize("engine", ENGINE_TARGETS)
@pytest.mark.parametrize("name", _PROGRAMS)
def test_open_arrays(name: str, engine: str) -> None:
    body, expected = _PROGRAMS[name]
    text = f"{_POUS}PROGRAM main\n{body}\nEND_PROGRAM"
    generated = compile_files([SourceFile("main.st", text)], ENGINE_TARGETS[engine])
    with Simulation(generated, engine) as simulation:
        assert simulation.scan() is None
        assert {path: simulation.get(f"main.{path}") for path in expected} == expected


@pytest.mark.parametrize("engine", ENGINE_TARGETS)
def test_each_subscript_is_checked(engine: str) -> None:
    variables = "m : ARRAY[1..2, -3..0] OF INT; i : DINT := 1; j : DINT := -1;"
    text = f"{_POUS}PROGRAM main\nVAR {variables} END_VAR\nset(i, j, 1, m);\nEND_PROGRAM"
    generated = compile_files([SourceFile("main.st", text)], ENGINE_TARGETS[engine])
    with Simulation(generated, engine) as simulation:
        for i, j, right in ((2, 0, True), (1, -3, True), (0, 0, False), (3, 0, False), (1, 1, False), (1, -4, False),
                            (-2147483648, 0, False), (1, 2147483647, False)):  # fmt: skip
            simulation.restart(cold=True)
            simulation.set("main.i", i)
            simulation.set("main.j", j)
            fault = simulation.scan()
            assert (fault is None) is right
            assert fault is None or fault.kind == "index"


@pytest.mark.parametrize("engine", ENGINE_TARGETS)
def test_a_dimension_that_is_worked_out(engine: str) -> None:
    text = f"""{_POUS}PROGRAM main
VAR m : ARRAY[1..2, -3..0] OF INT; d : INT := 1; low, span : DINT; END_VAR
low := LOWER_BOUND(m, d); span := pass_on(m, d);
END_PROGRAM"""
    generated = compile_files([SourceFile("main.st", text)], ENGINE_TARGETS[engine])
    with Simulation(generated, engine) as simulation:
        simulation.set("main.d", 2)
        assert simulation.scan() is None
        assert (simulation.get("main.low"), simulation.get("main.span")) == (-3, 3)
        simulation.set("main.d", 3)
        fault = simulation.scan()
        assert fault is not None and fault.kind == "range"
