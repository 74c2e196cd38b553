"""Passes over the IR: each a small function, in the order in which they run; the verifier looks at every result."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from iec2mpy.ir import Module
from iec2mpy.ir import nodes as n
from iec2mpy.ir.verifier import verify
from iec2mpy.passes.dead import remove_dead
from iec2mpy.passes.fold import fold
from iec2mpy.passes.inline import inline
from iec2mpy.passes.ranges import narrow

BODY_PASSES: tuple[Callable[[n.Body], n.Body], ...] = (fold, narrow, fold, remove_dead)
"""What is done to each body, before it is inlined and after others were inlined into it."""


def run(module: Module) -> Module:
    """The module, better: the same meaning, less work."""
    verify(module)
    return _each_body(inline(_each_body(module)))


def _each_body(module: Module) -> Module:
    for rewrite in BODY_PASSES:
        module = replace(module, bodies={pou: rewrite(body) for pou, body in module.bodies.items()})
        verify(module)
    return module
