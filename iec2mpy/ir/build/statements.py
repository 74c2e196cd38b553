"""Statements: each becomes a line marker and what it does."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from iec2mpy.ir import nodes as n
from iec2mpy.ir.build.branches import LONGEST, Branch, keep_in_frame, lower_chain
from iec2mpy.ir.build.calls import call_block, call_function
from iec2mpy.ir.build.context import Context
from iec2mpy.ir.build.controlled import call_standard
from iec2mpy.ir.build.expressions import assign_expr, lower_expr
from iec2mpy.ir.build.loops import lower_for, lower_repeat, lower_while
from iec2mpy.ir.build.splits import lower_split
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
        case t.CallFunction(t.StandardCall() as call):
            call_standard(context, call)
        case t.CallFunction(t.FunctionCall() as call):
            call_function(context, call, None)
        case t.Split():
            lower_split(context, statement)
        case t.CallBlock():
            call_block(context, statement)
        case t.If():
            _lower_if(context, statement)
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


def _lower_if(context: Context, statement: t.If) -> None:
    """Each condition is evaluated only where those before it do not hold."""

    def branch(number: int, condition: t.Expr, body: tuple[t.Stmt, ...]) -> Branch:
        def test() -> n.Expr:
            if number:
                context.line(condition.span)
            return lower_expr(context, condition)

        return test, lambda: lower_block(context, body)

    branches = [branch(number, *parts) for number, parts in enumerate(statement.branches)]
    lower_chain(context, branches, lambda: lower_block(context, statement.otherwise))


def _lower_case(context: Context, statement: t.Case) -> None:
    """A group may change the variable that selected it, so the selector is kept."""
    selector = lower_expr(context, statement.selector)
    selector = context.kept(selector) if len(statement.groups) <= LONGEST else keep_in_frame(context, selector)

    def branch(labels: tuple[tuple[int, int], ...], body: tuple[t.Stmt, ...]) -> Branch:
        return lambda: _any([_label(selector, label) for label in labels]), lambda: lower_block(context, body)

    branches = [branch(labels, body) for labels, body in statement.groups]
    lower_chain(context, branches, lambda: lower_block(context, statement.otherwise))


def _any(conditions: Sequence[n.Expr]) -> n.Expr:
    """Whether one of the conditions holds; in halves, so that many do not make a deep tree."""
    if len(conditions) == 1:
        return conditions[0]
    middle = len(conditions) // 2
    return n.Op("or", _any(conditions[:middle]), _any(conditions[middle:]), ty.BOOL)


def _label(selector: n.Expr, label: tuple[int, int]) -> n.Expr:
    low, high = (n.Const(bound, selector.type) for bound in label)
    if label[0] == label[1]:
        return n.Op("eq", selector, low, ty.BOOL)
    return n.Op("and", n.Op("ge", selector, low, ty.BOOL), n.Op("le", selector, high, ty.BOOL), ty.BOOL)
