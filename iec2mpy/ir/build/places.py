"""Places: variables, their fields and elements, with the check of each index."""

from __future__ import annotations

from collections.abc import Callable

from iec2mpy.ir import nodes as n
from iec2mpy.ir.build.checks import check_range
from iec2mpy.ir.build.context import Context, is_in_out
from iec2mpy.ir.build.packed import PackedPlace, element_of, field_of
from iec2mpy.semantics import typed as t
from iec2mpy.semantics import types as ty
from iec2mpy.syntax.tree import PouKind, Section

LowerExpr = Callable[[Context, t.Expr], n.Expr]
NULL = n.Const(0, ty.REFERENCE)


def variable_place(variable: t.Variable) -> n.Place:
    """Where a variable lives, seen from any body that may name it."""
    own = storage_place(variable)
    return _followed(own, variable.type) if variable.by_reference else own


def storage_place(variable: t.Variable) -> n.Place:
    """The variable's own storage: for an in-out, that of its reference."""
    declared = n.storage_type(variable)
    owner = variable.owner
    if owner is None or variable.address is not None:
        return n.Place(n.Global(variable), (), declared)
    in_frame = owner.kind is PouKind.FUNCTION or variable.section is Section.TEMP
    root = n.Frame(owner) if in_frame else n.Self(owner)
    return n.Place(root, (n.Field(variable),), declared)


def field_place(base: n.Place, variable: t.Variable) -> n.Place:
    """A field of a structure, or a variable of an instance; an in-out of it is followed."""
    place = n.Place(base.root, (*base.steps, n.Field(variable)), n.storage_type(variable))
    return _followed(place, variable.type) if variable.by_reference else place


def _followed(in_out: n.Place, declared: ty.Type) -> n.Place:
    """What an in-out stands for."""
    return n.Place(n.Deref(n.Load(in_out, ty.REFERENCE), declared), (), ty.unaliased(declared))


def address_place(address: t.Address) -> n.Place:
    """The place that an initial value refers to."""
    steps = tuple(n.Element(n.Const(s, ty.DINT)) if isinstance(s, int) else n.Field(s) for s in address.steps)
    whole = storage_place(address.variable)
    return n.Place(whole.root, (*whole.steps, *steps), ty.unaliased(address.type))


def plain_place(context: Context, expr: t.Expr, lower_expr: LowerExpr) -> n.Place:
    """`lower_place`, for what never lies among shared bytes: an instance, and what is referred to."""
    place = lower_place(context, expr, lower_expr)
    assert isinstance(place, n.Place), f"{expr} lies among shared bytes"
    return place


def lower_place(context: Context, expr: t.Expr, lower_expr: LowerExpr) -> n.Place | PackedPlace:
    """The place that a variable, field or element names; checks of indices are emitted."""
    if context.instance is not None and expr is context.instance[0]:
        return context.instance[1]
    match expr:
        case t.VariableRef(variable) if variable in context.edges:
            return context.edges[variable]
        case t.VariableRef(variable) | t.DirectRef(variable):
            if variable.shared is not None:
                storage = storage_place(variable.shared.storage)
                return PackedPlace(storage, variable.shared.bit, ty.unaliased(variable.type))
            return variable_place(variable)
        case t.FieldRef(base, variable):
            whole = lower_place(context, base, lower_expr)
            if isinstance(whole, n.Place) and isinstance(whole.type, ty.StructType) and whole.type.storage is not None:
                whole = PackedPlace(fixed(context, field_place(whole, whole.type.storage)), 0, whole.type)
            return field_of(whole, variable) if isinstance(whole, PackedPlace) else field_place(whole, variable)
        case t.ElementRef(base, indices):
            base_place = lower_place(context, base, lower_expr)
            mark = context.mark()
            index = _flat_index(context, base, indices, lower_expr)
            if isinstance(base_place, PackedPlace):
                return element_of(context, base_place, index)
            base_place = context.settle_place(mark, base_place)
            return n.Place(base_place.root, (*base_place.steps, n.Element(index)), ty.unaliased(expr.type))
        case t.Dereference(base):
            reference = context.atom(lower_expr(context, base))
            context.emit(n.Guard(n.Op("eq", reference, NULL, ty.BOOL), "NULL", context.site))
            return n.Place(n.Deref(reference, expr.type), (), ty.unaliased(expr.type))
        case _:
            raise AssertionError(f"not a variable: {expr}")


