"""Dead code: statements that can never run, branches that are never taken, locals that nobody reads."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

from iec2mpy.ir import nodes as n
from iec2mpy.ir.walk import expressions, map_block, may_fault, set_local, statements


def remove_dead(body: n.Body) -> n.Body:
    """The body without what has no effect. A value that may fault counts as an effect."""
    block = _cut(map_block(body.block, _reduce))
    while (smaller := _without_unread(block)) != block:
        block = smaller
    return replace(body, block=block)


def _without_unread(block: n.Block) -> n.Block:
    """The block without locals that nothing reads; the next time, those that only they have read are unread too."""
    reads = Counter(e.number for s in statements(block) for e in expressions(s) if isinstance(e, n.Local))
    return map_block(block, lambda s: () if _is_unread(s, reads) else (s,))


def _reduce(statement: n.Stmt) -> n.Block:
    match statement:
        case n.If(n.Const() as condition, then, otherwise):
            return _cut(then if condition.value else otherwise)
        case n.If(condition, then, otherwise):
            then, otherwise = _cut(then), _cut(otherwise)
            if not _has_code(then) and not _has_code(otherwise) and not may_fault(condition):
                return ()
            return (n.If(condition, then, otherwise),)
        case n.Try(body):
            return (n.Try(_cut(body)),) if _may_be_caught(body) else _cut(body)
        case n.While(n.Const() as condition) if not condition.value:
            return ()
        case n.While(condition, body):
            return (n.While(condition, _cut(body)),)
        case n.Guard(n.Const() as condition) if not condition.value:
            return ()
        case _:
            return (statement,)


def _cut(block: n.Block) -> n.Block:
    """The block up to the first statement that leaves it."""
    for position, statement in enumerate(block):
        if isinstance(statement, (n.Return, n.Break, n.Next)):
            return block[: position + 1]
    return block


def _is_unread(statement: n.Stmt, reads: Counter[int]) -> bool:
    local = set_local(statement)
    if local is None or reads[local.number]:
        return False
    return not (isinstance(statement, n.SetLocal) and may_fault(statement.value))


def _may_be_caught(block: n.Block) -> bool:
    """Whether a fault may be raised in the block that `Try` catches."""
    return any(
        isinstance(s, (n.Call, n.Guard)) or any(may_fault(expr) for expr in expressions(s)) for s in statements(block)
    )


def _has_code(block: n.Block) -> bool:
    return any(not isinstance(s, n.Line) for s in block)
