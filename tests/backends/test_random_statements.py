"""Statements of every kind: the generated code does what the interpreter of the test does, on every engine."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings

from iec2mpy.backends.target import ENGINE_TARGETS
from iec2mpy.project.compile import compile_files
from iec2mpy.simulator.session import Simulation
from iec2mpy.source.spans import SourceFile
from tests.backends.random_statements import RandomScans, scans


def exact(value: Any) -> Any:
    """So that it can be compared: -0.0 is not 0.0, and NaN is NaN."""
    if isinstance(value, dict):
        return {name: exact(item) for name, item in value.items()}
    if isinstance(value, list):
        return [exact(item) for item in value]
    return repr(value) if isinstance(value, float) else int(value)


def run(program: RandomScans, engine: str) -> list[Any]:
    """What is to be seen after each scan, as in `program.scans`."""
    generated = compile_files([SourceFile("random.st", program.text)], ENGINE_TARGETS[engine])
    found: list[Any] = []
    with Simulation(generated, engine) as simulation:
        for expected in program.scans:
            fault = simulation.scan()
            names = expected if isinstance(expected, dict) else {}
            found.append(fault.kind if fault else {name: exact(simulation.get(f"main.{name}")) for name in names})
    return found


FOUND = {
    "VAR d : DINT; END_VAR d := 582; d := -d;": -582,
    "VAR d : DINT; x : REAL := 443.221741; END_VAR d := REAL_TO_DINT(x * 1.0e6);": 443221728,
    "VAR d : DINT; END_VAR d := d - 1073741824;": -1073741824,
}
"""Programs that random ones led to, and what `d` is after a scan."""


@pytest.mark.parametrize("engine", ENGINE_TARGETS)
@pytest.mark.parametrize("body", FOUND)
def test_found(engine: str, body: str) -> None:
    text = f"PROGRAM main\n{body}\nEND_PROGRAM\n"
    with Simulation(compile_files([SourceFile("found.st", text)], ENGINE_TARGETS[engine]), engine) as simulation:
        assert simulation.scan() is None
        assert simulation.get("main.d") == FOUND[body]


@pytest.mark.parametrize("engine", ENGINE_TARGETS)
@settings(max_examples=30, deadline=None, suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large])
@given(program=scans())
def test_random_statements(engine: str, program: RandomScans) -> None:
    assert run(program, engine) == [s if isinstance(s, str) else exact(s) for s in program.scans]
