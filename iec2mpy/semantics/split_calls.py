"""Calls of SPLIT_DATE and its like: standard functions with outputs and without a result (table 36, 5 to 7)."""

from __future__ import annotations

from iec2mpy.semantics import expressions
from iec2mpy.semantics.arguments import ArgumentMatch, match_arguments
from iec2mpy.semantics.coercion import coerce, describe
from iec2mpy.semantics.control import take_control
from iec2mpy.semantics.conversions import is_integer, type_named
from iec2mpy.semantics.references import Use, reference
from iec2mpy.semantics.scope import Scope
from iec2mpy.semantics.signatures import Signature
from iec2mpy.semantics.typed import Convert, Expr, OutputArgument, Pou, Split, Variable, VariableRef
from iec2mpy.semantics.types import base_type
from iec2mpy.source.spans import Span
from iec2mpy.syntax import tree
from iec2mpy.syntax.tree import PouKind, Section


def check(scope: Scope, call: tree.CallExpr, signature: Signature) -> Split | None:
    """The checked call; each output goes to a variable of any integer type, and may be left out."""
    taken = take_control(scope, call)
    if taken is None:
        return None
    call, control = taken
    matched = match_arguments(scope, call, _as_pou(signature, call.span))
    if matched is None:
        return None
    operand: Expr | None = None
    outputs: list[OutputArgument] = []
    for match in matched:
        if match.parameter.section is Section.INPUT:
            operand = _input(scope, match, signature)
            if operand is None:
                return None
            continue
        output = _output(scope, match)
        if output is None:
            return None
        outputs.append(output)
    if operand is None:
        names = ", ".join(p.name for p in signature.inputs)
        scope.diagnostics.add("E0404", f"{signature.name} needs {names}.", call.span)
        return None
    return Split(operand, tuple(outputs), control, call.span)


def _as_pou(signature: Signature, span: Span) -> Pou:
    """The function as one of the program would be declared, whose arguments are matched in the same way."""
    pou = Pou(PouKind.FUNCTION, signature.name, span)
    for section, parameters in ((Section.INPUT, signature.inputs), (Section.OUTPUT, signature.outputs)):
        for parameter in parameters:
            t = type_named(parameter.type)
            assert t is not None, f"{signature.name} has parameters of elementary types"
            variable = Variable(parameter.name, t, section, span, 0, owner=pou)
            pou.variables[variable.key] = variable
    return pou


def _input(scope: Scope, match: ArgumentMatch, signature: Signature) -> Expr | None:
    parameter = match.parameter
    value = expressions.check(scope, match.value, parameter.type)
    what = f"`{parameter.name}` of {signature.name} is {parameter.type}"
    return value and coerce(scope, value, parameter.type, "E0312", what)


def _output(scope: Scope, match: ArgumentMatch) -> OutputArgument | None:
    parameter, span = match.parameter, match.value.span
    target = reference(scope, match.value, Use.WRITE)
    if target is None:
        return None
    if not is_integer(target.type):
        scope.diagnostics.add(
            "E0312",
            f"The output `{parameter.name}` is an integer, but this variable is {describe(target.type)}.",
            span,
            "Take it into an INT, and convert that.",
        )
        return None
    value = VariableRef(parameter, parameter.type, span)
    return OutputArgument(parameter, target, Convert(value, base_type(target.type), span))
