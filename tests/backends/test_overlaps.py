"""Variables at addresses that overlap: what is written through one is read through another, on every engine."""

from __future__ import annotations

import struct

import pytest

from iec2mpy.backends.target import ENGINE_TARGETS
from iec2mpy.project.compile import compile_files
from iec2mpy.simulator.session import Simulation
from iec2mpy.source.spans import SourceFile

_VIEWS = """
PROGRAM main
VAR
  give : DWORD; real_in : REAL; mode : INT;
  whole AT %MD5 : DWORD := 16#8040_20F1;
  signed AT %MD5 : DINT;
  number AT %MD5 : REAL;
  span AT %MD5 : TIME;
  low AT %MW10 : WORD; high AT %MW11 : INT;
  b0 AT %MB20 : BYTE; b3 AT %MB23 : SINT; b1 AT %MB21 : USINT;
  first AT %MX20.0 : BOOL; last AT %MX23.7 : BOOL; nine AT %MX169 : BOOL;
  bits AT %MX20.0 : ARRAY[0..31] OF BOOL;
  words AT %MW10 : ARRAY[1..2] OF UINT;
  seen_first, seen_last, seen_nine : BOOL; seen_low : WORD; seen_high : INT; seen_real : REAL; seen_span : TIME;
  long AT %ML100 : LWORD; real64 AT %ML100 : LREAL; int64 AT %ML100 : LINT; long_low AT %MD200 : DWORD;
  long_top AT %MX807.7 : BOOL; seen_lreal : LREAL; seen_lint : LINT;
  seen_signed : DINT; k, ones : INT; shifted : DWORD; sum : UINT;
END_VAR
CASE mode OF
  1: whole := give;
  2: low := 16#5678; high := -2;
  3: number := real_in;
  4: b0 := 16#AB; b3 := -128; b1 := 7;
  5: first := NOT first; last := NOT last; nine := NOT nine;
  6: FOR k := 0 TO 31 DO bits[k] := (give AND SHL(DWORD#1, k)) <> 0; END_FOR;
  7: FOR k := 1 TO 2 DO words[k] := words[3 - k]; END_FOR;
  8: low.%B1 := b0; whole.31 := first;
  9: span := T#1s - T#2s;
END_CASE;
seen_first := first; seen_last := last; seen_nine := nine; seen_low := low; seen_high := high;
seen_signed := signed; seen_real := number; seen_span := span;
ones := 0;
FOR k := 0 TO 31 DO IF bits[k] THEN ones := ones + 1; END_IF; END_FOR;
sum := words[1] + words[2];
shifted := SHR(%MD5, 4);
IF mode = 10 THEN long := 16#C004_0000_0000_0001; long_low := long_low OR DWORD#2; END_IF;
IF mode = 11 THEN real64 := 2.5; END_IF;
IF mode = 12 THEN int64 := -2; long_top := FALSE; END_IF;
seen_lreal := real64; seen_lint := int64;
END_PROGRAM
"""


def _signed(number: int, bits: int) -> int:
    return number - (1 << bits) if number >> bits - 1 else number


def _check(simulation: Simulation, whole: int, mode: int) -> None:
    simulation.set("main.mode", mode)
    assert simulation.scan() is None
    low, high = whole & 0xFFFF, whole >> 16
    expected = {
        "main.whole": whole,
        "%MD5": whole,
        "main.seen_signed": _signed(whole, 32),
        "main.seen_low": low,
        "main.words": [low, high],
        "main.seen_high": _signed(high, 16),
        "main.b0": whole & 0xFF,
        "main.b1": whole >> 8 & 0xFF,
        "%MB23": _signed(whole >> 24, 8),
        "main.seen_first": bool(whole & 1),
        "main.seen_nine": bool(whole & 512),
        "main.seen_last": bool(whole >> 31),
        "main.bits": [bool(whole >> bit & 1) for bit in range(32)],
        "main.ones": whole.bit_count(),
        "main.sum": low + high & 0xFFFF,
        "main.shifted": whole >> 4,
    }
    assert {path: simulation.get(path) for path in expected} == expected


