"""A value becomes one of the type that its place needs, or a diagnostic says why it cannot."""

from __future__ import annotations

import math

from iec2mpy.semantics import arithmetic
from iec2mpy.semantics.conversions import (
    BIT_KINDS,
    INTEGER_KINDS,
    UNTYPED_INT,
    UNTYPED_REAL,
    can_stand_for,
    conversion_name,
    converts_implicitly,
    is_integer,
    is_untyped,
    literal_type,
    same_type,
)
from iec2mpy.semantics.loose import converts, converts_in_dialects, loosely
from iec2mpy.semantics.scope import UNKNOWN, Scope
from iec2mpy.semantics.typed import Constant, Convert, Expr
from iec2mpy.semantics.types import (
    BOOL,
    LREAL,
    REAL,
    ArrayType,
    BlockType,
    ElementaryType,
    EnumType,
    Kind,
    OpenArrayType,
    RefType,
    StringType,
    StructType,
    SubrangeType,
    Type,
    base_type,
    unaliased,
    value_type,
)
from iec2mpy.source.dialects import with_dialects
from iec2mpy.source.spans import Span

_SHOWN = 40
"""The longest text of an expression that a hint repeats."""


def coerce(scope: Scope, value: Expr, target: Type, code: str = "E0301", needs: str | None = None) -> Expr | None:
    """`value` as a value of type `target`, converted implicitly where that is allowed (figure 12).

    None where it cannot be, after a diagnostic: `code` is the one for a wrong type, `needs` begins its sentence
    ("`PT` is TIME"). A subrange takes its base type: its limits are checked for constants here, else at run time.
    """
    if target is UNKNOWN:
        return None
    if isinstance(value, Constant) and is_untyped(value.type):
        return _literal(scope, value, target, code, needs)
    if not converts_implicitly(value.type, target):
        if converts(value, target):
            return _in_subrange(scope, loosely(value, target), target)
        _mismatch(scope, value, target, code, needs)
        return None
    return _in_subrange(scope, convert(value, target), target)


def convert(value: Expr, target: Type) -> Expr:
    """`value`, whose type converts implicitly, as one of the base type of `target`."""
    to, source = base_type(target), base_type(value.type)
    if isinstance(to, StringType):
        if isinstance(source, StringType) and source.length <= to.length:
            return value
    elif to is source or not isinstance(to, ElementaryType) or not isinstance(source, ElementaryType):
        return value
    if isinstance(value, Constant):
        assert isinstance(source, (ElementaryType, StringType))
        return Constant(arithmetic.convert(value.value, source, to), to, value.span)
    return Convert(value, to, value.span)


def typed_literal(scope: Scope, value: Expr) -> Expr | None:
    """`value`, with the type that a literal has where its context gives it none: the first of INT, DINT, UDINT, LINT
    and ULINT that holds it; REAL, or LREAL where it is too large for that."""
    if not isinstance(value, Constant) or not is_untyped(value.type):
        return value
    if value.type is UNTYPED_REAL:
        return coerce(scope, value, REAL if fits_literal(value, REAL) else LREAL)
    t = literal_type(int(value.value))
    if t is None:
        scope.diagnostics.add("E0501", f"{value.value} is too large for every integer type.", value.span)
        return None
    return Constant(value.value, t, value.span)


def fits_literal(value: Constant, target: Type) -> bool:
    """Whether an untyped literal can be one of the type `target`."""
    t = base_type(target)
    if not isinstance(t, ElementaryType):
        return False
    if t.kind is Kind.REAL:
        return math.isfinite(arithmetic.to_precision(_number(value), t))
    integral = value.type is UNTYPED_INT and t.kind in INTEGER_KINDS | BIT_KINDS
    return integral and t.low <= int(value.value) <= t.high


def _number(value: Constant) -> float:
    """The number of a literal; infinity where it is too large even for LREAL."""
    try:
        return float(value.value)
    except OverflowError:
        return math.inf


