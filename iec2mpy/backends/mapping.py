"""From the layout to the map: every variable that can be seen from outside, as leaves."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from iec2mpy.backends.layout import NOWHERE, Layout, Size
from iec2mpy.backends.memory_map import Dimension, MappedVariable, MemoryMap, Site
from iec2mpy.semantics import types as ty
from iec2mpy.semantics.packing import bit_size, element_bits, field_offsets
from iec2mpy.semantics.typed import Variable
from iec2mpy.semantics.types import Kind
from iec2mpy.syntax.tree import PouKind, Section

_KINDS = {
    Kind.BOOL: "bool",
    Kind.DURATION: "duration",
    Kind.CHARACTER: "character",
    Kind.REFERENCE: "reference",
}
_WIDE_KINDS = {
    **{ty.REAL: "real", ty.LREAL: "lreal", ty.LTIME: "ltime"},
    **dict.fromkeys((ty.LINT, ty.ULINT, ty.LWORD), "integer64"),
}


def make_map(layout: Layout, sites: list[Site], program: str) -> MemoryMap:
    """The map of all global and located variables, and of the programs with what is in them."""
    enums: dict[str, dict[str, int]] = {}
    variables = list(_variables(layout, enums))
    return MemoryMap(variables, enums, sites, program)


def _variables(layout: Layout, enums: dict[str, dict[str, int]]) -> Iterator[MappedVariable]:
    for variable, at in layout.globals.items():
        yield from _leaves(layout, variable, variable.name, at, enums)
    named: set[str] = set()
    for run, base in zip(layout.module.programs, layout.instances, strict=True):
        for variable in run.pou.variables.values():
            if variable.shared is not None:
                named.add(variable.address or "")
                yield from _shared_leaves(layout, variable, f"{run.name}.{variable.name}", enums)
                continue
            position = _position(layout, run.pou, variable, base)
            if position is None:
                continue
            if variable.address is not None:
                named.add(variable.address)
            yield from _leaves(layout, variable, f"{run.name}.{variable.name}", position, enums)
    for address, (variable, at) in layout.located.items():
        if address not in named:
            yield from _leaves(layout, variable, variable.name, at, enums)
    for variable in layout.sharing:
        if variable.owner is None and variable.name not in named:
            yield from _shared_leaves(layout, variable, variable.name, enums)


def _position(layout: Layout, pou: object, variable: Variable, base: Size) -> Size | None:
    """Where a program's variable is; None for what belongs to others."""
    owner = variable.owner
    assert owner is not None and owner is pou and owner.kind is PouKind.PROGRAM
    if variable.section in (Section.IN_OUT, Section.EXTERNAL):
        return None
    if variable.address is not None:
        return layout.located[variable.address][1]
    if variable.section is Section.TEMP:
        return layout.frames[owner] + layout.frame_record(owner).offsets[variable]
    return base + layout.instance_record(owner).offsets[variable]


def _leaves(
    layout: Layout, variable: Variable, path: str, at: Size, enums: dict[str, dict[str, int]]
) -> Iterator[MappedVariable]:
    for leaf in _type_leaves(layout, variable.type, path, at, {"V": (), "O": ()}, enums):
        yield _declared(leaf, variable)


def _shared_leaves(
    layout: Layout, variable: Variable, path: str, enums: dict[str, dict[str, int]]
) -> Iterator[MappedVariable]:
    for leaf in _packed_leaves(variable.type, path, layout.first_bit(variable), (), enums):
        yield _declared(leaf, variable)


def _declared(leaf: MappedVariable, variable: Variable) -> MappedVariable:
    return replace(
        leaf,
        address=variable.address,
        constant=variable.constant,
        file=variable.span.file.name,
        line=variable.span.line,
    )


def _type_leaves(
    layout: Layout,
    declared: ty.Type,
    path: str,
    at: Size,
    dimensions: dict[str, tuple[Dimension, ...]],
    enums: dict[str, dict[str, int]],
) -> Iterator[MappedVariable]:
    shape = ty.unaliased(declared)
    if isinstance(shape, ty.ArrayType):
        element = layout.size_of(shape.element)
        inner = {array: (*dimensions[array], *_dimensions(shape, element.of(array))) for array in "VO"}
        path += f"[{',' * (len(shape.bounds) - 1)}]"
        yield from _type_leaves(layout, shape.element, path, at, inner, enums)
    elif isinstance(shape, ty.StructType) and shape.storage is not None:
        in_bits = tuple(replace(dimension, stride=8 * dimension.stride) for dimension in dimensions["V"])
        yield from _packed_leaves(shape, path, 8 * at.v, in_bits, enums)
    elif isinstance(shape, (ty.StructType, ty.BlockType)):
        for variable, offset in layout.record(shape).offsets.items():
            if not (variable.by_reference or variable.hidden):
                inner_path = f"{path}.{variable.name}"
                yield from _type_leaves(layout, variable.type, inner_path, at + offset, dimensions, enums)
    else:
        yield _leaf(shape, str(declared), path, at, dimensions, enums)


def _packed_leaves(
    declared: ty.Type, path: str, bit: int, dimensions: tuple[Dimension, ...], enums: dict[str, dict[str, int]]
) -> Iterator[MappedVariable]:
    """The leaves of a variable among bytes; positions and strides are in bits."""
    shape = ty.unaliased(declared)
    if isinstance(shape, ty.ArrayType):
        inner = (*dimensions, *_dimensions(shape, element_bits(shape) or 0))
        path += f"[{',' * (len(shape.bounds) - 1)}]"
        yield from _packed_leaves(shape.element, path, bit, inner, enums)
    elif isinstance(shape, ty.StructType):
        for variable, offset in field_offsets(shape).items():
            yield from _packed_leaves(variable.type, f"{path}.{variable.name}", bit + offset, dimensions, enums)
    else:
        leaf = _leaf(shape, str(declared), path, NOWHERE, {"V": dimensions, "O": dimensions}, enums)
        yield replace(leaf, array="B", slot=bit, bits=bit_size(shape) or 0)


def _dimensions(array: ty.ArrayType, stride: int) -> list[Dimension]:
    """The last subscript runs fastest."""
    found: list[Dimension] = []
    for (low, high), length in zip(reversed(array.bounds), reversed(array.lengths), strict=True):
        found.insert(0, Dimension(low, high, stride))
        stride *= length
    return found


def _leaf(
    shape: ty.Type,
    type_name: str,
    path: str,
    at: Size,
    dimensions: dict[str, tuple[Dimension, ...]],
    enums: dict[str, dict[str, int]],
) -> MappedVariable:
    stored = ty.value_type(shape)
    assert stored is not None
    if isinstance(stored, ty.StringType):
        kind = "wstring" if stored.wide else "string"
        return MappedVariable(path, type_name, kind, "O", at.o, 0, stored.length, dimensions["O"])
    low, high = ty.value_range(shape) or (0, 0)
    array = "O" if stored.in_objects else "V"
    if isinstance(shape, ty.EnumType):
        kind, type_name = "enum", shape.name
        enums[shape.name] = dict(shape.values)
    elif stored.kind in ty.MOMENTS:
        kind = stored.name.lower()
    elif stored.in_objects:
        kind = _WIDE_KINDS[stored]
    else:
        kind = _KINDS.get(stored.kind, "unsigned32" if stored.high >= 1 << 31 else "integer")
    if isinstance(shape, ty.RefType):
        low = high = 0  # only NULL can be written from outside
    return MappedVariable(path, type_name, kind, array, at.of(array), low, high, dimensions[array])
