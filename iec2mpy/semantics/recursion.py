"""Cycles of calls: a POU that calls itself, directly or through others, is an error (6.6.1.1)."""

from __future__ import annotations

from iec2mpy.semantics.scope import GlobalScope
from iec2mpy.semantics.typed import Pou
from iec2mpy.source.spans import Span


def report_recursion(world: GlobalScope) -> None:
    """Report each call that closes a cycle."""
    calls = {scope.pou: scope.calls for scope in world.scopes.values() if scope.pou is not None}
    done: set[Pou] = set()
    for start in calls:
        if start not in done:
            _visit(world, calls, start, done)


def _visit(world: GlobalScope, calls: dict[Pou, dict[Pou, Span]], start: Pou, done: set[Pou]) -> None:
    """A walk along the calls; the path is kept in a list, as chains may be deeper than Python's stack."""
    path, pending = [start], [iter(calls[start].items())]
    while path:
        step = next(pending[-1], None)
        if step is None:
            done.add(path.pop())
            pending.pop()
            continue
        callee, span = step
        if callee in path:
            through = [f"`{pou.name}`" for pou in path[path.index(callee) + 1 :]]
            by = f" through {', '.join(through)}" if through else ""
            world.diagnostics.add(
                "E0410",
                f"`{callee.name}` calls itself{by}.",
                span,
                "Use a loop: a controller has no stack for such calls.",
            )
        elif callee not in done and callee in calls:
            path.append(callee)
            pending.append(iter(calls[callee].items()))
