"""Conversion functions, whose names follow a rule: X_TO_Y, TO_Y, X_TRUNC_Y, TRUNC_Y, TRUNC (table 22)."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass

from iec2mpy.semantics import arithmetic, expressions, loose, operators, standard_calls
from iec2mpy.semantics.coercion import coerce, describe, typed_literal
from iec2mpy.semantics.conversions import converts_explicitly, is_integer, is_real, type_named
from iec2mpy.semantics.scope import Scope
from iec2mpy.semantics.signatures import Parameter, Signature
from iec2mpy.semantics.typed import Constant, Convert, Expr
from iec2mpy.semantics.types import DINT, REAL, ElementaryType, StringType, Type, base_type
from iec2mpy.syntax import tree


@dataclass(frozen=True, slots=True)
class Conversion:
    """`source` is None where the argument decides, `target` where the place of the call does (TRUNC alone)."""

    name: str
    source: ElementaryType | StringType | None
    target: ElementaryType | StringType | None
    truncate: bool


_NAME = re.compile(r"(?:([A-Z_]+?)_)?(TO|TRUNC)_([A-Z_]+)")


def parse(name: str) -> Conversion | None:
    """The conversion that a function name stands for, in any letter case, or None where it is none."""
    name = name.upper()
    if name == "TRUNC":
        return Conversion(name, None, None, True)
    match = _NAME.fullmatch(name)
    if match is None:
        return None
    source = type_named(match[1]) if match[1] else None
    target = type_named(match[3])
    truncate = match[2] == "TRUNC"
    if target is None or (match[1] and source is None):
        return None
    if truncate and (not (source is None or is_real(source)) or not is_integer(target)):
        return None
    return Conversion(name, source, target, truncate)


def check(
    scope: Scope, call: tree.CallExpr, conversion: Conversion, expected: Type | None, keep: Callable[[Expr], Expr]
) -> Expr | None:
    """The checked call of a conversion; `keep` is applied to its argument."""
    given = standard_calls.match(scope, call, Signature(conversion.name, (Parameter("IN", "ANY"),), "ANY"))
    if given is None or given[0] is None:
        return None
    value = expressions.check(scope, given[0], conversion.source)
    if value is None:
        return None
    source = conversion.source
    if source is None and conversion.truncate and not is_real(value.type):
        source = REAL  # the input is ANY_REAL (table 22)
    if source is not None:
        value = coerce(scope, value, source, "E0312", f"The input of {conversion.name} is {source}")
    else:
        value = typed_literal(scope, value)
    return value and _converted(scope, call, conversion, keep(value), _target(conversion, expected))


def _target(conversion: Conversion, expected: Type | None) -> ElementaryType | StringType:
    if conversion.target is not None:
        return conversion.target
    # TRUNC alone is overloaded by its result, ANY_INT: the integer type of its place
    t = base_type(expected) if expected is not None else None
    return t if isinstance(t, ElementaryType) and is_integer(t) else DINT


def _converted(
    scope: Scope, call: tree.CallExpr, conversion: Conversion, value: Expr, target: ElementaryType | StringType
) -> Expr | None:
    source = base_type(value.type)
    if not isinstance(source, (ElementaryType, StringType)):
        scope.diagnostics.add(
            "E0312", f"{conversion.name} needs a single value, but this is {describe(value.type)}.", value.span
        )
        return None
    if REAL in (source, target) and target is not source:
        number = loose.by_value(value, target)
        if number is not None:
            return number
    if not converts_explicitly(source, target):
        _no_conversion(scope, call, source, target)
        return None
    if source is target:
        return value
    if isinstance(source, StringType) and isinstance(target, StringType):
        if source.wide == target.wide:
            return value
        target = StringType(source.length, target.wide)
    if isinstance(value, Constant):
        return operators.folded(
            scope, lambda: arithmetic.convert(value.value, source, target, conversion.truncate), target, call.span
        )
    return Convert(value, target, call.span, conversion.truncate)


def _no_conversion(
    scope: Scope, call: tree.CallExpr, source: ElementaryType | StringType, target: ElementaryType | StringType
) -> None:
    if isinstance(source, StringType) or isinstance(target, StringType):
        scope.diagnostics.add(
            "E0916", f"The conversion from {describe(source)} to {describe(target)} is not supported yet.", call.span
        )
    else:
        scope.diagnostics.add(
            "E0312",
            f"There is no conversion from {source} to {target}.",
            call.span,
            "Convert to an integer type in between.",
        )
