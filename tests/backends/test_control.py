"""EN and ENO, on all engines: what is caught, what is not, and what stays as it was (6.6.1.5)."""

from __future__ import annotations

from collections.abc import Mapping

import pytest

from iec2mpy.backends.target import ENGINE_TARGETS
from iec2mpy.project.compile import compile_files
from iec2mpy.simulator.session import Fault, Simulation
from iec2mpy.source.spans import SourceFile

_LONG = "\n".join(f"n := n + {number} - v;" for number in range(90))
"""Too much to stand in place of its call."""
_POUS = f"""TYPE pair : STRUCT a : INT; b : REAL; END_STRUCT; END_TYPE

FUNCTION quotient : INT
VAR_INPUT a, b : INT; END_VAR
VAR_OUTPUT rest : INT; END_VAR
VAR_IN_OUT steps : INT; END_VAR
steps := steps + 1;
rest := a MOD b;
quotient := a / b;
steps := steps + 10;
END_FUNCTION

FUNCTION deep : INT
VAR_INPUT a, b : INT; END_VAR
VAR_IN_OUT steps : INT; END_VAR
VAR n, v : INT; END_VAR
{_LONG}
deep := quotient(a := a, b := b, steps := steps) + 1;
END_FUNCTION

FUNCTION root : REAL
VAR_INPUT x : REAL; END_VAR
root := SQRT(x);
END_FUNCTION

FUNCTION two : pair
VAR_INPUT a : INT; END_VAR
two.a := 10 / a;
two.b := 0.5;
END_FUNCTION

FUNCTION endless : BOOL
VAR n : INT; END_VAR
WHILE n < 3 DO n := 1; END_WHILE;
endless := TRUE;
END_FUNCTION

FUNCTION_BLOCK store
VAR_INPUT EN : BOOL; i, v : INT; END_VAR
VAR_OUTPUT ENO, was : BOOL; n : INT; END_VAR
VAR a : ARRAY[1..3] OF INT; END_VAR
was := EN;
n := n + 1;
a[i] := v;
n := a[1] + a[2] + a[3];
IF v = 99 THEN ENO := FALSE; END_IF;
END_FUNCTION_BLOCK
"""
Values = Mapping[str, object]


def _run(
    engine: str, variables: str, body: str, steps: list[tuple[Values, Values]], last: Values | None = None
) -> Fault | None:
    """Each step sets variables, scans, and compares others; `last` is set before the last scan, which may fault."""
    text = f"{_POUS}\nPROGRAM main\nVAR {variables} END_VAR\n{body}\nEND_PROGRAM\n"
    with Simulation(compile_files([SourceFile("main.st", text)], ENGINE_TARGETS[engine]), engine) as simulation:
        for given, expected in steps:
            for name, value in given.items():
                simulation.set(f"main.{name}", value)
            assert simulation.scan() is None
            assert {name: simulation.get(f"main.{name}") for name in expected} == expected, given
        for name, value in (last or {}).items():
            simulation.set(f"main.{name}", value)
        return simulation.scan() if last is not None else None


pytestmark = pytest.mark.parametrize("engine", ENGINE_TARGETS)


@pytest.mark.parametrize("function", ["quotient", "deep"])
def test_a_fault_ends_the_call_however_deep_it_is(engine: str, function: str) -> None:
    more = {"quotient": 0, "deep": 1}[function]
    _run(
        engine,
        "a : INT := 7; b, c, n : INT; ok : BOOL;",
        f"c := {function}(a := a, b := b, steps := n, ENO => ok);",
        [
            ({"b": 2}, {"c": 3 + more, "ok": True, "n": 11}),
            ({"b": 0}, {"c": 3 + more, "ok": False, "n": 12}),
            ({"b": -7}, {"c": -1 + more, "ok": True, "n": 23}),
        ],
    )


def test_outputs_are_copied_only_after_success(engine: str) -> None:
    _run(
        engine,
        "b, r, n : INT; x : ARRAY[1..2] OF INT; bad : BOOL;",
        "x[n MOD 2 + 1] := quotient(a := 9, b := b, steps := n, rest => r, NOT ENO => bad) * 2;",
        [({"b": 4}, {"r": 1, "x": [4, 0], "bad": False}), ({"b": 0}, {"r": 1, "bad": True, "x": [4, 0]})],
    )


def test_within_an_expression_a_failed_call_gives_the_default_value(engine: str) -> None:
    _run(
        engine,
        "b, y, n : INT; s : STRING; ok, high : BOOL;",
        """y := 100 + DIV(IN1 := 8, IN2 := b, ENO => ok);
s := CONCAT('<', LEFT(IN := 'abc', L := b, ENO => high));""",
        [
            ({"b": 2}, {"y": 104, "ok": True, "s": "<ab", "high": True}),
            ({"b": 0}, {"y": 100, "ok": False, "s": "<", "high": True}),
            ({"b": -1}, {"y": 92, "ok": True, "s": "<", "high": False}),
        ],
    )


