"""What variables start with where nothing is said (table 10, 6.4.4)."""

from __future__ import annotations

from collections.abc import Sequence

from iec2mpy.semantics.typed import Value
from iec2mpy.semantics.types import (
    AliasType,
    ArrayType,
    ElementaryType,
    EnumType,
    Kind,
    RefType,
    StringType,
    StructType,
    SubrangeType,
    Type,
)


def default_value(t: Type) -> Value:
    """What a variable of the type starts with where its declaration says nothing."""
    if isinstance(t, ElementaryType):
        return 0.0 if t.kind is Kind.REAL else 0
    if isinstance(t, StringType):
        return ""
    if isinstance(t, (EnumType, SubrangeType, AliasType)):
        return t.default
    if isinstance(t, RefType):
        return 0  # NULL (6.4.4.10.2)
    if isinstance(t, ArrayType):
        return nested([default_value(t.element)] * element_count(t.lengths), t.lengths)
    if isinstance(t, StructType):
        return {key: field.initial for key, field in t.fields.items()}
    return {}  # an instance: what its block declares


def element_count(lengths: Sequence[int]) -> int:
    """How many elements an array with dimensions of these lengths has."""
    size = 1
    for length in lengths:
        size *= length
    return size


def nested(values: Sequence[Value], lengths: Sequence[int]) -> Value:
    """Elements in order, the rightmost subscript fastest, as one sequence in another for each dimension."""
    if len(lengths) == 1:
        return tuple(values)
    row = element_count(lengths[1:])
    return tuple(nested(values[i : i + row], lengths[1:]) for i in range(0, len(values), row))
