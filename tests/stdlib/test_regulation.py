"""The additional blocks against plain models of their definitions, over random inputs: REAL is compared to the bit."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from dataclasses import dataclass, field

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from iec2mpy.backends.target import ENGINE_TARGETS
from iec2mpy.project.compile import compile_files
from iec2mpy.simulator.session import Simulation
from iec2mpy.source.spans import SourceFile

SOURCE = """PROGRAM main
VAR x, y : BOOL; v, w : REAL; END_VAR
VAR
  semaphore : SEMA; sum : INTEGRAL; slope : DERIVATIVE; control : PID; way : RAMP; both_edges : HYSTERESIS;
END_VAR
semaphore(CLAIM := x, RELEASE := y);
sum(RUN := x, R1 := y, XIN := v, X0 := w, CYCLE := T#300ms);
slope(RUN := x, XIN := v, CYCLE := T#300ms);
control(AUTO := x, PV := v, SP := w, X0 := 0.3, KP := 1.7, TR := 2.5, TD := 0.4, CYCLE := T#300ms);
way(RUN := x, X0 := v, X1 := w, TR := T#1s, CYCLE := T#300ms);
both_edges(XIN1 := v, XIN2 := w, EPS := 0.75);
END_PROGRAM
"""
Inputs = tuple[bool, bool, float, float]


def single(number: float) -> float:
    """To single precision, as each result of REAL."""
    return struct.unpack("f", struct.pack("f", number))[0]


@dataclass
class Integral:
    out: float = 0.0

    def step(self, run: bool, reset: bool, value: float, start: float) -> float:
        if reset:
            self.out = start
        elif run:
            self.out = single(self.out + single(value * single(0.3)))
        return self.out


@dataclass
class Slope:
    last: list[float] = field(default_factory=lambda: [0.0, 0.0, 0.0])
    """The values of one, two and three calls ago."""

    def step(self, run: bool, value: float) -> float:
        one, two, three = self.last
        if not run:
            self.last = [value, value, value]
            return 0.0
        self.last = [value, one, two]
        rise = single(single(single(3.0 * single(value - three)) + one) - two)
        return single(rise / single(10.0 * single(0.3)))


@dataclass
class Ramp:
    start: float = 0.0
    calls: int = 0

    def step(self, run: bool, start: float, end: float) -> tuple[bool, float]:
        if not run:
            self.start, self.calls = start, 0
            return False, start
        elapsed = 300 * self.calls
        if elapsed >= 1000:
            return False, end
        self.calls += 1
        return True, single(self.start + single(single(single(end - self.start) * elapsed) / 1000))


@dataclass
class Model:
    claimed: bool = False
    above: bool = False
    sum: Integral = field(default_factory=Integral)
    slope: Slope = field(default_factory=Slope)
    error_sum: Integral = field(default_factory=Integral)
    error_slope: Slope = field(default_factory=Slope)
    ramp: Ramp = field(default_factory=Ramp)

    def step(self, x: bool, y: bool, v: float, w: float) -> dict[str, object]:
        busy = self.claimed and not (y and not x)
        self.claimed = x or busy
        self.above = v >= w - 0.75 if self.above else v > w + 0.75
        moving, position = self.ramp.step(x, v, w)
        return {
            "semaphore.busy": busy,
            "sum.q": not y,
            "sum.xout": self.sum.step(x, y, v, w),
            "slope.xout": self.slope.step(x, v),
            "control.xout": self._control(x, v, w),
            "way.busy": moving,
            "way.xout": position,
            "both_edges.q": self.above,
        }

    def _control(self, auto: bool, value: float, wanted: float) -> float:
        error = single(value - wanted)
        start = single(2.5 * single(single(0.3) - error))
        i_part = single(self.error_sum.step(auto, not auto, error, start) / 2.5)
        d_part = single(self.error_slope.step(auto, error) * single(0.4))
        return single(single(1.7) * single(single(error + i_part) + d_part))


@pytest.fixture(scope="module")
def simulation() -> Iterator[Simulation]:
    program = compile_files([SourceFile("blocks.st", SOURCE)], ENGINE_TARGETS["cpython"])
    with Simulation(program, "cpython") as running:
        yield running


# quarters: their sums are exact, so the comparator's edges are met
values = st.one_of(st.integers(-20, 20).map(lambda n: n / 4), st.floats(-1e3, 1e3, width=32))
runs = st.lists(st.tuples(st.tuples(st.booleans(), st.booleans(), values, values), st.integers(1, 6)), max_size=12)


@settings(max_examples=60, deadline=None)
@given(runs)
def test_blocks_do_what_their_definitions_say(simulation: Simulation, run: list[tuple[Inputs, int]]) -> None:
    simulation.restart(cold=True)
    model = Model()
    for inputs, scans in run:
        for name, value in zip("xyvw", inputs, strict=True):
            simulation.set(f"main.{name}", value)
        for _ in range(scans):
            assert simulation.scan() is None
            expected = model.step(*inputs)
            assert {path: simulation.get(f"main.{path}") for path in expected} == expected


def test_a_program_may_have_a_block_of_the_same_name() -> None:
    source = """FUNCTION_BLOCK PID
VAR_INPUT a : INT; END_VAR
VAR_OUTPUT b : INT; END_VAR
b := a + 1;
END_FUNCTION_BLOCK
PROGRAM main
VAR own : PID; END_VAR
own(a := 4);
END_PROGRAM
"""
    program = compile_files([SourceFile("own.st", source)], ENGINE_TARGETS["cpython"])
    with Simulation(program, "cpython") as running:
        running.scan()
        assert running.get("main.own.b") == 5
