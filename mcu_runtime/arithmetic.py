"""Operations that generated code does not write out: conversions of REAL, mathematical functions, powers.

Where MicroPython and CPython differ (what they raise, what overflows), the rule is here, once: an argument outside of a
function's domain faults `range`, overflow gives infinity, and NaN passes through.
"""

import math
from array import array

from mcu_runtime.faults import RANGE, ZERO

_INFINITY = float("inf")
_WORD = 0xFFFFFFFF
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


def real_div(a, b):
    if b == 0.0:
        raise ZERO
    return a / b


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


def int_pow(a, b):
    """The low 32 bits of the power, as an unsigned number; a negative exponent faults `range`."""
    if b < 0:
        raise RANGE
    result = 1
    a &= _WORD
    while b:
        if b & 1:
            result = result * a & _WORD
        a = a * a & _WORD
        b >>= 1
    return result


def unsigned_div(a, b):
    """Quotient of two 32-bit patterns, as a pattern."""
    b &= _WORD
    if b == 0:
        raise ZERO
    return _pattern((a & _WORD) // b)


def unsigned_mod(a, b):
    """Remainder of two 32-bit patterns, as a pattern; 0 where the divisor is 0 (table 29)."""
    b &= _WORD
    if b == 0:
        return 0
    return _pattern((a & _WORD) % b)


def _pattern(n):
    return n - 0x100000000 if n > 0x7FFFFFFF else n
