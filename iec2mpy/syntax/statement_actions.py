"""Actions of the rules for statements (7.3.3)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from iec2mpy.source.diagnostics import Diagnostics
from iec2mpy.source.dialects import require
from iec2mpy.source.spans import Span
from iec2mpy.syntax import tree
from iec2mpy.syntax.actions import action, over


@dataclass(frozen=True, slots=True)
class _CaseLabel:
    """Labels with their colon, as they stand among the statements of a CASE."""

    labels: tuple[tree.Expr | tree.LabelRange, ...]
    span: Span


@action
def assignment(values: list[Any], _diagnostics: Diagnostics) -> tree.AssignStmt:
    target, _, value, _ = values
    return tree.AssignStmt(target, value, over(target, value))


@action
def latch(values: list[Any], diagnostics: Diagnostics) -> tree.IfStmt:
    """`target S= value` is `IF value THEN target := TRUE; END_IF;`, R= the same with FALSE."""
    target, sign, value, _ = values
    to = sign.text[0].upper() == "S"
    constant = "TRUE" if to else "FALSE"
    instead = f"Write `IF {value.span.text} THEN {target.span.text} := {constant}; END_IF;`."
    message = f"`{sign.text}` is not an operator of the standard."
    require("set-reset-assignment", diagnostics, "E0129", message, sign.span, instead)
    span = over(target, value)
    assigned = tree.AssignStmt(target, tree.Literal("bool", to, None, sign.span), span)
    return tree.IfStmt((tree.Branch(value, (assigned,), span),), None, span)


@action
def assignment_attempt(values: list[Any], _diagnostics: Diagnostics) -> tree.AttemptStmt:
    target, _, value, _ = values
    return tree.AttemptStmt(target, value, over(target, value))


@action
def call_statement(values: list[Any], diagnostics: Diagnostics) -> tree.CallStmt | None:
    expression = values[0]
    if isinstance(expression, tree.CallExpr):
        return tree.CallStmt(expression, expression.span)
    text = expression.span.text
    diagnostics.add(
        "E0120",
        f"`{text}` alone is no statement.",
        expression.span,
        f"Assign to it, `{text} := …;`, or call it, `{text}();`.",
    )
    return None


@action
def exit_statement(values: list[Any], _diagnostics: Diagnostics) -> tree.ExitStmt:
    return tree.ExitStmt(values[0].span)


@action
def continue_statement(values: list[Any], _diagnostics: Diagnostics) -> tree.ContinueStmt:
    return tree.ContinueStmt(values[0].span)


@action
def return_statement(values: list[Any], _diagnostics: Diagnostics) -> tree.ReturnStmt:
    return tree.ReturnStmt(values[0].span)


def _branch(word: Any, condition: tree.Expr, then: Any, statements: list[tree.Stmt]) -> tree.Branch:
    return tree.Branch(condition, tuple(statements), over(word, statements[-1] if statements else then))


def _optional(statements: list[tree.Stmt] | None) -> tuple[tree.Stmt, ...] | None:
    return None if statements is None else tuple(statements)


@action
def if_statement(values: list[Any], _diagnostics: Diagnostics) -> tree.IfStmt:
    word, condition, then, statements, elsifs, otherwise, end, _ = values
    first = _branch(word, condition, then, statements)
    return tree.IfStmt((first, *elsifs), _optional(otherwise), over(word, end))


@action
def elsif(values: list[Any], _diagnostics: Diagnostics) -> tree.Branch:
    return _branch(*values)


@action
def case_label(values: list[Any], _diagnostics: Diagnostics) -> _CaseLabel:
    labels, colon = values
    return _CaseLabel(tuple(labels), over(labels[0], colon) if labels else colon.span)


@action
def label_range(values: list[Any], _diagnostics: Diagnostics) -> tree.LabelRange:
    low, _, high = values
    return tree.LabelRange(low, high, over(low, high))


@action
def case_statement(values: list[Any], diagnostics: Diagnostics) -> tree.CaseStmt:
    word, selector, _, items, otherwise, end, _ = values
    groups: list[tree.CaseGroup] = []
    label: _CaseLabel | None = None
    statements: list[tree.Stmt] = []

    def close() -> None:
        if label is not None:
            groups.append(
                tree.CaseGroup(label.labels, tuple(statements), over(label, statements[-1] if statements else label))
            )

    for item in items:
        if isinstance(item, _CaseLabel):
            close()
            label, statements = item, []
        elif label is None:
            diagnostics.add(
                "E0120",
                "This statement stands before the first label of its CASE.",
                item.span,
                "Write a value and `:` before it.",
            )
        else:
            statements.append(item)
    close()
    if not groups and not diagnostics.has_errors:
        diagnostics.add(
            "E0119", "This CASE has no labels.", over(word, values[2]), "Write at least one value, `:` and statements."
        )
    return tree.CaseStmt(selector, tuple(groups), _optional(otherwise), over(word, end))


@action
def for_statement(values: list[Any], _diagnostics: Diagnostics) -> tree.ForStmt:
    word, control, _, start, _, limit, step, _, statements, end, _ = values
    return tree.ForStmt(control, start, limit, step, tuple(statements), over(word, end))


@action
def while_statement(values: list[Any], _diagnostics: Diagnostics) -> tree.WhileStmt:
    word, condition, _, statements, end, _ = values
    return tree.WhileStmt(condition, tuple(statements), over(word, end))


@action
def repeat_statement(values: list[Any], _diagnostics: Diagnostics) -> tree.RepeatStmt:
    word, statements, _, until, end, _ = values
    return tree.RepeatStmt(tuple(statements), until, over(word, end))
