"""Viper's types, and the value that an expression leaves on its stack."""

from __future__ import annotations

import ast
from dataclasses import dataclass
from enum import Enum

from iec2mpy.simulator.viper32.code import constant
from iec2mpy.simulator.viper32.machine import INT_HIGH, INT_LOW, UINT_HIGH


class Kind(Enum):
    """A type of viper's compiler. UNBOUND is a local's before its first assignment, CAST that of `int`, `ptr32`, … ."""

    OBJECT = "object"
    BOOL = "bool"
    INT = "int"
    UINT = "uint"
    PTR = "ptr"
    PTR8 = "ptr8"
    PTR16 = "ptr16"
    PTR32 = "ptr32"
    NONE = "none"
    UNBOUND = "unbound"
    CAST = "cast"

    @property
    def shown(self) -> str:
        """As MicroPython's messages name it."""
        return "None" if self in (Kind.NONE, Kind.UNBOUND, Kind.CAST) else self.value


KINDS_BY_NAME = {
    kind.value: kind
    for kind in (Kind.OBJECT, Kind.BOOL, Kind.INT, Kind.UINT, Kind.PTR, Kind.PTR8, Kind.PTR16, Kind.PTR32)
}
CASTS = {name: kind for name, kind in KINDS_BY_NAME.items() if kind is not Kind.OBJECT}
WIDTHS = {Kind.PTR8: 1, Kind.PTR16: 2, Kind.PTR32: 4}
"""Bytes of what a pointer points to."""
POINTERS = frozenset({Kind.PTR, *WIDTHS})
NUMBERS = frozenset({Kind.INT, Kind.UINT})
TESTABLE = frozenset({Kind.OBJECT, Kind.BOOL, Kind.INT, Kind.UINT})
NATIVE = frozenset({Kind.BOOL, Kind.INT, Kind.UINT}) | POINTERS
_UNSIGNED = POINTERS | {Kind.UINT}


def is_unsigned(kind: Kind) -> bool:
    """Whether a register of this type is held as an unsigned number here."""
    return kind in _UNSIGNED


def bounds(kind: Kind) -> tuple[int, int]:
    """The lowest and the highest number that a register of this type holds."""
    return (0, UINT_HIGH) if is_unsigned(kind) else (INT_LOW, INT_HIGH)


@dataclass(frozen=True, slots=True)
class Value:
    """`code` computes it; a native one lies from `low` to `high`.

    `bits`: code that is cheaper and agrees with `code` in its low 32 bits. `immediate`: the number, where viper's
    compiler knows it. `cast`: what a CAST casts to. `in_local`: it is still in the register of a local.
    """

    kind: Kind
    code: ast.expr
    low: int = INT_LOW
    high: int = INT_HIGH
    bits: ast.expr | None = None
    immediate: int | None = None
    cast: Kind | None = None
    in_local: bool = False

    @property
    def low_bits(self) -> ast.expr:
        return self.code if self.bits is None else self.bits


def native(kind: Kind, code: ast.expr, in_local: bool = False) -> Value:
    """A native value of which no more than the type is known."""
    low, high = bounds(kind)
    return Value(kind, code, low, high, in_local=in_local)


def immediate(kind: Kind, number: int) -> Value:
    """A constant. `number` is in the range of an `int`; a `uint` constant keeps it too."""
    value = number & UINT_HIGH if is_unsigned(kind) else number
    return Value(kind, constant(value), value, value, immediate=number)


def an_object(code: ast.expr) -> Value:
    return Value(Kind.OBJECT, code)
