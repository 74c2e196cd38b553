"""Initial values, as they are stored: flat, in the order of the slots."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from iec2mpy.backends.forms import pattern
from iec2mpy.backends.layout import Layout
from iec2mpy.semantics import types as ty
from iec2mpy.syntax.tree import Section


def flat_values(layout: Layout, declared: ty.Type, value: object, array: str) -> list[object]:
    """What the slots of one array hold for a value of the type; slots of V as signed numbers.

    `value` is complete for arrays and structures; for an instance it may name only some variables.
    """
    declared = ty.unaliased(declared)
    if isinstance(declared, ty.ArrayType):
        return _array_values(layout, declared, value, len(declared.bounds), array)
    if isinstance(declared, (ty.StructType, ty.BlockType)):
        assert isinstance(value, Mapping)
        found: list[object] = []
        for variable in layout.record(declared).offsets:
            if variable.section is Section.IN_OUT:
                found += [0] if array == "V" else []
            else:
                given = value.get(variable.key, variable.initial)
                found += flat_values(layout, variable.type, given, array)
        return found
    stored = ty.value_type(declared)
    assert stored is not None
    if stored.in_objects != (array == "O"):
        return []
    if isinstance(stored, ty.ElementaryType) and array == "V":
        assert isinstance(value, int)
        return [pattern(int(value))]
    return [float(value)] if stored is ty.REAL and isinstance(value, (int, float)) else [value]


def _array_values(layout: Layout, declared: ty.ArrayType, value: object, dimensions: int, array: str) -> list[object]:
    """Nested sequences, one level a dimension."""
    if dimensions == 0:
        return flat_values(layout, declared.element, value, array)
    assert isinstance(value, Sequence)
    found: list[object] = []
    for item in value:
        found += _array_values(layout, declared, item, dimensions - 1, array)
    return found
