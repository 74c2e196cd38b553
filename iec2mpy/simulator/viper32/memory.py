"""Memory as pointers see it: every buffer that is turned into a pointer gets a made-up 32-bit address.

Addresses lie where an RP2040 has its RAM, and below 2^30, so that an address is a small int as it is there. Buffers lie
far from each other: a pointer that runs over an end hits nothing, and that is a fault.
"""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass
from typing import Any, Literal

from iec2mpy.simulator.viper32.errors import fault

_FIRST = 0x20000000
_GAP = 0x100000
_WORD = 0xFFFFFFFF
_FORMATS: dict[int, Literal["B", "H", "i"]] = {1: "B", 2: "H", 4: "i"}

View = tuple[int, Any, int]
"""The address, what is indexed from it, and how many elements that has."""


@dataclass(frozen=True, slots=True)
class _Region:
    """`buffer` is kept so that its identity stays its own."""

    start: int
    size: int
    buffer: Any
    data: memoryview


class Memory:
    """The buffers of one loaded module."""

    def __init__(self) -> None:
        self._regions: list[_Region] = []
        self._starts: list[int] = []
        self._by_identity: dict[int, int] = {}
        self._views: dict[tuple[int, int], View] = {}

    def address(self, value: Any) -> int:
        """What a cast to a pointer makes of an object: the address of a buffer, or an int's low 32 bits."""
        if type(value) is int:
            return value & _WORD
        known = self._by_identity.get(id(value))
        return known if known is not None else self._place(value)

    def view(self, address: int, width: int) -> View:
        """What a pointer to elements of `width` bytes can index upward from `address`; nothing where no buffer is."""
        found = self._views.get((address, width))
        return found if found is not None else self._make_view(address, width)

    def load(self, address: int, index: int, width: int) -> int:
        """One element, wherever it is."""
        elements, at = self._element(address, index, width, "wild read")
        return elements[at]

    def store(self, address: int, index: int, width: int, value: int) -> None:
        """`value` is in the range of the element already."""
        elements, at = self._element(address, index, width, "wild write")
        if elements.readonly:
            raise fault("wild write: the memory is read-only")
        elements[at] = value

    def _place(self, value: Any) -> int:
        data = memoryview(value.encode() if isinstance(value, str) else value).cast("B")
        start = _FIRST
        if self._regions:
            last = self._regions[-1]
            start = (last.start + last.size + _GAP + 15) & ~15
        if start + len(data) >= 1 << 30:
            raise MemoryError("the model's address space is full")
        self._regions.append(_Region(start, len(data), value, data))
        self._starts.append(start)
        self._by_identity[id(value)] = start
        return start

    def _region(self, address: int) -> _Region | None:
        position = bisect_right(self._starts, address) - 1
        if position < 0:
            return None
        region = self._regions[position]
        return region if address < region.start + region.size else None

    def _make_view(self, address: int, width: int) -> View:
        region = self._region(address)
        if region is None or address % width or region.data.readonly:
            return (address, (), 0)  # not kept: a buffer may get this address later
        offset = address - region.start
        count = (region.size - offset) // width
        view = (address, region.data[offset : offset + count * width].cast(_FORMATS[width]), count)
        self._views[address, width] = view
        return view

    def _element(self, address: int, index: int, width: int, what: str) -> tuple[memoryview, int]:
        target = (address + index * width) & _WORD
        region = self._region(target)
        if region is None or target + width > region.start + region.size:
            raise fault(f"{what}: index {index} of a pointer to 0x{address:08x}")
        if target % width:
            raise fault(f"{what}: address 0x{target:08x} is not a multiple of {width}")
        offset = target - region.start
        return region.data[offset : offset + width].cast(_FORMATS[width]), 0
