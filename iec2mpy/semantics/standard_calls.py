"""Calls of standard functions: overloads are resolved over generic types (6.6.1.7, 6.6.2.5)."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise

from iec2mpy.semantics import arithmetic, array_limits, byte_order, expressions, loose, operators
from iec2mpy.semantics.arguments import report_mixed
from iec2mpy.semantics.arithmetic import COMPARISONS
from iec2mpy.semantics.coercion import coerce, describe, fits_literal, typed_literal
from iec2mpy.semantics.conversions import converts_implicitly, is_untyped, joined_type, type_named
from iec2mpy.semantics.defaults import default_value
from iec2mpy.semantics.scope import Scope
from iec2mpy.semantics.signatures import Parameter, Signature, generic_members
from iec2mpy.semantics.typed import BuiltinCall, Constant, Expr
from iec2mpy.semantics.types import (
    BOOL,
    ArrayType,
    ElementaryType,
    EnumType,
    Kind,
    RefType,
    StringType,
    StructType,
    Type,
    base_type,
    value_type,
)
from iec2mpy.source.spans import Span
from iec2mpy.source.suggest import suggest
from iec2mpy.syntax import tree

_SELECTIONS = frozenset(("SEL", "MAX", "MIN", "LIMIT", "MUX"))
"""Functions whose result is one of their arguments."""


def check(
    scope: Scope, call: tree.CallExpr, signature: Signature, expected: Type | None, keep: Callable[[Expr], Expr]
) -> Expr | None:
    """The checked call; `expected` gives literals a type where all arguments are literals. `keep` is applied to each
    argument."""
    given = match(scope, call, signature)
    if given is None:
        return None
    if array_limits.is_limit(signature.name):
        return array_limits.check(scope, signature.name, given, signature.fixed or expected, call.span)
    values = _checked(scope, given, signature, expected)
    if values is None:
        return None
    values = [value and keep(value) for value in values]
    if byte_order.is_conversion(signature.name):
        return byte_order.converted(scope, signature.name, values[0], expected, call.span)
    if signature.operator is not None:
        return _operator(scope, call, signature, values, expected)
    return _builtin(scope, call, signature, values, expected)


# --------------------------------------------------------------------------------------------- matching


def match(scope: Scope, call: tree.CallExpr, signature: Signature) -> list[tree.Expr | None] | None:
    """The arguments by position, None for those that a formal call leaves out; None after a diagnostic."""
    named = [argument for argument in call.arguments if argument.name is not None]
    if named and len(named) != len(call.arguments):
        report_mixed(scope, call)
        return None
    values = _by_name(scope, call, signature) if named else _by_position(scope, call, signature)
    if values is None:
        return None
    needed = 0 if named and signature.optional else len(signature.inputs)
    missing = [p.name for i, p in enumerate(signature.inputs[:needed]) if i >= len(values) or values[i] is None]
    if missing:
        scope.diagnostics.add(
            "E0404", f"{signature.name} needs {_inputs(signature)}: {', '.join(missing)} missing.", call.span
        )
        return None
    return values


def _inputs(signature: Signature) -> str:
    names = ", ".join(p.name for p in signature.inputs)
    return f"{names}, …" if signature.extensible else names or "no inputs"


def _by_position(scope: Scope, call: tree.CallExpr, signature: Signature) -> list[tree.Expr | None] | None:
    if not signature.extensible and len(call.arguments) > len(signature.inputs):
        extra = call.arguments[len(signature.inputs)]
        scope.diagnostics.add(
            "E0403", f"{signature.name} has {_inputs(signature)}, and {len(call.arguments)} are given.", extra.span
        )
        return None
    return [argument.value for argument in call.arguments]


def _by_name(scope: Scope, call: tree.CallExpr, signature: Signature) -> list[tree.Expr | None] | None:
    by_position: dict[int, tree.Expr | None] = {}
    for argument in call.arguments:
        assert argument.name is not None
        name = argument.name
        position = signature.position(name.text)
        if position is None:
            near = suggest(name.text, (p.name for p in signature.inputs))
            hint = f"Did you mean `{near}`?" if near else f"It has {_inputs(signature)}."
            scope.diagnostics.add("E0401", f"{signature.name} has no parameter `{name.text}`.", name.span, hint)
        elif argument.is_output:
            scope.diagnostics.add("E0408", f"`{name.text}` is an input.", argument.span, f"Write {name.text} := value.")
        elif position in by_position:
            scope.diagnostics.add("E0402", f"`{name.text}` is given twice.", argument.span)
        else:
            by_position[position] = argument.value
            continue
        return None
    # the highest number named sets how many inputs there are (6.6.2.5.1)
    return [by_position.get(i) for i in range(max(len(signature.inputs), 1 + max(by_position)))]


# ------------------------------------------------------------------------------------------------ types


def _checked(
    scope: Scope, given: Sequence[tree.Expr | None], signature: Signature, expected: Type | None
) -> list[Expr | None] | None:
    """The arguments, checked; those with a type of their own converted to it."""
    hint = expected if signature.result.startswith("ANY") else None
    values: list[Expr | None] = []
    correct = True
    for number, argument in enumerate(given):
        parameter = signature.parameter(number)
        assert parameter is not None
        concrete = _concrete(signature, parameter)
        if argument is None:
            values.append(None)
            continue
        value = expressions.check(scope, argument, concrete or (hint if parameter.type == signature.result else None))
        if value is not None and concrete is not None:
            value = coerce(scope, value, concrete, "E0312", f"`{parameter.name}` of {signature.name} is {concrete}")
        correct = correct and value is not None
        values.append(value)
    return values if correct else None


def _concrete(signature: Signature, parameter: Parameter) -> Type | None:
    """The one type of an input, or None where it is generic."""
    if signature.fixed is not None and parameter.type == signature.generic:
        return signature.fixed
    return type_named(parameter.type)


def _operator(
    scope: Scope, call: tree.CallExpr, signature: Signature, given: list[Expr | None], expected: Type | None
) -> Expr | None:
    """An operator that is written as a function: a chain of it, so that one meaning has one form."""
    operator, span = signature.operator, call.span
    assert operator is not None
    values = [value or Constant(0, BOOL, span) for value in given]  # only SEL, LIMIT, MUX may leave inputs out
    if operator == ":=":
        return values[0]
    if operator == "NOT":
        return operators.unary(scope, operator, values[0], expected, span)
    result = operators.binary(scope, operator, values[0], values[1], call.callee.span, span)
    for left, right in pairwise(values[1:]):
        if result is None:
            return None
        if operator in COMPARISONS:  # GT(a, b, c) is (a > b) AND (b > c): table 33
            link = operators.binary(scope, operator, left, right, call.callee.span, span)
            result = link and operators.binary(scope, "AND", result, link, call.callee.span, span)
        else:
            result = operators.binary(scope, operator, result, right, call.callee.span, span)
    return result


def _builtin(
    scope: Scope, call: tree.CallExpr, signature: Signature, values: list[Expr | None], expected: Type | None
) -> Expr | None:
    found: dict[str, Type] = {}
    positions: dict[str | int, list[int]] = {}
    for number in range(len(values)):
        parameter = signature.parameter(number)
        assert parameter is not None
        if _concrete(signature, parameter) is None:
            positions.setdefault(number if signature.separate else parameter.type, []).append(number)
    for numbers in positions.values():
        parameter = signature.parameter(numbers[0])
        assert parameter is not None
        generic = parameter.type
        hint = expected if generic == signature.result else None
        group = [value for i in numbers if (value := values[i]) is not None]
        unified = _unify(scope, signature, generic, group, hint)
        if unified is None:
            return None
        converted = iter(unified[0])
        for i in numbers:
            if values[i] is not None:
                values[i] = next(converted)
        found[generic] = unified[1]
    arguments = tuple(
        value if value is not None else _default(signature, number, found, call.span)
        for number, value in enumerate(values)
    )
    t = _result(signature, found, arguments)
    single = value_type(t)
    if arguments and single is not None and all(isinstance(argument, Constant) for argument in arguments):
        constants = [argument.value for argument in arguments if isinstance(argument, Constant)]
        return operators.folded(scope, lambda: arithmetic.builtin(signature.name, constants, single), t, call.span)
    return BuiltinCall(signature.name, arguments, t, call.span)


def _default(signature: Signature, number: int, found: Mapping[str, Type], span: Span) -> Expr:
    """What stands for an input that is left out: the default value of its type (table 20, 1b)."""
    parameter = signature.parameter(number)
    assert parameter is not None
    t = _concrete(signature, parameter) or found.get(parameter.type, BOOL)
    value = default_value(t)
    assert isinstance(value, (int, float, str))
    return Constant(value, t, span)


def _result(signature: Signature, found: Mapping[str, Type], arguments: Sequence[Expr]) -> Type:
    if signature.fixed is not None and signature.result == signature.generic:
        t: Type = signature.fixed
    else:
        t = found.get(signature.result) or type_named(signature.result) or BOOL
    if isinstance(t, StringType):
        lengths = [a.type.length for a in arguments if isinstance(a.type, StringType)]
        return StringType(max(lengths), t.wide) if signature.name in _SELECTIONS else StringType(wide=t.wide)
    return t


def _unify(
    scope: Scope, signature: Signature, generic: str, values: list[Expr], expected: Type | None
) -> tuple[list[Expr], Type] | None:
    """The values in one type that the generic type has; `expected` is taken where all are literals that fit it."""
    if not values:
        return [], expected or type_named(generic_members(generic)[0]) or BOOL
    common = _expected_for_literals(generic, values, expected) or _common(scope, signature, values)
    if common is None:
        return None
    t = _member(generic, common) or _loose_member(generic, values[0])
    if t is None:
        _not_generic(scope, signature, generic, values[0])
        return None
    what = f"{signature.name} is used with {t}"
    converted = [coerce(scope, value, t, "E0312", what) for value in values]
    complete = [value for value in converted if value is not None]
    return (complete, t) if len(complete) == len(values) else None


def _expected_for_literals(generic: str, values: list[Expr], expected: Type | None) -> Type | None:
    if expected is None:
        return None
    t = base_type(expected)
    if not isinstance(t, ElementaryType) or t.name not in generic_members(generic):
        return None
    literals = [v for v in values if isinstance(v, Constant) and is_untyped(v.type) and fits_literal(v, t)]
    return t if len(literals) == len(values) else None


def _common(scope: Scope, signature: Signature, values: list[Expr]) -> Type | None:
    """The type that all values convert to; literals take that of the others where they fit it."""
    typed = [value for value in values if not is_untyped(value.type)]
    literals = [value for value in values if is_untyped(value.type)]
    for literal in literals:
        assert isinstance(literal, Constant)
        if not typed or not fits_literal(literal, typed[0].type):
            value = typed_literal(scope, literal)
            if value is None:
                return None
            typed.append(value)
    common = base_type(typed[0].type)
    for value in typed[1:]:
        joined = joined_type(common, base_type(value.type)) or loose.joined(typed[0], value)
        if joined is None:
            scope.diagnostics.add(
                "E0303", f"{signature.name} cannot take both {describe(common)} and {describe(value.type)}.", value.span
            )
            return None
        common = joined
    return common


def _member(generic: str, t: Type) -> Type | None:
    """The type itself where the generic type has it, else the one of its members that it converts to."""
    names = generic_members(generic)
    if isinstance(t, StringType):
        return t if t.name in names else None
    if isinstance(t, (EnumType, RefType)):
        return t if generic == "ANY" else None
    if isinstance(t, ElementaryType) and t.name in names:
        return t
    return next((m for name in names if (m := type_named(name)) is not None and converts_implicitly(t, m)), None)


def _loose_member(generic: str, value: Expr) -> Type | None:
    """The member of the generic type with the same bits, where the dialect makes no difference."""
    if not loose.is_loose(value):
        return None
    names = generic_members(generic)
    kinds = (Kind.UNSIGNED, Kind.BITS)
    return next((t for kind in kinds if (t := loose.of_kind(value.type, kind)).name in names), None)


_MEANS = {
    "ANY_INT": "an integer",
    "ANY_REAL": "a REAL number",
    "ANY_NUM": "a number",
    "ANY_MAGNITUDE": "a number or a duration",
    "ANY_BCD": "a BYTE, WORD, DWORD or LWORD",
    "ANY_BIT": "a bit string such as WORD",
    "ANY_STRING": "a STRING",
    "ANY_ELEMENTARY": "a single value",
    "ANY": "a single value",
}


def _not_generic(scope: Scope, signature: Signature, generic: str, value: Expr) -> None:
    if generic == "ANY" and isinstance(base_type(value.type), (StructType, ArrayType)):
        what = f"{signature.name} of whole structures and arrays"
        scope.diagnostics.add("E0915", f"{what} is not supported yet.", value.span, "Use IF.")
        return
    scope.diagnostics.add(
        "E0312", f"{signature.name} needs {_MEANS[generic]}, but this is {describe(value.type)}.", value.span
    )
