"""What every operation means, on values as they are stored (`typed.Scalar`).

Pure functions, in one place: the checker folds constants with them, the optimiser does, and tests take them as the
model that generated code is compared to. Integers wrap to the width of their type after each operation; REAL is single
precision, LREAL double; an operation that stops the controller at run time raises `ArithmeticFault` here.
"""

from __future__ import annotations

import math
import operator
import struct
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction

from iec2mpy.semantics import calendar
from iec2mpy.semantics.typed import Scalar
from iec2mpy.semantics.types import (
    CHAR,
    DWORD,
    LREAL,
    LTIME,
    LWORD,
    MOMENTS,
    REAL,
    TIME,
    WCHAR,
    ElementaryType,
    Kind,
    StringType,
)

SingleType = ElementaryType | StringType
"""The type of a single value: enumerations, subranges and aliases are reduced to it by `types.value_type`."""


class ArithmeticFault(Exception):
    """`kind`: "zero" for a division, "range" for a value that the result cannot have (the run time's faults)."""

    def __init__(self, kind: str) -> None:
        super().__init__(kind)
        self.kind = kind


# ------------------------------------------------------------------------------------------ single values


def wrap(value: int, to: ElementaryType) -> int:
    """The value of type `to` with the same low bits."""
    value &= (1 << to.bits) - 1
    return value - (1 << to.bits) if value > to.high else value


def to_single(value: float) -> float:
    """The nearest single-precision number; infinity where the value is too large for one."""
    try:
        return struct.unpack("<f", struct.pack("<f", value))[0]
    except OverflowError:
        return math.copysign(math.inf, value)


def to_precision(value: float, of: ElementaryType) -> float:
    """The nearest number that a REAL or LREAL can be."""
    return to_single(value) if of is REAL else value


def truncating_divide(dividend: int, divisor: int) -> int:
    """Integer division that rounds towards zero (table 29, 4); raises `ArithmeticFault` for a divisor of 0."""
    if divisor == 0:
        raise ArithmeticFault("zero")
    quotient = abs(dividend) // abs(divisor)
    return quotient if (dividend < 0) == (divisor < 0) else -quotient


def modulo(dividend: int, divisor: int) -> int:
    """The remainder of `truncating_divide`, with the sign of the dividend; 0 for a divisor of 0 (table 29, note e)."""
    return dividend - truncating_divide(dividend, divisor) * divisor if divisor else 0


# ---------------------------------------------------------------------------------------------- operators


def _real(of: ElementaryType, function: Callable[..., float], *arguments: float) -> float:
    """The result as a REAL or LREAL; an argument outside of the function's domain faults, overflow gives infinity."""
    try:
        return to_precision(function(*arguments), of)
    except OverflowError:
        return math.inf
    except ValueError:
        raise ArithmeticFault("range") from None


def _divide_real(dividend: float, divisor: float) -> float:
    if divisor == 0:
        raise ArithmeticFault("zero")
    return dividend / divisor


def _power(base: float, exponent: float) -> float:
    """`base ** exponent`. The sign of an overflow is that of the true result, which `_real` cannot know."""
    try:
        return math.pow(base, exponent)
    except OverflowError:
        return -math.inf if base < 0 and exponent % 2 == 1 else math.inf


_INTEGER: Mapping[str, Callable[[int, int], int]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": truncating_divide,
    "MOD": modulo,
    "AND": operator.and_,
    "OR": operator.or_,
    "XOR": operator.xor,
}
_REAL: Mapping[str, Callable[[float, float], float]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": _divide_real,
    "**": _power,
}
_COMPARE: Mapping[str, Callable[[Scalar, Scalar], bool]] = {
    "=": operator.eq,
    "<>": operator.ne,
    "<": operator.lt,
    ">": operator.gt,
    "<=": operator.le,
    ">=": operator.ge,
}
COMPARISONS = frozenset(_COMPARE)


def binary(name: str, left: Scalar, right: Scalar, left_type: SingleType, right_type: SingleType) -> Scalar:
    """`left name right`; both have one type, except for a duration * or / a number. A comparison gives 0 or 1."""
    if name in _COMPARE:
        # strings compare by the codes of their characters, the shorter one first (6.6.2.5.10)
        return int(_COMPARE[name](left, right))
    assert isinstance(left_type, ElementaryType)
    if left_type.kind is Kind.REAL:
        return _real(left_type, _REAL[name], float(left), float(right))
    if left_type.kind in MOMENTS:
        assert isinstance(right_type, ElementaryType)
        return _of_moment(name, int(left), int(right), left_type, right_type)
    if isinstance(right_type, ElementaryType) and right_type.kind is Kind.REAL:
        return _scaled_duration(name, int(left), float(right), left_type, right_type)
    assert isinstance(left, int) and isinstance(right, int)
    return wrap(_INTEGER[name](left, right), left_type)


