"""The map of the memory image: which slot holds which variable, and how values look from outside.

Written as `program.map.json` beside the program. A variable in it is a leaf: one value, or all the elements of arrays
that are alike, with subscripts left open (`main.a[].x`). What is asked for may be more than a leaf: `main.a` is a list,
`main.a[2]` a table.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, field

from iec2mpy.backends.coding import decode, encode
from iec2mpy.backends.shared_bytes import Patch, joined, places_of, split
from iec2mpy.semantics.types import ELEMENTARY, MOMENTS


@dataclass(frozen=True, slots=True)
class Dimension:
    """`stride`: slots from one element to the next."""

    low: int
    high: int
    stride: int


@dataclass(frozen=True, slots=True)
class MappedVariable:
    """A leaf. `path` as declared, with `[]`, `[,]`, … for subscripts; `kind` how its value is coded (`coding.py`);
    `low`, `high` the values that an integer may have, and the capacity of a string.

    `array` is V or O, or B for a variable among shared bytes, each in a slot of V: its `slot` and strides count bits,
    from slot 0 on, and `bits` is its size (`shared_bytes.py`)."""

    path: str
    type: str
    kind: str
    array: str
    slot: int
    low: int = 0
    high: int = 0
    dimensions: tuple[Dimension, ...] = ()
    address: str | None = None
    constant: bool = False
    file: str = ""
    line: int = 0
    bits: int = 0


@dataclass(frozen=True, slots=True)
class Site:
    """A place that may raise a fault."""

    number: int
    file: str
    line: int
    pou: str


@dataclass(frozen=True, slots=True)
class Leaf:
    """One value in its slot."""

    variable: MappedVariable
    path: str
    slot: int


@dataclass(frozen=True, slots=True)
class Group:
    """A whole array (`items`) or structure (`fields`, by their names as declared)."""

    path: str
    items: tuple[Node, ...] | None = None
    fields: Mapping[str, Node] = field(default_factory=dict)


Node = Leaf | Group
ReadSlots = Callable[[Sequence[tuple[str, int]]], Sequence[object]]
"""Raw values of places such as ("V", 8)."""
Written = tuple[str, int, object]
"""A raw value for a place."""


class UnknownPath(LookupError):
    """The program has no such variable; the text says which are near."""


class BadValue(ValueError):
    """The variable cannot have this value; the text says what it can have."""


_TOLD_BY_NAME = {
    **{"bool": "BOOL", "lreal": "LREAL", "character": "CHAR", "string": "STRING", "wstring": "WSTRING"},
    **{t.name.lower(): t.name for t in ELEMENTARY.values() if t.kind in MOMENTS},
    "reference": "REF_TO",
}
"""The types that the board tells by their name, by the kind of a variable."""

_TOKEN = re.compile(r"\.?([^.\[\]]+)|\[([^\]]*)\]")


class MemoryMap:
    """Finds variables by their paths, in any letter case, and reads and writes them through raw slots."""

    def __init__(
        self,
        variables: Sequence[MappedVariable],
        enums: Mapping[str, Mapping[str, int]],
        sites: Sequence[Site],
        program: str,
    ) -> None:
        self.variables = tuple(variables)
        self.enums = enums
        self.sites = tuple(sites)
        self.program = program
        self._tree: dict[str, object] = {}
        for variable in self.variables:
            self._plant(variable)
        # an array or structure at an address begins there
        self._by_address = {v.address.upper(): v for v in reversed(self.variables) if v.address}

    def _plant(self, variable: MappedVariable) -> None:
        """Adds a leaf to the tree of names: a step is a case-folded name, or "[]" with its dimensions."""
        dimensions = iter(variable.dimensions)
        branch = self._tree
        steps = [(m[1], m[2]) for m in _TOKEN.finditer(variable.path)]
        for position, (name, subscripts) in enumerate(steps):
            if name is not None:
                key, shown = name.casefold(), name
            else:
                key, shown = "[]", tuple(next(dimensions) for _ in range(subscripts.count(",") + 1))
            entry = branch.setdefault(key, (shown, {}))
            assert isinstance(entry, tuple)
            if position == len(steps) - 1:
                branch[key] = (shown, variable)
            else:
                branch = entry[1]

    # ------------------------------------------------------------------------------------ finding

    def resolve(self, path: str) -> Node:
        """What a path such as `main.a[3].x` or `%IX0.0` names; raises UnknownPath."""
        if path.startswith("%"):
            variable = self._by_address.get(path.upper())
            if variable is None:
                raise UnknownPath(f"the program has nothing at {path}")
            return Leaf(variable, path.upper(), variable.slot)
        branch: object = self._tree
        offsets: list[tuple[int, Dimension]] = []
        walked = ""
        for match in _TOKEN.finditer(path):
            branch, walked = self._step(branch, match, walked, offsets, path)
        return self._node(branch, walked, offsets)

    def _step(
        self, branch: object, match: re.Match[str], walked: str, offsets: list[tuple[int, Dimension]], path: str
    ) -> tuple[object, str]:
        name, subscripts = match[1], match[2]
        if not isinstance(branch, dict):
            raise UnknownPath(f"{walked} has no parts, in {path}")
        if name is not None:
            entry = branch.get(name.strip().casefold())
            if entry is None:
                raise UnknownPath(self._unknown(name, walked, branch))
            return entry[1], f"{walked}.{entry[0]}".lstrip(".")
        if "[]" not in branch:
            raise UnknownPath(f"{walked} is no array, in {path}")
        dimensions, inner = branch["[]"]
        try:
            numbers = [int(part) for part in subscripts.split(",")]
        except ValueError:
            raise UnknownPath(f"{walked}[{subscripts}]: a subscript here is a number") from None
        if len(numbers) != len(dimensions):
            raise UnknownPath(f"{walked} has {len(dimensions)} dimensions, not {len(numbers)}")
        for number, dimension in zip(numbers, dimensions, strict=True):
            if not dimension.low <= number <= dimension.high:
                raise UnknownPath(f"{walked}[{subscripts}]: {number} is not in {dimension.low}..{dimension.high}")
        offsets.extend(zip(numbers, dimensions, strict=True))
        return inner, f"{walked}[{','.join(map(str, numbers))}]"

    def _unknown(self, name: str, walked: str, branch: Mapping[str, tuple[object, object]]) -> str:
        from iec2mpy.source.suggest import suggest

        where = f"{walked} has no {name}" if walked else f"there is no {name}"
        # a variable's own name, without that of its program, is what newcomers write
        inside = (v.path for v in self.variables if v.path.casefold().endswith(f".{name.casefold()}"))
        near = suggest(name, [str(shown) for key, (shown, _) in branch.items() if key != "[]"]) or next(inside, None)
        return f"{where}; did you mean {near}?" if near else where

    def _node(self, branch: object, walked: str, offsets: list[tuple[int, Dimension]]) -> Node:
        if isinstance(branch, MappedVariable):
            # the dimensions on the way were taken from some leaf below: each leaf has strides of its own
            slot = branch.slot
            for (number, _), dimension in zip(offsets, branch.dimensions, strict=True):
                slot += (number - dimension.low) * dimension.stride
            return Leaf(branch, walked, slot)
        assert isinstance(branch, dict)
        if "[]" in branch:
            dimensions, inner = branch["[]"]
            return self._array(inner, walked, offsets, list(dimensions), [])
        fields = {shown: self._node(inner, f"{walked}.{shown}", offsets) for shown, inner in branch.values()}
        return Group(walked, fields=fields)

    def _array(
        self,
        inner: object,
        walked: str,
        offsets: list[tuple[int, Dimension]],
        dimensions: list[Dimension],
        numbers: list[tuple[int, Dimension]],
    ) -> Node:
        if not dimensions:
            subscripts = ",".join(str(number) for number, _ in numbers)
            return self._node(inner, f"{walked}[{subscripts}]", [*offsets, *numbers])
        dimension, *rest = dimensions
        items = (
            self._array(inner, walked, offsets, rest, [*numbers, (number, dimension)])
            for number in range(dimension.low, dimension.high + 1)
        )
        return Group(walked, items=tuple(items))

    # ------------------------------------------------------------------------- reading and writing

    def leaves(self, node: Node) -> Iterable[Leaf]:
        """The single values of a node."""
        if isinstance(node, Leaf):
            yield node
            return
        for part in (*(node.items or ()), *node.fields.values()):
            yield from self.leaves(part)

    def read(self, node: Node, read_slots: ReadSlots) -> object:
        """The value: bool, int, float, str; a duration as `T#…` or `LT#…`, an enumeration as its name; lists and
        tables of these."""
        leaves = list(self.leaves(node))
        values = dict(zip(leaves, self.read_leaves(leaves, read_slots), strict=True))

        def build(part: Node) -> object:
            if isinstance(part, Leaf):
                return values[part]
            if part.items is not None:
                return [build(item) for item in part.items]
            return {name: build(inner) for name, inner in part.fields.items()}

        return build(node)

    def read_leaves(self, leaves: Sequence[Leaf], read_slots: ReadSlots) -> list[object]:
        """The values of many leaves, with one reading of slots."""
        places = [places_of(leaf.variable, leaf.slot) for leaf in leaves]
        raw = iter(read_slots([place for group in places for place in group]))
        stored = [[next(raw) for _ in group] for group in places]
        return [
            self.decode(leaf, joined(leaf.variable, leaf.slot, parts))
            for leaf, parts in zip(leaves, stored, strict=True)
        ]

    def decode(self, leaf: Leaf, raw: object) -> object:
        """The value of a slot as it is shown."""
        return decode(leaf.variable.kind, raw, self.enums.get(leaf.variable.type, {}))

    def write(self, node: Node, value: object, read_slots: ReadSlots) -> list[Written]:
        """The raw values that give the node a value; of a structure, only the fields named. Raises BadValue."""
        plain: list[Written] = []
        patches: dict[int, Patch] = {}
        for leaf, raw in self.encode(node, value):
            if leaf.variable.array == "B":
                split(leaf.variable, leaf.slot, raw, patches)
            else:
                plain.append((leaf.variable.array, leaf.slot, raw))
        slots = list(patches)
        old = read_slots([("V", slot) for slot in slots]) if slots else []
        return plain + [("V", slot, patches[slot].over(byte)) for slot, byte in zip(slots, old, strict=True)]

    def encode(self, node: Node, value: object) -> list[tuple[Leaf, object]]:
        """The single values of a node's value, in their raw form; of a structure, only the fields named. Raises
        BadValue."""
        if isinstance(node, Leaf):
            variable = node.variable
            try:
                raw = encode(variable.kind, value, variable.low, variable.high, self.enums.get(variable.type, {}))
            except ValueError as error:
                raise BadValue(f"{node.path} is {variable.type}: {error}") from None
            return [(node, raw)]
        if node.items is not None:
            if not isinstance(value, Sequence) or isinstance(value, str) or len(value) != len(node.items):
                raise BadValue(f"{node.path} is an array of {len(node.items)}: its value is a list of as many")
            return [w for item, part in zip(node.items, value, strict=True) for w in self.encode(item, part)]
        if not isinstance(value, Mapping):
            raise BadValue(f"{node.path} is a structure: its value is a table of its fields")
        encoded = []
        fields = {name.casefold(): part for name, part in node.fields.items()}
        for name, part in value.items():
            if name.casefold() not in fields:
                raise BadValue(f"{node.path} has no field {name}")
            encoded += self.encode(fields[name.casefold()], part)
        return encoded

    def site(self, number: int) -> Site | None:
        """The place with this number, or None."""
        return next((site for site in self.sites if site.number == number), None)

    # ------------------------------------------------------------------------------------- as text

    def to_json(self) -> str:
        """The file `program.map.json`."""
        content = {
            "version": 1,
            "program": self.program,
            "variables": [asdict(variable) for variable in self.variables],
            "enums": {name: dict(values) for name, values in self.enums.items()},
            "sites": [asdict(site) for site in self.sites],
        }
        return json.dumps(content, indent=1) + "\n"

    def to_names(self) -> str:
        """The file `program.names`, which the board reads line by line (docs/internals.md)."""
        lines = []
        for name, values in self.enums.items():
            lines.append("\t".join([f"={name}", *(f"{value}:{number}" for value, number in values.items())]))
        for v in self.variables:
            dimensions = ";".join(f"{d.low}:{d.high}:{d.stride}" for d in v.dimensions)
            bounds = ("", "") if v.kind in ("real", "lreal") else (str(v.low), str(v.high))
            type_name = _TOLD_BY_NAME.get(v.kind, v.type)  # not an alias
            array = f"B{v.bits}" if v.array == "B" else v.array
            lines.append("\t".join([v.path.casefold(), type_name, array, str(v.slot), *bounds, dimensions]))
        lines += ["\t".join([f"@{s.number}", s.file, str(s.line), s.pou]) for s in self.sites]
        return "\n".join(lines) + "\n"
