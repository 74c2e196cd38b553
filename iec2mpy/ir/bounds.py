"""Bounds of integer expressions: what a value can be, from declared types and from the expression itself."""

from __future__ import annotations

from collections.abc import Callable

from iec2mpy.ir import nodes as n
from iec2mpy.semantics import types as ty

Bounds = tuple[int, int]
Known = Callable[[n.Expr], Bounds | None]
"""What is known of a variable or local at a point of the program, beyond its type."""


_WIDEST = 64
"""No shift is wider than a type, whatever its count may be."""


def nothing_known(_expr: n.Expr) -> Bounds | None:
    return None


def bounds(expr: n.Expr, known: Known = nothing_known) -> Bounds:
    """Lowest and highest value of an expression that is stored as an integer."""
    found = _bounds(expr, known)
    limits = _type_bounds(expr.type)
    if isinstance(expr, n.Op) and expr.name in ("add", "sub", "mul", "div", "shl"):
        # these leave their type, until they are wrapped; of the quotients only the lowest number by -1
        return found or (-(1 << _WIDEST), 1 << _WIDEST)
    if found is None:
        return limits
    # what is known cannot make a value leave its type
    return max(found[0], limits[0]), min(found[1], limits[1])


def _type_bounds(value_type: n.ValueType) -> Bounds:
    assert isinstance(value_type, ty.ElementaryType) and not value_type.in_objects, value_type
    return value_type.low, value_type.high


def _bounds(expr: n.Expr, known: Known) -> Bounds | None:
    match expr:
        case n.Const():
            return expr.number, expr.number
        case n.Local(_, _, low, high):
            found = known(expr)
            if found is None and low is not None and high is not None:
                return low, high
            return found
        case n.Load(place):
            return known(expr) or ty.value_range(place.type)
        case n.Ref():
            return 1, ty.REFERENCE.high  # never NULL
        case n.Wrap(operand, value_type):
            inner = bounds(operand, known) if not operand.type.in_objects else None
            limits = _type_bounds(value_type)
            return inner if inner is not None and limits[0] <= inner[0] and inner[1] <= limits[1] else limits
        case n.Select(_, then, otherwise):
            (low1, high1), (low2, high2) = bounds(then, known), bounds(otherwise, known)
            return min(low1, low2), max(high1, high2)
        case n.Op(name, left, right) if name in _OPERATIONS and not left.type.in_objects:
            return _OPERATIONS[name](bounds(left, known), bounds(right, known))
        case n.Intrinsic("real_to_int" | "real_trunc" | "str_to_int", (_, n.Const() as low, n.Const() as high)):
            return low.number, high.number
        case n.Intrinsic("LEN"):
            return 0, ty.INT.high
        case _:
            return None


def _add(a: Bounds, b: Bounds) -> Bounds:
    return a[0] + b[0], a[1] + b[1]


def _subtract(a: Bounds, b: Bounds) -> Bounds:
    return a[0] - b[1], a[1] - b[0]


def _multiply(a: Bounds, b: Bounds) -> Bounds:
    corners = [x * y for x in a for y in b]
    return min(corners), max(corners)


def _divide(a: Bounds, b: Bounds) -> Bounds | None:
    if b[0] <= 0:
        # of a quotient of unknown sign only the size is known
        largest = max(abs(a[0]), abs(a[1]))
        return -largest, largest
    corners = [_truncate(x, y) for x in a for y in b]
    return min(corners), max(corners)


def _truncate(dividend: int, divisor: int) -> int:
    quotient = abs(dividend) // abs(divisor)
    return quotient if (dividend < 0) == (divisor < 0) else -quotient


def _modulo(a: Bounds, b: Bounds) -> Bounds:
    largest = max(abs(b[0]), abs(b[1]), 1) - 1
    return (max(a[0], -largest) if a[0] < 0 else 0), (min(a[1], largest) if a[1] > 0 else 0)


def _and(a: Bounds, b: Bounds) -> Bounds | None:
    if a[0] >= 0 and b[0] >= 0:
        return 0, min(a[1], b[1])
    return None


def _or(a: Bounds, b: Bounds) -> Bounds | None:
    if a[0] >= 0 and b[0] >= 0:
        return 0, (1 << max(a[1], b[1]).bit_length()) - 1
    return None


def _shl(a: Bounds, b: Bounds) -> Bounds | None:
    return (0, a[1] << min(b[1], _WIDEST)) if a[0] >= 0 and b[0] >= 0 else None


def _shr(a: Bounds, b: Bounds) -> Bounds | None:
    return (0, a[1] >> b[0]) if a[0] >= 0 and b[0] >= 0 else None


_OPERATIONS: dict[str, Callable[[Bounds, Bounds], Bounds | None]] = {
    "add": _add,
    "sub": _subtract,
    "mul": _multiply,
    "div": _divide,
    "mod": _modulo,
    "and": _and,
    "or": _or,
    "xor": _or,
    "shl": _shl,
    "shr": _shr,
}
