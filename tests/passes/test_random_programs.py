"""What the passes make of a program does the same: all values, the fault, and the line that raised it."""

from __future__ import annotations

from dataclasses import replace

from hypothesis import given, settings
from hypothesis import strategies as st

from iec2mpy import backends, ir, passes
from iec2mpy.backends.target import ENGINE_TARGETS
from iec2mpy.ir import nodes as n
from iec2mpy.ir.verifier import verify
from iec2mpy.project.compile import check_files
from iec2mpy.simulator.session import Simulation
from iec2mpy.source.spans import SourceFile
from tests.passes.random_programs import program

_SCANS = 3


def _trace(module: n.Module, engine: str) -> list[object]:
    generated = backends.generate(module, ENGINE_TARGETS[engine])
    roots = list(dict.fromkeys(v.path.split(".")[0].split("[")[0] for v in generated.map.variables))
    found: list[object] = []
    with Simulation(generated, engine) as simulation:
        for _ in range(_SCANS):
            fault = simulation.scan()
            found.append(fault and (fault.kind, fault.file, fault.line, fault.pou))
            found.append({root: simulation.get(root) for root in roots})
            if fault is not None:
                break
    return found


def _compare(seed: int, engine: str) -> None:
    module = ir.build(check_files([SourceFile("random.st", program(seed))]).application)
    assert _trace(passes.run(module), engine) == _trace(module, engine)


@settings(max_examples=25, deadline=None)
@given(seed=st.integers(0, 1 << 32))
def test_passes_change_nothing_that_can_be_seen(seed: int) -> None:
    _compare(seed, "cpython")


@settings(max_examples=8, deadline=None)
@given(seed=st.integers(0, 1 << 32))
def test_passes_change_nothing_that_can_be_seen_on_a_board(seed: int) -> None:
    _compare(seed, "viper32")


@settings(max_examples=15, deadline=None)
@given(seed=st.integers(0, 1 << 32))
def test_every_pass_leaves_sound_ir(seed: int) -> None:
    module = ir.build(check_files([SourceFile("random.st", program(seed))]).application)
    verify(module)
    for rewrite in passes.BODY_PASSES:
        module = replace(module, bodies={pou: rewrite(body) for pou, body in module.bodies.items()})
        verify(module)
    verify(passes.inline(module))