@pytest.mark.parametrize("engine", ENGINE_TARGETS)
def test_views_of_the_same_bytes(engine: str) -> None:
    generated = compile_files([SourceFile("views.st", _VIEWS)], ENGINE_TARGETS[engine])
    with Simulation(generated, engine) as simulation:
        _check(simulation, 0x8040_20F1, 0)
        for whole in (0, 0xFFFF_FFFF, 0x1234_5678, 0x8000_0001, 0x7FFF_FFFE):
            simulation.set("main.give", whole)
            _check(simulation, whole, 1)
            _check(simulation, 0xFFFE_5678, 2)
            _check(simulation, whole, 6)
        _check(simulation, 0x80FF_07AB, 4)
        _check(simulation, 0x00FF_05AA, 5)
        _check(simulation, 0x00FF_00FF, 7)
        _check(simulation, 0x80FF_FFFF, 8)
        _check(simulation, 0xFFFF_FC18, 9)
        assert simulation.get("main.seen_span") == "T#-1s"
        for number in (0.0, -2.5, 1e10):
            simulation.set("main.real_in", number)
            _check(simulation, struct.unpack("<I", struct.pack("<f", number))[0], 3)
            assert simulation.get("main.seen_real") == number


@pytest.mark.parametrize("engine", ENGINE_TARGETS)
def test_long_values(engine: str) -> None:
    generated = compile_files([SourceFile("views.st", _VIEWS)], ENGINE_TARGETS[engine])
    steps = [
        (10, 0xC004_0000_0000_0003, -(2.5 + 3 * 2**-51)),
        (11, 0x4004_0000_0000_0000, 2.5),
        (12, 0x7FFF_FFFF_FFFF_FFFE, None),
    ]
    with Simulation(generated, engine) as simulation:
        for mode, whole, real in steps:
            simulation.set("main.mode", mode)
            assert simulation.scan() is None
            assert simulation.get("main.long") == whole
            assert simulation.get("main.seen_lint") == _signed(whole, 64)
            assert simulation.get("main.long_low") == whole & 0xFFFF_FFFF
            if real is not None:
                # a board with single precision reads what it can hold
                seen = [simulation.get("main.seen_lreal"), simulation.get("main.real64")]
                assert seen == pytest.approx([real, real])
        simulation.set("main.real64", -2.5)
        assert simulation.get("%ML100") == 0xC004_0000_0000_0000


def test_values_from_outside() -> None:
    generated = compile_files([SourceFile("views.st", _VIEWS)], ENGINE_TARGETS["cpython"])
    with Simulation(generated, "cpython") as simulation:
        simulation.set("main.number", 1.5)
        _check(simulation, 0x3FC0_0000, 0)
        simulation.set("%MB20", 0x81)
        simulation.set("%MX20.0", False)
        simulation.set("main.bits[1]", True)
        simulation.set("main.high", -1)
        _check(simulation, 0xFFFF_0082, 0)
        simulation.set("main.bits", [bit < 9 for bit in range(32)])
        _check(simulation, 0x1FF, 0)
        simulation.restart(cold=True)
        _check(simulation, 0x8040_20F1, 0)


