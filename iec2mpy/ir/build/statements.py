"""Statements: each becomes a line marker and what it does."""

from __future__ import annotations

from collections.abc import Iterable

from iec2mpy.ir import nodes as n
from iec2mpy.ir.build.calls import call_block, call_function
from iec2mpy.ir.build.context import Context
from iec2mpy.ir.build.expressions import assign_expr, lower_expr
from iec2mpy.ir.build.loops import lower_for, lower_repeat, lower_while
from iec2mpy.semantics import typed as t
from iec2mpy.semantics import types as ty


def lower_block(context: Context, statements: Iterable[t.Stmt]) -> None:
    for statement in statements:
        context.line(statement.span)
        _lower(context, statement)


def _lower(context: Context, statement: t.Stmt) -> None:
    match statement:
        case t.Assign(target, value):
            assign_expr(context, target, value)
        case t.CallFunction(call):
            call_function(context, call)
        case t.CallBlock():
            call_block(context, statement)
        case t.If(branches, otherwise):
            _lower_if(context, branches, otherwise)
        case t.Case():
            _lower_case(context, statement)
        case t.For():
            lower_for(context, statement, lower_block)
        case t.While():
            lower_while(context, statement, lower_block)
        case t.Repeat():
            lower_repeat(context, statement, lower_block)
        case t.Exit():
            context.emit(n.Break())
        case t.Continue():
            context.emit(n.Next())
        case t.Return():
            context.emit(n.Return())


def _lower_if(
    context: Context, branches: tuple[tuple[t.Expr, tuple[t.Stmt, ...]], ...], otherwise: tuple[t.Stmt, ...]
) -> None:
    """An ELSIF stands in the ELSE of what comes before it: its condition is evaluated only there."""
    (condition, body), *rest = branches
    value = lower_expr(context, condition)
    with context.block() as then:
        lower_block(context, body)
    with context.block() as other:
        if rest:
            context.line(rest[0][0].span)
            _lower_if(context, tuple(rest), otherwise)
        else:
            lower_block(context, otherwise)
    context.emit(n.If(value, tuple(then), tuple(other)))


def _lower_case(context: Context, statement: t.Case) -> None:
    selector = context.atom(lower_expr(context, statement.selector))
    if not isinstance(selector, (n.Const, n.Local)):
        # a group may change the variable that selected it
        selector = context.spill(selector)
    _lower_groups(context, selector, statement.groups, statement.otherwise)


def _lower_groups(
    context: Context,
    selector: n.Expr,
    groups: tuple[tuple[tuple[tuple[int, int], ...], tuple[t.Stmt, ...]], ...],
    otherwise: tuple[t.Stmt, ...],
) -> None:
    if not groups:
        lower_block(context, otherwise)
        return
    (labels, body), *rest = groups
    condition = _label(selector, labels[0])
    for label in labels[1:]:
        condition = n.Op("or", condition, _label(selector, label), ty.BOOL)
    with context.block() as then:
        lower_block(context, body)
    with context.block() as other:
        _lower_groups(context, selector, tuple(rest), otherwise)
    context.emit(n.If(condition, tuple(then), tuple(other)))


def _label(selector: n.Expr, label: tuple[int, int]) -> n.Expr:
    low, high = (n.Const(bound, selector.type) for bound in label)
    if label[0] == label[1]:
        return n.Op("eq", selector, low, ty.BOOL)
    return n.Op("and", n.Op("ge", selector, low, ty.BOOL), n.Op("le", selector, high, ty.BOOL), ty.BOOL)
