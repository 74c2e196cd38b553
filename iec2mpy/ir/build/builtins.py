"""Standard functions that are more than an operator: one small function a family, chosen by a table."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from iec2mpy.ir import nodes as n
from iec2mpy.ir.build.context import Context
from iec2mpy.ir.build.conversions import bit_string, fit_string, from_bits, to_bits
from iec2mpy.ir.build.moments import concatenated, day_of_week, together
from iec2mpy.ir.build.parts import joined, read_part
from iec2mpy.ir.intrinsics import INTRINSICS
from iec2mpy.ir.walk import may_fault
from iec2mpy.semantics import types as ty

Lowering = Callable[[Context, str, list[n.Expr], n.ValueType], n.Expr]


def lower_builtin(context: Context, name: str, arguments: Sequence[n.Expr], result: n.ValueType) -> n.Expr:
    """The call of a standard function, by its name in `stdlib/functions.toml`."""
    # all arguments of a call are evaluated, also those that are not selected: one that may fault is evaluated now
    values = [context.spill(a) if may_fault(a) else a for a in arguments]
    return _LOWERINGS.get(name, _intrinsic)(context, name, values, result)


def power(context: Context, base: n.Expr, exponent: n.Expr, result: n.ValueType) -> n.Expr:
    """`**`: a REAL to the power of any number (table 29, EXPT)."""
    context.emit(n.Mark(context.site))
    return n.Intrinsic("EXPT", (base, exponent), result)


def _intrinsic(context: Context, name: str, arguments: list[n.Expr], result: n.ValueType) -> n.Expr:
    if INTRINSICS[name].faults:
        context.emit(n.Mark(context.site))
    if not isinstance(result, ty.StringType):
        return n.Intrinsic(name, tuple(arguments), result)
    return fit_string(n.Intrinsic(name, tuple(arguments), ty.StringType(_longest(arguments))), result)


def _longest(arguments: Sequence[n.Expr]) -> int:
    """How long a string that is made of others can be: no function repeats one."""
    return sum(a.type.length for a in arguments if isinstance(a.type, ty.StringType))


def _now(_context: Context, _name: str, _arguments: list[n.Expr], result: n.ValueType) -> n.Expr:
    return n.Now(result)


def _abs(context: Context, name: str, arguments: list[n.Expr], result: n.ValueType) -> n.Expr:
    assert isinstance(result, ty.ElementaryType)
    if not result.is_whole:
        return n.Intrinsic(name, tuple(arguments), result)
    value = context.atom(arguments[0])
    zero = n.Const(0, result)
    negated = n.Wrap(n.Op("sub", zero, value, result), result)
    return n.Select(n.Op("lt", value, zero, ty.BOOL), negated, value, result)


def _sel(context: Context, _name: str, arguments: list[n.Expr], result: n.ValueType) -> n.Expr:
    selector, if_false, if_true = arguments
    return n.Select(selector, if_true, if_false, result)


def _extreme(context: Context, name: str, arguments: list[n.Expr], result: n.ValueType) -> n.Expr:
    comparison = {"MAX": "ge", "MIN": "le"}[name]
    best = context.atom(arguments[0])
    for argument in arguments[1:]:
        value = context.atom(argument)
        better = n.Select(n.Op(comparison, best, value, ty.BOOL), best, value, result)
        best = better if argument is arguments[-1] else context.spill(better)
    return best


def _limit(context: Context, _name: str, arguments: list[n.Expr], result: n.ValueType) -> n.Expr:
    low, value, high = arguments
    return _extreme(context, "MIN", [_extreme(context, "MAX", [value, low], result), high], result)


def _mux(context: Context, _name: str, arguments: list[n.Expr], result: n.ValueType) -> n.Expr:
    selector, *values = arguments
    selector = context.atom(selector)
    last = n.Const(len(values) - 1, selector.type)
    outside = n.Op("gt", selector, last, ty.BOOL)
    if isinstance(selector.type, ty.ElementaryType) and selector.type.low < 0:
        outside = n.Op("or", n.Op("lt", selector, n.Const(0, selector.type), ty.BOOL), outside, ty.BOOL)
    context.emit(n.Guard(outside, "range", context.site))
    chosen = values[-1]
    for number in reversed(range(len(values) - 1)):
        condition = n.Op("eq", selector, n.Const(number, selector.type), ty.BOOL)
        chosen = n.Select(condition, values[number], chosen, result)
    return chosen


def _shift(context: Context, name: str, arguments: list[n.Expr], result: n.ValueType) -> n.Expr:
    """SHL, SHR: by the width or more leaves nothing; ROL, ROR: the count is taken modulo the width."""
    value, count = arguments
    assert isinstance(result, ty.ElementaryType)
    width = result.bits
    value = context.atom(value)
    count = _shift_count(context, count, width)
    if result.in_objects:
        return n.Op(name.lower(), value, count, result)
    if name in ("ROL", "ROR"):
        places = n.Op("and", count, n.Const(width - 1, count.type), count.type) if width > 1 else n.Const(0, ty.INT)
        if isinstance(places, n.Const) and places.value == 0:
            return value
        places = context.atom(places)
        unmoved = n.Op("eq", places, n.Const(0, places.type), ty.BOOL)
        return n.Select(unmoved, value, n.Op(name.lower(), value, places, result), result)
    moved = n.Op(name.lower(), value, count, result)
    if name == "SHL":
        moved = n.Wrap(moved, result)
    fits = n.Op("lt", count, n.Const(width, count.type), ty.BOOL)
    return n.Select(fits, moved, n.Const(0, result), result)


def _shift_count(context: Context, count: n.Expr, width: int) -> n.Expr:
    """The count, which is not negative, as an atom in V; one of a wide type is cut so that it means the same."""
    count = context.atom(count)
    assert isinstance(count.type, ty.ElementaryType)
    if count.type.low < 0:
        negative = n.Op("lt", count, n.Const(0, count.type), ty.BOOL)
        context.emit(n.Guard(negative, "range", context.site))
    if not count.type.in_objects:
        return count
    # at least the width, and the same modulo the width, which is a power of 2
    low = n.Op("and", n.Wrap(count, ty.UINT), n.Const(width - 1, ty.UINT), ty.UINT)
    beyond = n.Op("add", low, n.Const(width, ty.UINT), ty.UINT)
    fits = n.Op("lt", count, n.Const(width, count.type), ty.BOOL)
    return context.spill(n.Select(fits, low, beyond, ty.UINT))


def _concatenated(context: Context, _name: str, arguments: list[n.Expr], result: n.ValueType) -> n.Expr:
    return concatenated(context, arguments, result)


def _together(context: Context, _name: str, arguments: list[n.Expr], result: n.ValueType) -> n.Expr:
    day, time = arguments
    return together(context, day, time, result)


def _day_of_week(_context: Context, _name: str, arguments: list[n.Expr], _result: n.ValueType) -> n.Expr:
    return day_of_week(arguments[0])


def _from_bcd(context: Context, name: str, arguments: list[n.Expr], result: n.ValueType) -> n.Expr:
    assert isinstance(result, ty.ElementaryType)
    return _intrinsic(context, name, [*arguments, n.Const(result.high, result)], result)


def _to_bcd(context: Context, name: str, arguments: list[n.Expr], result: n.ValueType) -> n.Expr:
    assert isinstance(result, ty.ElementaryType)
    return _intrinsic(context, name, [*arguments, n.Const(result.bits // 4, ty.INT)], result)


def _is_valid(context: Context, _name: str, arguments: list[n.Expr], _result: n.ValueType) -> n.Expr:
    """Less itself, a number is 0, and NaN and infinity are NaN."""
    value = context.atom(arguments[0])
    return n.Op("eq", n.Op("sub", value, value, value.type), n.Const(0.0, value.type), ty.BOOL)


def swap_bytes(context: Context, _name: str, arguments: list[n.Expr], result: n.ValueType) -> n.Expr:
    """The value with its bytes in the other order; one of a single byte stays."""
    (value,) = arguments
    if not isinstance(result, ty.ElementaryType) or result.bits < 16:
        return value
    bits = context.kept(to_bits(context, value, result))
    parts = [read_part(bits, 8 * number, ty.BYTE) for number in reversed(range(result.bits // 8))]
    return from_bits(context, joined(parts, bit_string(result)), result)


_LOWERINGS: dict[str, Lowering] = {
    **dict.fromkeys(("CONCAT_DATE", "CONCAT_TOD", "CONCAT_LTOD", "CONCAT_DT", "CONCAT_LDT"), _concatenated),
    **dict.fromkeys(("CONCAT_DATE_TOD", "CONCAT_DATE_LTOD"), _together),
    "DAY_OF_WEEK": _day_of_week,
    "__NOW": _now,
    "__NOW_LTIME": _now,
    "ABS": _abs,
    "SEL": _sel,
    "MAX": _extreme,
    "MIN": _extreme,
    "LIMIT": _limit,
    "MUX": _mux,
    "SHL": _shift,
    "SHR": _shift,
    "ROL": _shift,
    "ROR": _shift,
    "BCD_TO": _from_bcd,
    "TO_BCD": _to_bcd,
    "IS_VALID": _is_valid,
    "TO_BIG_ENDIAN": swap_bytes,
}