_WHOLES = """
TYPE
  Point : STRUCT x : INT; on, off : BOOL; y : DINT; tail : ARRAY[0..9] OF INT; END_STRUCT;
  Level : INT (0..100);
END_TYPE
FUNCTION doubled : INT
VAR_IN_OUT what : INT; all : Point; END_VAR
what := what * 2;
all.tail[9] := what;
doubled := what;
END_FUNCTION
FUNCTION_BLOCK Keeper
VAR_INPUT p : Point; END_VAR
VAR_OUTPUT y : INT; same : BOOL; END_VAR
VAR_IN_OUT n : INT; END_VAR
y := DINT_TO_INT(p.y);
same := p.tail[0] = n;
n := n + 1;
END_FUNCTION_BLOCK
PROGRAM main
VAR
  p AT %MB100 : Point := (x := 3, off := TRUE, y := -7);
  raw AT %MB100 : ARRAY[0..29] OF BYTE;
  plain, back : Point;
  n AT %MW70 : INT; n_low AT %MB140 : BYTE;
  equal, differs : BOOL; keeper : Keeper; r : INT; i : INT; loops : INT;
  level AT %MW80 : Level; level_low AT %MB160 : BYTE;
  counter AT %MW90 : INT; counter_low AT %MB180 : SINT;
END_VAR
VAR RETAIN kept AT %MW95 : WORD; kept_low AT %MB190 : BYTE; END_VAR
plain := p;
plain.tail[5] := 77;
p := plain;
back := p;
equal := p = plain;
p.x := p.x + 1;
differs := p = plain;
n := 21;
r := doubled(what := n, all := p);
keeper(p := p, n := n, y => p.tail[1 + 1]);
FOR counter := 1 TO 5 BY 2 DO loops := loops + counter_low; END_FOR;
i := BYTE_TO_INT(level_low);
level := i + 1;
kept := kept + 1;
END_PROGRAM
"""


@pytest.mark.parametrize("engine", ENGINE_TARGETS)
def test_whole_values(engine: str) -> None:
    text = _WHOLES.replace("kept := kept + 1", "kept := 16#1201")
    generated = compile_files([SourceFile("wholes.st", text)], ENGINE_TARGETS[engine])
    with Simulation(generated, engine) as simulation:
        assert simulation.get("main.raw") == [3, 0, 2, 0xF9, 255, 255, 255, *[0] * 23]
        assert simulation.scan() is None
        tail = [0, 0, -7, 0, 0, 77, 0, 0, 0, 42]
        expected = {
            "main.p": {"x": 4, "on": False, "off": True, "y": -7, "tail": tail},
            "main.back": {"x": 3, "on": False, "off": True, "y": -7, "tail": [0, 0, 0, 0, 0, 77, 0, 0, 0, 0]},
            "main.raw[0]": 4,
            "main.raw[25]": 42,
            "main.equal": True,
            "main.differs": False,
            "main.r": 42,
            "main.n": 43,
            "main.keeper.same": False,
            "main.loops": 9,
            "main.counter": 7,
            "main.level": 1,
            "main.kept": 0x1201,
        }
        assert {path: simulation.get(path) for path in expected} == expected
        simulation.set("main.level_low", 100)
        fault = simulation.scan()
        assert fault is not None
        assert fault.kind == "range"
        simulation.restart(cold=False)
        assert simulation.get("main.kept") == 0x1201
        assert simulation.get("main.n") == 0


@pytest.mark.parametrize("engine", ENGINE_TARGETS)
def test_inputs_keep_their_bytes(engine: str) -> None:
    text = """PROGRAM main
VAR bit AT %IX0.3 : BOOL; whole AT %IB0 : BYTE; two AT %ID0 : DWORD; second AT %IW1 : WORD; seen : BYTE; END_VAR
seen := whole;
IF bit THEN %QX1.2 := TRUE; END_IF;
%QB1 := %QB1 OR BYTE#1;
END_PROGRAM
"""
    generated = compile_files([SourceFile("inputs.st", text)], ENGINE_TARGETS[engine])
    with Simulation(generated, engine) as simulation:
        simulation.set("%IX0.3", True)
        simulation.set("%IW1", 0xABCD)
        simulation.restart(cold=True)
        assert simulation.scan() is None
        expected = {"main.seen": 8, "%QB1": 5, "%QX1.2": True, "%ID0": 0xABCD0000}
        assert {path: simulation.get(path) for path in expected} == expected
