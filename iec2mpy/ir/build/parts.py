"""Parts of bit strings (6.6.1.3): bits taken out of a value, and put into one."""

from __future__ import annotations

from collections.abc import Sequence

from iec2mpy.ir import nodes as n
from iec2mpy.semantics import types as ty


def read_part(whole: n.Expr, low: int, part: ty.ElementaryType) -> n.Expr:
    """As many bits of the whole as the part's type has, from bit `low` on."""
    moved = n.Op("shr", whole, n.Const(low, ty.INT), whole.type) if low else whole
    return n.Wrap(moved, part)


def joined(parts: Sequence[n.Expr], whole: ty.ElementaryType) -> n.Expr:
    """The bytes as one bit string, the lowest first."""
    value = n.Wrap(parts[0], whole)
    for number, part in enumerate(parts[1:], 1):
        moved = n.Op("shl", n.Wrap(part, whole), n.Const(number * ty.BYTE.bits, ty.INT), whole)
        value = n.Op("or", value, moved, whole)
    return value


def with_part(whole: n.Expr, low: int, part: n.Expr) -> n.Expr:
    """The whole with the part's value in its bits from `low` on."""
    assert isinstance(whole.type, ty.ElementaryType) and isinstance(part.type, ty.ElementaryType)
    ones = ((1 << part.type.bits) - 1) << low
    if isinstance(part, n.Const):
        moved: n.Expr = n.Const(part.number << low, whole.type)
    else:
        moved = n.Wrap(part, whole.type)
        if low:
            moved = n.Op("shl", moved, n.Const(low, ty.INT), whole.type)
    if moved == n.Const(ones, whole.type):
        return n.Op("or", whole, moved, whole.type)
    rest = n.Op("and", whole, n.Const(whole.type.high ^ ones, whole.type), whole.type)
    return n.Op("or", rest, moved, whole.type)
