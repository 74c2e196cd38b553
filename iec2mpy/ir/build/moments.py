"""Dates and times of day: their arithmetic (table 35), their conversions (table 26), and their parts (table 36).

Those of 64 bits are objects: a number from V becomes one before it meets them.
"""

from __future__ import annotations

from collections.abc import Sequence

from iec2mpy.ir import nodes as n
from iec2mpy.ir.build.checks import check_range
from iec2mpy.ir.build.context import Context
from iec2mpy.semantics import types as ty
from iec2mpy.semantics.calendar import DAY, DURATION, UNIT, sizes
from iec2mpy.semantics.types import Kind

_DAY_MS = DAY // UNIT[ty.TOD]
_SUNDAY = 4
"""1970-01-01 was a Thursday."""


def add_or_subtract(context: Context, operator: str, left: n.Expr, right: n.Expr) -> n.Expr:
    """A date or time of day + or - a duration, or the difference of two (table 35, 2 to 9)."""
    of = left.type
    assert isinstance(of, ty.ElementaryType)
    name = {"+": "add", "-": "sub"}[operator]
    if right.type is of:
        result = DURATION[of]
        return n.Wrap(_times(n.Op(name, left, right, of), UNIT[of] // UNIT[result]), result)
    if of is ty.TOD:
        return _turned(context, name, left, right)
    total = n.Op(name, left, as_object(right), of)
    return _rest(total, DAY, of) if of.kind is Kind.TIME_OF_DAY else n.Wrap(total, of)


def _turned(context: Context, name: str, time: n.Expr, by: n.Expr) -> n.Expr:
    """A TOD goes round after midnight. No step leaves 32 bits."""
    day = n.Const(_DAY_MS, ty.DINT)
    turned = context.spill(n.Op(name, time, n.Op("mod", context.atom(by), day, ty.DINT), ty.DINT))
    below = n.Op("lt", turned, n.Const(0, ty.DINT), ty.BOOL)
    beyond = n.Op("ge", turned, day, ty.BOOL)
    less = n.Select(beyond, n.Op("sub", turned, day, ty.DINT), turned, ty.DINT)
    return n.Wrap(n.Select(below, n.Op("add", turned, day, ty.DINT), less, ty.DINT), ty.TOD)


# -------------------------------------------------------------------------------------------- conversions


def convert_moment(context: Context, value: n.Expr, target: ty.ElementaryType) -> n.Expr:
    """From or to a date or time of day, as `calendar.converted` says. A value that the target does not have faults; a
    bit string keeps the low bits."""
    source = value.type
    assert isinstance(source, ty.ElementaryType)
    size, size_of_target = sizes(source, target)
    if target.kind is Kind.TIME_OF_DAY and source.kind is Kind.DATE_AND_TIME:
        value = _rest(value, DAY // size, source)
    elif target is ty.LDATE and source is not ty.DATE:
        value = context.atom(as_object(value))
        value = n.Op("sub", value, _rest(value, DAY // size, source), source)
    if size >= size_of_target:
        return _multiplied(context, value, size // size_of_target, target)
    return _divided(context, value, size_of_target // size, target)


def _multiplied(context: Context, value: n.Expr, factor: int, target: ty.ElementaryType) -> n.Expr:
    if target.kind is not Kind.BITS:
        value = check_range(context, value, -(-target.low // factor), target.high // factor, "range")
    if target.in_objects:
        value = as_object(value)
    return n.Wrap(_times(value, factor), target)


def _divided(context: Context, value: n.Expr, divisor: int, target: ty.ElementaryType) -> n.Expr:
    source = value.type
    assert isinstance(source, ty.ElementaryType)
    if not source.in_objects:
        # only seconds to a DATE, which has them all
        return n.Intrinsic("floor_quotient", (value, n.Const(divisor, ty.DINT)), target)
    quotient: n.Expr = n.Intrinsic("floor_quotient", (value, n.Const(divisor, source)), source)
    if target.kind is not Kind.BITS:
        quotient = check_range(context, quotient, target.low, target.high, "range")
    return n.Wrap(quotient, target)


def _times(value: n.Expr, factor: int) -> n.Expr:
    return n.Op("mul", value, n.Const(factor, value.type), value.type) if factor > 1 else value


def _rest(value: n.Expr, divisor: int, of: ty.ElementaryType) -> n.Expr:
    """The remainder, never negative."""
    return n.Intrinsic("floor_rest", (value, n.Const(divisor, of)), of)


def as_object(value: n.Expr) -> n.Expr:
    """An integer as one of 64 bits."""
    return value if value.type.in_objects else n.Wrap(value, ty.LINT)


# -------------------------------------------------------------------------------------------------- parts


def concatenated(context: Context, arguments: Sequence[n.Expr], result: n.ValueType) -> n.Expr:
    """CONCAT_DATE, CONCAT_TOD, CONCAT_LTOD, CONCAT_DT and CONCAT_LDT: what numbers say (table 36, 2 to 4). Numbers that
    no calendar has fault."""
    assert isinstance(result, ty.ElementaryType)
    context.emit(n.Mark(context.site))
    if result.kind is Kind.DATE:
        return n.Intrinsic("concat_date", tuple(arguments), ty.DATE)
    if result.kind is Kind.TIME_OF_DAY:
        time = n.Intrinsic("concat_tod", tuple(arguments), ty.TOD)
        return convert_moment(context, context.spill(time), result) if result is not ty.TOD else time
    day = context.spill(n.Intrinsic("concat_date", tuple(arguments[:3]), ty.DATE))
    time = context.spill(n.Intrinsic("concat_tod", tuple(arguments[3:]), ty.TOD))
    return together(context, day, time, result)


def together(context: Context, day: n.Expr, time: n.Expr, result: n.ValueType) -> n.Expr:
    """CONCAT_DATE_TOD and CONCAT_DATE_LTOD: a date and a time of day (table 36, 1)."""
    assert isinstance(result, ty.ElementaryType)
    assert isinstance(time.type, ty.ElementaryType)
    start = convert_moment(context, day, result)
    rest = _times(as_object(time), UNIT[time.type] // UNIT[result])
    return n.Wrap(n.Op("add", start, rest, result), result)


def day_of_week(day: n.Expr) -> n.Expr:
    """DAY_OF_WEEK: 0 for a Sunday (table 36, 8)."""
    since_a_sunday = _SUNDAY - ty.DATE.low + ty.DATE.low % 7
    counted = n.Op("add", day, n.Const(since_a_sunday, ty.DINT), ty.DINT)
    return n.Wrap(n.Op("mod", counted, n.Const(7, ty.DINT), ty.DINT), ty.INT)


_OF_DATE = {"YEAR": ("year_of", ty.UINT), "MONTH": ("month_of", ty.USINT), "DAY": ("day_of", ty.USINT)}
_OF_TIME = {
    "HOUR": (3_600_000, 24, ty.USINT),
    "MINUTE": (60_000, 60, ty.USINT),
    "SECOND": (1_000, 60, ty.USINT),
    "MILLISECOND": (1, 1_000, ty.UINT),
}


def parts(context: Context, value: n.Expr, names: Sequence[str]) -> list[n.Expr]:
    """The parts of a date or time of day that are named (table 36, 5 to 7), each as a small number."""
    value = context.kept(value)
    day = _kept_as(context, value, ty.DATE) if any(name in _OF_DATE for name in names) else None
    time = _kept_as(context, value, ty.TOD) if any(name in _OF_TIME for name in names) else None
    found: list[n.Expr] = []
    for name in names:
        if name in _OF_DATE:
            assert day is not None
            function, of = _OF_DATE[name]
            found.append(n.Intrinsic(function, (day,), of))
        else:
            assert time is not None
            unit, count, of = _OF_TIME[name]
            whole = n.Op("div", time, n.Const(unit, ty.DINT), ty.DINT) if unit > 1 else time
            found.append(n.Wrap(n.Op("mod", whole, n.Const(count, ty.DINT), ty.DINT), of))
    return found


def _kept_as(context: Context, value: n.Expr, target: ty.ElementaryType) -> n.Expr:
    return value if value.type is target else context.kept(convert_moment(context, value, target))
