"""Literals become constants (6.3); those without a prefix stay untyped until their context gives them a type."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

from iec2mpy.semantics.arithmetic import to_precision, truncating_divide
from iec2mpy.semantics.calendar import TYPE_OF_PREFIX, UNIT
from iec2mpy.semantics.conversions import UNTYPED_INT, UNTYPED_REAL, type_named
from iec2mpy.semantics.scope import Scope
from iec2mpy.semantics.typed import Constant
from iec2mpy.semantics.types import (
    BOOL,
    LDATE,
    LDT,
    LREAL,
    LTIME,
    MOMENTS,
    NULL_TYPE,
    REAL,
    TIME,
    ElementaryType,
    Kind,
    StringType,
    Type,
    base_type,
)
from iec2mpy.syntax import tree


def literal(scope: Scope, expr: tree.Literal, expected: Type | None) -> Constant | None:
    """The constant that a literal stands for; None after a diagnostic. `expected` is the type that its place needs: it
    tells whether 'A' is a string or a character (table 6)."""
    prefix = (expr.prefix or "").upper()
    if expr.kind in ("string", "wstring"):
        return _text(scope, expr, prefix, expected)
    return _LITERALS[expr.kind](scope, expr, prefix)


def _integer(scope: Scope, expr: tree.Literal, prefix: str) -> Constant | None:
    value = expr.value
    assert isinstance(value, int)
    if not prefix:
        return Constant(value, UNTYPED_INT, expr.span)
    t = type_named(prefix)
    if not isinstance(t, ElementaryType) or t.kind in _WITHOUT_NUMBERS:
        _no_such_literal(scope, expr, prefix)
        return None
    if t.kind is Kind.REAL:
        return _real(scope, expr, prefix)
    if t.low <= value <= t.high:
        return Constant(value, t, expr.span)
    scope.diagnostics.add("E0501", f"{value} does not fit {t}.", expr.span, f"{t} holds {t.low} to {t.high}.")
    return None


def _real(scope: Scope, expr: tree.Literal, prefix: str) -> Constant | None:
    assert isinstance(expr.value, (int, float))
    t = {"": LREAL, "REAL": REAL, "LREAL": LREAL}.get(prefix)
    if t is None:
        _no_such_literal(scope, expr, prefix)
        return None
    try:
        value = to_precision(float(expr.value), t)
    except OverflowError:
        value = math.inf
    if not math.isfinite(value):
        largest = "3.4E38" if t is REAL else "1.7E308"
        scope.diagnostics.add(
            "E0501", f"This number is too large for {t}.", expr.span, f"{t} holds numbers up to {largest}."
        )
        return None
    return Constant(value, t, expr.span) if prefix else Constant(expr.value, UNTYPED_REAL, expr.span)


def _bool(scope: Scope, expr: tree.Literal, prefix: str) -> Constant | None:
    if prefix and prefix != BOOL.name:
        _no_such_literal(scope, expr, prefix)
        return None
    return Constant(int(bool(expr.value)), BOOL, expr.span)


def _text(scope: Scope, expr: tree.Literal, prefix: str, expected: Type | None) -> Constant | None:
    text = str(expr.value)
    t = StringType(max(len(text), 1), wide=expr.kind == "wstring")
    wanted = type_named(prefix) if prefix else base_type(expected) if expected is not None else None
    if wanted is t.character and (prefix or len(text) == 1):
        if len(text) == 1:
            return Constant(ord(text), t.character, expr.span)
        scope.diagnostics.add("E0301", f"A {prefix} is one character, and here are {len(text)}.", expr.span)
        return None
    if len(text) > StringType().length:
        scope.diagnostics.add(
            "E0501", f"This text has {len(text)} characters; a {t.name} holds {StringType().length}.", expr.span
        )
        return None
    return Constant(text, t, expr.span)


_WITHOUT_NUMBERS = frozenset((Kind.DURATION, Kind.CHARACTER)) | MOMENTS
"""No number is a literal of these."""
_LONGEST = {
    TIME: "TIME holds up to T#24d20h31m23s647ms, about 24.8 days; LTIME, written LT#, holds 292 years.",
    LTIME: "LTIME holds up to 292 years.",
    LDATE: "LDATE holds the years 1678 to 2261; DATE holds 1 to 9999.",
    LDT: "LDT holds the years 1678 to 2261; DT holds 1 to 9999.",
}


def _of_time(scope: Scope, expr: tree.Literal, prefix: str) -> Constant | None:
    """A duration, a date or a time of day (tables 8 and 9): what is finer than its type is cut off."""
    assert isinstance(expr.value, int)
    t = TYPE_OF_PREFIX[prefix]
    value = truncating_divide(expr.value, UNIT[t]) if t.kind is Kind.DURATION else expr.value // UNIT[t]
    if t.low <= value <= t.high:
        return Constant(value, t, expr.span)
    what = f"This duration is too long for {t}." if t.kind is Kind.DURATION else f"{t} does not go to this date."
    scope.diagnostics.add("E0501", what, expr.span, _LONGEST[t])
    return None


def _null(_scope: Scope, expr: tree.Literal, _prefix: str) -> Constant:
    return Constant(0, NULL_TYPE, expr.span)


def _no_such_literal(scope: Scope, expr: tree.Literal, prefix: str) -> None:
    if type_named(prefix):
        scope.diagnostics.add("E0301", f"This is no value of the type {prefix}.", expr.span)
    else:
        scope.diagnostics.add("E0203", f"There is no type `{expr.prefix}` with such literals.", expr.span)


_LITERALS: Mapping[str, Callable[[Scope, tree.Literal, str], Constant | None]] = {
    "bool": _bool,
    "int": _integer,
    "real": _real,
    **dict.fromkeys(("duration", "date", "tod", "dt"), _of_time),
    "null": _null,
}