def _literal(scope: Scope, value: Constant, target: Type, code: str, needs: str | None) -> Expr | None:
    t = base_type(target)
    if fits_literal(value, t):
        assert isinstance(t, ElementaryType)
        stored = arithmetic.to_precision(_number(value), t) if t.kind is Kind.REAL else int(value.value)
        return _in_subrange(scope, Constant(stored, t, value.span), target)
    if isinstance(t, ElementaryType) and t.kind is Kind.REAL:
        largest = "REAL holds numbers up to 3.4E38." if t is REAL else "LREAL holds numbers up to 1.7E308."
        scope.diagnostics.add("E0501", f"This number is too large for {t}.", value.span, largest)
        return None
    if value.type is UNTYPED_INT and is_integer(t):
        assert isinstance(t, ElementaryType)
        wider = literal_type(int(value.value))
        hint = f"{t} holds {t.low} to {t.high}" + (f"; {wider} is large enough." if wider else ".")
        scope.diagnostics.add("E0501", f"{value.value} does not fit {target}.", value.span, hint)
        return None
    _mismatch(scope, value, target, code, needs)
    return None


def _in_subrange(scope: Scope, value: Expr, target: Type) -> Expr | None:
    limits = unaliased(target)
    if not isinstance(limits, SubrangeType) or not isinstance(value, Constant):
        return value
    if limits.low <= int(value.value) <= limits.high:
        return value
    scope.diagnostics.add(
        "E0504",
        f"{value.value} is outside of {target}, which has the values {limits.low} to {limits.high}.",
        value.span,
    )
    return None


# ---------------------------------------------------------------------------------------------- messages


def describe(t: Type) -> str:
    """What kind of value a type is, for messages: its name, or "an integer"."""
    if t is UNTYPED_INT:
        return "an integer"
    return "a real number" if t is UNTYPED_REAL else str(t)


def _mismatch(scope: Scope, value: Expr, target: Type, code: str, needs: str | None) -> None:
    what = needs or f"{target} is needed"
    scope.diagnostics.add(
        code, f"{what}, but this is {describe(value.type)}.", value.span, _mismatch_hint(value, target)
    )


def _mismatch_hint(value: Expr, target: Type) -> str | None:
    source, to = value.type, base_type(target)
    if isinstance(source, RefType) and same_type(source.target, target):
        return f"Write {shown(value.span)}^ for what it refers to."
    if isinstance(to, RefType) and same_type(source, to.target):
        return f"Write REF({shown(value.span)})."
    if isinstance(to, ElementaryType) and to.kind is Kind.DURATION and is_number(source):
        return "Write a duration such as T#500ms, or multiply T#1ms by the number."
    if to is BOOL and is_number(source):
        return (
            "Compare it, for example with <> 0."
            if not isinstance(value, Constant)
            else "Only 0 and 1, or FALSE and TRUE, are BOOL."
        )
    if isinstance(to, EnumType) and isinstance(value_type(source), ElementaryType):
        return f"Write one of its values: {', '.join(list(to.values)[:4])}{', …' if len(to.values) > 4 else ''}."
    if source is UNTYPED_REAL and is_integer(to):
        return f"Write it without a decimal point, or REAL_TO_{to}({shown(value.span)})."
    if isinstance(to, (StructType, ArrayType, BlockType)) and isinstance(base_type(source), (StructType, ArrayType)):
        return "Whole structures and arrays are assigned only to variables of the same type."
    name = conversion_name(source, target)
    if name is None:
        return None
    written = f"Write {name}({shown(value.span)})."
    return with_dialects("bits-are-numbers", written) if converts_in_dialects(source, target) else written


def is_number(t: Type) -> bool:
    """ANY_NUM, literals included."""
    t = base_type(t)
    return isinstance(t, ElementaryType) and (t.kind in INTEGER_KINDS or t.kind is Kind.REAL)


def shown(span: Span) -> str:
    """The text of an expression for a hint; `x` where it is long."""
    text = span.text
    return text if len(text) <= _SHOWN and "\n" not in text else "x"


def same_or_report(scope: Scope, value: Expr, target: Type, name: str) -> bool:
    """Whether `value` is a variable that can stand for the in-out `name` of type `target` (6.6.1.6, rule 6)."""
    if target is UNKNOWN or can_stand_for(value.type, target):
        return True
    if isinstance(target, OpenArrayType):
        message = f"`{name}` is {target}, but this is {describe(value.type)}."
        hint = "It takes arrays with as many dimensions, and of the same elements."
    else:
        message = f"The in-out `{name}` is {target}, but this variable is {describe(value.type)}."
        hint = "An in-out takes a variable of its very type: nothing is converted."
    scope.diagnostics.add("E0314", message, value.span, hint)
    return False
