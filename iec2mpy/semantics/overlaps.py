"""Addresses that overlap (6.5.5.3): `%MB20` is the low byte of `%MW10`, `%MX20.3` its bit 3.

An address that nothing overlaps is a place of its own. All variables of a group of addresses that overlap lie among the
same bytes, which are a variable without a name.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from iec2mpy.semantics.conversions import same_type
from iec2mpy.semantics.packing import bit_size, overlaid, packed, starts_at_bit
from iec2mpy.semantics.scope import UNKNOWN, GlobalScope
from iec2mpy.semantics.typed import SharedPlace, Variable
from iec2mpy.semantics.types import BYTE, ArrayType
from iec2mpy.source.diagnostics import Related
from iec2mpy.syntax import tree

SIZES = {"X": 1, "B": 8, "W": 16, "D": 32, "L": 64}
"""Bits of an address by its size prefix (table 16)."""
_BYTE = 8


@dataclass(frozen=True, slots=True)
class _Extent:
    """`group`: the addresses that can overlap each other; `end` is the bit after the last."""

    group: str
    start: int
    end: int
    variable: Variable


def share_storage(world: GlobalScope) -> list[Variable]:
    """Gives each variable that overlaps another its place among shared bytes; the result is these bytes."""
    extents: dict[int, _Extent] = {}
    for variable in (*world.located, *world.direct.values()):
        if variable.type is not UNKNOWN:
            extents[id(variable)] = _extent(variable)
    storages: list[Variable] = []
    for cluster in _clusters(list(extents.values())):
        if not _is_plain(cluster) and _may_share(world, cluster):
            _refuse_references(world, cluster)
            storages.append(_share(cluster))
    return storages


def _refuse_references(world: GlobalScope, cluster: Sequence[_Extent]) -> None:
    for variable in (extent.variable for extent in cluster):
        if variable.referred is not None:
            message = f"{variable.address} shares its storage with other addresses: it cannot be referred to."
            hint = "Copy it to a variable of its own, and refer to that."
            world.diagnostics.add("E0608", message, variable.referred, hint)


def place_of(address: str) -> tuple[str, int, int]:
    """The group of addresses that may overlap this one, its first bit there, and its size in bits."""
    area, size = address[1], address[2]
    path = [int(part) for part in address[3:].split(".")]
    if size == "X" and len(path) == 2 and path[1] < _BYTE:
        start = path[0] * _BYTE + path[1]
    elif len(path) == 1:
        start = path[0] * SIZES[size]
    else:
        return address, 0, SIZES[size]  # a hierarchical address is a place of its own
    # a channel of a board overlaps only those of its kind: bits with their bytes, words with words
    group = area if area == "M" else area + ("bits" if size in "XB" else "words")
    return group, start, SIZES[size]


def _extent(variable: Variable) -> _Extent:
    group, start, size = place_of(variable.address or "")
    return _Extent(group, start, start + max(bit_size(variable.type) or 0, size), variable)


def _clusters(extents: list[_Extent]) -> list[list[_Extent]]:
    """The extents in groups that do not touch each other's storage."""
    clusters: list[list[_Extent]] = []
    end = 0
    for extent in sorted(extents, key=lambda e: (e.group, e.start, e.end)):
        if clusters and clusters[-1][0].group == extent.group and extent.start < end:
            clusters[-1].append(extent)
            end = max(end, extent.end)
        else:
            clusters.append([extent])
            end = extent.end
    return clusters


def _is_plain(cluster: Sequence[_Extent]) -> bool:
    """Whether all of them are one address with one type, which holds no more than one channel of a board: an input or
    output of a byte, of a double word or of an array lies over several."""
    first = cluster[0].variable
    if any(e.variable.address != first.address or not same_type(e.variable.type, first.type) for e in cluster):
        return False
    channel = {"bits": SIZES["X"], "words": SIZES["W"]}.get(cluster[0].group[1:])
    return channel is None or cluster[0].end - cluster[0].start <= channel or bit_size(first.type) is None


def _may_share(world: GlobalScope, cluster: Sequence[_Extent]) -> bool:
    """Whether all have a place among bytes; the first that has none is reported."""
    for extent in cluster:
        variable = extent.variable
        if bit_size(variable.type) is None:
            # 6.4.4.7.1 leaves out strings that overlap
            problem, hint = "cannot share its storage", "Use addresses that do not overlap."
        elif extent.start % _BYTE and not starts_at_bit(variable.type):
            problem, hint = "must begin at a byte", "Give it the address of a byte."
        else:
            continue
        others = [e.variable for e in cluster if e is not extent and e.start < extent.end and extent.start < e.end]
        related = [Related(other.span, f"{other.address} is here.") for other in others[:1]]
        message = f"{variable.address} is {variable.type}, which {problem}."
        world.diagnostics.add("E0711", message, variable.span, hint, related)
        return False
    return True


def byte_addresses(storage: Variable) -> list[str]:
    """The address of each byte of shared storage; of one with levels, its own for all of them."""
    assert isinstance(storage.type, ArrayType)
    ((first, last),) = storage.type.bounds
    if storage.name != f"%{storage.name[1]}B{first}":
        return [storage.name] * (last - first + 1)
    return [f"{storage.name[:3]}{number}" for number in range(first, last + 1)]


def _share(cluster: Sequence[_Extent]) -> Variable:
    """The bytes for a cluster, with the initial values of its variables in the order of the program."""
    group = cluster[0].group
    first, end = cluster[0].start // _BYTE, max(e.end for e in cluster)
    count = -(-end // _BYTE) - first
    ordered = sorted((e for e in cluster), key=lambda e: (e.variable.span.file.path, e.variable.span.start))
    bits = 0
    for extent in ordered:
        variable = extent.variable
        size = bit_size(variable.type) or 0
        bits = overlaid(bits, packed(variable.type, variable.initial), extent.start - first * _BYTE, size)
    variables = [extent.variable for extent in ordered]
    storage = Variable(
        group if group.startswith("%") else f"%{group[0]}B{first}",
        ArrayType(BYTE, ((first, first + count - 1),)),
        tree.Section.GLOBAL,
        variables[0].span,
        tuple(bits.to_bytes(count, "little")),
        retain=True if any(v.retain for v in variables) else None,
    )
    for extent in cluster:
        extent.variable.shared = SharedPlace(storage, extent.start - first * _BYTE)
    return storage
