"""How values lie in the bytes of a memory: where variables share storage, their sizes and the bits of their values.

Little endian; a BOOL is one bit, everything else begins at a byte.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Mapping, Sequence

from iec2mpy.semantics.typed import Value, Variable
from iec2mpy.semantics.types import (
    ArrayType,
    ElementaryType,
    Kind,
    RefType,
    StructType,
    Type,
    unaliased,
    value_type,
)

_BYTE = 8


def bit_size(t: Type) -> int | None:
    """The bits that a value of the type takes; None for what has no place among bytes: strings, instances, and
    references, which a number must not overwrite."""
    t = unaliased(t)
    if isinstance(t, RefType):
        return None
    if isinstance(t, ArrayType):
        stride = element_bits(t)
        return None if stride is None else stride * math.prod(t.lengths)
    if isinstance(t, StructType):
        end = 0
        for field, offset in field_offsets(t).items():
            size = bit_size(field.type)
            if size is None:
                return None
            end = max(end, offset + size)
        return end
    single = value_type(t)
    return single.bits if isinstance(single, ElementaryType) else None


def element_bits(t: ArrayType) -> int | None:
    """The bits from one element of an array to the next: elements of BOOL lie bit by bit."""
    size = bit_size(t.element)
    return size if size is None or size == 1 else _whole_bytes(size)


def field_offsets(t: StructType) -> dict[Variable, int]:
    """Where each field of a structure begins, in bits: where its address says, else behind the one before."""
    offsets: dict[Variable, int] = {}
    end = 0
    for field in t.fields.values():
        size = bit_size(field.type) or 0
        start = end if size == 1 else _whole_bytes(end)
        if field.relative is not None:
            start = field.relative
        offsets[field] = start
        end = start + size
    return offsets


def starts_at_bit(t: Type) -> bool:
    """Whether a value of the type may begin inside of a byte: a BOOL, an array of BOOL."""
    t = unaliased(t)
    while isinstance(t, ArrayType) and element_bits(t) == 1:
        t = unaliased(t.element)
    return bit_size(t) == 1 and not isinstance(t, (ArrayType, StructType))


def _whole_bytes(bits: int) -> int:
    return -(-bits // _BYTE) * _BYTE


def packed(t: Type, value: Value) -> int:
    """The bits of a complete value of a type that has a size, as one number."""
    t = unaliased(t)
    if isinstance(t, ArrayType):
        stride = element_bits(t) or 0
        return _joined(t, value, stride, len(t.bounds))
    if isinstance(t, StructType):
        assert isinstance(value, Mapping)
        return packed_fields(t, value)
    single = value_type(t)
    assert isinstance(single, ElementaryType)
    if single.kind is Kind.REAL:
        assert isinstance(value, (int, float))
        return int.from_bytes(struct.pack("<f" if single.bits == 32 else "<d", value), "little")
    assert isinstance(value, int)
    return value & (1 << single.bits) - 1


def packed_fields(t: StructType, values: Mapping[str, Value]) -> int:
    """The bits of a structure, from the complete values of its fields."""
    bits = 0
    for field, offset in field_offsets(t).items():
        bits = overlaid(bits, packed(field.type, values[field.key]), offset, bit_size(field.type) or 0)
    return bits


def _joined(t: ArrayType, value: Value, stride: int, dimensions: int) -> int:
    if dimensions == 0:
        return packed(t.element, value)
    assert isinstance(value, Sequence)
    rest = math.prod(t.lengths[len(t.bounds) - dimensions + 1 :])
    return sum(_joined(t, item, stride, dimensions - 1) << i * stride * rest for i, item in enumerate(value))


def overlaid(bits: int, value: int, offset: int, size: int) -> int:
    """Bits with a value of `size` bits laid over them; one that is 0 leaves them, so that of variables in one place
    those without an initial value do not undo that of another."""
    if not value:
        return bits
    return bits & ~(((1 << size) - 1) << offset) | value << offset
