"""Large bodies in parts: a viper function of some 600 statements has hung an RP2350."""

from __future__ import annotations

from iec2mpy.ir import nodes as n
from iec2mpy.ir.walk import expressions, set_local, statements

MAX_STATEMENTS = 250


def split(body: n.Body) -> list[n.Block]:
    """The body's block, or several that do the same one after the other.

    Cuts stand between statements of the body itself, where no local is in use; one that may return early stays whole.
    """
    if _count(body.block) <= MAX_STATEMENTS or any(isinstance(s, n.Return) for s in statements(body.block)):
        return [body.block]
    last_use = _last_uses(body.block)
    parts: list[n.Block] = []
    part: list[n.Stmt] = []
    size = 0
    live_until = -1
    for position, statement in enumerate(body.block):
        count = _count((statement,))
        if part and live_until < position and size + count > MAX_STATEMENTS and isinstance(statement, n.Line):
            parts.append(tuple(part))
            part, size = [], 0
        part.append(statement)
        size += count
        live_until = max([live_until, *(last_use[local] for local in _locals(statement))])
    return [*parts, tuple(part)]


def _count(block: n.Block) -> int:
    return sum(not isinstance(s, n.Line) for s in statements(block))


def _locals(statement: n.Stmt) -> set[int]:
    """The locals that a statement, or what is inside of it, sets or reads."""
    found: set[int] = set()
    for inner in statements((statement,)):
        if (local := set_local(inner)) is not None:
            found.add(local.number)
        found |= {e.number for e in expressions(inner) if isinstance(e, n.Local)}
    return found


def _last_uses(block: n.Block) -> dict[int, int]:
    """The position of the last statement of the block that uses each local."""
    return {local: position for position, statement in enumerate(block) for local in _locals(statement)}
