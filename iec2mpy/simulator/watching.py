"""The variables that a simulation shows and records: inputs, outputs, and those that somebody asked for."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from iec2mpy.backends.coding import parse_duration
from iec2mpy.backends.memory_map import Leaf, MemoryMap
from iec2mpy.semantics.arithmetic import NANOSECONDS
from iec2mpy.simulator.session import Simulation
from iec2mpy.simulator.trace import Column, Number

_NUMBERS = ("integer", "unsigned32", "integer64", "real", "lreal", "duration", "ltime")
_DRAWN = {"bool": "bool", **dict.fromkeys(_NUMBERS, "number")}
"""How a kind of variable is drawn; all others are texts."""


@dataclass(frozen=True, slots=True)
class Watched:
    """One value that is watched. `group`: "inputs", "outputs" or "watched"."""

    group: str
    leaf: Leaf

    @property
    def address(self) -> str:
        return self.leaf.variable.address or ""

    @property
    def path(self) -> str:
        """The variable's own name, or its address where it has none."""
        return self.address if self.leaf.path.startswith("%") else self.leaf.path

    @property
    def column(self) -> Column:
        return Column(self.path, _DRAWN.get(self.leaf.variable.kind, "text"))


def watch(memory_map: MemoryMap, paths: Sequence[str]) -> list[Watched]:
    """All inputs, all outputs, then what `paths` name, each variable once. Raises UnknownPath."""
    watched: dict[tuple[str, int], Watched] = {}
    for area, group in (("%I", "inputs"), ("%Q", "outputs")):
        located = (v for v in memory_map.variables if v.address and v.address.upper().startswith(area))
        for variable in sorted(located, key=lambda v: _address_key(v.address or "")):
            leaf = Leaf(variable, variable.path, variable.slot)
            watched.setdefault((variable.array, variable.slot), Watched(group, leaf))
    for path in paths:
        for leaf in memory_map.leaves(memory_map.resolve(path)):
            watched.setdefault((leaf.variable.array, leaf.slot), Watched("watched", leaf))
    return list(watched.values())


def _address_key(address: str) -> tuple[str, list[int]]:
    """`%QX0.10` comes after `%QX0.9`."""
    return address[:3], [int(part) for part in address[3:].split(".")]


def values(simulation: Simulation, watched: Sequence[Watched]) -> list[object]:
    """Their values as they are shown: a duration as `T#…` or `LT#…`, an enumeration by its name."""
    return simulation.get_leaves([w.leaf for w in watched])


def numbers(watched: Sequence[Watched], shown: Sequence[object]) -> list[Number | str]:
    """The same values for a trace: a duration in milliseconds."""
    return [_number(w, value) for w, value in zip(watched, shown, strict=True)]


def _number(watched: Watched, shown: object) -> Number | str:
    assert isinstance(shown, (bool, int, float, str))
    match watched.leaf.variable.kind:
        case "duration":
            return parse_duration(str(shown)) // NANOSECONDS
        case "ltime":
            return parse_duration(str(shown)) / NANOSECONDS
        case _:
            return shown
