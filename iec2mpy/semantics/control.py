"""EN and ENO of a call (6.6.1.5). Every function and block has them, whether it declares them or not."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from iec2mpy.semantics import expressions
from iec2mpy.semantics.arguments import ArgumentMatch, output_argument, report_mixed
from iec2mpy.semantics.coercion import coerce, fits_literal, typed_literal
from iec2mpy.semantics.conversions import is_untyped
from iec2mpy.semantics.scope import Scope
from iec2mpy.semantics.typed import Constant, Control, Expr, OutputArgument, StandardCall, Variable, VariableRef
from iec2mpy.semantics.types import BOOL, Type, value_type
from iec2mpy.syntax import tree
from iec2mpy.syntax.tree import Section

Keep = Callable[[Expr], Expr]
"""What is done with each argument of a standard function once it is checked."""


def take_control(scope: Scope, call: tree.CallExpr) -> tuple[tree.CallExpr, Control | None] | None:
    """The call without EN and ENO, and what these are, if it has one of them; None after a diagnostic."""
    given = [a for a in call.arguments if a.name is not None and a.name.key in ("en", "eno")]
    if not given:
        return call, None
    rest = tuple(a for a in call.arguments if a not in given)
    if any(a.name is None for a in rest):
        # EN and ENO take part in formal calls only (6.6.1.4.2)
        report_mixed(scope, call)
        return None
    enable = _argument(scope, given, "en")
    eno = _argument(scope, given, "eno")
    if len(given) > (enable is not None) + (eno is not None):
        return None
    control = Control(_enable(scope, enable), _eno(scope, eno))
    wanted = [a for a in (enable, eno) if a is not None and a.value is not None]
    if len(wanted) > (control.enable is not None) + (control.eno is not None):
        return None
    return replace(call, arguments=rest), control if wanted else None


def _argument(scope: Scope, given: Sequence[tree.Argument], key: str) -> tree.Argument | None:
    """The argument of that name, which must be one, and have the right arrow; None also after a diagnostic."""
    first, *more = [a for a in given if a.name is not None and a.name.key == key] or [None]
    if first is None:
        return None
    name = key.upper()
    if more:
        scope.diagnostics.add("E0402", f"`{name}` is given twice.", more[0].span if more[0] else first.span)
        return None
    if key == "en" and first.is_output:
        scope.diagnostics.add("E0408", "`EN` is an input.", first.span, "Write EN := value.")
        return None
    if key == "eno" and not first.is_output:
        scope.diagnostics.add("E0407", "`ENO` is an output.", first.span, "Write ENO => variable.")
        return None
    return first


def _enable(scope: Scope, argument: tree.Argument | None) -> Expr | None:
    if argument is None or argument.value is None:
        return None
    value = expressions.check(scope, argument.value, BOOL)
    return value and coerce(scope, value, BOOL, "E0312", "The input `EN` is BOOL")


def _eno(scope: Scope, argument: tree.Argument | None) -> OutputArgument | None:
    if argument is None or argument.value is None:
        return None
    parameter = Variable("ENO", BOOL, Section.OUTPUT, argument.span, 0)
    return output_argument(scope, ArgumentMatch(parameter, argument.value, argument.negated), None)


# -------------------------------------------------------------------------------------- standard functions


def keeper(arguments: list[tuple[Variable, Expr]]) -> Keep:
    """Puts a variable of the call's own in place of each argument that is not constant, and notes its value."""

    def keep(value: Expr) -> Expr:
        if isinstance(value, Constant):
            return value
        variable = Variable("", value.type, None, value.span, 0)
        arguments.append((variable, value))
        return VariableRef(variable, value.type, value.span)

    return keep


def standard_call(
    scope: Scope,
    checked: Expr,
    arguments: list[tuple[Variable, Expr]],
    control: Control,
    expected: Type | None,
) -> StandardCall | None:
    """The checked call of a standard function, under EN and ENO."""
    if isinstance(checked, Constant) and is_untyped(checked.type):
        fits = expected is not None and fits_literal(checked, expected)
        typed = coerce(scope, checked, expected) if fits and expected is not None else typed_literal(scope, checked)
        if typed is None:
            return None
        checked = typed
    if value_type(checked.type) is None:
        what = "EN and ENO with a function of whole arrays and structures"
        scope.diagnostics.add("E0915", f"{what} is not supported yet.", checked.span, "Write IF around the call.")
        return None
    return StandardCall(checked, tuple(arguments), control, checked.type, checked.span)
