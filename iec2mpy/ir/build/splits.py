"""SPLIT_DATE and its like: a call with several outputs, and without a body (table 36, 5 to 7)."""

from __future__ import annotations

from iec2mpy.ir import nodes as n
from iec2mpy.ir.build.context import Context
from iec2mpy.ir.build.controlled import Stages, emit_call, preset
from iec2mpy.ir.build.expressions import assign_expr, lower_expr, stored_type
from iec2mpy.ir.build.moments import parts
from iec2mpy.semantics import typed as t


def lower_split(context: Context, split: t.Split) -> None:
    """The operand is worked out once, before its parts are stored: it may be one of the variables that they go to."""
    operand: list[n.Expr] = []
    names = [output.parameter.name for output in split.outputs]
    known: dict[t.Variable, n.Expr] = {}

    def prepare() -> None:
        operand.append(context.kept(lower_expr(context, split.operand)))
        if split.control is not None:
            for output in split.outputs:
                known[output.parameter] = preset(context, stored_type(output.parameter.type))

    def run() -> None:
        values = parts(context, operand[0], names)
        for output, value in zip(split.outputs, values, strict=True):
            local = known.get(output.parameter)
            if isinstance(local, n.Local):
                context.emit(n.SetLocal(local, value))
            else:
                known[output.parameter] = context.kept(value)

    def finish() -> None:
        with context.known(known):
            for output in split.outputs:
                assign_expr(context, output.target, output.value)

    emit_call(context, split.control, None, Stages(prepare, run, lambda: None, finish))
