"""The layout of the memory image: which slots of V and O each variable gets."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from iec2mpy.ir import nodes as n
from iec2mpy.semantics import types as ty
from iec2mpy.semantics.typed import Pou, Value, Variable
from iec2mpy.syntax.tree import PouKind, Section

# slots of V that belong to the controller (`mcu_runtime/slots.py` has the same numbers)
NOW = 1
LOOP = 2
SITE = 3
FIRST = 8
FIRST_OBJECT = 1

MAX_SLOTS = 1 << 16
"""A reference has 16 bits for a slot of V …"""
MAX_OBJECTS = 1 << 14
"""… and 14 for one of O."""


@dataclass(frozen=True, slots=True)
class Size:
    """So many slots of V and of O; also a position in both."""

    v: int
    o: int

    def __add__(self, other: Size) -> Size:
        return Size(self.v + other.v, self.o + other.o)

    def times(self, count: int) -> Size:
        return Size(self.v * count, self.o * count)

    def of(self, array: str) -> int:
        """The part in one of the two arrays."""
        return self.v if array == "V" else self.o


_SLOT = Size(1, 0)
_OBJECT = Size(0, 1)
NOWHERE = Size(0, 0)


Homes = Mapping[Pou, Size]
"""The bases of the instances that a variable stands in, from the program inwards."""


def packed(at: Size, size: Size) -> int:
    """A reference to what has that position and size, as a number: V in the low 16 bits, O above."""
    if not size.o:
        return at.v
    return (at.v if size.v else 0) | at.o << 16


@dataclass(frozen=True, slots=True)
class Record:
    """Where the variables of a block, a frame or a structure stand, from its base."""

    offsets: dict[Variable, Size]
    size: Size


@dataclass(slots=True)
class Layout:
    """The positions of everything.

    `located` by address: all variables at one address are one storage, except for those that lie among the bytes of
    `shared`: these are `sharing`. `instances` by the number of the program. A constant too large for the code of a
    32-bit viper has a slot of V of its own (`constants`); in viper each integer of 64 bits has one of O
    (`object_constants`), as a literal would be a machine word.
    """

    module: n.Module
    globals: dict[Variable, Size] = field(default_factory=dict)
    located: dict[str, tuple[Variable, Size]] = field(default_factory=dict)
    shared: dict[Variable, Size] = field(default_factory=dict)
    sharing: list[Variable] = field(default_factory=list)
    instances: list[Size] = field(default_factory=list)
    frames: dict[Pou, Size] = field(default_factory=dict)
    constants: dict[int, int] = field(default_factory=dict)
    object_constants: dict[int, int] = field(default_factory=dict)
    size: Size = Size(FIRST, FIRST_OBJECT)
    _records: dict[Pou | ty.StructType, Record] = field(default_factory=dict)
    _frame_records: dict[Pou, Record] = field(default_factory=dict)
    _single_bases: dict[Pou, Size | None] = field(default_factory=dict)

    # -------------------------------------------------------------------------------------- sizes

    def size_of(self, declared: ty.Type) -> Size:
        """The slots that a value of this type takes."""
        declared = ty.base_type(declared)
        if isinstance(declared, ty.ArrayType):
            return self.size_of(declared.element).times(math.prod(declared.lengths))
        if isinstance(declared, ty.OpenArrayType):
            return self.size_of(declared.element)  # what matters is in which arrays it has a part
        if isinstance(declared, (ty.StructType, ty.BlockType)):
            return self.record(declared).size
        stored = ty.value_type(declared)
        assert stored is not None
        return _OBJECT if stored.in_objects else _SLOT

    def record(self, declared: ty.StructType | ty.BlockType) -> Record:
        """The layout of a structure or of a block's instances."""
        if isinstance(declared, ty.BlockType):
            return self.instance_record(declared.pou)
        if declared not in self._records:
            fields = list(declared.fields.values()) if declared.storage is None else [declared.storage]
            self._records[declared] = self._lay_out(fields)
        return self._records[declared]

    def instance_record(self, pou: Pou) -> Record:
        """What an instance of a block or program keeps: all but VAR_TEMP and what is elsewhere."""
        if pou not in self._records:
            elsewhere = (Section.TEMP, Section.EXTERNAL)
            kept = [v for v in pou.variables.values() if v.section not in elsewhere and v.address is None]
            self._records[pou] = self._lay_out(kept)
        return self._records[pou]

    def frame_record(self, pou: Pou) -> Record:
        """What a POU holds only while it runs."""
        if pou not in self._frame_records:
            variables = list(pou.variables.values())
            if pou.kind is not PouKind.FUNCTION:
                variables = [v for v in variables if v.section is Section.TEMP]
            held = [v for v in variables if v.section is not Section.EXTERNAL]
            if pou.result is not None:
                held.append(pou.result)
            body = self.module.bodies.get(pou)
            self._frame_records[pou] = self._lay_out([*held, *(body.hidden if body else ())])
        return self._frame_records[pou]

    def _lay_out(self, variables: Sequence[Variable]) -> Record:
        offsets: dict[Variable, Size] = {}
        at = NOWHERE
        for variable in variables:
            offsets[variable] = at
            at += self.storage_of(variable)
        return Record(offsets, at)

    def storage_of(self, variable: Variable) -> Size:
        """The slots of a variable: an in-out is a reference, in one slot."""
        return _SLOT if variable.by_reference else self.size_of(variable.type)

    # ---------------------------------------------------------------------------------- positions

    def place(self, variable_size: Size) -> Size:
        """Takes the next free slots."""
        at = self.size
        self.size += variable_size
        return at

    def place_global(self, variable: Variable) -> None:
        """Gives a global or located variable its place, unless it has one."""
        if variable.shared is not None:
            self.sharing.append(variable)
        elif variable.address is None:
            self.globals[variable] = self.place(self.size_of(variable.type))
        elif variable.address not in self.located:
            self.located[variable.address] = variable, self.place(self.size_of(variable.type))

    def global_position(self, variable: Variable) -> Size:
        if variable in self.shared:
            return self.shared[variable]
        return self.globals[variable] if variable.address is None else self.located[variable.address][1]

    def first_bit(self, variable: Variable) -> int:
        """Where a variable among shared bytes begins: 8 times the slot of V of a byte, and the bit in it."""
        assert variable.shared is not None
        return 8 * self.shared[variable.shared.storage].v + variable.shared.bit

    def constant(self, value: int) -> int:
        """The slot of V that holds a constant."""
        if value not in self.constants:
            self.constants[value] = self.place(_SLOT).v
        return self.constants[value]

    def object_constant(self, value: int) -> int:
        """The slot of O that holds a constant."""
        if value not in self.object_constants:
            self.object_constants[value] = self.place(_OBJECT).o
        return self.object_constants[value]

    def single_base(self, pou: Pou) -> Size | None:
        """The base of the one instance that a block or program has in all of the application, or None where there are
        several. Such a body needs no base at run time."""
        return self._single_bases.get(pou)

    def storages(self) -> Iterator[tuple[ty.Type, Value, Size, Homes]]:
        """Everything that has a place and an initial value: (type, value, position, the instance that it stands in)."""
        for variable, at in (*self.globals.items(), *self.located.values(), *self.shared.items()):
            yield variable.type, variable.initial, at, {}
        runs = zip(self.module.programs, self.instances, strict=True)
        records: list[tuple[Record, Size, Homes]] = [
            *((self.instance_record(run.pou), base, {run.pou: base}) for run, base in runs),
            *((self.frame_record(pou), base, {}) for pou, base in self.frames.items()),
        ]
        for record, base, homes in records:
            for variable, offset in record.offsets.items():
                if not variable.by_reference:
                    yield variable.type, variable.initial, base + offset, homes

    def retained(self) -> Iterator[tuple[Size, Size]]:
        """The positions and sizes of what keeps its value over a warm restart."""
        for variable, at in (*self.globals.items(), *self.located.values(), *self.shared.items()):
            yield from self._retained_in(variable.type, at, bool(variable.retain))
        for run, base in zip(self.module.programs, self.instances, strict=True):
            yield from self._retained_in_record(self.instance_record(run.pou), base, run.retain)

    def _retained_in_record(self, record: Record, base: Size, inherited: bool) -> Iterator[tuple[Size, Size]]:
        """What says nothing of its own does as its instance does (6.5.6.2). References are not kept: where a variable
        is may differ from one version of a program to the next."""
        for variable, offset in record.offsets.items():
            if not variable.by_reference:
                retain = inherited if variable.retain is None else variable.retain
                yield from self._retained_in(variable.type, base + offset, retain)

    def _retained_in(self, declared: ty.Type, at: Size, retain: bool) -> Iterator[tuple[Size, Size]]:
        shape = ty.unaliased(declared)
        if isinstance(shape, ty.BlockType):
            yield from self._retained_in_record(self.record(shape), at, retain)
        elif not (ty.holds_instance(shape) or ty.holds_reference(shape)):
            if retain:
                yield at, self.size_of(shape)
        elif isinstance(shape, ty.ArrayType):
            element = self.size_of(shape.element)
            for number in range(math.prod(shape.lengths)):
                yield from self._retained_in(shape.element, at + element.times(number), retain)
        elif isinstance(shape, ty.StructType):
            for variable, offset in self.record(shape).offsets.items():
                yield from self._retained_in(variable.type, at + offset, retain)

    def find_single_bases(self) -> None:
        """Counts the instances of each block and program, once all have their positions."""
        bases: dict[Pou, list[Size]] = {}
        for run, base in zip(self.module.programs, self.instances, strict=True):
            bases.setdefault(run.pou, []).append(base)
        for declared, _, at, _ in self.storages():
            for pou, base in self._instances_in(declared, at):
                bases.setdefault(pou, []).append(base)
        self._single_bases = {pou: found[0] if len(found) == 1 else None for pou, found in bases.items()}

    def _instances_in(self, declared: ty.Type, at: Size) -> Iterator[tuple[Pou, Size]]:
        """The block instances in a variable; of an array of instances, two stand for all."""
        declared = ty.unaliased(declared)
        if isinstance(declared, ty.ArrayType):
            element = self.size_of(declared.element)
            for number in range(min(math.prod(declared.lengths), 2)):
                yield from self._instances_in(declared.element, at + element.times(number))
        elif isinstance(declared, ty.StructType):
            for variable, offset in self.record(declared).offsets.items():
                yield from self._instances_in(variable.type, at + offset)
        elif isinstance(declared, ty.BlockType):
            yield declared.pou, at
            for variable, offset in self.record(declared).offsets.items():
                if not variable.by_reference:
                    yield from self._instances_in(variable.type, at + offset)


def lay_out(module: n.Module) -> Layout:
    """Gives everything in the module its place: globals and located variables, programs, frames."""
    layout = Layout(module)
    located = [v for pou in module.bodies for v in pou.variables.values() if v.address is not None]
    for variable in (*module.globals, *located):
        layout.place_global(variable)
    for storage in module.storages:
        layout.shared[storage] = layout.place(layout.size_of(storage.type))
    for run in module.programs:
        layout.instances.append(layout.place(layout.instance_record(run.pou).size))
    for pou in module.bodies:
        layout.frames[pou] = layout.place(layout.frame_record(pou).size)
    layout.find_single_bases()
    return layout
