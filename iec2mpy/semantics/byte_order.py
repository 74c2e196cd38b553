"""The order of bytes (6.6.2.5.12, table 37). Here it is little endian: conversions to and from that change nothing."""

from __future__ import annotations

from iec2mpy.semantics import arithmetic, operators
from iec2mpy.semantics.coercion import coerce, describe, fits_literal, typed_literal
from iec2mpy.semantics.conversions import is_untyped
from iec2mpy.semantics.scope import Scope
from iec2mpy.semantics.typed import BuiltinCall, Constant, Expr
from iec2mpy.semantics.types import ElementaryType, Type, holds_instance, holds_reference, unaliased, value_type
from iec2mpy.source.spans import Span

_BIG = frozenset(("TO_BIG_ENDIAN", "FROM_BIG_ENDIAN", "BIG_ENDIAN_TO"))
_LITTLE = frozenset(("TO_LITTLE_ENDIAN", "FROM_LITTLE_ENDIAN", "LITTLE_ENDIAN_TO"))


def is_conversion(name: str) -> bool:
    return name in _BIG or name in _LITTLE


def converted(scope: Scope, name: str, value: Expr | None, expected: Type | None, span: Span) -> Expr | None:
    """The value with its bytes in the other order, or as they are; of an array or structure, each of its values."""
    assert value is not None, "the input cannot be left out"
    if isinstance(value, Constant) and is_untyped(value.type):
        fits = expected is not None and fits_literal(value, expected)
        typed = coerce(scope, value, expected) if fits and expected is not None else typed_literal(scope, value)
        if typed is None:
            return None
        value = typed
    if holds_instance(value.type) or holds_reference(value.type):
        message = f"{name} is for values such as numbers and bit strings, but this is {describe(value.type)}."
        scope.diagnostics.add("E0312", message, value.span)
        return None
    if name in _LITTLE:
        return value
    single = value_type(value.type)
    if single is None:
        return BuiltinCall("TO_BIG_ENDIAN", (value,), unaliased(value.type), span)
    if not isinstance(single, ElementaryType):
        return value  # the characters of a string are not moved
    if isinstance(value, Constant):
        number = value.value
        return operators.folded(scope, lambda: arithmetic.builtin("TO_BIG_ENDIAN", [number], single), single, span)
    return BuiltinCall("TO_BIG_ENDIAN", (value,), single, span)
