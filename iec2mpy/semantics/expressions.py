"""Expressions: each gets its type, each name its variable, and what is constant becomes a constant (7.3.2)."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from iec2mpy.semantics import arithmetic, calls, operators
from iec2mpy.semantics.literals import literal
from iec2mpy.semantics.names import enumerated_value, is_enumerated, is_nothing_else, qualified_value, unknown_value
from iec2mpy.semantics.references import Use, reference
from iec2mpy.semantics.scope import Scope
from iec2mpy.semantics.typed import Constant, Expr, PartRef, ReferenceTo, VariableRef
from iec2mpy.semantics.types import EnumType, RefType, Type, base_type, unaliased, value_type
from iec2mpy.syntax import tree


def check(scope: Scope, expr: tree.Expr, expected: Type | None = None) -> Expr | None:
    """The checked expression, or None where it is wrong, which has been reported.

    `expected` is the type that the place needs. It only decides what has no type of its own: an enumerated value whose
    name several types have, and literals; it never changes the type of an operation (6.6.1.7.2). A literal without a
    prefix may come back untyped (`conversions.is_untyped`): `coerce` or `typed_literal` gives it a type.
    """
    return _CHECKERS[type(expr)](scope, expr, expected)


def _literal(scope: Scope, expr: tree.Literal, expected: Type | None) -> Expr | None:
    return literal(scope, expr, expected)


def _name(scope: Scope, expr: tree.NameExpr, expected: Type | None) -> Expr | None:
    if is_enumerated(scope, expr, expected):
        return enumerated_value(scope, expr, expected)
    wanted = unaliased(expected) if expected is not None else None
    if isinstance(wanted, EnumType) and is_nothing_else(scope, expr):
        unknown_value(scope, wanted, tree.Name(expr.name, expr.span))
        return None
    return _variable(scope, expr, expected)


def _variable(scope: Scope, expr: tree.Expr, expected: Type | None) -> Expr | None:
    found = reference(scope, expr, Use.READ)
    if isinstance(found, PartRef) and isinstance(found.base, VariableRef) and found.base.variable.constant:
        whole = found.base.variable.initial
        assert isinstance(whole, int)
        return Constant(arithmetic.wrap(whole >> found.low, found.type), found.type, expr.span)
    if not isinstance(found, VariableRef) or not found.variable.constant:
        return found
    value = found.variable.initial
    if not isinstance(value, (int, float, str)) or value_type(found.type) is None:
        return found  # a constant array or structure stays a variable
    return Constant(value, base_type(found.type), expr.span)


def _reference(scope: Scope, expr: tree.RefExpr, expected: Type | None) -> Expr | None:
    target = reference(scope, expr.operand, Use.REFER)
    return target and ReferenceTo(target, RefType(target.type), expr.span)


def _typed_enum_value(scope: Scope, expr: tree.TypedEnumValue, expected: Type | None) -> Expr | None:
    return qualified_value(scope, expr)


def _call(scope: Scope, expr: tree.CallExpr, expected: Type | None) -> Expr | None:
    return calls.in_expression(scope, expr, expected)


def _unary(scope: Scope, expr: tree.UnaryExpr, expected: Type | None) -> Expr | None:
    operand = check(scope, expr.operand, expected)
    return operand and operators.unary(scope, expr.operator, operand, expected, expr.span)


def _binary(scope: Scope, expr: tree.BinaryExpr, expected: Type | None) -> Expr | None:
    # the operands of a long chain `a + b + c …` are checked in a loop: it may be deeper than Python's stack
    chain: list[tree.BinaryExpr] = []
    first: tree.Expr = expr
    while isinstance(first, tree.BinaryExpr):
        chain.append(first)
        first = first.left
    hint = None if any(link.operator in _COMPARISONS for link in chain) else expected
    left = check(scope, first, hint)
    for link in reversed(chain):
        right = check(scope, link.right, hint)
        if left is not None and right is not None:
            left = operators.binary(scope, link.operator, left, right, link.operator_span, link.span)
        else:
            left = None
    return left


_COMPARISONS = operators.COMPARISONS


def _not_yet(what: str) -> Callable[..., Expr | None]:
    def report(scope: Scope, expr: tree.Expr, expected: Type | None) -> Expr | None:
        scope.diagnostics.add("E0915", f"{what} is not supported yet.", expr.span)
        return None

    return report


_CHECKERS: Mapping[type, Callable[..., Expr | None]] = {
    tree.Literal: _literal,
    tree.NameExpr: _name,
    tree.TypedEnumValue: _typed_enum_value,
    tree.DirectVariable: _variable,
    tree.MemberExpr: _variable,
    tree.PartExpr: _variable,
    tree.IndexExpr: _variable,
    tree.DerefExpr: _variable,
    tree.RefExpr: _reference,
    tree.CallExpr: _call,
    tree.UnaryExpr: _unary,
    tree.BinaryExpr: _binary,
}
