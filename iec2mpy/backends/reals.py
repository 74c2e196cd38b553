"""REAL constants as text of Python that every MicroPython reads as exactly the number meant.

Where floats have single precision, MicroPython reads a decimal as its digits, times or divided by a power of ten, in
single precision; and so it does with numbers in a .mpy file. That is exact for up to 2^24 and 10^9. Any other constant
is made from its bits, once, at load.
"""

from __future__ import annotations

import struct
from decimal import Decimal

from iec2mpy.backends.forms import Binding, Text
from iec2mpy.backends.names import SlotNames
from iec2mpy.backends.target import Target
from iec2mpy.semantics.arithmetic import to_single

_EXACT_DIGITS = 1 << 24
_EXACT_POWER = 9


def real_text(value: float, target: Target, names: SlotNames) -> Text:
    """A REAL or LREAL constant: a literal, or the name of a constant of the module."""
    if target.single:
        value = to_single(value)
    if value != value or value in (float("inf"), float("-inf")):
        return Text(f'float("{value}")')
    code = _shortest(value) if target.single else repr(value)
    if target.single and not _is_read_exactly(code):
        return Text(names.real(_bits(value), code))
    return Text(code, Binding.UNARY if code.startswith("-") else Binding.ATOM)


def _shortest(value: float) -> str:
    """The shortest text that means this single."""
    code = next(t for t in (f"{value:.{digits}g}" for digits in range(6, 10)) if _is_same_single(float(t), value))
    return code if any(mark in code for mark in ".e") else code + ".0"


def _is_same_single(a: float, b: float) -> bool:
    try:
        return _bits(a) == _bits(b)
    except OverflowError:
        return False


def _is_read_exactly(code: str) -> bool:
    number = Decimal(code).normalize()
    _, digits, exponent = number.as_tuple()
    assert isinstance(exponent, int)
    return int("".join(map(str, digits))) <= _EXACT_DIGITS and abs(exponent) <= _EXACT_POWER


def _bits(value: float) -> int:
    return struct.unpack("<I", struct.pack("<f", value))[0]
