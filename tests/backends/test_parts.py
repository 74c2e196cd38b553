"""Parts of bit strings, read and written, on every engine, against what Python's integers give."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from iec2mpy.backends.target import ENGINE_TARGETS
from iec2mpy.project.compile import compile_files
from iec2mpy.semantics import types as ty
from iec2mpy.semantics.types import ElementaryType
from iec2mpy.simulator.session import Simulation
from iec2mpy.source.spans import SourceFile

_PARTS = {"X": ty.BOOL, "B": ty.BYTE, "W": ty.WORD, "D": ty.DWORD}
_WHOLES = (ty.BYTE, ty.WORD, ty.DWORD, ty.LWORD)


def _parts(of: ElementaryType) -> Iterator[tuple[str, ElementaryType, int]]:
    """Name of the part, its type, its lowest bit."""
    for size, part in _PARTS.items():
        if part.bits < of.bits:
            for number in range(of.bits // part.bits):
                yield f"{size}{number}", part, number * part.bits


def _text(of: ElementaryType) -> str:
    """Each part is read to `r…`; and written to a copy of the whole from `w…`, and as a constant of ones or zeros."""
    variables = [f"whole : {of.name};"]
    body = []
    for name, part, _ in _parts(of):
        ones = "TRUE" if part is ty.BOOL else f"16#{part.high:X}"
        variables += [f"r{name}, w{name} : {part.name}; to{name}, ones{name}, none{name} : {of.name};"]
        body += [f"r{name} := whole.%{name}; to{name} := whole; ones{name} := whole; none{name} := whole;"]
        body += [f"to{name}.%{name} := w{name}; ones{name}.%{name} := {ones}; none{name}.%{name} := 0;"]
    lines = "\n".join([*variables, "END_VAR", *body])
    return f"PROGRAM main\nVAR\n{lines}\nEND_PROGRAM\n"


@pytest.mark.parametrize("engine", ENGINE_TARGETS)
@pytest.mark.parametrize("of", _WHOLES, ids=lambda of: of.name)
def test_every_part(of: ElementaryType, engine: str) -> None:
    generated = compile_files([SourceFile("parts.st", _text(of))], ENGINE_TARGETS[engine])
    with Simulation(generated, engine) as simulation:
        for whole in (0, of.high, 1, 1 << of.bits - 1, 0xA5C3_961B_8001_7FFE & of.high, of.high >> 1):
            for given in (0, 0xFFFF_FFFF, 0x8181_8181, 0x7E5A_5A7E):
                simulation.set("main.whole", whole)
                for name, part, _ in _parts(of):
                    simulation.set(f"main.w{name}", bool(given & 1) if part is ty.BOOL else given & part.high)
                assert simulation.scan() is None
                for name, part, low in _parts(of):
                    ones = part.high << low
                    expected = {
                        f"r{name}": whole >> low & part.high,
                        f"to{name}": whole & ~ones | (given & part.high) << low,
                        f"ones{name}": whole | ones,
                        f"none{name}": whole & ~ones,
                    }
                    found = {variable: simulation.get(f"main.{variable}") for variable in expected}
                    assert found == expected, (hex(whole), hex(given))


_PLACES = """
TYPE Port : STRUCT mask : WORD; bits : ARRAY[1..2] OF BYTE; END_STRUCT; END_TYPE
FUNCTION next : INT
VAR_IN_OUT count : INT; END_VAR
count := count + 1;
next := count;
END_FUNCTION
FUNCTION mark : BOOL
VAR_IN_OUT state : DWORD; END_VAR
VAR_OUTPUT high : WORD; END_VAR
state.%W1 := 16#BEEF;
state.31 := FALSE;
high := state.%W1;
mark := state.%X0;
END_FUNCTION
FUNCTION_BLOCK Gate
VAR_INPUT given : WORD; END_VAR
VAR_OUTPUT open : BOOL; low : BYTE; END_VAR
open := given.15;
low := given.%B0;
END_FUNCTION_BLOCK
PROGRAM main
VAR
  ports : ARRAY[0..1] OF Port;
  gate1 : Gate;
  count : INT;
  flags, copied : WORD;
  long : DWORD := 16#0000_0001;
  located AT %QB3 : BYTE;
  first : BOOL;
END_VAR
VAR CONSTANT fixed : WORD := 16#8421; END_VAR
VAR constants : ARRAY[0..2] OF BYTE; END_VAR
ports[next(count) MOD 2].bits[2].%X6 := TRUE;
ports[1].mask.%B1 := ports[1].bits[2];
first := mark(state := long, high => copied);
gate1(given := copied, open => flags.%X3, low => flags.%B1);
gate1.given.%X0 := TRUE;
located.7 := first;
located.0 := located.7;
constants[0] := fixed.%B1;
constants[1].%X2 := fixed.15;
END_PROGRAM
"""


@pytest.mark.parametrize("engine", ENGINE_TARGETS)
def test_parts_of_every_kind_of_variable(engine: str) -> None:
    generated = compile_files([SourceFile("places.st", _PLACES)], ENGINE_TARGETS[engine])
    with Simulation(generated, engine) as simulation:
        assert simulation.scan() is None
        expected = {
            "main.count": 1,
            "main.ports[1].bits": [0, 0x40],
            "main.ports[1].mask": 0x4000,
            "main.long": 0x3EEF_0001,
            "main.copied": 0x3EEF,
            "main.flags": 0xEF00,
            "main.gate1.given": 0x3EEF,
            "main.located": 0x81,
            "main.constants": [0x84, 4, 0],
        }
        assert {path: simulation.get(path) for path in expected} == expected
