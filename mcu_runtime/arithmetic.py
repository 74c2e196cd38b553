"""Operations that generated code does not write out: integers of 64 bits, conversions of real numbers, mathematical
functions.

Where MicroPython and CPython differ (what they raise, what overflows), the rule is here, once: an argument outside of a
function's domain faults `range`, overflow gives infinity, and NaN passes through.
"""

import math
import struct
from array import array

from mcu_runtime.faults import RANGE

_INFINITY = float("inf")
_BEYOND = 36893488147419103232.0  # 2^65: no integer type has it
_single = array("f", [0.0])


def boxed(n):
    """The number as an object: an argument of a function is one."""
    return n


def wrap64(n):
    """`n` modulo 2^64, as a signed number."""
    if -0x8000000000000000 <= n <= 0x7FFFFFFFFFFFFFFF:
        return n
    n &= 0xFFFFFFFFFFFFFFFF
    return n if n <= 0x7FFFFFFFFFFFFFFF else n - 0x10000000000000000


def mask64(n):
    """`n` modulo 2^64."""
    return n & 0xFFFFFFFFFFFFFFFF


def quotient(a, b):
    """`a` / `b`, toward zero, where Python rounds down; `b` is not 0."""
    if (a < 0) == (b < 0):
        return a // b
    return -(-a // b)


def remainder(a, b):
    """What `quotient` leaves, with the sign of `a`; `b` is not 0."""
    return a - quotient(a, b) * b


def shl64(bits, n):
    return bits << n & 0xFFFFFFFFFFFFFFFF if n < 64 else 0


def shr64(bits, n):
    return bits >> n if n < 64 else 0


def rol64(bits, n):
    n &= 63
    return (bits << n | bits >> 64 - n) & 0xFFFFFFFFFFFFFFFF


def ror64(bits, n):
    n &= 63
    return (bits >> n | bits << 64 - n) & 0xFFFFFFFFFFFFFFFF


def f32(x):
    """`x` rounded to single precision; too large gives infinity."""
    _single[0] = x
    return _single[0]


def real_to_int(x, low, high):
    """Rounds half to even; NaN, and what lies outside of `low` to `high`, faults `range`."""
    if not -_BEYOND < x < _BEYOND:
        raise RANGE
    n = round(x)
    if n < low or n > high:
        raise RANGE
    return n


def real_trunc(x, low, high):
    """As `real_to_int`, but toward zero."""
    if not -_BEYOND < x < _BEYOND:
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


def lreal_to_bits(x):
    """The bits of a double, as an unsigned number."""
    return struct.unpack("<Q", struct.pack("<d", x))[0]


def bits_to_lreal(bits):
    """The double that has these 64 bits."""
    return struct.unpack("<d", struct.pack("<Q", bits))[0]


def lreal_to_real(x):
    """In single precision; a number that is too large for that faults `range`."""
    y = f32(x)
    if y - y != 0.0 and x - x == 0.0:
        raise RANGE
    return y


def _fraction(x):
    """(n, k): the finite `x` is n / 2^k, and k is not negative."""
    if x - x != 0.0:
        raise RANGE
    mantissa, exponent = math.frexp(x)
    n = int(mantissa * 9007199254740992.0)
    exponent -= 53
    return (n << exponent, 0) if exponent > 0 else (n, -exponent)


def _rounded_ratio(a, b):
    """The LTIME nearest to a / b, half to even; `b` is positive."""
    n = (2 * a + b) // (2 * b)
    if n & 1 and n * 2 * b == 2 * a + b:
        n -= 1
    if not -0x8000000000000000 <= n <= 0x7FFFFFFFFFFFFFFF:
        raise RANGE
    return n


def times_real(ns, x):
    """An LTIME by a real number: the exact product, rounded once."""
    n, k = _fraction(x)
    return _rounded_ratio(ns * n, 1 << k)


def over_real(ns, x):
    """An LTIME by a real number that is not 0: the exact quotient, rounded once."""
    if x == _INFINITY or x == -_INFINITY:
        return 0
    n, k = _fraction(x)
    ns <<= k
    return _rounded_ratio(ns, n) if n > 0 else _rounded_ratio(-ns, -n)


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
