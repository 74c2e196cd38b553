"""Errors of string functions (6.6.2.5.10), for calls with ENO: without it, lengths and positions are clamped."""

from __future__ import annotations

from collections.abc import Sequence

from iec2mpy.ir import nodes as n
from iec2mpy.ir.build.context import Context
from iec2mpy.semantics import types as ty

_LENGTH: dict[str, int] = {"LEFT": 1, "RIGHT": 1, "MID": 1, "DELETE": 1, "REPLACE": 2}
"""Which argument is a length: it must not be negative."""
_POSITION: dict[str, tuple[int, int]] = {"MID": (2, 1), "DELETE": (2, 1), "REPLACE": (3, 1), "INSERT": (2, 0)}
"""Which argument is a position in the first one, and the lowest that it can be: INSERT at 0 puts a text in front."""


def check_positions(context: Context, name: str, arguments: Sequence[n.Expr]) -> None:
    """Faults `range` for a negative length, and for a position that the string does not have."""
    if name in _LENGTH:
        _forbid(context, "lt", arguments[_LENGTH[name]], 0)
    if name in _POSITION:
        number, lowest = _POSITION[name]
        position = arguments[number]
        _forbid(context, "lt", position, lowest)
        length = context.spill(n.Intrinsic("LEN", (arguments[0],), ty.INT))
        context.emit(n.Guard(n.Op("gt", position, length, ty.BOOL), "range", context.site))


def _forbid(context: Context, comparison: str, value: n.Expr, limit: int) -> None:
    condition = n.Op(comparison, value, n.Const(limit, value.type), ty.BOOL)
    context.emit(n.Guard(condition, "range", context.site))
