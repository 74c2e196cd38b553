"""Expressions: from the checked tree to pure IR, with whatever has an effect emitted before it, from left to right."""

from __future__ import annotations

from iec2mpy.ir import nodes as n
from iec2mpy.ir.build import calls, controlled
from iec2mpy.ir.build.builtins import lower_builtin, power, swap_bytes
from iec2mpy.ir.build.context import Context
from iec2mpy.ir.build.conversions import convert, real_result
from iec2mpy.ir.build.moments import add_or_subtract, as_object
from iec2mpy.ir.build.packed import AnyPlace, PackedPlace, each_value, load, pack, unpack
from iec2mpy.ir.build.parts import read_part, with_part
from iec2mpy.ir.build.places import fixed, lower_place, plain_place
from iec2mpy.ir.build.stores import assign
from iec2mpy.ir.walk import may_fault
from iec2mpy.semantics import typed as t
from iec2mpy.semantics import types as ty
from iec2mpy.semantics.defaults import default_value

_COMPARISONS = {"=": "eq", "<>": "ne", "<": "lt", ">": "gt", "<=": "le", ">=": "ge"}
_BITWISE = {"AND": "and", "OR": "or", "XOR": "xor"}
_ARITHMETIC = {"+": "add", "-": "sub", "*": "mul"}
_DEPTH = 20
"""So many expressions inside of each other make a part."""


def lower_expr(context: Context, expr: t.Expr) -> n.Expr:
    """The value of an expression that has a single one (`value_type` of its type is not None). One that holds many
    others inside of each other is worked out in parts: CPython reads at most 100 brackets in a row."""
    context.depth += 1
    value = _lower(context, expr)
    context.depth -= 1
    return context.kept(value) if context.depth and context.depth % _DEPTH == 0 else value


def _lower(context: Context, expr: t.Expr) -> n.Expr:
    match expr:
        case t.Constant(value):
            return n.Const(value, stored_type(expr.type))
        case t.VariableRef(variable) if variable in context.values:
            return context.values[variable]
        case t.ReferenceTo(target):
            return n.Ref(plain_place(context, target, lower_expr))
        case t.VariableRef() | t.DirectRef() | t.FieldRef() | t.ElementRef() | t.Dereference():
            return _load(context, lower_place(context, expr, lower_expr), stored_type(expr.type))
        case t.PartRef(base, low, part):
            return read_part(lower_expr(context, base), low, part)
        case t.CharacterRef(base, index):
            arguments = lower_all(context, (base, index))
            context.emit(n.Mark(context.site))
            return n.Intrinsic("character", tuple(arguments), stored_type(expr.type))
        case t.Convert(operand):
            return convert(context, lower_expr(context, operand), stored_type(expr.type), expr.truncate)
        case t.Unary(operator, operand):
            return _unary(operator, lower_expr(context, operand))
        case t.Binary("AND_THEN" | "OR_ELSE" as operator, left, right):
            return _short_circuit(context, operator, left, right)
        case t.Binary(operator, left, right) if ty.value_type(left.type) is None:
            return _compared(context, operator, left, right)
        case t.Binary(operator, left, right):
            left_value, right_value = lower_all(context, (left, right))
            return _binary(context, operator, left_value, right_value, stored_type(expr.type))
        case t.BuiltinCall(name, arguments):
            return lower_builtin(context, name, lower_all(context, arguments), stored_type(expr.type))
        case t.FunctionCall() | t.StandardCall():
            return _called(context, expr)[0]


def _short_circuit(context: Context, operator: str, left: t.Expr, right: t.Expr) -> n.Expr:
    """The right side in a branch of its own, unless evaluating it does nothing that could be noticed."""
    first = lower_expr(context, left)
    with context.block() as branch:
        second = lower_expr(context, right)
    if not branch and not may_fault(second):
        return n.Op("and" if operator == "AND_THEN" else "or", first, second, ty.BOOL)
    result = context.spill(first)
    branch.append(n.SetLocal(result, second))
    then, otherwise = (tuple(branch), ()) if operator == "AND_THEN" else ((), tuple(branch))
    context.emit(n.If(result, then, otherwise))
    return result


