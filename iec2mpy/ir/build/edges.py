"""Inputs with an edge: each is worked out once an execution, before the body (6.6.3.5.3)."""

from __future__ import annotations

from iec2mpy.ir import nodes as n
from iec2mpy.ir.build.context import Context
from iec2mpy.ir.build.places import storage_place
from iec2mpy.semantics import types as ty
from iec2mpy.semantics.typed import EdgeInput
from iec2mpy.syntax.tree import Edge


def find_edge(context: Context, edge: EdgeInput) -> None:
    """Does what a hidden R_TRIG or F_TRIG does, executed with the input; what the body reads is the trigger's Q. The
    input itself keeps its value: a call that does not give it leaves it as it is."""
    level: n.Expr = n.Load(storage_place(edge.input), ty.BOOL)
    if edge.edge is Edge.FALLING:
        level = n.Not(level, ty.BOOL)
    memory = storage_place(edge.memory)
    seen = context.new_hidden(ty.BOOL)
    context.emit(n.Store(seen, n.Op("and", level, n.Not(n.Load(memory, ty.BOOL), ty.BOOL), ty.BOOL)))
    context.emit(n.Store(memory, level))
    context.edges[edge.input] = seen
