"""Inlining: a small body stands in place of its call.

On an RP2040 a timer costs 660 cycles as a shared function, and 43 in place. Larger bodies stay functions: code is
scarce too.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

from iec2mpy.ir import Module
from iec2mpy.ir import nodes as n
from iec2mpy.ir.walk import map_block, map_statement_exprs, map_statement_places, statements
from iec2mpy.semantics.typed import Pou

SMALL = 24
"""A body of up to so many statements is always inlined …"""
CALLED_ONCE = 80
"""… and one that is called from one place only, up to this size."""
LARGEST = 1500
"""No body grows beyond this."""


def inline(module: Module) -> Module:
    """The module with small functions and blocks in place of their calls."""
    calls = Counter(s.pou for body in module.bodies.values() for s in statements(body.block) if isinstance(s, n.Call))
    bodies: dict[Pou, n.Body] = {}
    for pou, body in module.bodies.items():
        # callees come first, so what is inlined here has taken in its own callees
        bodies[pou] = _inline_calls(body, bodies, calls)
    return replace(module, bodies=bodies)


def _inline_calls(body: n.Body, done: dict[Pou, n.Body], calls: Counter[Pou]) -> n.Body:
    size = _size(body.block)
    used = body.locals

    def replaced(statement: n.Stmt) -> n.Block:
        nonlocal size, used
        if not isinstance(statement, n.Call) or not _is_plain(statement.instance):
            return (statement,)
        callee = done[statement.pou]
        callee_size = _size(callee.block)
        limit = CALLED_ONCE if calls[statement.pou] == 1 else SMALL
        if callee_size > limit or size + callee_size > LARGEST or _returns_early(callee.block):
            return (statement,)
        size += callee_size
        block = _placed(callee.block, statement, used)
        used += callee.locals
        return block

    block = map_block(body.block, replaced)
    return replace(body, block=block, locals=used)


def _is_plain(instance: n.Place | None) -> bool:
    """An instance that is found without a subscript or reference: else each access would pay for it."""
    if instance is None:
        return True
    return not isinstance(instance.root, n.Deref) and all(isinstance(s, n.Field) for s in instance.steps)


def _size(block: n.Block) -> int:
    return sum(not isinstance(s, n.Line) for s in statements(block))


def _returns_early(block: n.Block) -> bool:
    return any(isinstance(s, n.Return) for s in statements(block))


def _placed(block: n.Block, call: n.Call, first_local: int) -> n.Block:
    """The callee's block with its instance for `Self`, and with locals of its own numbers."""

    def place(old: n.Place) -> n.Place:
        if not isinstance(old.root, n.Self):
            return old
        assert call.instance is not None
        return n.Place(call.instance.root, (*call.instance.steps, *old.steps), old.type)

    def local(expr: n.Expr) -> n.Expr:
        return replace(expr, number=expr.number + first_local) if isinstance(expr, n.Local) else expr

    def statement(old: n.Stmt) -> n.Block:
        new = map_statement_exprs(map_statement_places(old, place), local)
        if isinstance(new, (n.SetLocal, n.Compare)):
            new = replace(new, local=replace(new.local, number=new.local.number + first_local))
        return (new,)

    return map_block(block, statement)
