"""How an operation is written, in each form and for each width of a machine word.

Texts are Python; a number with each says how tightly it binds, so that brackets stand only where they are needed.
An integer text is a machine word: in the portable form any Python integer, in viper 64 or 32 bits. Where a word has 32
bits, UDINT and DWORD are held as their signed pattern; elsewhere as their value. Integers of 64 bits are Python's own
everywhere: to viper they are objects, which no operation joins with a machine word, and a literal is a machine word.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

from iec2mpy.backends.target import Target
from iec2mpy.semantics import types as ty


class Binding(IntEnum):
    """Python's precedence, from loose to tight."""

    SELECT = 0
    OR = 1
    AND = 2
    NOT = 3
    COMPARE = 4
    BIT_OR = 5
    BIT_XOR = 6
    BIT_AND = 7
    SHIFT = 8
    SUM = 9
    TERM = 10
    UNARY = 11
    ATOM = 12


@dataclass(frozen=True, slots=True)
class Text:
    """A piece of code and how tightly it binds."""

    code: str
    binding: Binding = Binding.ATOM

    def at(self, binding: Binding) -> str:
        """The code as an operand: in brackets if it binds more loosely."""
        return self.code if self.binding >= binding else f"({self.code})"


_OPERATORS = {
    "+": Binding.SUM,
    "-": Binding.SUM,
    "*": Binding.TERM,
    "//": Binding.TERM,
    "/": Binding.TERM,
    "%": Binding.TERM,
    "&": Binding.BIT_AND,
    "|": Binding.BIT_OR,
    "^": Binding.BIT_XOR,
    "<<": Binding.SHIFT,
    ">>": Binding.SHIFT,
    "and": Binding.AND,
    "or": Binding.OR,
    "==": Binding.COMPARE,
    "!=": Binding.COMPARE,
    "<": Binding.COMPARE,
    ">": Binding.COMPARE,
    "<=": Binding.COMPARE,
    ">=": Binding.COMPARE,
}
_BITWISE = frozenset({"&", "|", "^", "<<", ">>"})
_CHAINS = frozenset({"&", "|", "^", "and", "or"})


def infix(left: Text, operator: str, right: Text) -> Text:
    """`left operator right`; the right side keeps its brackets unless the operator is associative."""
    binding = _OPERATORS[operator]
    if operator == "+" and right.binding is Binding.UNARY and right.code.startswith("-"):
        return Text(f"{left.at(binding)} - {right.code[1:]}", binding)
    if binding is Binding.COMPARE:
        # Python would chain a comparison of a comparison
        return Text(f"{left.at(Binding.BIT_OR)} {operator} {right.at(Binding.BIT_OR)}", binding)
    if operator in _BITWISE:
        # Python's precedence of these is known to few: their operands are bare, or a chain of the same
        first = left.code if left.binding is binding and operator in _CHAINS else left.at(Binding.UNARY)
        return Text(f"{first} {operator} {right.at(Binding.UNARY)}", binding)
    tighter = binding if operator in _CHAINS else Binding(binding + 1)
    return Text(f"{left.at(binding)} {operator} {right.at(tighter)}", binding)


def call(function: str, *arguments: Text) -> Text:
    return Text(f"{function}({', '.join(a.code for a in arguments)})")


def number(value: int) -> Text:
    # a negative literal is one for Python's parser, but `-1 ** 2` and `x - -1` read badly
    return Text(str(value), Binding.ATOM if value >= 0 else Binding.UNARY)


def held_as_pattern(target: Target, value_type: ty.ElementaryType) -> bool:
    """Whether values of the type are held as a signed pattern of the same bits."""
    return target.word == 32 and value_type.high >= 1 << 31 and not value_type.in_objects


def pattern(value: int) -> int:
    """A 32-bit value as the signed number with the same bits."""
    return value - (1 << 32) if value >= 1 << 31 else value


def wrap(target: Target, value: Text, value_type: ty.ElementaryType) -> Text:
    """The value modulo 2^bits, in the range of the type."""
    bits = value_type.bits
    if target.word == 32 and bits == 32:
        return value
    if value_type.low == 0:
        return infix(value, "&", number((1 << bits) - 1))
    if target.word == 64 and bits == 32:
        return _sign_extended(value)
    half = 1 << bits - 1
    shifted = infix(infix(value, "+", number(half)), "&", number((1 << bits) - 1))
    return infix(shifted, "-", number(half))


def _sign_extended(value: Text) -> Text:
    """The low 32 bits of a 64-bit word as a signed number: the one place that does so."""
    return infix(infix(value, "<<", number(32)), ">>", number(32))


def load(target: Target, slot: Text, value_type: ty.ElementaryType, low: int) -> Text:
    """The value of a slot of V. `low`: the least value that it may have."""
    if value_type.high >= 1 << 31:
        # a 64-bit viper loads 32 bits without a sign, a 32-bit one keeps the pattern
        return slot if target.word else infix(slot, "&", number(0xFFFFFFFF))
    if target.word == 64 and low < 0:
        return _sign_extended(slot)
    return slot


def stored(target: Target, value: Text, value_type: ty.ElementaryType, high: int) -> Text:
    """The value as it is written to a slot of V. `high`: the greatest that it may have."""
    if target.word == 0 and value_type.low == 0 and high >= 1 << 31:
        return infix(infix(value, "^", number(1 << 31)), "-", number(1 << 31))
    return value


def unsigned(target: Target, value: Text, value_type: ty.ElementaryType) -> Text:
    """The value for a place that needs its true, unsigned number: a comparison, a shift, a call of the runtime."""
    return call("uint", value) if held_as_pattern(target, value_type) else value
