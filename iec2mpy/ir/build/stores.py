"""Values into variables: what is checked or cut on the way, and initial values."""

from __future__ import annotations

from iec2mpy.ir import nodes as n
from iec2mpy.ir.build.checks import check_range
from iec2mpy.ir.build.context import Context
from iec2mpy.ir.build.conversions import fit_string
from iec2mpy.ir.build.packed import PackedPlace, store
from iec2mpy.semantics import types as ty


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
    else:
        assert isinstance(initial, (int, float, str))
        context.emit(n.Store(place, n.Const(initial, stored)))
