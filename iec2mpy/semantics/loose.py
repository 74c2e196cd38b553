"""Integers and bit strings in the dialects where they are one: BYTE, WORD and DWORD are numbers without a sign.

Each converts to every type of the same width or more. The bits stay; what has a sign is extended with it.
"""

from __future__ import annotations

from iec2mpy.semantics import arithmetic
from iec2mpy.semantics.conversions import converts_implicitly, is_untyped
from iec2mpy.semantics.typed import Constant, Convert, Expr
from iec2mpy.semantics.types import BYTE, DINT, DWORD, ELEMENTARY, REAL, WORD, ElementaryType, Kind, Type, base_type
from iec2mpy.source.dialects import accepts

_KINDS = (Kind.SIGNED, Kind.UNSIGNED, Kind.BITS)
_BITS = (BYTE, WORD, DWORD)


def is_loose(value: Expr) -> bool:
    """Whether the value stands in a file whose dialect has it so, and is an integer or a bit string."""
    t = base_type(value.type)
    is_number = isinstance(t, ElementaryType) and t.kind in _KINDS and not is_untyped(t)
    return is_number and accepts(value.span.file, "bits-are-numbers")


def of_kind(t: Type, kind: Kind) -> ElementaryType:
    """The type of that kind with the width of `t`, an integer or a bit string."""
    t = base_type(t)
    assert isinstance(t, ElementaryType)
    return t if t.kind is kind else _of(kind, t.bits)


def _of(kind: Kind, bits: int) -> ElementaryType:
    return next(t for t in ELEMENTARY.values() if t.kind is kind and t.bits == bits)


def converts(value: Expr, target: Type) -> bool:
    """Whether the dialect converts the value to one of type `target`."""
    return is_loose(value) and converts_in_dialects(value.type, target)


def converts_in_dialects(source: Type, target: Type) -> bool:
    """Whether there is a dialect that converts values of type `source` to `target`, without being asked to."""
    source, to = base_type(source), base_type(target)
    if not isinstance(source, ElementaryType) or source.kind not in _KINDS or is_untyped(source):
        return False
    return to is REAL or (isinstance(to, ElementaryType) and to.kind in _KINDS and to.bits >= source.bits)


def loosely(value: Expr, target: Type) -> Expr:
    """`value` as one of type `target`, to which it converts, in the dialect or in the standard."""
    source, to = base_type(value.type), base_type(target)
    assert isinstance(source, ElementaryType) and isinstance(to, ElementaryType)
    if converts_implicitly(source, to) or to is REAL:
        return _converted(as_number(value), to)
    if source.kind is Kind.SIGNED:
        value = _converted(value, _of(Kind.SIGNED, to.bits))
    return _converted(_converted(value, of_kind(value.type, Kind.BITS)), to)


def as_number(value: Expr) -> Expr:
    """A bit string as the number that its bits are; any other value as it is."""
    t = base_type(value.type)
    if is_loose(value) and isinstance(t, ElementaryType) and t.kind is Kind.BITS:
        return _converted(value, of_kind(t, Kind.UNSIGNED))
    return value


def as_signed(value: Expr) -> Expr:
    """A bit string as DINT: what `-` makes of it may be below 0."""
    is_bits = base_type(value.type) in _BITS
    return loosely(value, DINT) if is_bits and converts(value, DINT) else value


def as_bits(value: Expr) -> Expr:
    """An integer as its bits; any other value as it is."""
    t = base_type(value.type)
    if is_loose(value) and isinstance(t, ElementaryType) and t.kind is not Kind.BITS:
        return _converted(value, of_kind(t, Kind.BITS))
    return value


def by_value(value: Expr, target: Type) -> Expr | None:
    """WORD_TO_REAL and REAL_TO_WORD, of numbers; in the standard there are only those of DWORD, which keep the bits."""
    bits = base_type(target)
    if bits is REAL and base_type(value.type) in _BITS and is_loose(value):
        return loosely(value, REAL)
    if bits in _BITS and accepts(value.span.file, "bits-are-numbers"):
        return _converted(_converted(value, of_kind(bits, Kind.UNSIGNED)), of_kind(bits, Kind.BITS))
    return None


def joined(a: Expr, b: Expr) -> ElementaryType | None:
    """The type in which two values meet, where the dialect converts both: REAL, or the wider one; of two as wide the
    one with a sign, then the number."""
    pair = [t for t in (base_type(a.type), base_type(b.type)) if isinstance(t, ElementaryType)]
    if not (is_loose(a) or is_loose(b)) or len(pair) < 2 or any(t.kind not in _KINDS and t is not REAL for t in pair):
        return None
    return REAL if REAL in pair else max(pair, key=lambda t: (t.bits, -_KINDS.index(t.kind)))


def _converted(value: Expr, to: ElementaryType) -> Expr:
    source = base_type(value.type)
    if source is to:
        return value
    if isinstance(value, Constant):
        assert isinstance(source, ElementaryType)
        return Constant(arithmetic.convert(value.value, source, to), to, value.span)
    return Convert(value, to, value.span)
