"""Checks of values while the program runs: against the bounds of a subscript, a subrange, a type."""

from __future__ import annotations

from iec2mpy.ir import nodes as n
from iec2mpy.ir.build.context import Context
from iec2mpy.semantics import types as ty


def check_range(context: Context, value: n.Expr, low: int, high: int, fault: str) -> n.Expr:
    """The value, which was checked to be inside the bounds; as an atom, if a check was needed."""
    assert isinstance(value.type, ty.ElementaryType)
    inside = isinstance(value, n.Const) and low <= value.number <= high
    if inside or (low <= value.type.low and value.type.high <= high):
        return value
    value = context.atom(value)
    context.emit(n.Guard(outside(value, low, high), fault, context.site))
    return value


def outside(value: n.Expr, low: int, high: int) -> n.Expr:
    """Whether an atom, whose type has more values than that, is not in low..high."""
    assert isinstance(value.type, ty.ElementaryType)
    checks = [("lt", low)] * (low > value.type.low) + [("gt", high)] * (high < value.type.high)
    conditions = [n.Op(name, value, n.Const(bound, value.type), ty.BOOL) for name, bound in checks]
    return conditions[0] if len(conditions) == 1 else n.Op("or", conditions[0], conditions[1], ty.BOOL)
