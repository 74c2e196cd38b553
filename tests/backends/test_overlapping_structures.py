"""Structures with OVERLAP, on every engine: what is written to one member is read from another."""

from __future__ import annotations

import pytest

from iec2mpy.backends.target import ENGINE_TARGETS
from iec2mpy.project.compile import compile_files
from iec2mpy.simulator.session import Simulation
from iec2mpy.source.spans import SourceFile

_TEXT = """
TYPE
  Frame : STRUCT
    head AT %B0 : INT;
    length AT %B2 : USINT := 26;
    flag AT %X3.7 : BOOL;
    tail AT %B6 : WORD;
  END_STRUCT;
  Raw : STRUCT bytes : ARRAY[0..7] OF BYTE; END_STRUCT;
  View : STRUCT OVERLAP
    frame AT %B0 : Frame;
    raw AT %B0 : Raw;
    number AT %B4 : REAL;
    bits AT %X4.1 : ARRAY[1..3] OF BOOL;
    top AT %W6 : INT;
  END_STRUCT;
END_TYPE
FUNCTION clear : INT
VAR_IN_OUT v : View; END_VAR
v.raw.bytes[1] := 16#7F;
clear := v.frame.head;
END_FUNCTION
FUNCTION_BLOCK Holder
VAR_INPUT v : View; i : INT; END_VAR
VAR_OUTPUT seen : INT; frame : Frame; END_VAR
seen := BYTE_TO_INT(v.raw.bytes[i]);
frame := v.frame;
END_FUNCTION_BLOCK
PROGRAM main
VAR
  views : ARRAY[1..2] OF View; one : View; plain : Frame; same, other : BOOL;
  holder1, holder2 : Holder; i : INT := 2; n, cleared : INT;
  placed AT %MB40 : Frame; low AT %MB46 : BYTE;
END_VAR
views[i].frame.head := -2;
views[i].bits[i] := TRUE;
views[i].frame.flag := TRUE;
views[1].number := 1.5;
one := views[i];
same := one = views[2];
plain := views[2].frame;
plain.tail := 16#1234;
one.frame := plain;
other := one = views[2];
cleared := clear(one);
holder1(v := one, i := 6);
holder2(v := views[1], i := 7);
n := views[1].top;
placed := plain;
END_PROGRAM
"""


@pytest.mark.parametrize("engine", ENGINE_TARGETS)
def test_members_share_their_bytes(engine: str) -> None:
    generated = compile_files([SourceFile("views.st", _TEXT)], ENGINE_TARGETS[engine])
    with Simulation(generated, engine) as simulation:
        assert simulation.get("main.one.raw.bytes") == [0, 0, 26, 0, 0, 0, 0, 0]
        assert simulation.scan() is None
        expected = {
            "main.views[2].raw.bytes": [0xFE, 0xFF, 26, 0x80, 4, 0, 0, 0],
            "main.views[1].raw.bytes[7]": 0x3F,
            "main.views[2].bits": [False, True, False],
            "main.same": True,
            "main.other": False,
            "main.plain": {"head": -2, "length": 26, "flag": True, "tail": 0x1234},
            "main.one.raw.bytes": [0xFE, 0x7F, 26, 0x80, 4, 0, 0x34, 0x12],
            "main.cleared": 0x7FFE,
            "main.holder1.seen": 0x34,
            "main.holder1.frame": {"head": 0x7FFE, "length": 26, "flag": True, "tail": 0x1234},
            "main.holder2.seen": 0x3F,
            "main.n": 0x3FC0,
            "main.placed": {"head": -2, "length": 26, "flag": True, "tail": 0x1234},
            "main.low": 0x34,
        }
        found = {path: simulation.get(path) for path in expected}
        assert found == expected
        simulation.set("main.views[1].frame.head", 0x0102)
        simulation.set("main.views[1].bits[3]", True)
        assert simulation.get("main.views[1].raw.bytes") == [2, 1, 26, 0, 8, 0, 0xC0, 0x3F]
        simulation.restart(cold=True)
        assert simulation.get("main.one.frame.length") == 26
