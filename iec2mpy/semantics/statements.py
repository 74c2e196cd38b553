"""Statements (7.3.3)."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from iec2mpy.semantics import calls
from iec2mpy.semantics.case_labels import check_case
from iec2mpy.semantics.coercion import coerce, describe
from iec2mpy.semantics.conversions import is_integer
from iec2mpy.semantics.expressions import check
from iec2mpy.semantics.references import Use, reference
from iec2mpy.semantics.scope import Scope
from iec2mpy.semantics.typed import (
    Assign,
    Constant,
    Continue,
    Exit,
    Expr,
    For,
    If,
    Repeat,
    Return,
    Stmt,
    VariableRef,
    While,
)
from iec2mpy.semantics.types import BOOL, EnumType, RefType, base_type
from iec2mpy.source.spans import Span
from iec2mpy.syntax import tree

_LEAVING = (Return, Exit, Continue)


def check_body(scope: Scope, body: Sequence[tree.Stmt]) -> tuple[Stmt, ...]:
    """The statements, checked; those that are wrong are reported and left out."""
    checked: list[Stmt] = []
    for number, statement in enumerate(body):
        result = _CHECKERS[type(statement)](scope, statement)
        if result is not None:
            checked.append(result)
        if isinstance(result, _LEAVING) and number + 1 < len(body):
            scope.diagnostics.add(
                "W0602",
                f"This is never reached: {statement.span.text.rstrip(';').upper()} comes before it.",
                body[number + 1].span,
            )
    return tuple(checked)


def _assign(scope: Scope, statement: tree.AssignStmt) -> Stmt | None:
    target = reference(scope, statement.target, Use.WRITE)
    value = check(scope, statement.value, target.type if target is not None else None)
    if target is None or value is None:
        return None
    converted = coerce(scope, value, target.type, "E0301", f"`{statement.target.span.text}` is {target.type}")
    return converted and Assign(target, converted, statement.span)


def _attempt(scope: Scope, statement: tree.AttemptStmt) -> Stmt | None:
    """`target ?= value` (6.6.6.7): between references of one type it is an assignment. Others would need an instance of
    a derived type, and there is no EXTENDS yet."""
    target = reference(scope, statement.target, Use.WRITE)
    value = check(scope, statement.value, target.type if target is not None else None)
    if target is None or value is None:
        return None
    for side in (target, value):
        if not isinstance(side.type, RefType):
            scope.diagnostics.add(
                "E0316",
                f"`?=` is for references, but this is {describe(side.type)}.",
                side.span,
                "Write := to assign a value.",
            )
            return None
    converted = coerce(scope, value, target.type, "E0301", f"`{statement.target.span.text}` is {target.type}")
    return converted and Assign(target, converted, statement.span)


def _call(scope: Scope, statement: tree.CallStmt) -> Stmt | None:
    return calls.as_statement(scope, statement.call)


def condition(scope: Scope, expr: tree.Expr, keyword: str) -> Expr | None:
    """A BOOL expression; `keyword` names the statement that needs it."""
    value = check(scope, expr, BOOL)
    return value and coerce(scope, value, BOOL, "E0304", f"{keyword} needs a BOOL")


def _if(scope: Scope, statement: tree.IfStmt) -> Stmt | None:
    branches: list[tuple[Expr, tuple[Stmt, ...]]] = []
    for number, branch in enumerate(statement.branches):
        test = condition(scope, branch.condition, "ELSIF" if number else "IF")
        body = check_body(scope, branch.body)
        if test is not None:
            branches.append((test, body))
    otherwise = check_body(scope, statement.otherwise or ())
    return If(tuple(branches), otherwise, statement.span) if len(branches) == len(statement.branches) else None


def _case(scope: Scope, statement: tree.CaseStmt) -> Stmt | None:
    return check_case(scope, statement, check_body)


# ---------------------------------------------------------------------------------------------------- loops


def _for(scope: Scope, statement: tree.ForStmt) -> Stmt | None:
    control = _control_variable(scope, statement.control)
    bounds = [_bound(scope, expr, control) for expr in (statement.start, statement.end)]
    step = _step(scope, statement, control)
    if control is None:
        _loop_body(scope, statement.body)
        return None
    assert isinstance(statement.control, tree.NameExpr)
    variable = scope.locals[statement.control.name.casefold()]
    outer = scope.controls
    scope.controls = {**outer, variable: statement.control.span}
    body = _loop_body(scope, statement.body)
    scope.controls = outer
    start, end = bounds
    if start is None or end is None or step is None:
        return None
    return For(control, start, end, step, body, statement.span)


def _control_variable(scope: Scope, expr: tree.Expr) -> Expr | None:
    control = reference(scope, expr, Use.WRITE)
    if control is None:
        return None
    if not isinstance(control, VariableRef):
        scope.diagnostics.add(
            "E0309", "The control variable of FOR must be a variable of its own, not a part of one.", expr.span
        )
        return None
    if not is_integer(control.type) or isinstance(control.type, EnumType):
        scope.diagnostics.add(
            "E0309",
            f"The control variable of FOR must be an integer, but this is {describe(control.type)}.",
            expr.span,
            "Count with an INT, and calculate from it in the body.",
        )
        return None
    return control


def _bound(scope: Scope, expr: tree.Expr, control: Expr | None) -> Expr | None:
    t = base_type(control.type) if control is not None else None
    value = check(scope, expr, t)
    if value is None or t is None:
        return None
    return coerce(scope, value, t, "E0309", f"The control variable of this FOR is {t}")


def _step(scope: Scope, statement: tree.ForStmt, control: Expr | None) -> Expr | None:
    if statement.step is None:
        return Constant(1, base_type(control.type), statement.control.span) if control is not None else None
    step = _bound(scope, statement.step, control)
    if isinstance(step, Constant) and step.value == 0:
        scope.diagnostics.add("E0510", "A step of 0 never reaches the end.", step.span)
        return None
    return step


def _loop_body(scope: Scope, body: Sequence[tree.Stmt]) -> tuple[Stmt, ...]:
    scope.loops += 1
    checked = check_body(scope, body)
    scope.loops -= 1
    return checked


def _while(scope: Scope, statement: tree.WhileStmt) -> Stmt | None:
    test = condition(scope, statement.condition, "WHILE")
    body = _loop_body(scope, statement.body)
    return test and While(test, body, statement.span)


def _repeat(scope: Scope, statement: tree.RepeatStmt) -> Stmt | None:
    body = _loop_body(scope, statement.body)
    test = condition(scope, statement.until, "UNTIL")
    return test and Repeat(body, test, statement.span)


def _in_loop(scope: Scope, span: Span, keyword: str) -> bool:
    if scope.loops:
        return True
    hint = "RETURN leaves the whole POU." if keyword == "EXIT" else None
    scope.diagnostics.add("E0601", f"{keyword} stands outside of any loop.", span, hint)
    return False


def _exit(scope: Scope, statement: tree.ExitStmt) -> Stmt | None:
    return Exit(statement.span) if _in_loop(scope, statement.span, "EXIT") else None


def _continue(scope: Scope, statement: tree.ContinueStmt) -> Stmt | None:
    return Continue(statement.span) if _in_loop(scope, statement.span, "CONTINUE") else None


def _return(scope: Scope, statement: tree.ReturnStmt) -> Stmt | None:
    return Return(statement.span)


_CHECKERS: Mapping[type, Callable[..., Stmt | None]] = {
    tree.AssignStmt: _assign,
    tree.AttemptStmt: _attempt,
    tree.CallStmt: _call,
    tree.IfStmt: _if,
    tree.CaseStmt: _case,
    tree.ForStmt: _for,
    tree.WhileStmt: _while,
    tree.RepeatStmt: _repeat,
    tree.ExitStmt: _exit,
    tree.ContinueStmt: _continue,
    tree.ReturnStmt: _return,
}
