"""Conversions between elementary types (tables 22 to 27): what each pair of kinds means.

Between numbers, a value out of range faults; from and to bit strings the low bits are kept.
"""

from __future__ import annotations

from iec2mpy.ir import nodes as n
from iec2mpy.ir.build.checks import check_range
from iec2mpy.ir.build.context import Context
from iec2mpy.ir.build.moments import convert_moment
from iec2mpy.semantics import types as ty
from iec2mpy.semantics.arithmetic import NANOSECONDS
from iec2mpy.semantics.types import Kind

_TO_STRING = {
    Kind.BOOL: "bool_to_str",
    Kind.SIGNED: "int_to_str",
    Kind.UNSIGNED: "int_to_str",
    Kind.BITS: "int_to_str",
    Kind.REAL: "real_to_str",
    Kind.DURATION: "time_to_str",
    Kind.CHARACTER: "char_to_str",
}
_LONGEST_NUMBER = 30
"""No number, truth value or duration has more characters than that."""
_LONGEST_DATE = 40
"""Nor one literal of a date."""
_BITS = (Kind.BOOL, Kind.BITS)
_UNSIGNED = {1: ty.BOOL, 8: ty.BYTE, 16: ty.WORD, 32: ty.DWORD, 64: ty.LWORD}
_PATTERNS = {
    (ty.REAL, ty.DWORD): "real_to_bits",
    (ty.DWORD, ty.REAL): "bits_to_real",
    (ty.LREAL, ty.LWORD): "lreal_to_bits",
    (ty.LWORD, ty.LREAL): "bits_to_lreal",
}
"""What is converted bit by bit: a real number and the bit string of its width (6.6.2.5.5)."""
_UNKNOWN_CHARACTER = n.Const(ord("?"), ty.CHAR)
"""Stands for a character that CHAR does not have (table 27, 6)."""


def convert(context: Context, value: n.Expr, target: n.ValueType, truncate: bool) -> n.Expr:
    """The value as one of the target type."""
    source = value.type
    if source == target:
        return value
    if isinstance(target, ty.StringType):
        return _to_string(value, target)
    if isinstance(source, ty.StringType):
        return _from_string(context, value, target)
    if (source, target) in _PATTERNS:
        return n.Intrinsic(_PATTERNS[source, target], (value,), target)
    if source.kind is Kind.REAL:
        return _from_real(context, value, target, truncate)
    if target.kind is Kind.REAL:
        return n.ToReal(value, target)
    if source.kind in ty.MOMENTS or target.kind in ty.MOMENTS:
        return convert_moment(context, value, target)
    if target.kind is Kind.BOOL:
        # to BOOL the lowest bit is kept (table 24)
        lowest = n.Op("and", n.Wrap(value, ty.DWORD), n.Const(1, ty.DWORD), ty.DWORD)
        return n.Op("ne", lowest, n.Const(0, ty.DWORD), ty.BOOL)
    if source is ty.WCHAR and target is ty.CHAR:
        code = context.atom(value)
        known = n.Op("le", code, n.Const(ty.CHAR.high, source), ty.BOOL)
        return n.Select(known, n.Wrap(code, target), _UNKNOWN_CHARACTER, target)
    if source.kind is Kind.DURATION and target.kind is Kind.DURATION:
        return _duration(context, value, target)
    if source.kind in _BITS or target.kind in _BITS:
        # the bits are moved as they are: a sign is not spread
        return n.Wrap(n.Wrap(value, _UNSIGNED[source.bits]), target)
    return n.Wrap(check_range(context, value, target.low, target.high, "range"), target)


def bit_string(of: ty.ElementaryType) -> ty.ElementaryType:
    """The bit string of the same width."""
    return _UNSIGNED[of.bits]


def to_bits(context: Context, value: n.Expr, of: ty.ElementaryType) -> n.Expr:
    """The bits of a value of the type: of a real number its own, of all else those of the number that is stored."""
    bits = bit_string(of)
    return convert(context, value, bits, truncate=False) if of.kind is Kind.REAL else n.Wrap(value, bits)


