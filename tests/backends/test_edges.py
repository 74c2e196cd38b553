"""Inputs with an edge: they do what R_TRIG and F_TRIG do, on all engines (6.6.3.5.3)."""

from __future__ import annotations

import random

import pytest

from iec2mpy.backends.target import ENGINE_TARGETS
from iec2mpy.project.compile import compile_files
from iec2mpy.simulator.session import Simulation
from iec2mpy.source.spans import SourceFile

_TEXT = """FUNCTION_BLOCK seen
VAR_INPUT up : BOOL R_EDGE; down, other : BOOL F_EDGE; level : BOOL; END_VAR
VAR_OUTPUT rose, fell, plain : BOOL; END_VAR
rose := up;
fell := down;
plain := level;
END_FUNCTION_BLOCK

PROGRAM main
VAR_INPUT own : BOOL R_EDGE; END_VAR
VAR x, call, owned : BOOL; n : ARRAY[1..2] OF seen; rise : R_TRIG; fall : F_TRIG; END_VAR
owned := own;
IF call THEN
  n[1](up := x, down := x, level := x);
  n[2](up := NOT x);
  rise(CLK := x);
  fall(CLK := x);
END_IF;
END_PROGRAM
"""


@pytest.mark.parametrize("engine", ENGINE_TARGETS)
def test_edges_are_those_of_the_standard_blocks(engine: str) -> None:
    chosen = random.Random(7)
    generated = compile_files([SourceFile("edges.st", _TEXT)], ENGINE_TARGETS[engine])
    before = False
    with Simulation(generated, engine) as simulation:
        for _ in range(60):
            x = chosen.random() < 0.5
            simulation.set("main.x", x)
            simulation.set("main.own", x)
            simulation.set("main.call", chosen.random() < 0.7)
            assert simulation.scan() is None
            assert simulation.get("main.n[1].rose") == simulation.get("main.rise.Q")
            assert simulation.get("main.n[1].fell") == simulation.get("main.fall.Q")
            assert simulation.get("main.owned") == (x and not before)
            assert simulation.get("main.own") == x, "the input itself keeps its level"
            before = x
