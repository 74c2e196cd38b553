"""Variables among shared bytes: each read and write is composed of reads and writes of the bytes, little endian."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import overload

from iec2mpy.ir import nodes as n
from iec2mpy.ir.build.context import Context
from iec2mpy.ir.build.conversions import bit_string, from_bits, to_bits
from iec2mpy.ir.build.parts import joined, read_part, with_part
from iec2mpy.semantics import types as ty
from iec2mpy.semantics.packing import element_bits, field_offsets
from iec2mpy.semantics.typed import Variable

_BYTE = 8


@dataclass(frozen=True, slots=True)
class PackedPlace:
    """A value among bytes, which means the same after any statement.

    `storage`: the place of an array of BYTE; `bit`: from its first bit. `byte_index` and `bit_index` are what
    subscripts add to that, in bytes and in bits: a constant or a local, or None. `type` as in a Place.
    """

    storage: n.Place
    bit: int
    type: ty.Type
    byte_index: n.Expr | None = None
    bit_index: n.Expr | None = None


AnyPlace = n.Place | PackedPlace


def field_of(place: PackedPlace, field: Variable) -> PackedPlace:
    """A field of a structure."""
    assert isinstance(place.type, ty.StructType)
    return replace(place, bit=place.bit + field_offsets(place.type)[field], type=ty.unaliased(field.type))


def element_of(context: Context, place: PackedPlace, index: n.Expr) -> PackedPlace:
    """An element of an array, by its number from 0."""
    assert isinstance(place.type, ty.ArrayType)
    element, stride = ty.unaliased(place.type.element), element_bits(place.type)
    assert stride is not None, "the checker lets only what has a size among bytes"
    if isinstance(index, n.Const):
        return replace(place, bit=place.bit + stride * index.number, type=element)
    if stride == 1:
        return replace(place, bit_index=context.kept(index), type=element)
    step = n.Op("mul", index, n.Const(stride // _BYTE, ty.DINT), ty.DINT) if stride > _BYTE else index
    moved = step if place.byte_index is None else n.Op("add", place.byte_index, step, ty.DINT)
    return replace(place, byte_index=context.kept(moved), type=element)


def load(context: Context, place: PackedPlace) -> n.Expr:
    """The single value that is there."""
    stored = ty.value_type(place.type)
    assert isinstance(stored, ty.ElementaryType)
    if stored.bits == 1:
        byte, bit = _bit(context, place)
        value = n.Load(byte, ty.BYTE)
        if isinstance(bit, n.Const):
            return read_part(value, bit.number, stored)
        return n.Wrap(n.Op("shr", value, bit, ty.BYTE), stored)
    parts = [n.Load(_byte(place, number), ty.BYTE) for number in range(stored.bits // _BYTE)]
    return from_bits(context, joined(parts, bit_string(stored)), stored)


def store(context: Context, place: PackedPlace, value: n.Expr) -> None:
    """Stores a single value; the bits around it stay as they are."""
    stored = ty.value_type(place.type)
    assert isinstance(stored, ty.ElementaryType)
    if stored.bits == 1:
        byte, bit = _bit(context, place)
        old = n.Load(byte, ty.BYTE)
        if isinstance(bit, n.Const):
            context.emit(n.Store(byte, with_part(old, bit.number, value)))
            return
        mask = n.Op("shl", n.Const(1, ty.BYTE), bit, ty.BYTE)
        rest = n.Op("and", old, n.Not(mask, ty.BYTE), ty.BYTE)
        moved = n.Op("shl", n.Wrap(value, ty.BYTE), bit, ty.BYTE)
        context.emit(n.Store(byte, n.Op("or", rest, moved, ty.BYTE)))
        return
    whole = context.kept(to_bits(context, value, stored))
    for number in range(stored.bits // _BYTE):
        part = read_part(whole, number * _BYTE, ty.BYTE) if stored.bits > _BYTE else whole
        context.emit(n.Store(_byte(place, number), part))


def _byte(place: PackedPlace, number: int, index: n.Expr | None = None) -> n.Place:
    """The place of a byte: that many behind the one where the value begins; `index` is added to it."""
    at: n.Expr = n.Const(place.bit // _BYTE + number, ty.DINT)
    for more in (place.byte_index, index):
        if more is not None:
            at = n.Op("add", more, at, ty.DINT)
    return n.Place(place.storage.root, (*place.storage.steps, n.Element(at)), ty.BYTE)


def _bit(context: Context, place: PackedPlace) -> tuple[n.Place, n.Expr]:
    """The byte that holds a BOOL, and the number of its bit there."""
    first = place.bit % _BYTE
    if place.bit_index is None:
        return _byte(place, 0), n.Const(first, ty.INT)
    assert isinstance(place.storage.type, ty.ArrayType)
    at = context.new_local(ty.DINT, 0, _BYTE * place.storage.type.lengths[0])
    context.emit(n.SetLocal(at, n.Op("add", place.bit_index, n.Const(first, ty.DINT), ty.DINT)))
    byte = _byte(place, 0, n.Op("shr", at, n.Const(3, ty.DINT), ty.DINT))
    return byte, n.Op("and", at, n.Const(_BYTE - 1, ty.DINT), ty.DINT)


# ------------------------------------------------------------------------------------------ whole values

_UNROLLED = 8
"""So many elements are written out; more are a loop."""


def unpack(context: Context, target: n.Place, source: PackedPlace) -> None:
    """Copies a value of any type from among bytes to a place of its own."""

    def take(plain: n.Place, packed: AnyPlace) -> None:
        assert isinstance(packed, PackedPlace)
        context.emit(n.Store(plain, load(context, packed)))

    each_value(context, target, source, take)


def pack(context: Context, target: PackedPlace, source: n.Place) -> None:
    """Copies a value of any type from a place of its own to one among bytes."""

    def put(plain: n.Place, packed: AnyPlace) -> None:
        stored = ty.value_type(plain.type)
        assert stored is not None
        assert isinstance(packed, PackedPlace)
        store(context, packed, n.Load(plain, stored))

    each_value(context, source, target, put)


def each_value(context: Context, one: n.Place, other: AnyPlace, copy: Callable[[n.Place, AnyPlace], None]) -> None:
    """Calls `copy` for each single value of two places, which have the same type; inside of loops for arrays."""
    shape = one.type
    if isinstance(shape, ty.StructType):
        for field in [shape.storage] if shape.storage is not None else shape.fields.values():
            each_value(context, _field(one, field), _field(other, field), copy)
    elif isinstance(shape, ty.ArrayType):
        count = math.prod(shape.lengths)
        if count <= _UNROLLED:
            for number in range(count):
                index = n.Const(number, ty.DINT)
                each_value(context, _element(context, one, index), _element(context, other, index), copy)
            return
        counter = context.new_local(ty.DINT, 0, count)
        context.emit(n.SetLocal(counter, n.Const(0, ty.DINT)))
        with context.block() as body:
            each_value(context, _element(context, one, counter), _element(context, other, counter), copy)
            context.emit(n.SetLocal(counter, n.Op("add", counter, n.Const(1, ty.DINT), ty.DINT)))
        context.emit(n.While(n.Op("lt", counter, n.Const(count, ty.DINT), ty.BOOL), tuple(body)))
    else:
        copy(one, other)


@overload
def _field(place: n.Place, field: Variable) -> n.Place: ...
@overload
def _field(place: AnyPlace, field: Variable) -> AnyPlace: ...
def _field(place: AnyPlace, field: Variable) -> AnyPlace:
    declared = ty.unaliased(field.type)
    if isinstance(place, n.Place):
        return replace(place, steps=(*place.steps, n.Field(field)), type=declared)
    assert isinstance(place.type, ty.StructType)
    return replace(place, type=declared) if field is place.type.storage else field_of(place, field)


@overload
def _element(context: Context, place: n.Place, index: n.Expr) -> n.Place: ...
@overload
def _element(context: Context, place: AnyPlace, index: n.Expr) -> AnyPlace: ...
def _element(context: Context, place: AnyPlace, index: n.Expr) -> AnyPlace:
    if not isinstance(place, n.Place):
        return element_of(context, place, index)
    assert isinstance(place.type, ty.ArrayType)
    return replace(place, steps=(*place.steps, n.Element(index)), type=ty.unaliased(place.type.element))
