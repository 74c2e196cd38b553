"""Values into variables: what is checked or cut on the way, and initial values."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from iec2mpy.ir import nodes as n
from iec2mpy.ir.build.checks import check_range
from iec2mpy.ir.build.context import Context
from iec2mpy.ir.build.conversions import fit_string
from iec2mpy.ir.build.packed import PackedPlace, store
from iec2mpy.ir.build.places import address_place, field_place, length, storage_place, variable_place
from iec2mpy.semantics import typed as t
from iec2mpy.semantics import types as ty
from iec2mpy.semantics.defaults import default_value


def assign(context: Context, place: n.Place | PackedPlace, declared: ty.Type, value: n.Expr) -> None:
    """Stores a single value: a subrange is checked (6.4.4.4.1), a string cut to its capacity."""
    declared = ty.unaliased(declared)
    if isinstance(declared, ty.SubrangeType):
        value = check_range(context, value, declared.low, declared.high, "range")
    elif isinstance(declared, ty.StringType):
        value = fit_string(value, declared)
    if isinstance(place, PackedPlace):
        store(context, place, value)
    else:
        context.emit(n.Store(place, value))


def assign_initial(context: Context, place: n.Place) -> None:
    """Gives a variable of a frame its initial value, as at each call."""
    step = place.steps[-1]
    assert isinstance(step, n.Field)
    initial = step.variable.initial
    stored = ty.value_type(place.type)
    if stored is None:
        context.emit(n.Reset(place, initial))
        for part, address in addresses_in(place, initial):
            context.emit(n.Store(part, n.Ref(address_place(address))))
    elif isinstance(initial, t.Address):
        context.emit(n.Store(place, n.Ref(address_place(initial))))
    else:
        assert isinstance(initial, (int, float, str))
        context.emit(n.Store(place, n.Const(initial, stored)))


def addresses_in(place: n.Place, value: t.Value) -> Iterator[tuple[n.Place, t.Address]]:
    """The references in the initial value of an array or structure that are not NULL, with their places: they depend on
    the instance that runs."""
    if isinstance(value, t.Address):
        yield place, value
    elif isinstance(place.type, ty.StructType):
        assert isinstance(value, Mapping)
        for key, field in place.type.fields.items():
            yield from addresses_in(field_place(place, field), value[key])
    elif isinstance(place.type, ty.ArrayType):
        for number, item in enumerate(_elements(value, len(place.type.bounds))):
            element = n.Element(n.Const(number, ty.DINT))
            part = n.Place(place.root, (*place.steps, element), ty.unaliased(place.type.element))
            yield from addresses_in(part, item)


def _elements(value: t.Value, dimensions: int) -> Iterator[t.Value]:
    if dimensions == 0:
        yield value
        return
    assert isinstance(value, Sequence)
    for item in value:
        yield from _elements(item, dimensions - 1)


def fill_initial(context: Context, array: t.Variable) -> None:
    """Gives each element of an output ARRAY[*] its initial value, as an output has one at each call (6.6.1.4.1)."""
    assert isinstance(array.type, ty.OpenArrayType)
    element = ty.unaliased(array.type.element)
    count: n.Expr = n.Const(1, ty.DINT)
    for low, high in array.limits:
        one = length(n.Load(storage_place(low), ty.DINT), n.Load(storage_place(high), ty.DINT))
        count = one if isinstance(count, n.Const) else n.Op("mul", count, one, ty.DINT)
    left = context.spill(n.Wrap(count, ty.DINT))
    whole = variable_place(array)
    place = n.Place(whole.root, (*whole.steps, n.Element(left)), element)
    initial, stored = default_value(element), ty.value_type(element)
    with context.block() as body:
        context.emit(n.SetLocal(left, n.Wrap(n.Op("sub", left, n.Const(1, ty.DINT), ty.DINT), ty.DINT)))
        if stored is None:
            context.emit(n.Reset(place, initial))
        else:
            assert isinstance(initial, (int, float, str))
            context.emit(n.Store(place, n.Const(initial, stored)))
    context.emit(n.While(n.Op("gt", left, n.Const(0, ty.DINT), ty.BOOL), tuple(body)))
