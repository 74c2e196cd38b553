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
from iec2mpy.passes.returns import without_returns
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
    inlined = False

    def in_block(block: n.Block) -> n.Block:
        nonlocal size, used, inlined
        result: list[n.Stmt] = []
        for statement in block:
            match statement:
                case n.If(condition, then, otherwise):
                    result.append(n.If(condition, in_block(then), in_block(otherwise)))
                case n.Try(inner):
                    result.append(n.Try(in_block(inner)))
                case n.While(condition, inner):
                    result.append(n.While(condition, in_block(inner)))
                case n.Call(pou) if (code := _code_of(done[pou], statement, calls, LARGEST - size)) is not None:
                    inlined = True
                    size += _size(code)
                    result += _placed(code, statement, used, _taken_bindings(result, statement))
                    used += done[pou].locals
                case _:
                    result.append(statement)
        return tuple(result)

    block = in_block(body.block)
    return replace(body, block=block, locals=used) if inlined else body


def _code_of(callee: n.Body, call: n.Call, calls: Counter[Pou], room: int) -> n.Block | None:
    """What can stand in place of the call, or None."""
    limit = min(CALLED_ONCE if calls[call.pou] == 1 else SMALL, room)
    return without_returns(callee.block) if _is_plain(call.instance) and _size(callee.block) <= limit else None


def _taken_bindings(before: list[n.Stmt], call: n.Call) -> dict[n.Place, n.Place]:
    """What the in-outs of a call stand for, by the places of their references. Those that stand for a plain place are
    taken out of what comes before the call: the code in its place names that itself."""
    root, steps = (call.instance.root, call.instance.steps) if call.instance else (n.Frame(call.pou), ())
    in_outs = [v for v in call.pou.parameters if v.by_reference]
    own = {n.Place(root, (*steps, n.Field(v)), n.storage_type(v)) for v in in_outs}
    found: dict[n.Place, n.Place] = {}
    position = len(before)
    while len(found) < len(own):
        # a call is given all of its in-outs, just before it
        position -= 1
        statement = before[position]
        if isinstance(statement, n.Bind) and statement.reference in own:
            found[statement.reference] = statement.target
            if _is_direct(statement.target):
                del before[position]
    return {reference: target for reference, target in found.items() if _is_direct(target)}


def _is_direct(target: n.Place) -> bool:
    """Whether using the place costs no more than following a reference. (Its subscripts are constants or locals.)"""
    return not (isinstance(target.root, n.Deref) and target.steps)


def _is_plain(instance: n.Place | None) -> bool:
    """An instance that is found without a subscript or reference: else each access would pay for it."""
    if instance is None:
        return True
    return not isinstance(instance.root, n.Deref) and all(isinstance(s, n.Field) for s in instance.steps)


def _size(block: n.Block) -> int:
    return sum(not isinstance(s, n.Line) for s in statements(block))


def _placed(block: n.Block, call: n.Call, first_local: int, bindings: dict[n.Place, n.Place]) -> n.Block:
    """The callee's block with its instance for `Self`, with what its in-outs stand for, and with locals of its own
    numbers."""

    def place(old: n.Place) -> n.Place:
        if isinstance(old.root, n.Deref):
            reference = old.root.reference
            target = bindings.get(reference.place) if isinstance(reference, n.Load) else None
            return n.Place(target.root, (*target.steps, *old.steps), old.type) if target is not None else old
        if not isinstance(old.root, n.Self):
            return old
        assert call.instance is not None
        return n.Place(call.instance.root, (*call.instance.steps, *old.steps), old.type)

    def local(expr: n.Expr) -> n.Expr:
        return replace(expr, number=expr.number + first_local) if isinstance(expr, n.Local) else expr

    def statement(old: n.Stmt) -> n.Block:
        # places last: the locals in what an in-out stands for are those of the body around
        new = map_statement_places(map_statement_exprs(old, local), place)
        if isinstance(new, (n.SetLocal, n.Compare)):
            new = replace(new, local=replace(new.local, number=new.local.number + first_local))
        return (new,)

    return map_block(block, statement)
