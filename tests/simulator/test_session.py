"""Sessions, on a program written by hand: paths in, values out, faults with their places."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from iec2mpy.backends.generator import GeneratedProgram
from iec2mpy.backends.layout import Size
from iec2mpy.backends.memory_map import BadValue, MappedVariable, MemoryMap, Site, UnknownPath
from iec2mpy.backends.target import ENGINE_TARGETS
from iec2mpy.simulator.engines import ENGINES
from iec2mpy.simulator.session import Simulation
from tests.simulator.handwritten import COMMAND, COUNT, KEPT, PROGRAMS, TEXT, TIME, X


def _integer(path: str, place: tuple[str, int], address: str | None = None) -> MappedVariable:
    return MappedVariable(path, "INT", "integer", *place, low=-32768, high=32767, address=address)


MAP = MemoryMap(
    [
        _integer("main.command", COMMAND, "%IW0"),
        _integer("main.count", COUNT),
        _integer("main.kept", KEPT),
        MappedVariable("main.time", "TIME", "duration", *TIME, low=-(2**31), high=2**31 - 1),
        MappedVariable("main.x", "REAL", "real", *X),
        MappedVariable("main.text", "STRING[10]", "string", *TEXT, high=10),
    ],
    {},
    [Site(12, "src/main.st", 4, "main")],
    "0",
)


@pytest.fixture(params=ENGINES)
def simulation(request: pytest.FixtureRequest) -> Iterator[Simulation]:
    name = request.param
    program = GeneratedProgram(ENGINE_TARGETS[name], PROGRAMS[name], MAP, "0", Size(16, 3), 2)
    with Simulation(program, name) as simulation:
        yield simulation


def test_values_by_path(simulation: Simulation) -> None:
    simulation.set("Main.X", 2.5)
    assert simulation.scan(3) is None
    assert simulation.get("main.count") == 3
    assert simulation.get("main.time") == "T#20ms"
    assert simulation.get("main") == {
        "command": 0,
        "count": 3,
        "kept": 3,
        "time": "T#20ms",
        "x": 2.5,
        "text": "ä",
    }
    simulation.set("main", {"text": "new", "count": 9})
    assert (simulation.get("main.text"), simulation.get("main.count")) == ("new", 9)


def test_a_span_of_time(simulation: Simulation) -> None:
    assert simulation.period == 10_000
    assert simulation.run(55_000) is None
    assert simulation.get("main.count") == 5


def test_a_fault_says_where(simulation: Simulation) -> None:
    simulation.set("%IW0", 1)
    fault = simulation.scan()
    assert fault is not None
    assert (fault.kind, fault.file, fault.line, fault.pou) == ("zero", "src/main.st", 4, "main")
    assert fault.message == "zero: a division by zero (src/main.st, line 4, in main)"
    simulation.set("%IW0", 2)
    simulation.restart(cold=True)
    fault = simulation.scan()
    assert fault is not None
    assert fault.message == "loop: a loop does not come to its end"


def test_restarts(simulation: Simulation) -> None:
    simulation.scan(2)
    simulation.restart(cold=False)
    simulation.scan()
    assert (simulation.get("main.kept"), simulation.get("main.time")) == (3, "T#20ms")
    simulation.restart(cold=True)
    simulation.scan()
    assert (simulation.get("main.kept"), simulation.get("main.time")) == (1, "T#0ms")


def test_what_cannot_be(simulation: Simulation) -> None:
    with pytest.raises(UnknownPath):
        simulation.get("main.nothing")
    with pytest.raises(BadValue):
        simulation.set("main.count", 40_000)