def lower_aggregate(context: Context, expr: t.Expr) -> n.Place:
    """Where a whole array or structure is."""
    if isinstance(expr, t.FunctionCall):
        return _called_whole(context, expr)[0]
    if isinstance(expr, t.BuiltinCall):
        return _swapped(context, lower_aggregate(context, expr.arguments[0]))
    place = lower_place(context, expr, lower_expr)
    if isinstance(place, n.Place):
        return place
    whole = context.new_hidden(place.type)
    unpack(context, whole, place)
    return whole


def _swapped(context: Context, place: n.Place) -> n.Place:
    """A copy of a whole array or structure, with the bytes of each of its values in the other order."""
    whole = context.new_hidden(place.type)
    context.emit(n.Copy(whole, place))

    def swap(value: n.Place, _: AnyPlace) -> None:
        stored = stored_type(value.type)
        context.emit(n.Store(value, swap_bytes(context, "TO_BIG_ENDIAN", [n.Load(value, stored)], stored)))

    each_value(context, whole, whole, swap)
    return whole


def _called(context: Context, call: t.FunctionCall | t.StandardCall) -> tuple[n.Expr, n.Local | None]:
    """The single result of a call; under EN and ENO with whether the call came to its end. Where it did not, the result
    has the default value of its type."""
    if isinstance(call, t.StandardCall):
        return controlled.call_standard(context, call)
    stored = stored_type(call.type)
    if call.control is None:
        result, _ = calls.call_function(context, call, None)
        assert result is not None, "the checker lets only functions with a result into expressions"
        return context.spill(n.Load(result, stored)), None
    value = controlled.preset(context, stored)
    _, done = calls.call_function(context, call, lambda result: context.emit(n.SetLocal(value, n.Load(result, stored))))
    return value, done


def _called_whole(context: Context, call: t.FunctionCall) -> tuple[n.Place, n.Local | None]:
    """Where the result of a call is that is an array or structure; the next call of the function overwrites it. Under
    EN and ENO it is a copy, and with it comes whether the call came to its end."""
    if call.control is None:
        result, _ = calls.call_function(context, call, None)
        assert result is not None, "the checker lets only functions with a result into expressions"
        return result, None
    kept = context.new_hidden(ty.unaliased(call.type))
    context.emit(n.Reset(kept, default_value(kept.type)))
    _, done = calls.call_function(context, call, lambda result: context.emit(n.Copy(kept, result)))
    return kept, done


def assign_expr(context: Context, target: t.Expr, value: t.Expr) -> None:
    """`target := value`, for single values and whole arrays and structures. The target's subscripts come first."""
    conversions: list[t.Convert] = []
    call = value
    while isinstance(call, t.Convert):
        conversions.insert(0, call)
        call = call.operand
    if isinstance(call, (t.FunctionCall, t.StandardCall)) and call.control is not None:
        _assign_controlled(context, target, call, conversions)
        return
    place = lower_place(context, _stored(target), lower_expr)
    mark = context.mark()
    if ty.value_type(target.type) is None:
        source = lower_aggregate(context, value)
        _copy(context, context.settle_place(mark, place) if isinstance(place, n.Place) else place, source)
        return
    indices = (target.index,) if isinstance(target, t.CharacterRef) else ()
    *index, lowered = lower_all(context, (*indices, value))
    _store(context, target, context.settle_place(mark, place) if isinstance(place, n.Place) else place, index, lowered)


def _stored(target: t.Expr) -> t.Expr:
    """The variable that is written where a part of it, or a character, is assigned."""
    return target.base if isinstance(target, (t.PartRef, t.CharacterRef)) else target


def _copy(context: Context, place: n.Place | PackedPlace, source: n.Place) -> None:
    """A whole array or structure to its place."""
    if isinstance(place, PackedPlace):
        pack(context, place, source)
    else:
        context.emit(n.Copy(place, source))


