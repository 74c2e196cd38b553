"""Constant folding: what is known at compile time is not worked out at run time."""

from __future__ import annotations

from iec2mpy.ir import nodes as n
from iec2mpy.ir.walk import map_body, may_fault
from iec2mpy.semantics import arithmetic
from iec2mpy.semantics import types as ty

_OPERATORS = {
    **{"add": "+", "sub": "-", "mul": "*", "div": "/", "mod": "MOD", "and": "AND", "or": "OR", "xor": "XOR"},
    **{"eq": "=", "ne": "<>", "lt": "<", "gt": ">", "le": "<=", "ge": ">="},
}


def fold(body: n.Body) -> n.Body:
    """The body with constant expressions worked out, and operations that change nothing left out."""
    return map_body(body, _fold)


def _fold(expr: n.Expr) -> n.Expr:
    match expr:
        case n.Wrap(n.Const() as operand, ty.ElementaryType() as to):
            return n.Const(arithmetic.wrap(operand.number, to), to)
        case n.ToReal(n.Const(value), ty.ElementaryType() as to):
            return n.Const(arithmetic.to_precision(float(value), to), to)
        case n.Not(n.Const() as operand, ty.ElementaryType() as to):
            return n.Const(arithmetic.wrap(~operand.number, to), to)
        case n.Not(n.Not(operand, inner), outer) if inner == outer:
            return operand
        case n.Select(n.Const() as condition, then, otherwise):
            return then if condition.value else otherwise
        case n.Op(name, n.Const() as left, n.Const() as right) if name in _OPERATORS:
            return _operation(expr, left, right)
        case n.Op(name, left, right):
            return _identity(expr, name, left, right)
        case _:
            return expr


def _operation(expr: n.Op, left: n.Const, right: n.Const) -> n.Expr:
    """Exact for integers, as `Wrap` is a node of its own; the meaning of all else is `arithmetic`'s."""
    if expr.name in n.ARITHMETIC and isinstance(expr.type, ty.ElementaryType) and expr.type.is_whole:
        exact = {
            "add": left.number + right.number,
            "sub": left.number - right.number,
            "mul": left.number * right.number,
        }
        return n.Const(exact[expr.name], expr.type)
    try:
        value = arithmetic.binary(_OPERATORS[expr.name], left.value, right.value, left.type, right.type)
    except arithmetic.ArithmeticFault:
        # it faults where it stands, when it is reached
        return expr
    return n.Const(value, expr.type)


def _identity(expr: n.Op, name: str, left: n.Expr, right: n.Expr) -> n.Expr:
    """x + 0, x * 1, b AND TRUE and their like; not of real numbers, where x + 0.0 is not always x."""
    if isinstance(left, n.Const) and name in ("add", "mul", "and", "or", "xor"):
        left, right = right, left
    if not isinstance(right, n.Const) or not isinstance(left.type, ty.ElementaryType) or not left.type.is_whole:
        return expr
    value = right.number
    if (value == 0 and name in ("add", "sub", "or", "xor", "shl", "shr")) or (value == 1 and name in ("mul", "div")):
        return left
    if value == 0 and name in ("and", "mul") and not may_fault(left):
        return n.Const(0, expr.type)
    if value == left.type.high and name == "and":
        return left
    return expr
