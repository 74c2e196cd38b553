"""Types of 64 bits, which are objects to MicroPython, on every engine."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from iec2mpy.backends.coding import format_duration
from iec2mpy.backends.target import ENGINE_TARGETS, PORTABLE
from iec2mpy.project.compile import compile_files
from iec2mpy.semantics import arithmetic
from iec2mpy.semantics import types as ty
from iec2mpy.simulator.session import Simulation
from iec2mpy.source.spans import SourceFile

_TOGETHER = """TYPE big : LINT (-10..10_000_000_000) := 5; E : LINT (e1 := 5_000_000_000, e2); END_TYPE
FUNCTION twice : LINT
VAR_INPUT x : LINT; END_VAR
VAR_IN_OUT n : ULINT; END_VAR
n := n + 1;
twice := x * 2;
END_FUNCTION
PROGRAM main
VAR a : LINT := 9223372036854775807; b : LINT; c : ULINT; d : LWORD := 16#8000_0000_0000_0001;
 i : INT := -5; u : UDINT := 4000000000;
 m : ARRAY[0..3] OF LINT := [1, 2, 3, 4]; s : LINT; k : LINT; t : big;
 w : DWORD; x : LREAL; y : LREAL := 1.0E300; e : E := e2;
 l : LTIME; l2 : LTIME := LT#1s; q : BOOL; r : REAL := 2.5; g : DINT;
 h : LINT := -7; rr : LREAL; tt : TIME := T#1s; END_VAR