def _store(context: Context, target: t.Expr, place: n.Place | PackedPlace, index: list[n.Expr], value: n.Expr) -> None:
    """A single value to where `_stored` is; `index` has the number of the character, if it is one."""
    if isinstance(target, t.CharacterRef):
        # the string with another character goes where it was; no character is added at its end
        assert isinstance(place, n.Place), "no string lies among shared bytes"
        place = fixed(context, place)
        string = n.Load(place, stored_type(target.base.type))
        context.emit(n.Mark(context.site))
        context.emit(n.Store(place, n.Intrinsic("with_character", (string, *index, value), string.type)))
    elif isinstance(target, t.PartRef):
        place = fixed(context, place) if isinstance(place, n.Place) else place
        whole = _load(context, place, stored_type(target.base.type))
        assign(context, place, target.base.type, with_part(whole, target.low, value))
    else:
        assign(context, place, target.type, value)


def _assign_controlled(
    context: Context, target: t.Expr, call: t.FunctionCall | t.StandardCall, conversions: list[t.Convert]
) -> None:
    """The result of a call with EN or ENO: it is copied only where there is one (6.6.1.5)."""
    place = lower_place(context, _stored(target), lower_expr)
    place = fixed(context, place) if isinstance(place, n.Place) else place
    index = [context.kept(lower_expr(context, target.index))] if isinstance(target, t.CharacterRef) else []
    if isinstance(call, t.FunctionCall) and ty.value_type(call.type) is None:
        source, done = _called_whole(context, call)
        with context.block() as copies:
            _copy(context, place, source)
    else:
        value, done = _called(context, call)
        with context.block() as copies:
            for conversion in conversions:
                value = convert(context, value, stored_type(conversion.type), conversion.truncate)
            _store(context, target, place, index, value)
    assert done is not None, "a call with EN or ENO may not come to its end"
    context.emit(n.If(done, tuple(copies), ()))


def _load(context: Context, place: n.Place | PackedPlace, value_type: n.ValueType) -> n.Expr:
    return load(context, place) if isinstance(place, PackedPlace) else n.Load(place, value_type)


def lower_all(context: Context, exprs: tuple[t.Expr, ...]) -> list[n.Expr]:
    """The values of several expressions, in their order."""
    values: list[n.Expr] = []
    for expr in exprs:
        mark = context.mark()
        value = lower_expr(context, expr)
        values = [*context.settle(mark, values), value]
    return values


def stored_type(declared: ty.Type | None) -> n.ValueType:
    """What a single value of this type is stored as."""
    assert declared is not None
    stored = ty.value_type(declared)
    assert stored is not None, f"{declared} is no single value"
    return stored


def _compared(context: Context, operator: str, left: t.Expr, right: t.Expr) -> n.Expr:
    """`=` and `<>` of whole arrays and structures (7.3.3.2)."""
    left_place = lower_aggregate(context, left)
    mark = context.mark()
    right_place = lower_aggregate(context, right)
    (left_place,) = context.settle_wholes(mark, [left_place])
    equal = context.new_local(ty.BOOL, 0, 1)
    context.emit(n.Compare(equal, left_place, right_place))
    return equal if operator == "=" else n.Not(equal, ty.BOOL)


def _unary(operator: str, operand: n.Expr) -> n.Expr:
    if operator == "NOT":
        return n.Not(operand, operand.type)
    if _is_real(operand.type):
        # 0.0 - x would lose the sign of zero
        return n.Op("mul", operand, n.Const(-1.0, operand.type), operand.type)
    return n.Wrap(n.Op("sub", n.Const(0, operand.type), operand, operand.type), operand.type)