def _scaled_duration(name: str, duration: int, factor: float, of: ElementaryType, factor_type: ElementaryType) -> int:
    """A TIME is calculated with as a number of the factor's type. An LTIME, whose nanoseconds that type could not hold,
    is scaled exactly, and rounded once."""
    if of is TIME:
        product = _real(factor_type, _REAL[name], to_precision(float(duration), factor_type), factor)
        return _round_to(product, TIME)
    if name == "/" and factor == 0:
        raise ArithmeticFault("zero")
    if math.isinf(factor) and name == "/":
        return 0
    if not math.isfinite(factor):
        raise ArithmeticFault("range")
    exact = Fraction(duration) * Fraction(factor) if name == "*" else Fraction(duration) / Fraction(factor)
    return _in_range(round(exact), of)


def _of_moment(name: str, left: int, right: int, of: ElementaryType, right_type: ElementaryType) -> int:
    """A date or time of day and a duration, or the difference of two (table 35, 2 to 9). A time of day goes round."""
    units = calendar.UNIT
    moment = _INTEGER[name](left * units[of], right * units[right_type])
    if right_type is of:
        result = calendar.DURATION[of]
        return wrap(moment // units[result], result)
    value = moment // units[of]
    return value % (of.high + 1) if of.kind is Kind.TIME_OF_DAY else wrap(value, of)


def bitwise(name: str, left: int, right: int) -> int:
    """AND, OR, XOR of two numbers that have no width yet."""
    return _INTEGER[name](left, right)


def unary(name: str, operand: Scalar, of: SingleType) -> Scalar:
    """`-operand` of a number or a duration, `NOT operand` of a bit string."""
    assert isinstance(of, ElementaryType)
    if of.kind is Kind.REAL:
        return -float(operand)
    assert isinstance(operand, int)
    return wrap(-operand if name == "-" else ~operand, of)


# -------------------------------------------------------------------------------------------- conversions


def _in_range(value: int, to: ElementaryType) -> int:
    if not to.low <= value <= to.high:
        raise ArithmeticFault("range")
    return value


def _round_to(value: float, to: ElementaryType, truncate: bool = False) -> int:
    """A real number as an integer: half to even (6.6.2.5.3), or towards zero."""
    if not math.isfinite(value):
        raise ArithmeticFault("range")
    return _in_range(int(value) if truncate else round(value), to)


def _parse_integer(text: str) -> int:
    """A decimal integer with an optional sign, nothing else; everything else faults `range`."""
    digits = text[1:] if text[:1] in ("+", "-") else text
    if not digits or not all("0" <= c <= "9" for c in digits):
        raise ArithmeticFault("range")
    return int(text)


_BOOL_TEXT = {"FALSE": 0, "TRUE": 1, "0": 0, "1": 1}


def _from_text(text: str, to: ElementaryType) -> int:
    if to.kind in MOMENTS:
        return _in_range(_calendar(calendar.parse, text, to), to)
    if to.kind is Kind.BOOL:
        if text.upper() not in _BOOL_TEXT:
            raise ArithmeticFault("range")
        return _BOOL_TEXT[text.upper()]
    return _in_range(_parse_integer(text), to)


def _calendar(function: Callable[..., int], *arguments: object) -> int:
    """What no calendar has faults."""
    try:
        return function(*arguments)
    except ValueError:
        raise ArithmeticFault("range") from None


_UNKNOWN_CHARACTER = "?"
"""Stands for a character that its target does not have (table 27)."""


def _to_text(value: Scalar, source: SingleType, to: StringType) -> str:
    if isinstance(source, StringType):
        text = str(value)
        return text if to.wide else "".join(c if ord(c) <= CHAR.high else _UNKNOWN_CHARACTER for c in text)
    if source.kind is Kind.CHARACTER:
        return chr(int(value))
    if source.kind in MOMENTS:
        return calendar.text(int(value), source)
    return ("FALSE", "TRUE")[int(value)] if source.kind is Kind.BOOL else str(value)


def _is_bits(of: ElementaryType) -> bool:
    return of.kind in (Kind.BOOL, Kind.BITS)


_PATTERNS: Mapping[tuple[ElementaryType, ElementaryType], tuple[str, str]] = {
    (REAL, DWORD): ("<f", "<I"),
    (DWORD, REAL): ("<I", "<f"),
    (LREAL, LWORD): ("<d", "<Q"),
    (LWORD, LREAL): ("<Q", "<d"),
}
"""What exchanges its bits, and how `struct` packs and unpacks them."""
NANOSECONDS = 1_000_000
"""In a millisecond: of LTIME in a unit of TIME."""


def _narrowed(value: float, to: ElementaryType) -> float:
    """A REAL or LREAL as the other; a number that is too large for REAL faults."""
    result = to_precision(value, to)
    if math.isinf(result) and math.isfinite(value):
        raise ArithmeticFault("range")
    return result


def convert(value: Scalar, source: SingleType, to: SingleType, truncate: bool = False) -> Scalar:
    """A value of type `source` as one of type `to` (table 22).

    Numbers keep their value or fault `range`; from and to bit strings the low bits are kept, without sign extension
    (6.6.2.5.5); REAL and DWORD, LREAL and LWORD exchange bit patterns; TIME counts as its milliseconds, LTIME as its
    nanoseconds, but to each other they keep the duration, cut to milliseconds; a character counts as its code; a string
    is cut to its length.
    """
    if isinstance(to, StringType):
        return _to_text(value, source, to)[: to.length]
    if isinstance(source, StringType):
        if to is source.character:
            return ord(str(value)[0]) if value else 0
        return _from_text(str(value), to)
    if source is to:
        return value
    if (source, to) in _PATTERNS:
        number, bits = _PATTERNS[source, to]
        return struct.unpack(bits, struct.pack(number, value))[0]
    if source.kind is Kind.REAL:
        if to.kind is Kind.REAL:
            return _narrowed(float(value), to)
        return _round_to(float(value), to, truncate)
    assert isinstance(value, int)
    if to.kind is Kind.REAL:
        return to_precision(float(value), to)
    if source.kind in MOMENTS or to.kind in MOMENTS:
        value = calendar.converted(value, source, to)
        return wrap(value, to) if _is_bits(to) else _in_range(value, to)
    if source.kind is Kind.DURATION and to.kind is Kind.DURATION:
        value = value * NANOSECONDS if to is LTIME else truncating_divide(value, NANOSECONDS)
        return _in_range(value, to)
    if source is WCHAR and to is CHAR:
        return value if value <= CHAR.high else ord(_UNKNOWN_CHARACTER)
    if _is_bits(source) or _is_bits(to):
        return wrap(value & ((1 << source.bits) - 1), to)
    return _in_range(value, to)


# ------------------------------------------------------------------------------------- standard functions


def _shift(name: str, value: int, count: int, of: ElementaryType) -> int:
    if count < 0:  # an error by table 30
        raise ArithmeticFault("range")
    if name == "SHL":
        return wrap(value << min(count, of.bits), of)
    if name == "SHR":
        return value >> min(count, of.bits)
    count %= of.bits
    if name == "ROR":
        count = of.bits - count
    return wrap(value << count | value >> of.bits - count, of)


def _clamped(text: str, length: int, position: int = 1) -> slice:
    """The part of a text of `length` characters from `position` (from 1), cut to what is there."""
    start = max(position, 1) - 1
    return slice(start, start + max(length, 0))


def _left(text: str, length: int) -> str:
    return text[: max(length, 0)]


def _right(text: str, length: int) -> str:
    return text[max(len(text) - max(length, 0), 0) :]


def _mid(text: str, length: int, position: int) -> str:
    return text[_clamped(text, length, position)]


def _insert(text: str, inserted: str, position: int) -> str:
    at = max(position, 0)
    return text[:at] + inserted + text[at:]


def _delete(text: str, length: int, position: int) -> str:
    return _replace(text, "", length, position)


def _replace(text: str, replacement: str, length: int, position: int) -> str:
    part = _clamped(text, length, position)
    return text[: part.start] + replacement + text[part.stop :]


def _find(text: str, sought: str) -> int:
    return text.find(sought) + 1 if sought else 0


_STRING_FUNCTIONS: Mapping[str, Callable[..., Scalar]] = {
    "LEN": len,
    "LEFT": _left,
    "RIGHT": _right,
    "MID": _mid,
    "CONCAT": lambda *texts: "".join(texts),
    "INSERT": _insert,
    "DELETE": _delete,
    "REPLACE": _replace,
    "FIND": _find,
}


_REAL_FUNCTIONS: Mapping[str, Callable[..., float]] = {
    "SQRT": math.sqrt,
    "LN": math.log,
    "LOG": math.log10,
    "EXP": math.exp,
    "SIN": math.sin,
    "COS": math.cos,
    "TAN": math.tan,
    "ASIN": math.asin,
    "ACOS": math.acos,
    "ATAN": math.atan,
    "ATAN2": math.atan2,
}


def _limit(low: Scalar, value: Scalar, high: Scalar) -> Scalar:
    """MIN(MAX(value, low), high): `high` wins where the limits cross (table 32, 5)."""
    return _minimum(_maximum(value, low), high)


def _maximum(*values: Scalar) -> Scalar:
    best = values[0]
    for value in values[1:]:
        if value > best:  # type: ignore[operator] - all have one type
            best = value
    return best


def _minimum(*values: Scalar) -> Scalar:
    best = values[0]
    for value in values[1:]:
        if value < best:  # type: ignore[operator] - all have one type
            best = value
    return best


def _multiplex(selector: int, *values: Scalar) -> Scalar:
    if not 0 <= selector < len(values):
        raise ArithmeticFault("range")
    return values[selector]


_SELECTIONS: Mapping[str, Callable[..., Scalar]] = {
    "SEL": lambda g, in0, in1: in1 if g else in0,
    "MAX": _maximum,
    "MIN": _minimum,
    "LIMIT": _limit,
    "MUX": _multiplex,
}


def _from_bcd(value: Scalar, result: ElementaryType) -> Scalar:
    digits = f"{int(value):x}"
    if not digits.isdecimal() or int(digits) > result.high:
        raise ArithmeticFault("range")
    return int(digits)


def _to_bcd(value: Scalar, result: ElementaryType) -> Scalar:
    if int(value) < 0 or int(value) >= 10 ** (result.bits // 4):
        raise ArithmeticFault("range")
    return int(str(int(value)), 16)


def _swapped(value: Scalar, of: ElementaryType) -> Scalar:
    if of.bits < 16:
        return value
    if of.kind is Kind.REAL:
        form = "f" if of.bits == 32 else "d"
        return struct.unpack(f">{form}", struct.pack(f"<{form}", value))[0]
    bits = int(value) & (1 << of.bits) - 1
    return wrap(int.from_bytes(bits.to_bytes(of.bits // 8, "little"), "big"), of)


_BITWISE_FUNCTIONS: Mapping[str, Callable[[Scalar, ElementaryType], Scalar]] = {
    "BCD_TO": _from_bcd,
    "TO_BCD": _to_bcd,
    "IS_VALID": lambda value, _: int(math.isfinite(value)) if isinstance(value, float) else 1,
    "IS_VALID_BCD": lambda value, _: int(f"{int(value):x}".isdecimal()),
    **dict.fromkeys(("TO_BIG_ENDIAN", "FROM_BIG_ENDIAN", "BIG_ENDIAN_TO"), _swapped),
    **dict.fromkeys(("TO_LITTLE_ENDIAN", "FROM_LITTLE_ENDIAN", "LITTLE_ENDIAN_TO"), lambda value, _: value),
}


def builtin(name: str, arguments: Sequence[Scalar], result: SingleType) -> Scalar:
    """A standard function that is no operator, by its name; `result` is the type of what it gives.

    String functions clamp lengths and positions; their result is cut to the length of `result`.
    """
    if name in _SELECTIONS:
        return _SELECTIONS[name](*arguments)
    if name in _STRING_FUNCTIONS:
        value = _STRING_FUNCTIONS[name](*arguments)
        return value[: result.length] if isinstance(value, str) and isinstance(result, StringType) else value
    if name in _REAL_FUNCTIONS:
        assert isinstance(result, ElementaryType)
        return _real(result, _REAL_FUNCTIONS[name], *map(float, arguments))
    assert isinstance(result, ElementaryType)
    if name in calendar.FUNCTIONS:
        return _in_range(_calendar(calendar.FUNCTIONS[name], result, *arguments), result)
    value = arguments[0]
    if name in _BITWISE_FUNCTIONS:
        return _BITWISE_FUNCTIONS[name](value, result)
    if name == "ABS":
        return abs(value) if isinstance(value, float) else wrap(abs(int(value)), result)
    return _shift(name, int(value), int(arguments[1]), result)
