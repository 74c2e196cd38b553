"""The arguments of a call of a user's function or of a block: matched to parameters, and checked (6.6.1.4)."""

from __future__ import annotations

from dataclasses import dataclass

from iec2mpy.semantics import expressions
from iec2mpy.semantics.coercion import coerce, describe, same_or_report
from iec2mpy.semantics.conversions import BIT_KINDS
from iec2mpy.semantics.references import Use, reference
from iec2mpy.semantics.scope import UNKNOWN, Scope
from iec2mpy.semantics.signatures import parameter_key
from iec2mpy.semantics.typed import (
    ActualParameter,
    Constant,
    Expr,
    FieldRef,
    InOutArgument,
    InputArgument,
    OutputArgument,
    Pou,
    Unary,
    Variable,
    VariableRef,
)
from iec2mpy.semantics.types import DINT, ArrayType, ElementaryType, OpenArrayType, base_type, unaliased
from iec2mpy.source.suggest import suggest
from iec2mpy.syntax import tree
from iec2mpy.syntax.tree import Section


@dataclass(frozen=True, slots=True)
class ArgumentMatch:
    """A parameter with what the call gives for it."""

    parameter: Variable
    value: tree.Expr
    negated: bool


def match_arguments(scope: Scope, call: tree.CallExpr, callee: Pou) -> list[ArgumentMatch] | None:
    """The arguments in the order written; None after a diagnostic."""
    named = [argument for argument in call.arguments if argument.name is not None]
    if not named:
        return _by_position(scope, call, callee)
    if len(named) != len(call.arguments):
        report_mixed(scope, call)
        return None
    return _by_name(scope, named, callee)


def report_mixed(scope: Scope, call: tree.CallExpr) -> None:
    """Say that a call names some of its arguments only."""
    unnamed = next(argument for argument in call.arguments if argument.name is None)
    scope.diagnostics.add(
        "E0412",
        "Some arguments of this call have names, and this one has none.",
        unnamed.span,
        "Name all of them, or none.",
    )


def _by_position(scope: Scope, call: tree.CallExpr, callee: Pou) -> list[ArgumentMatch] | None:
    """A non-formal call gives all parameters in their order (6.6.1.4.2); none at all is an incomplete formal call."""
    given, parameters = call.arguments, [p for p in callee.parameters if p.key not in ("en", "eno")]
    if len(given) > len(parameters):
        scope.diagnostics.add(
            "E0403",
            f"`{callee.name}` has {_count(len(parameters))}, and {len(given)} are given.",
            given[len(parameters)].span,
        )
        return None
    if given and len(given) < len(parameters):
        missing = ", ".join(p.name for p in parameters[len(given) :])
        scope.diagnostics.add(
            "E0404",
            f"`{callee.name}` has {_count(len(parameters))}, and {len(given)} given: {missing} missing.",
            call.span,
            "Give all of them, or name those that are given: name := value.",
        )
        return None
    return [
        ArgumentMatch(parameter, argument.value, argument.negated)
        for parameter, argument in zip(parameters, given, strict=False)
        if argument.value is not None
    ]


def _count(number: int) -> str:
    return {0: "no parameters", 1: "1 parameter"}.get(number, f"{number} parameters")


def _by_name(scope: Scope, given: list[tree.Argument], callee: Pou) -> list[ArgumentMatch] | None:
    parameters = {p.key: p for p in callee.parameters}
    matched: list[ArgumentMatch] = []
    seen: set[Variable] = set()
    correct = True
    for argument in given:
        assert argument.name is not None
        parameter = parameters.get(parameter_key(callee, argument.name.key))
        if parameter is None:
            _unknown_parameter(scope, argument.name, callee)
            correct = False
        elif parameter in seen:
            scope.diagnostics.add("E0402", f"`{parameter.name}` is given twice.", argument.span)
            correct = False
        elif not _right_arrow(scope, argument, parameter):
            correct = False
        else:
            seen.add(parameter)
            if argument.value is not None:
                matched.append(ArgumentMatch(parameter, argument.value, argument.negated))
    return matched if correct else None


def _unknown_parameter(scope: Scope, name: tree.Name, callee: Pou) -> None:
    near = suggest(name.text, (p.name for p in callee.parameters))
    variable = callee.variables.get(name.key)
    hint = f"Did you mean `{near}`?" if near else None
    if variable is not None:
        hint = f"`{variable.name}` is a variable of its own, and no parameter."
    elif hint is None and callee.parameters:
        hint = f"It has {', '.join(p.name for p in callee.parameters)}."
    scope.diagnostics.add("E0401", f"`{callee.name}` has no parameter `{name.text}`.", name.span, hint)


