"""RETURN in the middle of a body becomes ELSE: such a body can stand in place of its call."""

from __future__ import annotations

from iec2mpy.ir import nodes as n
from iec2mpy.ir.walk import statements


def without_returns(block: n.Block) -> n.Block | None:
    """The block without RETURN, or None where code would have to be doubled, or a loop be left."""
    for position, statement in enumerate(block):
        if isinstance(statement, n.Return):
            return block[:position]
        if not _has_return((statement,)):
            continue
        if not isinstance(statement, n.If):
            return None
        rest = block[position + 1 :]
        if _always_returns(statement.then):
            then, otherwise = statement.then, (*statement.otherwise, *rest)
        elif _always_returns(statement.otherwise):
            then, otherwise = (*statement.then, *rest), statement.otherwise
        else:
            return None
        new_then, new_otherwise = without_returns(then), without_returns(otherwise)
        if new_then is None or new_otherwise is None:
            return None
        return (*block[:position], n.If(statement.condition, new_then, new_otherwise))
    return block


def _has_return(block: n.Block) -> bool:
    return any(isinstance(statement, n.Return) for statement in statements(block))


def _always_returns(block: n.Block) -> bool:
    """Whether every way through the block comes to a RETURN."""
    return any(
        isinstance(s, n.Return) or (isinstance(s, n.If) and _always_returns(s.then) and _always_returns(s.otherwise))
        for s in block
    )
