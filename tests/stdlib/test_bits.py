"""BCD, the order of bytes, and validation (tables 22, 37 and 39), on every engine and at compile time."""

from __future__ import annotations

import struct

import pytest

from iec2mpy.backends.target import ENGINE_TARGETS
from iec2mpy.project.compile import compile_files
from iec2mpy.semantics.typed import Constant
from iec2mpy.simulator.session import Simulation
from iec2mpy.source.spans import SourceFile
from tests.semantics.checking import codes_of, value_of

_BITS = {"BYTE": 8, "WORD": 16, "DWORD": 32, "LWORD": 64}
_NUMBERS = {"USINT": 8, "UINT": 16, "UDINT": 32, "ULINT": 64}


def _bcd_text() -> str:
    variables, body = [], []
    for bits, number in zip(_BITS, _NUMBERS, strict=True):
        variables += [f"b{bits} : {bits}; n{number} : {number}; from{bits} : {number}; to{number} : {bits};"]
        variables += [f"plain{bits} : {number}; ok{bits} : BOOL;"]
        body += [f"ok{bits} := IS_VALID_BCD(b{bits}); to{number} := {number}_TO_BCD_{bits}(n{number});"]
        body += [f"IF ok{bits} THEN from{bits} := {bits}_BCD_TO_{number}(b{bits});"]
        body += [f"plain{bits} := BCD_TO_{number}(b{bits}); END_IF;"]
    return "\n".join(["PROGRAM main", "VAR", *variables, "END_VAR", *body, "END_PROGRAM"])


