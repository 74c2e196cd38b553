"""Integers of every width: the generated code gives what the model of the meaning gives, on every engine."""

from __future__ import annotations

import pytest
from hypothesis import HealthCheck, given, settings

from iec2mpy.backends.target import ENGINE_TARGETS
from iec2mpy.project.compile import compile_files
from iec2mpy.simulator.session import Simulation
from iec2mpy.source.spans import SourceFile
from tests.backends.random_programs import RandomProgram, programs


@pytest.mark.parametrize("engine", ENGINE_TARGETS)
@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large])
@given(program=programs())
def test_random_expressions(engine: str, program: RandomProgram) -> None:
    generated = compile_files([SourceFile("random.st", program.text)], ENGINE_TARGETS[engine])
    with Simulation(generated, engine) as simulation:
        assert simulation.scan() is None
        found = [simulation.get(f"main.r{number}") for number in range(len(program.results))]
    assert [int(value) for value in found] == list(program.results)