def _right_arrow(scope: Scope, argument: tree.Argument, parameter: Variable) -> bool:
    """Inputs and in-outs are given with :=, outputs are taken with => (6.6.1.4.2)."""
    name = parameter.name
    if parameter.section is Section.OUTPUT and not argument.is_output:
        scope.diagnostics.add("E0407", f"`{name}` is an output.", argument.span, f"Write {name} => variable.")
        return False
    if parameter.section is not Section.OUTPUT and argument.is_output:
        kind = "an in-out" if parameter.section is Section.IN_OUT else "an input"
        scope.diagnostics.add("E0408", f"`{name}` is {kind}.", argument.span, f"Write {name} := value.")
        return False
    return True


def missing_in_outs(scope: Scope, call: tree.CallExpr, callee: Pou, matched: list[ArgumentMatch]) -> bool:
    """Whether an in-out is not given, which is reported (6.6.1.4.1)."""
    given = {match.parameter for match in matched}
    for parameter in callee.parameters:
        if parameter.by_reference and parameter not in given:
            what = "in-out" if parameter.section is Section.IN_OUT else "array"
            scope.diagnostics.add(
                "E0405",
                f"The {what} `{parameter.name}` of `{callee.name}` is missing.",
                call.span,
                f"Give it a variable: {parameter.name} := variable.",
            )
            return True
    return False


def pass_arguments(
    scope: Scope, matched: list[ArgumentMatch], instance: Expr | None
) -> tuple[ActualParameter, ...] | None:
    """Each argument in the type of its parameter; `instance` is None for a function."""
    passed = [_pass(scope, match, instance) for match in matched]
    actual = [argument for argument in passed if argument is not None]
    if len(actual) != len(matched):
        return None
    return (*actual, *(limit for argument in actual for limit in _limits(argument)))


def _limits(argument: ActualParameter) -> list[InputArgument]:
    """The limits of what an ARRAY[*] stands for."""
    if not isinstance(argument, InOutArgument):
        return []
    found: list[InputArgument] = []
    given = limits_of(argument.target)
    for own, limits in zip(argument.parameter.limits, given, strict=bool(argument.parameter.limits)):
        found += [InputArgument(variable, limit) for variable, limit in zip(own, limits, strict=True)]
    return found


def limits_of(array: Expr) -> list[tuple[Expr, Expr]]:
    """The lowest and the highest subscript of each dimension, as DINT."""
    if isinstance(array.type, ArrayType):
        return [(Constant(low, DINT, array.span), Constant(high, DINT, array.span)) for low, high in array.type.bounds]
    if not isinstance(array.type, OpenArrayType):
        return []
    assert isinstance(array, VariableRef), "an ARRAY[*] is a parameter, and no part of anything"
    pairs = array.variable.limits
    return [(VariableRef(low, DINT, array.span), VariableRef(high, DINT, array.span)) for low, high in pairs]


def _pass(scope: Scope, match: ArgumentMatch, instance: Expr | None) -> ActualParameter | None:
    parameter, value = match.parameter, match.value
    if parameter.by_reference:
        uses = {Section.INPUT: Use.READ, Section.OUTPUT: Use.WRITE, Section.IN_OUT: Use.IN_OUT}
        assert parameter.section is not None
        target = reference(scope, value, uses[parameter.section])
        if target is None or not same_or_report(scope, target, parameter.type, parameter.name):
            return None
        return InOutArgument(parameter, target)
    if parameter.section is Section.OUTPUT:
        return output_argument(scope, match, instance)
    checked = expressions.check(scope, value, parameter.type)
    if checked is None:
        return None
    passed = coerce(scope, checked, parameter.type, "E0312", f"The input `{parameter.name}` is {parameter.type}")
    return passed and InputArgument(parameter, passed)


_NAMING = (tree.NameExpr, tree.DirectVariable, tree.MemberExpr, tree.IndexExpr, tree.PartExpr, tree.DerefExpr)


def output_argument(scope: Scope, match: ArgumentMatch, instance: Expr | None) -> OutputArgument | None:
    """Where an output goes, with what is assigned there; `instance` is None for a function."""
    parameter, span = match.parameter, match.value.span
    if not isinstance(match.value, _NAMING):
        scope.diagnostics.add(
            "E0413",
            f"The output `{parameter.name}` needs a variable to go to.",
            span,
            "Take it into a variable, and calculate after the call.",
        )
        return None
    target = reference(scope, match.value, Use.WRITE)
    if target is None or parameter.type is UNKNOWN:
        return None
    t = unaliased(parameter.type)
    value: Expr = VariableRef(parameter, t, span) if instance is None else FieldRef(instance, parameter, t, span)
    if match.negated:
        t = base_type(t)
        if not isinstance(t, ElementaryType) or t.kind not in BIT_KINDS:
            scope.diagnostics.add(
                "E0312", f"Only a BOOL output can be negated, and `{parameter.name}` is {describe(t)}.", span
            )
            return None
        value = Unary("NOT", value, t, span)
    # the limits of a subrange are checked when the program runs, as for each assignment
    converted = coerce(scope, value, target.type, "E0312", f"`{span.text}` is {describe(target.type)}")
    return converted and OutputArgument(parameter, target, converted)
