"""Operations that generated code does not write out: conversions of REAL, mathematical functions.

Where MicroPython and CPython differ (what they raise, what overflows), the rule is here, once: an argument outside of a
function's domain faults `range`, overflow gives infinity, and NaN passes through.
"""

import math
import struct
from array import array

from mcu_runtime.faults import RANGE

_INFINITY = float("inf")
_single = array("f", [0.0])


def f32(x):
    """`x` rounded to single precision; too large gives infinity."""
    _single[0] = x
    return _single[0]


def real_to_int(x, low, high):
    """Rounds half to even; NaN, and what lies outside of `low` to `high`, faults `range`."""
    if not -4294967296.0 < x < 4294967296.0:
        raise RANGE
    n = round(x)
    if n < low or n > high:
        raise RANGE
    return n


def real_trunc(x, low, high):
    """As `real_to_int`, but toward zero."""
    if not -4294967296.0 < x < 4294967296.0:
        raise RANGE
    n = int(x)
    if n < low or n > high:
        raise RANGE
    return n


def real_to_bits(x):
    """The bits of a single, as an unsigned number (6.6.2.5.5)."""
    return struct.unpack("<I", struct.pack("<f", x))[0]


def bits_to_real(bits):
    """The single that has these 32 bits; they may come with a sign."""
    return struct.unpack("<f", struct.pack("<I", bits & 0xFFFFFFFF))[0]


def _defined(function):
    """`function`, which raises where it is not defined."""

    def checked(x):
        try:
            return function(x)
        except ValueError:
            pass
        raise RANGE  # outside of `except`, so that the one object keeps no context

    return checked


real_sqrt = _defined(math.sqrt)
real_ln = _defined(math.log)
real_log = _defined(math.log10)
real_sin = _defined(math.sin)
real_cos = _defined(math.cos)
real_tan = _defined(math.tan)
real_asin = _defined(math.asin)
real_acos = _defined(math.acos)
real_atan = math.atan
real_atan2 = math.atan2


def real_exp(x):
    try:
        return math.exp(x)
    except (OverflowError, ValueError):  # MicroPython raises ValueError for both: exp is defined everywhere
        return _INFINITY


def real_pow(a, b):
    """0 to a negative power, and a negative base with an exponent that is no whole number, fault `range`."""
    if a == 0.0 and b < 0.0:
        raise RANGE
    if a < 0.0 and -_INFINITY < b < _INFINITY and b != math.floor(b):
        raise RANGE
    try:
        return math.pow(a, b)
    except (OverflowError, ValueError):
        return -_INFINITY if a < 0.0 and math.fmod(b, 2.0) != 0.0 else _INFINITY
