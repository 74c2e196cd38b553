"""CASE: its selector and its labels (7.3.3.3)."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from iec2mpy.semantics.coercion import coerce, describe, typed_literal
from iec2mpy.semantics.conversions import INTEGER_KINDS
from iec2mpy.semantics.expressions import check
from iec2mpy.semantics.scope import Scope
from iec2mpy.semantics.typed import Case, Constant, Expr, Stmt
from iec2mpy.semantics.types import ElementaryType, EnumType, Kind, Type, base_type
from iec2mpy.source.diagnostics import Related
from iec2mpy.source.spans import Span
from iec2mpy.syntax import tree

Label = tuple[int, int]
"""First and last number that a label selects."""


def check_case(
    scope: Scope, statement: tree.CaseStmt, check_body: Callable[[Scope, Sequence[tree.Stmt]], tuple[Stmt, ...]]
) -> Case | None:
    """The checked CASE; labels that overlap earlier ones give a warning, as the first group that matches runs."""
    selector = _selector(scope, statement.selector)
    groups: list[tuple[tuple[Label, ...], tuple[Stmt, ...]]] = []
    seen: list[tuple[Label, Span]] = []
    correct = True
    for group in statement.groups:
        labels: list[Label] = []
        for written in group.labels if selector is not None else ():
            label = _label(scope, written, selector.type) if selector is not None else None
            if label is None:
                correct = False
                continue
            _warn_of_overlap(scope, label, written.span, seen)
            seen.append((label, written.span))
            labels.append(label)
        groups.append((tuple(labels), check_body(scope, group.body)))
    otherwise = check_body(scope, statement.otherwise or ())
    if selector is None or not correct:
        return None
    return Case(selector, tuple(groups), otherwise, statement.span)


def _selector(scope: Scope, expr: tree.Expr) -> Expr | None:
    value = check(scope, expr)
    if value is None:
        return None
    t = base_type(value.type)
    if isinstance(t, EnumType) or (isinstance(t, ElementaryType) and t.kind in INTEGER_KINDS | {Kind.BITS}):
        return typed_literal(scope, value)
    scope.diagnostics.add(
        "E0308",
        f"CASE needs an integer, a bit string or an enumeration, but this is {describe(value.type)}.",
        expr.span,
        "Use IF and ELSIF.",
    )
    return None


def _label(scope: Scope, written: tree.Expr | tree.LabelRange, selector: Type) -> Label | None:
    if not isinstance(written, tree.LabelRange):
        value = _number(scope, written, selector)
        return None if value is None else (value, value)
    low, high = _number(scope, written.low, selector), _number(scope, written.high, selector)
    if low is None or high is None:
        return None
    if low > high:
        scope.diagnostics.add(
            "E0506", f"The limits {low}..{high} hold no value.", written.span, "Write the smaller limit first."
        )
        return None
    return low, high


def _number(scope: Scope, expr: tree.Expr, selector: Type) -> int | None:
    value = check(scope, expr, selector)
    if value is None:
        return None
    if not isinstance(value, Constant):
        scope.diagnostics.add(
            "E0505", "A label of CASE must be constant.", expr.span, "Compare variables with IF and ELSIF."
        )
        return None
    t = base_type(selector)
    label = coerce(scope, value, t, "E0308", f"The labels of this CASE are {t}")
    return int(label.value) if isinstance(label, Constant) else None


def _warn_of_overlap(scope: Scope, label: Label, span: Span, seen: list[tuple[Label, Span]]) -> None:
    for (low, high), first in seen:
        if label[0] <= high and low <= label[1]:
            scope.diagnostics.add(
                "W0601",
                f"The label {span.text} overlaps {first.text} above, whose statements run.",
                span,
                None,
                [Related(first, f"{first.text} is here.")],
            )
            return
