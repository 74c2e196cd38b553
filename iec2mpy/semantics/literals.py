"""Literals become constants (6.3); those without a prefix stay untyped until their context gives them a type."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

from iec2mpy.semantics.arithmetic import to_single, truncating_divide
from iec2mpy.semantics.conversions import UNTYPED_INT, UNTYPED_REAL, type_named
from iec2mpy.semantics.scope import Scope
from iec2mpy.semantics.typed import Constant
from iec2mpy.semantics.types import (
    BOOL,
    NOT_YET,
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

_NANOSECONDS = 1_000_000
"""In a millisecond, the unit of TIME."""
_DATES = {"date": "Dates", "tod": "Times of day", "dt": "Dates with a time"}


def literal(scope: Scope, expr: tree.Literal, expected: Type | None) -> Constant | None:
    """The constant that a literal stands for; None after a diagnostic. `expected` is the type that its place needs: it
    tells whether 'A' is a string or a character (table 6)."""
    prefix = (expr.prefix or "").upper()
    if expr.kind in _DATES:
        what = f"The type {prefix}" if prefix in NOT_YET else _DATES[expr.kind]
        verb = "is" if prefix in NOT_YET else "are"
        scope.diagnostics.add("E0914", f"{what} {verb} not supported yet.", expr.span)
        return None
    if prefix in NOT_YET or prefix == "LT":
        name = "LTIME" if prefix == "LT" else prefix
        scope.diagnostics.add("E0914", f"The type {name} is not supported yet.", expr.span)
        return None
    if expr.kind in ("string", "wstring"):
        return _text(scope, expr, prefix, expected)
    return _LITERALS[expr.kind](scope, expr, prefix)


def _integer(scope: Scope, expr: tree.Literal, prefix: str) -> Constant | None:
    value = expr.value
    assert isinstance(value, int)
    if not prefix:
        return Constant(value, UNTYPED_INT, expr.span)
    t = type_named(prefix)
    if not isinstance(t, ElementaryType) or t.kind is Kind.DURATION:
        _no_such_literal(scope, expr, prefix)
        return None
    if t is REAL:
        return _real(scope, expr, prefix)
    if t.low <= value <= t.high:
        return Constant(value, t, expr.span)
    scope.diagnostics.add("E0501", f"{value} does not fit {t}.", expr.span, f"{t} holds {t.low} to {t.high}.")
    return None


def _real(scope: Scope, expr: tree.Literal, prefix: str) -> Constant | None:
    assert isinstance(expr.value, (int, float))
    try:
        single = to_single(float(expr.value))
    except OverflowError:
        single = math.inf
    if not math.isfinite(single):
        scope.diagnostics.add(
            "E0501", "This number is too large for REAL.", expr.span, "REAL holds numbers up to 3.4E38."
        )
        return None
    if not prefix:
        return Constant(expr.value, UNTYPED_REAL, expr.span)
    if prefix != REAL.name:
        _no_such_literal(scope, expr, prefix)
        return None
    return Constant(single, REAL, expr.span)


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


def _duration(scope: Scope, expr: tree.Literal, prefix: str) -> Constant | None:
    assert isinstance(expr.value, int)
    value = truncating_divide(expr.value, _NANOSECONDS)
    if TIME.low <= value <= TIME.high:
        return Constant(value, TIME, expr.span)
    scope.diagnostics.add(
        "E0501",
        "This duration is too long for TIME.",
        expr.span,
        "TIME holds up to T#24d20h31m23s647ms, about 24.8 days.",
    )
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
    "duration": _duration,
    "null": _null,
}
