"""The standard blocks against plain models of tables 43 to 46, over random inputs, in virtual time."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from iec2mpy.backends.target import ENGINE_TARGETS
from iec2mpy.project.compile import compile_files
from iec2mpy.simulator.session import Simulation
from iec2mpy.source.spans import SourceFile

PERIOD = 10
PT = 50
PV = 3
SOURCE = f"""PROGRAM main
VAR x, y, z, w : BOOL; END_VAR
VAR
  set_first : SR; reset_first : RS; rise : R_TRIG; fall : F_TRIG;
  up : CTU; down : CTD; both : CTUD; pulse : TP; on_delay : TON; off_delay : TOF;
END_VAR
set_first(S1 := x, R := y);
reset_first(S := x, R1 := y);
rise(CLK := x);
fall(CLK := x);
up(CU := x, R := y, PV := {PV});
down(CD := x, LD := y, PV := {PV});
both(CU := x, CD := z, R := y, LD := w, PV := {PV});
pulse(IN := x, PT := T#{PT}ms);
on_delay(IN := x, PT := T#{PT}ms);
off_delay(IN := x, PT := T#{PT}ms);
END_PROGRAM
"""
Inputs = tuple[bool, bool, bool, bool]


def simulation_of(source: str) -> Simulation:
    return Simulation(compile_files([SourceFile("blocks.st", source)], ENGINE_TARGETS["cpython"]), "cpython")


@pytest.fixture(scope="module")
def simulation() -> Iterator[Simulation]:
    with simulation_of(SOURCE) as running:
        yield running


@dataclass
class Model:
    """Straight from the tables, with the time as a number that never wraps."""

    now: int = -PERIOD
    last: Inputs = (False, False, False, False)
    q_set: bool = False
    q_reset: bool = False
    up: int = 0
    down: int = 0
    both: int = 0
    pulse_start: int | None = None
    risen: int | None = None
    fallen: int | None = None
    has_been_on: bool = False

    def step(self, inputs: Inputs) -> dict[str, object]:
        self.now += PERIOD
        x, y, z, w = inputs
        x_rises, z_rises = x and not self.last[0], z and not self.last[2]
        # F_TRIG keeps NOT CLK, and starts as if CLK had been TRUE
        x_falls = not x and (self.last[0] or self.now == 0)
        self.last = inputs
        self.q_set = x or (not y and self.q_set)
        self.q_reset = not y and (x or self.q_reset)
        self.up = 0 if y else self.up + x_rises
        self.down = PV if y else self.down - x_rises
        if y:
            self.both = 0
        elif w:
            self.both = PV
        elif x_rises != z_rises:
            self.both += 1 if x_rises else -1
        return {
            "set_first.q1": self.q_set,
            "reset_first.q1": self.q_reset,
            "rise.q": x_rises,
            "fall.q": x_falls,
            "up.cv": self.up,
            "up.q": self.up >= PV,
            "down.cv": self.down,
            "down.q": self.down <= 0,
            "both.cv": self.both,
            "both.qu": self.both >= PV,
            "both.qd": self.both <= 0,
            **self._timers(x, x_rises),
        }

    def _timers(self, x: bool, rises: bool) -> dict[str, object]:
        if self.pulse_start is None and x:
            self.pulse_start = self.now
        pulse = 0 if self.pulse_start is None else min(self.now - self.pulse_start, PT)
        pulse_q = self.pulse_start is not None and pulse < PT
        if self.pulse_start is not None and not pulse_q and not x:
            self.pulse_start, pulse = None, 0
        self.risen = None if not x else self.now if rises else self.risen
        on = 0 if self.risen is None else min(self.now - self.risen, PT)
        if x:
            self.has_been_on, self.fallen = True, None
        elif self.has_been_on and self.fallen is None:
            self.fallen = self.now
        off = 0 if self.fallen is None else min(self.now - self.fallen, PT)
        return {
            "pulse.q": pulse_q,
            "pulse.et": pulse,
            "on_delay.q": x and on == PT,
            "on_delay.et": on,
            "off_delay.q": self.has_been_on and off < PT,
            "off_delay.et": off,
        }


# inputs that last: timers see both sides of PT
runs = st.lists(
    st.tuples(st.tuples(st.booleans(), st.booleans(), st.booleans(), st.booleans()), st.integers(1, 8)), max_size=14
)


@settings(max_examples=60, deadline=None)
@given(runs)
def test_blocks_do_what_their_tables_say(simulation: Simulation, run: list[tuple[Inputs, int]]) -> None:
    simulation.restart(cold=True)
    model = Model()
    for inputs, scans in run:
        for name, value in zip("xyzw", inputs, strict=True):
            simulation.set(f"main.{name}", value)
        for _ in range(scans):
            assert simulation.scan() is None
            expected = model.step(inputs)
            found = {path: simulation.get(f"main.{path}") for path in expected}
            assert {k: _milliseconds(v) for k, v in found.items()} == expected


def _milliseconds(value: object) -> object:
    """A duration is read as its literal."""
    literal = re.fullmatch(r"T#(\d+)ms", value) if isinstance(value, str) else None
    return int(literal[1]) if literal else value


LONG = """PROGRAM main
VAR x : BOOL; on_delay : TON; off_delay : TOF; pulse : TP; END_VAR
on_delay(IN := x, PT := T#5s);
off_delay(IN := x, PT := T#5s);
pulse(IN := x, PT := T#5s);
END_PROGRAM
CONFIGURATION plant
  RESOURCE cpu ON PLC
    TASK slow(INTERVAL := T#6d, PRIORITY := 1);
    PROGRAM main WITH slow : main;
  END_RESOURCE
END_CONFIGURATION
"""


def test_a_timer_that_is_over_stays_over_when_the_clock_wraps() -> None:
    """32 bits of milliseconds wrap after 49.7 days: a difference of more than 24.8 is negative."""
    with simulation_of(LONG) as running:
        running.set("main.x", True)
        running.scan()
        assert (running.get("main.on_delay.q"), running.get("main.pulse.q")) == (False, True)
        for _ in range(20):
            running.scan()
            assert (running.get("main.on_delay.q"), running.get("main.pulse.q")) == (True, False)
        running.set("main.x", False)
        running.scan()
        assert running.get("main.off_delay.q") is True
        for _ in range(20):
            running.scan()
            assert running.get("main.off_delay.q") is False


@pytest.mark.parametrize(
    ("block", "high", "low"),
    [
        ("INT", 32767, -32768),
        ("DINT", 2147483647, -2147483648),
        ("UDINT", 4294967295, 0),
        ("LINT", (1 << 63) - 1, -(1 << 63)),
        ("ULINT", (1 << 64) - 1, 0),
    ],
)
def test_counters_stop_at_the_limits_of_their_type(block: str, high: int, low: int) -> None:
    source = f"""PROGRAM main
VAR x : BOOL; END_VAR
VAR
  up : CTU_{block} := (CV := {high - 1}); down : CTD_{block} := (CV := {low + 1});
  top : CTUD_{block} := (CV := {high - 1}); bottom : CTUD_{block} := (CV := {low + 1});
END_VAR
up(CU := x); down(CD := x); top(CU := x); bottom(CD := x);
x := NOT x;
END_PROGRAM
"""
    with simulation_of(source) as running:
        running.scan(10)
        found = [running.get(f"main.{name}.cv") for name in ("up", "down", "top", "bottom")]
    assert found == [high, low, high, low]


def test_a_pt_of_zero_is_over_at_once() -> None:
    source = """PROGRAM main
VAR on_delay : TON; off_delay : TOF; pulse : TP; x : BOOL := TRUE; END_VAR
on_delay(IN := x); off_delay(IN := x); pulse(IN := x);
END_PROGRAM
"""
    with simulation_of(source) as running:
        running.scan()
        assert [running.get(f"main.{name}.q") for name in ("on_delay", "off_delay", "pulse")] == [True, True, False]
        running.set("main.x", False)
        running.scan()
        assert [running.get(f"main.{name}.q") for name in ("on_delay", "off_delay", "pulse")] == [False, False, False]
