"""String functions (6.6.2.5.11) and the conversions between STRING and other types.

Positions count from 1. Lengths and positions are clamped to what the string has; a text that does not say a value of
the type faults `range`.
"""

from mcu_runtime.arithmetic import real_to_bits
from mcu_runtime.decimals import read, shortest
from mcu_runtime.faults import RANGE

_DIGITS = "0123456789abcdef"
# Longest units first: "ms" before "m" and "s".
_UNITS = (("ms", 1), ("d", 86_400_000), ("h", 3_600_000), ("m", 60_000), ("s", 1000))
_SHOWN = (("d", 86_400_000), ("h", 3_600_000), ("m", 60_000), ("s", 1000), ("ms", 1))


def _clamp(n, low, high):
    if n < low:
        return low
    return high if n > high else n


def str_cut(s, n):
    """What fits a STRING[n]."""
    return s if len(s) <= n else s[:n]


def str_left(s, n):
    return s[: _clamp(n, 0, len(s))]


def str_right(s, n):
    return s[len(s) - _clamp(n, 0, len(s)) :]


def str_mid(s, n, position):
    """`n` characters from `position`."""
    start = _clamp(position, 1, len(s) + 1) - 1
    return s[start : start + _clamp(n, 0, len(s))]


def str_concat(*parts):
    return "".join(parts)


def str_insert(s, inserted, position):
    """`inserted` after the character at `position`."""
    at = _clamp(position, 0, len(s))
    return s[:at] + inserted + s[at:]


def str_delete(s, n, position):
    """Without `n` characters from `position` on."""
    return str_replace(s, "", n, position)


def str_replace(s, new, n, position):
    """`new` in place of `n` characters from `position` on."""
    start = _clamp(position, 1, len(s) + 1) - 1
    return s[:start] + new + s[start + _clamp(n, 0, len(s)) :]


def str_find(s, wanted):
    """Position of the first `wanted` in `s`; 0 where there is none."""
    return s.find(wanted) + 1 if wanted else 0


def bool_to_str(b):
    return "TRUE" if b else "FALSE"


def int_to_str(n):
    return str(n)


def real_to_str(x):
    """The shortest decimal that is this number in single precision, written as a literal of REAL (table 5)."""
    if x != x or x - x != 0.0:
        return "nan" if x != x else "inf" if x > 0.0 else "-inf"
    sign = "-" if real_to_bits(x) >> 31 else ""
    if x == 0.0:
        return sign + "0.0"
    digits, exponent = shortest(abs(x))
    if -4 <= exponent < max(len(digits), 6):
        digits = "0" * -exponent + digits
        point = max(exponent, 0) + 1
        end = ""
    else:
        point = 1
        end = "E%+03d" % exponent
    digits += "0" * (point + 1 - len(digits))
    return sign + digits[:point] + "." + digits[point:] + end


def str_to_bool(s):
    """A literal of BOOL: `TRUE`, `FALSE`, `1`, `0`, in any letter case."""
    text = s.strip().upper()
    if text in ("TRUE", "1"):
        return 1
    if text in ("FALSE", "0"):
        return 0
    raise RANGE


def str_to_int(s, low, high):
    """A literal of an integer, also with a base (`16#FF`) and single underlines."""
    negative, text = _sign(s.strip())
    base = 10
    if "#" in text:
        prefix, text = text.split("#", 1)
        base = {"2": 2, "8": 8, "16": 16}.get(prefix, 0)
    n = _number(text, base)
    if negative:
        n = -n
    if n < low or n > high:
        raise RANGE
    return n


def str_to_real(s):
    """A literal of REAL; the point and the exponent may be missing."""
    negative, text = _sign(s.strip())
    mantissa, e, exponent = text.lower().partition("e")
    whole, point, fraction = mantissa.partition(".")
    power = 0
    if e:
        down, exponent = _sign(exponent)
        power = -_number(exponent, 10) if down else _number(exponent, 10)
    digits = str(_number(whole, 10))
    if point:
        _number(fraction, 10)
        fraction = fraction.replace("_", "")
        digits += fraction
        power -= len(fraction)
    x = read(digits, power)
    return -x if negative else x


def time_to_str(ms):
    """Such as `T#1d2h3m4s5ms`; units that are 0 are left out."""
    if ms == 0:
        return "T#0s"
    text = "T#-" if ms < 0 else "T#"
    ms = abs(ms)
    for unit, size in _SHOWN:
        if ms >= size:
            text += str(ms // size) + unit
            ms %= size
    return text


def str_to_time(s):
    """A literal of TIME (table 8), in ms, rounded; it faults `range` where it is none, or is too long for TIME."""
    prefix, hash_sign, text = s.strip().lower().partition("#")
    if prefix not in ("t", "time") or not hash_sign:
        raise RANGE
    negative, text = _sign(text)
    if not text:
        raise RANGE
    ms = 0
    previous = 0
    while text:
        end = 0
        while end < len(text) and text[end] in "0123456789._":
            end += 1
        unit, size = _unit(text[end:])
        if previous and size >= previous:  # table 8: from long units to short ones
            raise RANGE
        previous = size
        whole, point, fraction = text[:end].partition(".")
        ms += _number(whole, 10) * size
        text = text[end + len(unit) :].lstrip("_")
        if point:  # integers only: a board's float is too short for days in ms
            if text:  # table 8: only the last unit may have a fraction
                raise RANGE
            parts = 10 ** len(fraction.replace("_", ""))
            ms += (2 * _number(fraction, 10) * size + parts) // (2 * parts)
    if negative:
        ms = -ms
    if not -0x80000000 <= ms <= 0x7FFFFFFF:
        raise RANGE
    return ms


def _unit(text):
    """The unit that a text starts with, and its ms."""
    for unit, size in _UNITS:
        if text.startswith(unit):
            return unit, size
    raise RANGE


def _sign(text):
    """(whether negative, the text after its sign)."""
    if text[:1] in ("+", "-"):
        return text[0] == "-", text[1:]
    return False, text


def _number(text, base):
    """An unsigned integer, with single underlines between its digits."""
    if not text or text[0] == "_" or text[-1] == "_" or "__" in text:
        raise RANGE
    n = 0
    for c in text.lower():
        if c == "_":
            continue
        digit = _DIGITS.find(c)
        if not 0 <= digit < base:
            raise RANGE
        n = n * base + digit
    return n
