"""Takes out of a tree what could not be read whole, so that no later stage judges what stands in its place."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from iec2mpy.source.spans import Span
from iec2mpy.syntax import tree
from iec2mpy.syntax.tokens import Token

_VALUES = frozenset({"LITERAL", "INTEGER", "DIRECT"})


def holes(tokens: Sequence[Token]) -> list[int]:
    """Where something stands for what could not be read: ERROR tokens and malformed literals."""
    return [token.start for token in tokens if token.type == "ERROR" or (token.bad and token.type in _VALUES)]


def prune(value: Any, at: Sequence[int]) -> Any:
    """What a part of a file was read as, without the declarations and statements that have a hole.

    `at`: the offsets of the holes, in rising order.
    """
    if isinstance(value, list):
        return list(_whole(value, at))
    if isinstance(value, tree.VarSection):
        return replace(value, declarations=_whole(value.declarations, at))
    if isinstance(value, tree.ConfigurationDecl) and _inside(value.span, at):
        return None
    return value


def _inside(span: Span, at: Sequence[int]) -> Sequence[int]:
    return at[bisect_left(at, span.start) : bisect_right(at, span.end)]


def _whole(nodes: Sequence[Any], at: Sequence[int]) -> tuple[Any, ...]:
    """Declarations or statements without those that have a hole; one that has it in an inner statement stays."""
    kept: list[Any] = []
    for node in nodes:
        found = _inside(node.span, at)
        if not found:
            kept.append(node)
        elif sum(len(_inside(inner.span, found)) for inner in _inner(node)) >= len(found):
            kept.append(_with_pruned_bodies(node, found))
    return tuple(kept)


def _inner(statement: Any) -> tuple[Any, ...]:
    """The statements directly inside of one."""
    match statement:
        case tree.IfStmt(branches, otherwise):
            return (*(inner for branch in branches for inner in branch.body), *(otherwise or ()))
        case tree.CaseStmt(_, groups, otherwise):
            return (*(inner for group in groups for inner in group.body), *(otherwise or ()))
        case tree.ForStmt() | tree.WhileStmt() | tree.RepeatStmt():
            return statement.body
    return ()


def _with_pruned_bodies(statement: Any, at: Sequence[int]) -> Any:
    if isinstance(statement, tree.IfStmt):
        branches = tuple(replace(branch, body=_whole(branch.body, at)) for branch in statement.branches)
        return replace(statement, branches=branches, otherwise=_optional(statement.otherwise, at))
    if isinstance(statement, tree.CaseStmt):
        groups = tuple(replace(group, body=_whole(group.body, at)) for group in statement.groups)
        return replace(statement, groups=groups, otherwise=_optional(statement.otherwise, at))
    return replace(statement, body=_whole(statement.body, at))


def _optional(statements: Sequence[Any] | None, at: Sequence[int]) -> tuple[Any, ...] | None:
    return None if statements is None else _whole(statements, at)