b := a + 1;
c := TO_ULINT(u) * 4000000000;
c := c - TO_ULINT(twice(3, c));
d := ROL(d, 1) OR SHL(LWORD#1, 63) XOR NOT LWORD#0;
FOR k := 0 TO 3 DO s := s + m[k] * i; END_FOR;
t := t + 1;
w := LWORD_TO_DWORD(d);
x := i + 0.5;
y := y * 10.0;
l := l2 * r + tt;
q := l > T#3s AND u < a;
g := LINT_TO_DINT(h / 2);
h := h MOD 4;
CASE b OF -9223372036854775808: h := h - 10; 5_000_000_000..6_000_000_000: h := 0; END_CASE;
rr := SQRT(x * x) ;
END_PROGRAM
"""
_EXPECTED = {
    "b": -(1 << 63),
    "c": 15999999999999999994,
    "d": (1 << 63) - 1,
    "s": -50,
    "t": 6,
    "w": 0xFFFFFFFF,
    "x": -4.5,
    "l": "LT#3s500ms",
    "q": True,
    "g": -3,
    "h": -13,
    "rr": 4.5,
    "k": 4,
    "e": "e2",
}
_SHARED = """PROGRAM main
VAR a AT %MW0 : ARRAY[0..3] OF WORD; l AT %MW0 : LINT; x AT %MW10 : LREAL;
 w AT %MW13 : WORD; y : LREAL; q : BOOL; END_VAR
l := l - 2;
w := 16#4000;
y := x;
q := l < 0;
END_PROGRAM
"""
_BLOCKS = """PROGRAM main
VAR c : CTU_LINT; d : CTD_ULINT; b : CTUD_LINT; x : BOOL; t : TON_LTIME; p : TP_LTIME; o : TOF_LTIME; END_VAR
x := NOT x;
c(CU := x, PV := 9223372036854775807);
d(CD := x, LD := FALSE, PV := 3);
b(CD := x, PV := 2);
t(IN := TRUE, PT := LT#4ms);
p(IN := TRUE, PT := LT#3ms500us);
o(IN := FALSE, PT := LT#1s);
END_PROGRAM
"""


def _simulation(text: str, engine: str) -> Simulation:
    return Simulation(compile_files([SourceFile("wide.st", text)], ENGINE_TARGETS[engine], 1500), engine)


@pytest.mark.parametrize("engine", ENGINE_TARGETS)
def test_all_together(engine: str) -> None:
    with _simulation(_TOGETHER, engine) as running:
        assert running.scan() is None
        assert {name: running.get(f"main.{name}") for name in _EXPECTED} == _EXPECTED


@pytest.mark.parametrize("engine", ENGINE_TARGETS)
def test_among_shared_bytes(engine: str) -> None:
    with _simulation(_SHARED, engine) as running:
        running.scan()
        assert running.get("main.a") == [0xFFFE, 0xFFFF, 0xFFFF, 0xFFFF]
        assert [running.get(f"main.{name}") for name in ("l", "x", "y", "q")] == [-2, 2.0, 2.0, True]
        running.set("main.l", 1 << 32)
        running.set("main.x", 1.0)
        running.scan()
        assert running.get("main.a") == [0xFFFE, 0xFFFF, 0, 0]


@pytest.mark.parametrize("engine", ENGINE_TARGETS)
def test_blocks(engine: str) -> None:
    with _simulation(_BLOCKS, engine) as running:
        running.scan(2)
        assert running.get("main.t.et") == "LT#1ms500us"
        running.set("main.c.cv", (1 << 63) - 2)
        running.scan(3)
        assert [running.get(f"main.{name}") for name in ("t.et", "t.q", "p.q", "c.q")] == ["LT#4ms", True, False, True]


@pytest.mark.parametrize("engine", ENGINE_TARGETS)
@pytest.mark.parametrize(
    ("variables", "body", "kind"),
    [
        ("a : LINT := -1; b : ULINT;", "b := LINT_TO_ULINT(a);", "range"),
        ("a : ULINT := 5_000_000_000; b : UDINT;", "b := ULINT_TO_UDINT(a);", "range"),
        ("a : LINT; b : LINT := 1;", "b := b / a;", "zero"),
        ("a : LREAL := 1.0E30; b : LINT;", "b := LREAL_TO_LINT(a);", "range"),
        ("a : LINT (0..9) := 9;", "a := a + 1;", "range"),
        ("a : LINT := 5_000_000_000; b : ARRAY[0..3] OF INT;", "b[a] := 1;", "index"),
        ("a : LTIME := LT#100d; b : TIME;", "b := LTIME_TO_TIME(a);", "range"),
        ("a : LINT := -1; b : LWORD;", "b := SHL(b, a);", "range"),
        ("a : LTIME := LT#1s; x : REAL := 1.0E12;", "a := a * x;", "range"),
        ("a : LTIME := LT#1s; x : REAL;", "a := a / x;", "zero"),
    ],
)
def test_faults(engine: str, variables: str, body: str, kind: str) -> None:
    with _simulation(f"PROGRAM main\nVAR {variables} END_VAR\n{body}\nEND_PROGRAM\n", engine) as running:
        fault = running.scan()
        assert fault is not None
        assert fault.kind == kind


_SCALED = """PROGRAM main
VAR a, product, quotient : LTIME; x : REAL; END_VAR
product := a * x;
quotient := a / x;
END_PROGRAM
"""
_FACTORS = st.floats(min_value=2**-20, max_value=2**20, width=32).flatmap(lambda x: st.sampled_from([x, -x]))


@pytest.mark.parametrize("engine", ENGINE_TARGETS)
@settings(max_examples=20, deadline=None)
@given(duration=st.integers(-(2**42), 2**42), factor=_FACTORS)
def test_ltime_by_a_real_is_exact_everywhere(engine: str, duration: int, factor: float) -> None:
    with _simulation(_SCALED, engine) as running:
        running.set("main.a", f"LT#{'-' if duration < 0 else ''}{abs(duration)}ns")
        running.set("main.x", factor)
        assert running.scan() is None
        for name, operator in (("product", "*"), ("quotient", "/")):
            value = arithmetic.binary(operator, duration, factor, ty.LTIME, ty.REAL)
            assert isinstance(value, int)
            assert running.get(f"main.{name}") == format_duration("LT", value, "ns")


def test_retained() -> None:
    variables = "VAR RETAIN a : LINT; END_VAR\nVAR b : LINT; END_VAR\n"
    text = f"PROGRAM main\n{variables}a := a + 5_000_000_000; b := b + 1;\nEND_PROGRAM\n"
    program = compile_files([SourceFile("wide.st", text)], PORTABLE)
    with Simulation(program, "cpython") as running:
        running.scan(2)
        running.restart(cold=False)
        running.scan()
        assert (running.get("main.a"), running.get("main.b")) == (15_000_000_000, 1)
