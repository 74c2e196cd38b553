"""REAL constants mean on boards what they mean here."""

from __future__ import annotations

import struct

import numpy
import pytest
from hypothesis import given
from hypothesis import strategies as st

from iec2mpy.backends.names import SlotNames
from iec2mpy.backends.reals import real_text
from iec2mpy.backends.target import PORTABLE, VIPER32

_FINITE = st.floats(width=32, allow_nan=False, allow_infinity=False)


def read_in_single(text: str) -> float:
    """A literal as MicroPython reads it where floats have single precision."""
    mantissa, _, exponent = text.lstrip("-").partition("e")
    whole, _, fraction = mantissa.partition(".")
    fraction = fraction.rstrip("0")
    power = int(exponent or 0) - len(fraction)
    digits = numpy.float32(int(whole + fraction))
    scale = numpy.float32(10 ** abs(power))
    value = float(digits / scale if power < 0 else digits * scale)
    return -value if text.startswith("-") else value


@given(_FINITE)
def test_boards_read_what_is_meant(value: float) -> None:
    names = SlotNames()
    code = real_text(value, VIPER32, names).code
    if names.real_lines():
        bits = struct.unpack("<I", struct.pack("<f", value))[0]
        assert names.real_lines()[0].startswith(f"{code} = bits_to_real(0x{bits:08X})  # ")
    else:
        assert struct.pack("<f", read_in_single(code)) == struct.pack("<f", value)


@given(_FINITE)
def test_doubles_read_what_is_meant(value: float) -> None:
    names = SlotNames()
    assert struct.pack("<d", float(real_text(value, PORTABLE, names).code)) == struct.pack("<d", value)
    assert not names.real_lines()


@pytest.mark.parametrize("text", ["0.0", "-0.0", "0.1", "-2.5", "3.14159", "1e+09", "100000.0", "16777216.0"])
def test_usual_constants_are_literals(text: str) -> None:
    value = struct.unpack("<f", struct.pack("<f", float(text)))[0]
    assert real_text(value, VIPER32, SlotNames()).code == text


def test_others_are_named() -> None:
    names = SlotNames()
    pi = struct.unpack("<f", bytes.fromhex("db0f4940"))[0]
    assert real_text(pi, VIPER32, names).code == "_real_40490fdb"
    assert names.real_lines() == ["_real_40490fdb = bits_to_real(0x40490FDB)  # 3.1415927"]
