"""Calls of functions and blocks: arguments into the callee's variables, the call, outputs back."""

from __future__ import annotations

from collections.abc import Sequence

from iec2mpy.ir import nodes as n
from iec2mpy.ir.build import expressions
from iec2mpy.ir.build.context import Context, reads
from iec2mpy.ir.build.places import lower_place, storage_place
from iec2mpy.ir.build.stores import assign, assign_initial
from iec2mpy.semantics import typed as t
from iec2mpy.semantics import types as ty


def call_function(context: Context, call: t.FunctionCall) -> n.Place | None:
    """Calls a function; gives the place of its result, which the next call of it overwrites."""
    function = call.function
    given = {a.parameter for a in call.arguments}
    for parameter in function.inputs:
        if parameter not in given:
            assign_initial(context, storage_place(parameter))
    _pass_arguments(context, call.arguments, n.Place(n.Frame(function), (), ty.BOOL))
    context.emit(n.Call(function, None))
    _take_outputs(context, call.arguments)
    if function.result is None:
        return None
    result = storage_place(function.result)
    if ty.value_type(result.type) is not None:
        return result
    kept = context.new_hidden(result.type, function.result.initial)
    context.emit(n.Copy(kept, result))
    return kept


def call_block(context: Context, call: t.CallBlock) -> None:
    """Invokes an instance: its inputs keep their values unless they are given (6.6.3.4.1)."""
    instance = _fixed(context, lower_place(context, call.instance, expressions.lower_expr))
    _pass_arguments(context, call.arguments, instance)
    context.emit(n.Call(call.block, instance))
    _take_outputs(context, call.arguments)


def _fixed(context: Context, place: n.Place) -> n.Place:
    """The place with its subscripts worked out once."""
    steps = tuple(n.Element(context.atom(s.index)) if isinstance(s, n.Element) else s for s in place.steps)
    return n.Place(place.root, steps, place.type)


def _pass_arguments(context: Context, arguments: Sequence[t.ActualParameter], callee: n.Place) -> None:
    """Evaluates all arguments in the order written, then stores them: a store must not change a later argument."""
    values: list[n.Expr] = []
    inputs: list[t.InputArgument] = []
    bindings: list[tuple[t.Variable, n.Place]] = []
    for argument in arguments:
        mark = context.mark()
        match argument:
            case t.InputArgument(parameter, value) if ty.value_type(parameter.type) is None:
                source = expressions.lower_aggregate(context, value)
                values = context.settle(mark, values)
                context.emit(n.Copy(_own(callee, parameter), source))
            case t.InputArgument(_, value):
                lowered = expressions.lower_expr(context, value)
                values = [*context.settle(mark, values), lowered]
                inputs.append(argument)
            case t.InOutArgument(parameter, target):
                place = _fixed(context, lower_place(context, target, expressions.lower_expr))
                values = context.settle(mark, values)
                bindings.append((parameter, place))
            case t.OutputArgument():
                pass
    stored: set[t.Variable] = set()
    for position, argument in enumerate(inputs):
        if stored and reads(values[position], stored):
            values[position:] = [
                v if isinstance(v, (n.Const, n.Local)) else context.spill(v) for v in values[position:]
            ]
            break
        stored.add(argument.parameter)
    for argument, value in zip(inputs, values, strict=True):
        assign(context, _own(callee, argument.parameter), argument.parameter.type, value)
    for parameter, place in bindings:
        context.emit(n.Bind(_own(callee, parameter), place))


def _own(callee: n.Place, parameter: t.Variable) -> n.Place:
    """The storage of a parameter in the callee's frame or instance; of an in-out, that of its reference."""
    return n.Place(callee.root, (*callee.steps, n.Field(parameter)), ty.unaliased(parameter.type))


def _take_outputs(context: Context, arguments: Sequence[t.ActualParameter]) -> None:
    for argument in arguments:
        if isinstance(argument, t.OutputArgument):
            expressions.assign_expr(context, argument.target, argument.value)