def fixed(context: Context, place: n.Place) -> n.Place:
    """The place with its subscripts worked out here and now, once."""
    root = place.root
    if isinstance(root, n.Deref) and not is_in_out(root.reference):
        root = n.Deref(context.kept(root.reference), root.type)
    steps = tuple(n.Element(context.kept(s.index)) if isinstance(s, n.Element) else s for s in place.steps)
    return n.Place(root, steps, place.type)


def _flat_index(context: Context, array: t.Expr, indices: tuple[t.Expr, ...], lower_expr: LowerExpr) -> n.Expr:
    """The element's number from 0: rows first (6.4.4.5.1)."""
    values: list[n.Expr] = []
    for index in indices:
        mark = context.mark()
        value = lower_expr(context, index)
        values = [*context.settle(mark, values), value]
    if isinstance(array, t.VariableRef) and array.variable.limits:
        return _open_flat_index(context, array.variable, values)
    assert isinstance(array.type, ty.ArrayType)
    flat: n.Expr = n.Const(0, ty.DINT)
    for value, (low, high) in zip(values, array.type.bounds, strict=True):
        offset = _offset(context, value, low, high)
        flat = _add(_multiply(flat, high - low + 1), offset)
    return flat


def _open_flat_index(context: Context, array: t.Variable, values: list[n.Expr]) -> n.Expr:
    """The same, of an ARRAY[*], whose limits are known when the program runs."""
    flat: n.Expr = n.Const(0, ty.DINT)
    for value, limits in zip(values, array.limits, strict=True):
        low, high = (n.Load(storage_place(limit), ty.DINT) for limit in limits)
        value = n.Wrap(context.atom(check_range(context, value, ty.DINT.low, ty.DINT.high, "index")), ty.DINT)
        below, above = n.Op("lt", value, low, ty.BOOL), n.Op("gt", value, high, ty.BOOL)
        context.emit(n.Guard(n.Op("or", below, above, ty.BOOL), "index", context.site))
        offset = n.Op("sub", value, low, ty.DINT)
        if not isinstance(flat, n.Const):
            flat = n.Op("mul", flat, length(low, high), ty.DINT)
        flat = _add(flat, offset)
    return flat


def length(low: n.Expr, high: n.Expr) -> n.Expr:
    """How many subscripts there are from one to the other."""
    return n.Op("add", n.Op("sub", high, low, ty.DINT), n.Const(1, ty.DINT), ty.DINT)


def _offset(context: Context, value: n.Expr, low: int, high: int) -> n.Expr:
    """The index less its lower bound, checked: a wrong one would be a wild write."""
    if isinstance(value, n.Const):
        return n.Const(value.number - low, ty.DINT)
    value = check_range(context, value, low, high, "index")
    if value.type.in_objects:
        value = n.Wrap(value, ty.DINT)
    return _add(value, n.Const(-low, ty.DINT))


def _add(left: n.Expr, right: n.Expr) -> n.Expr:
    if isinstance(left, n.Const) and isinstance(right, n.Const):
        return n.Const(left.number + right.number, ty.DINT)
    if isinstance(left, n.Const) and left.value == 0:
        return right
    if isinstance(right, n.Const) and right.value == 0:
        return left
    return n.Op("add", left, right, ty.DINT)


def _multiply(left: n.Expr, factor: int) -> n.Expr:
    if isinstance(left, n.Const):
        return n.Const(left.number * factor, ty.DINT)
    return left if factor == 1 else n.Op("mul", left, n.Const(factor, ty.DINT), ty.DINT)
