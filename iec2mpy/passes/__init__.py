"""Passes over the IR: each a small function, in the order in which they run. The verifier looks at what they make."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from iec2mpy.ir import Module
from iec2mpy.ir import nodes as n
from iec2mpy.ir.verifier import verify
from iec2mpy.ir.walk import reached
from iec2mpy.passes.dead import remove_dead
from iec2mpy.passes.fold import fold
from iec2mpy.passes.inline import inline
from iec2mpy.passes.ranges import narrow
from iec2mpy.semantics.typed import Pou

BODY_PASSES: tuple[Callable[[n.Body], n.Body], ...] = (fold, narrow, fold, remove_dead)
"""What is done to each body, before it is inlined and after others were inlined into it."""


def run(module: Module) -> Module:
    """The module, better: the same meaning, less work."""
    verify(module)
    module = _improved(module, set(module.bodies))
    before = module.bodies
    module = inline(module)
    # what was only inlined is not generated, and what took nothing in is as good as before
    module = _improved(module, {b.pou for b in reached(module) if b is not before[b.pou]})
    verify(module)
    return module


def improve(body: n.Body) -> n.Body:
    """One body, by all the passes that look at no other."""
    for rewrite in BODY_PASSES:
        body = rewrite(body)
    return body


def _improved(module: Module, chosen: set[Pou]) -> Module:
    return replace(
        module, bodies={pou: improve(body) if pou in chosen else body for pou, body in module.bodies.items()}
    )