def test_real_faults_of_the_runtime(engine: str) -> None:
    _run(
        engine,
        "x : REAL; y, z : REAL; i : INT; ok, fine, whole : BOOL;",
        """y := root(x := x, ENO => ok);
z := SQRT(IN := x, ENO => fine);
i := REAL_TO_INT(IN := x, ENO => whole);""",
        [
            ({"x": 9.0}, {"y": 3.0, "ok": True, "z": 3.0, "fine": True, "i": 9, "whole": True}),
            ({"x": -4.0}, {"y": 3.0, "ok": False, "z": 3.0, "fine": False, "i": -4, "whole": True}),
            ({"x": 1e9}, {"ok": True, "i": -4, "whole": False}),
        ],
    )


def test_whole_results(engine: str) -> None:
    _run(
        engine,
        "a : INT; p, q : pair; ok : BOOL; same : BOOL;",
        "p := two(a := a, ENO => ok); same := two(EN := a > 5, a := a) = q;",
        [
            ({"a": 5}, {"p": {"a": 2, "b": 0.5}, "ok": True, "same": True}),
            ({"a": 0}, {"p": {"a": 2, "b": 0.5}, "ok": False}),
            ({"a": 10}, {"p": {"a": 1, "b": 0.5}, "ok": True, "same": False}),
        ],
    )


def test_blocks_keep_what_they_had_stored(engine: str) -> None:
    _run(
        engine,
        "s : store; en, ok, eno, was : BOOL; i, v, out : INT;",
        "s(EN := en, i := i, v := v, ENO => ok, n => out, was => was); eno := s.ENO;",
        [
            ({"en": False, "i": 9}, {"ok": False, "eno": False, "s.n": 0, "out": 0, "was": False}),
            ({"en": True, "i": 2, "v": 5}, {"ok": True, "eno": True, "s.n": 5, "out": 5, "was": True}),
            ({"i": 4}, {"ok": False, "eno": False, "s.n": 6, "out": 5}),
            ({"i": 1, "v": 99}, {"ok": False, "eno": False, "s.n": 104, "out": 104}),
            ({"v": 1}, {"ok": True, "eno": True, "s.n": 6, "out": 6}),
        ],
    )


def test_a_call_that_is_not_enabled_does_not_look_at_its_arguments(engine: str) -> None:
    _run(
        engine,
        "i, n, y : INT; x : ARRAY[1..3] OF INT := [3, 4, 5];",
        "y := quotient(EN := i >= 1 AND i <= 3, b := 1, a := x[i], steps := n);",
        [({"i": 3}, {"y": 5, "n": 11}), ({"i": 4}, {"y": 5, "n": 11}), ({"i": 1}, {"y": 3, "n": 22})],
    )


@pytest.mark.parametrize(
    ("body", "kind"),
    [
        ("ok := endless(ENO => ok);", "loop"),
        ("y := quotient(EN := TRUE, a := 1, b := b, steps := n);", "zero"),
        ("y := quotient(a := 1 / b, b := 1, steps := n, ENO => ok);", "zero"),
        ("y := DIV(IN1 := DIV(1, b), IN2 := 1, ENO => ok);", "zero"),
        ("y := DIV(IN1 := quotient(a := 1, b := b, steps := n), IN2 := 1, ENO => ok);", "zero"),
        ("ok := TRUE; x[quotient(a := 4, b := 1, steps := n, ENO => ok)] := 1;", "index"),
        ("small := DIV(IN1 := 40, IN2 := b + 1, ENO => ok);", "range"),
    ],
)
def test_what_is_not_caught(engine: str, body: str, kind: str) -> None:
    fault = _run(engine, "b, n, y : INT; x : ARRAY[1..3] OF INT; small : INT (0..9); ok : BOOL;", body, [], last={})
    assert fault is not None
    assert fault.kind == kind


def test_faults_in_turn(engine: str) -> None:
    """A fault that was caught is caught again, and one that is not stops the controller."""
    fault = _run(
        engine,
        "b, c, n, caught : INT; ok, guarded : BOOL := TRUE;",
        """FOR n := 1 TO 200 DO
  IF guarded THEN c := DIV(IN1 := n, IN2 := b, ENO => ok);
  ELSE c := n / b;
  END_IF;
  IF NOT ok THEN caught := caught + 1; END_IF;
END_FOR;""",
        [({}, {"caught": 200, "n": 201}), ({"b": 1}, {"caught": 200, "c": 200})],
        last={"guarded": False, "b": 0},
    )
    assert fault is not None
    assert (fault.kind, fault.line - _POUS.count("\n")) == ("zero", 6)