@pytest.mark.parametrize("engine", ENGINE_TARGETS)
def test_bcd(engine: str) -> None:
    generated = compile_files([SourceFile("bcd.st", _bcd_text())], ENGINE_TARGETS[engine])
    with Simulation(generated, engine) as simulation:
        for digits in ("0", "9", "42", "1234567890123456", "9999999999999999", "8000000000000001"):
            for bits, number in zip(_BITS, _NUMBERS, strict=True):
                shown = digits[-(_BITS[bits] // 4) :]
                simulation.set(f"main.b{bits}", int(shown, 16))
                simulation.set(f"main.n{number}", min(int(shown), (1 << _NUMBERS[number]) - 1))
            assert simulation.scan() is None
            for bits, number in zip(_BITS, _NUMBERS, strict=True):
                shown = digits[-(_BITS[bits] // 4) :]
                expected = [True, int(shown), int(shown), int(shown, 16)]
                names = (f"ok{bits}", f"from{bits}", f"plain{bits}", f"to{number}")
                assert [simulation.get(f"main.{name}") for name in names] == expected
        for bad in ("A", "1A1", "F0000000"):
            for bits, width in _BITS.items():
                simulation.set(f"main.b{bits}", int(bad, 16) % (1 << width))
            assert simulation.scan() is None
            assert simulation.get("main.okLWORD") is False


@pytest.mark.parametrize("engine", ENGINE_TARGETS)
@pytest.mark.parametrize(
    "body",
    [
        "n := BCD_TO_USINT(w);",
        "n := WORD_BCD_TO_USINT(w + WORD#0);",
        "b := TO_BCD_BYTE(i);",
        "b := INT_TO_BCD_BYTE(0 - i);",
    ],
)
def test_what_is_out_of_range_faults(body: str, engine: str) -> None:
    text = f"PROGRAM main\nVAR w : WORD := 16#256; n : USINT; b : BYTE; i : INT := 100; END_VAR\n{body}\nEND_PROGRAM\n"
    generated = compile_files(
        [SourceFile("bcd.st", text.replace("w + WORD#0", "w OR WORD#16#00A0"))], ENGINE_TARGETS[engine]
    )
    with Simulation(generated, engine) as simulation:
        fault = simulation.scan()
        assert fault is not None
        assert fault.kind == "range"


_VALUES = {
    "INT": -2,
    "UINT": 0x1234,
    "WORD": 0xFF01,
    "DINT": -123456789,
    "UDINT": 0x89ABCDEF,
    "DWORD": 0x80000001,
    "LINT": -(1 << 40) - 3,
    "ULINT": (1 << 63) + 5,
    "LWORD": 0x0123456789ABCDEF,
    "BYTE": 0xA5,
    "BOOL": True,
}


def _swapped(name: str, value: int) -> int:
    size = {"INT": 2, "UINT": 2, "WORD": 2, "BYTE": 1, "BOOL": 1}.get(
        name, 8 if name[0] == "L" or name == "ULINT" else 4
    )
    signed = name.endswith("INT") and not name.startswith("U")
    return int.from_bytes(value.to_bytes(size, "little", signed=signed), "big", signed=signed)


@pytest.mark.parametrize("engine", ENGINE_TARGETS)
def test_order_of_bytes(engine: str) -> None:
    names = list(_VALUES)
    variables = [f"v{n}, big{n}, back{n}, little{n}, same{n} : {n};" for n in names]
    body = [
        f"big{n} := TO_BIG_ENDIAN(v{n}); back{n} := FROM_BIG_ENDIAN(big{n}); little{n} := TO_LITTLE_ENDIAN(v{n});"
        f"same{n} := LITTLE_ENDIAN_TO(BIG_ENDIAN_TO(big{n}));"
        for n in names
    ]
    wholes = """END_VAR
VAR
  p : Pair := (a := 16#1234, r := 1.5, b := 7, t := T#1ms, s := 'ab', l := [12(16#0102)]); q, q2 : Pair; low : BYTE;
  shared AT %MW10 : ARRAY[0..1] OF WORD; first AT %MB21 : BYTE;
"""
    text = "\n".join(
        [
            "TYPE Pair : STRUCT a : UINT; r : REAL; b : BYTE; t : TIME; s : STRING[3];",
            "l : ARRAY[1..12] OF WORD; END_STRUCT; END_TYPE",
            "PROGRAM main",
            f"VAR {' '.join(variables)}\n{wholes}END_VAR",
            *body,
            "q := TO_BIG_ENDIAN(p); q2 := FROM_BIG_ENDIAN(IN := q);",
            "shared[1] := 16#ABCD; shared := TO_BIG_ENDIAN(shared);",
            "END_PROGRAM",
        ]
    )
    generated = compile_files([SourceFile("order.st", text)], ENGINE_TARGETS[engine])
    with Simulation(generated, engine) as simulation:
        for name, value in _VALUES.items():
            simulation.set(f"main.v{name}", value)
        assert simulation.scan() is None
        for name, value in _VALUES.items():
            swapped = value if name == "BOOL" else _swapped(name, value)
            expected = [swapped, value, value, value]
            assert [simulation.get(f"main.{view}{name}") for view in ("big", "back", "little", "same")] == expected
        assert simulation.get("main.q2") == simulation.get("main.p")
        real = struct.unpack(">f", struct.pack("<f", 1.5))[0]
        q = simulation.get("main.q")
        assert isinstance(q, dict)
        assert q == {
            "a": 0x3412,
            "r": pytest.approx(real),
            "b": 7,
            "t": "T#4h39m37s216ms",
            "s": "ab",
            "l": [0x0201] * 12,
        }
        assert simulation.get("main.shared") == [0, 0xCDAB]


@pytest.mark.parametrize("engine", ENGINE_TARGETS)
def test_validation_of_reals(engine: str) -> None:
    text = """PROGRAM main
VAR x : REAL; l : LREAL; good, good_l, never : BOOL; END_VAR
good := IS_VALID(x); good_l := IS_VALID(l * 2.0); never := NOT IS_VALID(1.0);
END_PROGRAM
"""
    generated = compile_files([SourceFile("valid.st", text)], ENGINE_TARGETS[engine])
    with Simulation(generated, engine) as simulation:
        for number, good in (
            (0.0, True),
            (3e38, True),
            (float("inf"), False),
            (float("-inf"), False),
            (float("nan"), False),
        ):
            simulation.set("main.x", number)
            simulation.set("main.l", number / 10)
            assert simulation.scan() is None
            assert [simulation.get(f"main.{name}") for name in ("good", "good_l", "never")] == [good, good, False]


@pytest.mark.parametrize(
    ("expression", "of", "value"),
    [
        ("BCD_TO_UINT(WORD#16#0369)", "UINT", 369),
        ("TO_BCD_WORD(9876)", "WORD", 0x9876),
        ("TO_BIG_ENDIAN(16#1234)", "WORD", 0x3412),
        ("TO_BIG_ENDIAN(INT#-2)", "INT", -257),
        ("IS_VALID_BCD(BYTE#16#9A)", "BOOL", 0),
    ],
)
def test_constants(expression: str, of: str, value: int) -> None:
    found = value_of("", expression, of)
    assert isinstance(found, Constant)
    assert found.value == value


@pytest.mark.parametrize(
    ("variables", "body", "code"),
    [
        ("u : UINT; r : REAL;", "u := BCD_TO_UINT(r);", "E0312"),
        ("u : UINT; d : DWORD;", "u := WORD_BCD_TO_UINT(d);", "E0312"),
        ("u : UINT;", "u := BCD_TO_UINT(WORD#16#00AF);", "E0508"),
        ("b : BYTE;", "b := TO_BCD_BYTE(100);", "E0508"),
        ("w : WORD; d : DWORD;", "w := TO_BIG_ENDIAN(d);", "E0301"),
        ("t, t2 : TON;", "t := TO_BIG_ENDIAN(t);", "E0312"),
        ("r : REAL;", "r := REAL_BCD_TO_UINT(r);", "E0207"),
        ("a, b : ARRAY[1..2] OF WORD; ok : BOOL;", "b := TO_BIG_ENDIAN(IN := a, ENO => ok);", "E0915"),
    ],
)
def test_wrong_calls(variables: str, body: str, code: str) -> None:
    assert codes_of(variables, body) == [code]
