"""Initial values, as they are stored: flat, in the order of the slots."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from iec2mpy.backends.forms import pattern
from iec2mpy.backends.layout import Homes, Layout, Size, packed
from iec2mpy.semantics import types as ty
from iec2mpy.semantics.typed import Address


def flat_values(
    layout: Layout, declared: ty.Type, value: object, array: str, at: Size, homes: Homes
) -> list[object]:
    """What the slots of one array hold for a value of the type; slots of V as signed numbers.

    `value` is complete for arrays and structures; for an instance it may name only some variables. It stands at `at`,
    inside of the instances that `homes` tells; a reference to a variable of another instance is NULL.
    """
    declared = ty.unaliased(declared)
    if isinstance(declared, ty.ArrayType):
        stride = layout.size_of(declared.element)
        found: list[object] = []
        for number, item in enumerate(_elements(value, len(declared.bounds))):
            found += flat_values(layout, declared.element, item, array, at + stride.times(number), homes)
        return found
    if isinstance(declared, (ty.StructType, ty.BlockType)):
        return _record_values(layout, declared, value, array, at, homes)
    stored = ty.value_type(declared)
    assert stored is not None
    if stored.in_objects != (array == "O"):
        return []
    if isinstance(value, Address):
        return [_reference(layout, value, homes)]
    if isinstance(stored, ty.ElementaryType) and array == "V":
        assert isinstance(value, int)
        return [pattern(int(value))]
    is_real = isinstance(stored, ty.ElementaryType) and stored.is_real
    return [float(value)] if is_real and isinstance(value, (int, float)) else [value]


def _record_values(
    layout: Layout, declared: ty.StructType | ty.BlockType, value: object, array: str, at: Size, homes: Homes
) -> list[object]:
    assert isinstance(value, Mapping)
    if isinstance(declared, ty.BlockType):
        homes = {**homes, declared.pou: at}
    found: list[object] = []
    for variable, offset in layout.record(declared).offsets.items():
        if variable.by_reference:
            found += [0] if array == "V" else []
        else:
            given = value.get(variable.key, variable.initial)
            found += flat_values(layout, variable.type, given, array, at + offset, homes)
    return found


def _reference(layout: Layout, address: Address, homes: Homes) -> int:
    variable = address.variable
    if variable.owner is None or variable.address is not None:
        at = layout.global_position(variable)
    elif variable.owner in homes:
        at = homes[variable.owner] + layout.instance_record(variable.owner).offsets[variable]
    else:
        return 0
    declared = ty.unaliased(variable.type)
    for step in address.steps:
        if isinstance(step, int):
            assert isinstance(declared, ty.ArrayType)
            at += layout.size_of(declared.element).times(step)
            declared = ty.unaliased(declared.element)
        else:
            assert isinstance(declared, (ty.StructType, ty.BlockType))
            at += layout.record(declared).offsets[step]
            declared = ty.unaliased(step.type)
    return packed(at, layout.size_of(declared))


def _elements(value: object, dimensions: int) -> Iterator[object]:
    """Nested sequences, one level a dimension."""
    if dimensions == 0:
        yield value
        return
    assert isinstance(value, Sequence)
    for item in value:
        yield from _elements(item, dimensions - 1)