def _binary(context: Context, operator: str, left: n.Expr, right: n.Expr, result: n.ValueType) -> n.Expr:
    if operator in _COMPARISONS:
        return n.Op(_COMPARISONS[operator], left, right, ty.BOOL)
    if operator in _BITWISE:
        return n.Op(_BITWISE[operator], left, right, result)
    if operator == "**":
        return power(context, left, right, result)
    if isinstance(left.type, ty.ElementaryType) and left.type.kind in ty.MOMENTS:
        return add_or_subtract(context, operator, left, right)
    if isinstance(left.type, ty.ElementaryType) and left.type.kind is ty.Kind.DURATION and right.type != left.type:
        return _scaled_duration(context, operator, left, right)
    if operator == "MOD":
        return _modulo(context, left, right, result)
    if operator == "/":
        return divide(context, left, right, result)
    value = n.Op(_ARITHMETIC[operator], left, right, result)
    return value if _is_real(result) else n.Wrap(value, result)


def divide(context: Context, left: n.Expr, right: n.Expr, result: n.ValueType) -> n.Expr:
    """Division; by zero it faults, integers truncate."""
    right = _checked_divisor(context, right)
    if _is_real(result):
        return n.Op("div", left, right, result)
    return n.Wrap(_integer_division(context, "div", left, right, result), result)


def _modulo(context: Context, left: n.Expr, right: n.Expr, result: n.ValueType) -> n.Expr:
    """MOD; by zero it gives 0, as table 29 says."""
    if isinstance(right, n.Const):
        return _integer_division(context, "mod", left, right, result) if right.value else n.Const(0, result)
    left, right = context.atom(left), context.atom(right)
    quotient = context.new_local(result)
    zero = n.Op("eq", right, n.Const(0, right.type), ty.BOOL)
    with context.block() as then:
        context.emit(n.SetLocal(quotient, n.Const(0, result)))
    with context.block() as otherwise:
        context.emit(n.SetLocal(quotient, n.Op("mod", left, right, result)))
    context.emit(n.If(zero, tuple(then), tuple(otherwise)))
    return quotient


def _checked_divisor(context: Context, divisor: n.Expr) -> n.Expr:
    if isinstance(divisor, n.Const) and divisor.value != 0:
        return divisor
    divisor = context.atom(divisor)
    context.emit(n.Guard(n.Op("eq", divisor, n.Const(0, divisor.type), ty.BOOL), "zero", context.site))
    return divisor


def _integer_division(context: Context, name: str, left: n.Expr, right: n.Expr, result: n.ValueType) -> n.Expr:
    """The operands are written several times where a backend has to mend the sign, so they are atoms. Unsigned ones of
    32 bits take several statements on a 32-bit machine, so their result is a local of its own."""
    value = n.Op(name, context.atom(left), right, result)
    return context.spill(value) if result in (ty.UDINT, ty.DWORD) else value


def _scaled_duration(context: Context, operator: str, duration: n.Expr, factor: n.Expr) -> n.Expr:
    """A duration * or / a number (table 35, 10 and 11)."""
    result = duration.type
    assert isinstance(result, ty.ElementaryType)
    if _is_real(factor.type):
        return _scaled_by_real(context, operator, duration, factor, result)
    # of different widths, both are calculated with as objects
    wide = ty.LTIME if duration.type.in_objects or factor.type.in_objects else result
    if wide is ty.LTIME:
        duration, factor = as_object(duration), as_object(factor)
    if operator == "/":
        return n.Wrap(divide(context, duration, factor, wide), result)
    return n.Wrap(n.Op("mul", duration, factor, wide), result)


def _scaled_by_real(
    context: Context, operator: str, duration: n.Expr, factor: n.Expr, result: ty.ElementaryType
) -> n.Expr:
    if operator == "/":
        factor = _checked_divisor(context, factor)
    if result is ty.LTIME:
        # exactly: its nanoseconds are more than a board's float can tell apart
        context.emit(n.Mark(context.site))
        return n.Intrinsic("over_real" if operator == "/" else "times_real", (duration, factor), result)
    value = n.ToReal(duration, factor.type)
    scaled = n.Op("div" if operator == "/" else "mul", value, factor, factor.type)
    return real_result(context, scaled, result, truncate=False)


def _is_real(of: n.ValueType) -> bool:
    return isinstance(of, ty.ElementaryType) and of.kind is ty.Kind.REAL
