"""Calls with EN and ENO (6.6.1.5).

EN is evaluated first. Where it is FALSE, nothing else of the call takes place. Arguments belong to the caller: a fault
in one of them goes on outward. With ENO, a fault in what is called ends the call, and what it would give is not copied.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from iec2mpy.ir import nodes as n
from iec2mpy.ir.build import expressions
from iec2mpy.ir.build.context import FALSE, TRUE, Context
from iec2mpy.ir.build.string_checks import check_positions
from iec2mpy.ir.walk import may_fault
from iec2mpy.semantics import typed as t
from iec2mpy.semantics import types as ty
from iec2mpy.semantics.defaults import default_value

Emit = Callable[[], None]


@dataclass(frozen=True, slots=True)
class Stages:
    """What a call emits: `prepare` passes the arguments, `run` is what may fault, `leave` follows however that ended,
    and `finish`, which copies results and outputs, only where it came to its end."""

    prepare: Emit
    run: Emit
    leave: Emit
    finish: Emit


def emit_call(context: Context, control: t.Control | None, eno: n.Place | None, stages: Stages) -> n.Local | None:
    """Emits a call; gives whether it came to its end, or None for one without EN and ENO. `eno` is where the callee's
    own ENO is, if it has one."""
    if control is None:
        for stage in (stages.prepare, stages.run, stages.leave, stages.finish):
            stage()
        return None
    return _controlled(context, control, eno, stages)


def _controlled(context: Context, control: t.Control, eno: n.Place | None, stages: Stages) -> n.Local:
    enable = expressions.lower_expr(context, control.enable) if control.enable is not None else TRUE
    done = context.new_local(ty.BOOL, 0, 1)
    success = done if eno is None else context.new_local(ty.BOOL, 0, 1)
    context.emit(n.SetLocal(done, FALSE))
    if eno is not None:
        context.emit(n.SetLocal(success, FALSE))
    with context.block() as enabled:
        stages.prepare()
        with context.block() as tried:
            stages.run()
            if eno is not None:
                context.emit(n.SetLocal(success, n.Load(eno, ty.BOOL)))
            context.emit(n.SetLocal(done, TRUE))
        for statement in tried if control.eno is None else (n.Try(tuple(tried)),):
            context.emit(statement)
        stages.leave()
        with context.block() as copies:
            stages.finish()
        if copies:
            context.emit(n.If(done, tuple(copies), ()))
    for statement in enabled if control.enable is None else (n.If(enable, tuple(enabled), ()),):
        context.emit(statement)
    if eno is not None and not isinstance(eno.root, n.Frame):
        # the instance shows it also where the body did not run, or did not come to its end
        context.emit(n.Store(eno, success))
    if control.eno is not None:
        with context.known({control.eno.parameter: success}):
            expressions.assign_expr(context, control.eno.target, control.eno.value)
    return done


def preset(context: Context, value_type: n.ValueType) -> n.Local:
    """A local for the result of a call that may not come to its end."""
    value = context.new_local(value_type)
    initial = default_value(value_type)
    assert isinstance(initial, (int, float, str))
    context.emit(n.SetLocal(value, n.Const(initial, value_type)))
    return value


def call_standard(context: Context, call: t.StandardCall) -> tuple[n.Local, n.Local]:
    """A standard function: its result, and whether it has one."""
    value = preset(context, expressions.stored_type(call.type))
    known: dict[t.Variable, n.Expr] = {}

    def prepare() -> None:
        values = expressions.lower_all(context, tuple(argument for _, argument in call.arguments))
        for (variable, _), argument in zip(call.arguments, values, strict=True):
            known[variable] = context.spill(argument) if may_fault(argument) else context.atom(argument)

    def run() -> None:
        with context.known(known):
            if call.control.eno is not None and isinstance(call.call, t.BuiltinCall):
                arguments = expressions.lower_all(context, call.call.arguments)
                check_positions(context, call.call.name, arguments)
            context.emit(n.SetLocal(value, expressions.lower_expr(context, call.call)))

    stages = Stages(prepare, run, _nothing, _nothing)
    return value, _controlled(context, call.control, None, stages)


def _nothing() -> None:
    pass
