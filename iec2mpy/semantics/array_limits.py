"""LOWER_BOUND and UPPER_BOUND: the limits of arrays, of ARRAY[*] too (6.5.3, table 15)."""

from __future__ import annotations

from iec2mpy.semantics import expressions
from iec2mpy.semantics.arguments import limits_of
from iec2mpy.semantics.coercion import coerce, describe
from iec2mpy.semantics.conversions import UNTYPED_INT, is_integer
from iec2mpy.semantics.scope import Scope
from iec2mpy.semantics.typed import Binary, BuiltinCall, Constant, Convert, Expr
from iec2mpy.semantics.types import DINT, ArrayType, OpenArrayType, Type, base_type
from iec2mpy.source.spans import Span
from iec2mpy.syntax import tree

_SIDES = {"LOWER_BOUND": 0, "UPPER_BOUND": 1}


def is_limit(name: str) -> bool:
    """Whether the standard function of that name gives a limit of an array."""
    return name in _SIDES


def check(scope: Scope, name: str, given: list[tree.Expr | None], expected: Type | None, span: Span) -> Expr | None:
    """The checked call. Its result is of the integer type that the place needs, and DINT elsewhere; what is constant is
    a constant."""
    array_expr, dimension_expr = given
    assert array_expr is not None and dimension_expr is not None
    array = expressions.check(scope, array_expr)
    dimension = expressions.check(scope, dimension_expr)
    if array is None or dimension is None:
        return None
    if not isinstance(array.type, (ArrayType, OpenArrayType)):
        message = f"{name} is of an array, and this is {describe(array.type)}."
        scope.diagnostics.add("E0312", message, array.span)
        return None
    if isinstance(dimension, Constant) and (dimension.type is UNTYPED_INT or is_integer(dimension.type)):
        number = int(dimension.value)
        if not 1 <= number <= array.type.dimensions:
            message = f"There is no dimension {number}: the array has {array.type.dimensions}."
            scope.diagnostics.add("E0502", message, dimension.span, "The first one has the number 1.")
            return None
        limit = limits_of(array)[number - 1][_SIDES[name]]
    else:
        chosen = coerce(scope, dimension, DINT, "E0312", f"`DIM` of {name} is an integer")
        if chosen is None:
            return None
        selector = Binary("-", chosen, Constant(1, DINT, span), DINT, span)
        limit = BuiltinCall("MUX", (selector, *(pair[_SIDES[name]] for pair in limits_of(array))), DINT, span)
    if isinstance(limit, Constant):
        return Constant(limit.value, UNTYPED_INT, span)
    wanted = base_type(expected) if expected is not None else DINT
    return limit if wanted is DINT or not is_integer(wanted) else Convert(limit, wanted, span)
