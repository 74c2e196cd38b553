"""Calls of functions and blocks: arguments into the callee's variables, the call, outputs back."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from iec2mpy.ir import nodes as n
from iec2mpy.ir.build import expressions
from iec2mpy.ir.build.context import Context
from iec2mpy.ir.build.controlled import Emit, Stages, emit_call
from iec2mpy.ir.build.packed import PackedPlace, pack, unpack
from iec2mpy.ir.build.places import fixed, lower_place, plain_place, storage_place
from iec2mpy.ir.build.stores import assign, assign_initial
from iec2mpy.semantics import typed as t
from iec2mpy.semantics import types as ty


def call_function(
    context: Context, call: t.FunctionCall, take: Callable[[n.Place], None] | None
) -> tuple[n.Place | None, n.Local | None]:
    """Calls a function; gives the place of its result, which the next call of it overwrites, and under EN or ENO
    whether the call came to its end. `take` is given the place after the call, where that came to its end."""
    function = call.function
    result = storage_place(function.result) if function.result is not None else None
    in_outs = _InOuts()

    def prepare() -> None:
        _pass_arguments(context, call.arguments, n.Frame(function), (), in_outs)
        # after the arguments: these may call the same function, whose frame is one for all calls
        given = {a.parameter for a in call.arguments}
        for parameter in function.inputs:
            if parameter not in given:
                assign_initial(context, storage_place(parameter))

    def finish() -> None:
        _take_outputs(context, call.arguments)
        if take is not None and result is not None:
            take(result)

    eno = storage_place(function.eno) if function.eno is not None else None
    stages = _stages(context, n.Call(function, None), in_outs, prepare, finish)
    return result, emit_call(context, call.control, eno, stages)


def call_block(context: Context, call: t.CallBlock) -> None:
    """Invokes an instance: its inputs keep their values unless they are given (6.6.3.4.1)."""
    instance = fixed(context, plain_place(context, call.instance, expressions.lower_expr))
    in_outs = _InOuts()

    def prepare() -> None:
        _pass_arguments(context, call.arguments, instance.root, instance.steps, in_outs)

    def finish() -> None:
        with context.called(call.instance, instance):
            _take_outputs(context, call.arguments)

    own = call.block.eno
    eno = n.Place(instance.root, (*instance.steps, n.Field(own)), ty.BOOL) if own is not None else None
    emit_call(context, call.control, eno, _stages(context, n.Call(call.block, instance), in_outs, prepare, finish))


@dataclass(frozen=True, slots=True)
class _Copied:
    """What an in-out is given where its variable lies among shared bytes."""

    packed: PackedPlace
    copy: n.Place


@dataclass(frozen=True, slots=True)
class _InOuts:
    """What the in-outs of a call stand for, once its arguments are worked out."""

    bindings: list[n.Bind] = field(default_factory=list)
    copies: list[_Copied] = field(default_factory=list)


def _stages(context: Context, call: n.Call, in_outs: _InOuts, prepare: Emit, finish: Emit) -> Stages:
    """In-outs are bound directly before the call. What the body did to them stays, however it ended."""

    def run() -> None:
        for binding in in_outs.bindings:
            context.emit(binding)
        context.emit(call)

    def leave() -> None:
        for copied in in_outs.copies:
            pack(context, copied.packed, copied.copy)

    return Stages(prepare, run, leave, finish)


def _pass_arguments(
    context: Context,
    arguments: Sequence[t.ActualParameter],
    root: n.Root,
    steps: tuple[n.Step, ...],
    in_outs: _InOuts,
) -> None:
    """Evaluates all arguments in the order written, then stores them at the callee's frame or instance: an argument may
    call the same function. None reads what is stored here, as inputs and in-outs are not seen from outside.

    A variable among shared bytes has no slot that an in-out could stand for: a copy goes in, and back out after it."""
    values: list[n.Expr] = []
    wholes: list[n.Place] = []
    stores: list[tuple[n.Place, t.ActualParameter]] = []
    for argument in arguments:
        mark = context.mark()
        parameter = argument.parameter
        own = n.Place(root, (*steps, n.Field(parameter)), n.storage_type(parameter))
        match argument:
            case t.InputArgument(_, value) if ty.value_type(parameter.type) is None:
                place = expressions.lower_aggregate(context, value)
                values, wholes = context.settle(mark, values), [*context.settle_wholes(mark, wholes), place]
                stores.append((own, argument))
            case t.InputArgument(_, value):
                lowered = expressions.lower_expr(context, value)
                values, wholes = [*context.settle(mark, values), lowered], context.settle_wholes(mark, wholes)
                stores.append((own, argument))
            case t.InOutArgument(_, target):
                place = lower_place(context, target, expressions.lower_expr)
                if isinstance(place, PackedPlace):
                    in_outs.copies.append(_Copied(place, context.new_hidden(place.type)))
                    place = in_outs.copies[-1].copy
                else:
                    place = fixed(context, place)
                values, wholes = context.settle(mark, values), context.settle_wholes(mark, wholes)
                in_outs.bindings.append(n.Bind(own, place))
            case t.OutputArgument():
                pass
    single, whole = iter(values), iter(wholes)
    for own, argument in stores:
        if ty.value_type(own.type) is None:
            context.emit(n.Copy(own, next(whole)))
        else:
            assign(context, own, argument.parameter.type, next(single))
    for copied in in_outs.copies:
        unpack(context, copied.copy, copied.packed)


def _take_outputs(context: Context, arguments: Sequence[t.ActualParameter]) -> None:
    for argument in arguments:
        if isinstance(argument, t.OutputArgument):
            expressions.assign_expr(context, argument.target, argument.value)
