"""Values among shared bytes, seen from outside: one byte in each slot of V, little endian.

Positions count bits: 8 times the slot of a byte, and the bit in it.
"""

from __future__ import annotations

import struct
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from iec2mpy.backends.memory_map import MappedVariable

_BYTE = 8
_REALS = {32: "<f", 64: "<d"}


@dataclass(frozen=True, slots=True)
class Patch:
    """Bits of a byte that get a value: those of `mask`."""

    mask: int = 0
    value: int = 0

    def over(self, byte: object) -> int:
        """The byte with these bits."""
        assert isinstance(byte, int)
        return byte & ~self.mask | self.value


def places_of(variable: MappedVariable, slot: int) -> list[tuple[str, int]]:
    """The slots that hold a value of the variable which begins at `slot`: of one among bytes, those of its bytes."""
    if variable.array != "B":
        return [(variable.array, slot)]
    return [("V", number) for number in range(slot // _BYTE, -(-(slot + variable.bits) // _BYTE))]


def joined(variable: MappedVariable, slot: int, stored: Sequence[object]) -> object:
    """The raw value of a variable, from what is stored in the slots of `places_of`."""
    if variable.array != "B":
        return stored[0]
    number = _number(stored) >> slot % _BYTE & (1 << variable.bits) - 1
    if variable.kind in ("real", "lreal"):
        return struct.unpack(_REALS[variable.bits], number.to_bytes(variable.bits // _BYTE, "little"))[0]
    return number - (1 << variable.bits) if variable.low < 0 and number >> variable.bits - 1 else number


def _number(stored: Iterable[object]) -> int:
    number = 0
    for position, byte in enumerate(stored):
        assert isinstance(byte, int)
        number |= byte << position * _BYTE
    return number


def split(variable: MappedVariable, slot: int, raw: object, patches: dict[int, Patch]) -> None:
    """Adds a raw value of a variable to what each slot of V gets."""
    if isinstance(raw, float):
        number = int.from_bytes(struct.pack(_REALS[variable.bits], raw), "little")
    else:
        assert isinstance(raw, int)
        number = raw & (1 << variable.bits) - 1
    ones = (1 << variable.bits) - 1 << slot % _BYTE
    number <<= slot % _BYTE
    for position, (_, byte) in enumerate(places_of(variable, slot)):
        mask, value = (bits >> position * _BYTE & 0xFF for bits in (ones, number))
        old = patches.get(byte, Patch())
        patches[byte] = Patch(old.mask | mask, old.value & ~mask | value)