def from_bits(context: Context, bits: n.Expr, target: ty.ElementaryType) -> n.Expr:
    """The value of the type that has these bits."""
    return convert(context, bits, target, truncate=False) if target.kind is Kind.REAL else n.Wrap(bits, target)


def _duration(context: Context, value: n.Expr, target: ty.ElementaryType) -> n.Expr:
    """TIME as LTIME, or LTIME as TIME: cut to milliseconds."""
    unit = n.Const(NANOSECONDS, ty.LTIME)
    if target is ty.LTIME:
        return n.Op("mul", n.Wrap(value, target), unit, target)
    milliseconds = n.Op("div", value, unit, ty.LTIME)
    return n.Wrap(check_range(context, milliseconds, target.low, target.high, "range"), target)


def real_result(context: Context, value: n.Expr, target: ty.ElementaryType, truncate: bool) -> n.Expr:
    """A real number as an integer: rounded half to even or truncated; a value out of range faults."""
    context.emit(n.Mark(context.site))
    bounds = (n.Const(target.low, target), n.Const(target.high, target))
    return n.Intrinsic("real_trunc" if truncate else "real_to_int", (value, *bounds), target)


def _from_real(context: Context, value: n.Expr, target: ty.ElementaryType, truncate: bool) -> n.Expr:
    if target is ty.LREAL:
        return n.ToReal(value, target)
    if target is ty.REAL:
        context.emit(n.Mark(context.site))
        return n.Intrinsic("lreal_to_real", (value,), target)
    return real_result(context, value, target, truncate)


def _to_string(value: n.Expr, target: ty.StringType) -> n.Expr:
    source = value.type
    if not isinstance(source, ty.StringType) and source.kind in ty.MOMENTS:
        name = n.Const(source.name, ty.StringType(len(source.name)))
        value = n.Intrinsic("date_to_str", (value, name), ty.StringType(_LONGEST_DATE, target.wide))
    elif not isinstance(source, ty.StringType):
        longest = 1 if source.kind is Kind.CHARACTER else _LONGEST_NUMBER
        value = n.Intrinsic(_TO_STRING[source.kind], (value,), ty.StringType(longest, target.wide))
    elif source.wide and not target.wide:
        value = n.Intrinsic("to_narrow", (value,), ty.StringType(source.length))
    return fit_string(value, target)


def _from_string(context: Context, value: n.Expr, target: ty.ElementaryType) -> n.Expr:
    if target.kind is Kind.CHARACTER:
        return n.Intrinsic("str_to_char", (value,), target)
    context.emit(n.Mark(context.site))
    if target.kind is Kind.REAL:
        return n.Intrinsic("str_to_real", (value,), target)
    if target.kind is Kind.BOOL:
        return n.Intrinsic("str_to_bool", (value,), target)
    if target.kind is Kind.DURATION:
        return n.Intrinsic("str_to_time", (value,), target)
    bounds = (n.Const(target.low, target), n.Const(target.high, target))
    if target.kind in ty.MOMENTS:
        name = n.Const(target.name, ty.StringType(len(target.name)))
        return n.Intrinsic("str_to_date", (value, name, *bounds), target)
    return n.Intrinsic("str_to_int", (value, *bounds), target)


def fit_string(value: n.Expr, target: ty.StringType) -> n.Expr:
    """The string cut to the capacity of where it goes, if it can be longer."""
    source = value.type
    assert isinstance(source, ty.StringType)
    if isinstance(value, n.Const):
        return n.Const(str(value.value)[: target.length], target)
    if source.length <= target.length:
        return value
    if isinstance(value, n.Intrinsic) and value.name == "cut":
        value = value.arguments[0]
    return n.Intrinsic("cut", (value, n.Const(target.length, ty.INT)), target)
