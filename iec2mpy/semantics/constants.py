"""Constant expressions: what must be known when the program is compiled (6.6.1.2.4)."""

from __future__ import annotations

from iec2mpy.semantics import expressions
from iec2mpy.semantics.coercion import coerce
from iec2mpy.semantics.conversions import UNTYPED_INT, is_integer
from iec2mpy.semantics.scope import Scope
from iec2mpy.semantics.typed import Constant, Expr, Scalar
from iec2mpy.semantics.types import Type
from iec2mpy.source.spans import Span
from iec2mpy.syntax import tree


def integer(scope: Scope, expr: tree.Expr, what: str) -> int | None:
    """The number that `expr` stands for; `what` begins the sentence that says it must be a constant integer."""
    checked = expressions.check(scope, expr)
    if checked is None or not _is_constant(scope, checked, what, expr.span):
        return None
    assert isinstance(checked, Constant)
    if checked.type is UNTYPED_INT or is_integer(checked.type):
        return int(checked.value)
    scope.diagnostics.add("E0301", f"{what} must be an integer.", expr.span)
    return None


def scalar(scope: Scope, expr: tree.Expr, target: Type, what: str) -> Scalar | None:
    """The value of `expr` as one of the type `target`; `what` begins the sentence that says it must be constant."""
    checked = expressions.check(scope, expr, target)
    if checked is None or not _is_constant(scope, checked, what, expr.span):
        return None
    value = coerce(scope, checked, target)
    return value.value if isinstance(value, Constant) else None


def _is_constant(scope: Scope, checked: Expr, what: str, span: Span) -> bool:
    if isinstance(checked, Constant):
        return True
    scope.diagnostics.add(
        "E0505",
        f"{what} must be constant, and this changes while the program runs.",
        span,
        "Write a number, or a variable of VAR CONSTANT.",
    )
    return False
