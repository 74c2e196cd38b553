"""Calls of functions and blocks: arguments into the callee's variables, the call, outputs back."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from iec2mpy.ir import nodes as n
from iec2mpy.ir.build import expressions
from iec2mpy.ir.build.context import Context
from iec2mpy.ir.build.packed import PackedPlace, pack, unpack
from iec2mpy.ir.build.places import fixed, lower_place, plain_place, storage_place
from iec2mpy.ir.build.stores import assign, assign_initial
from iec2mpy.semantics import typed as t
from iec2mpy.semantics import types as ty


def call_function(context: Context, call: t.FunctionCall) -> n.Place | None:
    """Calls a function; gives the place of its result, which the next call of it overwrites."""
    function = call.function
    copies = _pass_arguments(context, call.arguments, n.Frame(function), ())
    # after the arguments: these may call the same function, whose frame is one for all calls
    given = {a.parameter for a in call.arguments}
    for parameter in function.inputs:
        if parameter not in given:
            assign_initial(context, storage_place(parameter))
    context.emit(n.Call(function, None))
    _copy_back(context, copies)
    _take_outputs(context, call.arguments)
    if function.result is None:
        return None
    return storage_place(function.result)


def call_block(context: Context, call: t.CallBlock) -> None:
    """Invokes an instance: its inputs keep their values unless they are given (6.6.3.4.1)."""
    instance = fixed(context, plain_place(context, call.instance, expressions.lower_expr))
    copies = _pass_arguments(context, call.arguments, instance.root, instance.steps)
    context.emit(n.Call(call.block, instance))
    _copy_back(context, copies)
    with context.called(call.instance, instance):
        _take_outputs(context, call.arguments)


def _pass_arguments(
    context: Context, arguments: Sequence[t.ActualParameter], root: n.Root, steps: tuple[n.Step, ...]
) -> list[_Copied]:
    """Evaluates all arguments in the order written, then stores them at the callee's frame or instance: an argument may
    call the same function. None reads what is stored here, as inputs and in-outs are not seen from outside.

    A variable among shared bytes has no slot that an in-out could stand for: a copy goes in, and back out after it."""
    values: list[n.Expr] = []
    wholes: list[n.Place] = []
    stores: list[tuple[n.Place, t.ActualParameter]] = []
    bindings: list[n.Bind] = []
    copies: list[_Copied] = []
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
                    copies.append(_Copied(place, context.new_hidden(place.type)))
                    place = copies[-1].copy
                else:
                    place = fixed(context, place)
                values, wholes = context.settle(mark, values), context.settle_wholes(mark, wholes)
                bindings.append(n.Bind(own, place))
            case t.OutputArgument():
                pass
    single, whole = iter(values), iter(wholes)
    for own, argument in stores:
        if ty.value_type(own.type) is None:
            context.emit(n.Copy(own, next(whole)))
        else:
            assign(context, own, argument.parameter.type, next(single))
    for copied in copies:
        unpack(context, copied.copy, copied.packed)
    for binding in bindings:
        context.emit(binding)
    return copies


@dataclass(frozen=True, slots=True)
class _Copied:
    """What an in-out is given where its variable lies among shared bytes."""

    packed: PackedPlace
    copy: n.Place


def _copy_back(context: Context, copies: Sequence[_Copied]) -> None:
    for copied in copies:
        pack(context, copied.packed, copied.copy)


def _take_outputs(context: Context, arguments: Sequence[t.ActualParameter]) -> None:
    for argument in arguments:
        if isinstance(argument, t.OutputArgument):
            expressions.assign_expr(context, argument.target, argument.value)
