"""Calls: which callee a name means, and in which places it can be called."""

from __future__ import annotations

from iec2mpy.semantics import conversion_functions, declarations, split_calls, standard_calls
from iec2mpy.semantics.arguments import ArgumentMatch, match_arguments, missing_in_outs, pass_arguments
from iec2mpy.semantics.control import Keep, keeper, standard_call, take_control
from iec2mpy.semantics.references import Use, reference
from iec2mpy.semantics.scope import UNKNOWN, Scope
from iec2mpy.semantics.signatures import function_names, standard_function
from iec2mpy.semantics.typed import CallBlock, CallFunction, Expr, FunctionCall, Pou, StandardCall, Stmt, Variable
from iec2mpy.semantics.types import NO_RESULT, BlockType, Type, unaliased
from iec2mpy.source.suggest import suggest
from iec2mpy.syntax import tree
from iec2mpy.syntax.tree import PouKind


def in_expression(scope: Scope, call: tree.CallExpr, expected: Type | None) -> Expr | None:
    """A call that gives a value; None after a diagnostic."""
    if _is_function_name(scope, call.callee):
        assert isinstance(call.callee, tree.NameExpr)
        function = _user_function(scope, call.callee)
        if function is not None:
            return _function_value(scope, call, function)
        return _standard(scope, call, expected)
    instance = reference(scope, call.callee, Use.CALL)
    if instance is not None and _is_instance(scope, call.callee, instance):
        scope.diagnostics.add(
            "E0409",
            "The call of a block has no result.",
            call.span,
            f"Call it in a statement of its own, and then use an output of `{call.callee.span.text}`.",
        )
    return None


def as_statement(scope: Scope, call: tree.CallExpr) -> Stmt | None:
    """A call that stands alone; None where there is nothing to do, or after a diagnostic."""
    if _is_function_name(scope, call.callee):
        assert isinstance(call.callee, tree.NameExpr)
        function = _user_function(scope, call.callee)
        if function is not None:
            checked = _function(scope, call, function)
            return checked and CallFunction(checked, call.span)
        signature = standard_function(call.callee.name)
        if signature is not None and signature.outputs:
            return split_calls.check(scope, call, signature)
        value = _standard(scope, call, None)
        if isinstance(value, StandardCall) and value.control.eno is not None:
            return CallFunction(value, call.span)
        if value is not None:
            scope.diagnostics.add("W0603", "This call does nothing: its result is not used.", call.span)
        return None
    instance = reference(scope, call.callee, Use.CALL)
    if instance is None or not _is_instance(scope, call.callee, instance):
        return None
    assert isinstance(instance.type, BlockType)
    return _block(scope, call, instance, instance.type)


def _is_function_name(scope: Scope, callee: tree.Expr) -> bool:
    """Whether the callee is a name that is no variable; the result variable of a function is one only in its body."""
    if not isinstance(callee, tree.NameExpr):
        return False
    variable = scope.locals.get(callee.name.casefold())
    return variable is None or (scope.pou is not None and variable is scope.pou.result)


def _is_instance(scope: Scope, callee: tree.Expr, found: Expr) -> bool:
    if isinstance(found.type, BlockType):
        return True
    scope.diagnostics.add(
        "E0411",
        f"`{callee.span.text}` is {found.type}, and cannot be called.",
        callee.span,
        "Only functions and instances of blocks are called.",
    )
    return False


# ------------------------------------------------------------------------------------------------- functions


def _user_function(scope: Scope, callee: tree.NameExpr) -> Pou | None:
    """The function of the program that is meant; None where there is none of that name."""
    key = callee.name.casefold()
    pou = scope.world.pous.get(key)
    if pou is None or pou.kind is not PouKind.FUNCTION:
        return None
    declarations.declare_pou(scope.world, key)
    return pou


def _function_value(scope: Scope, call: tree.CallExpr, function: Pou) -> Expr | None:
    if function.result is None:
        _no_result(scope, call, function.name)
        return None
    return _function(scope, call, function)


def _no_result(scope: Scope, call: tree.CallExpr, name: str) -> None:
    scope.diagnostics.add(
        "E0409",
        f"The function `{name}` has no result.",
        call.span,
        "Call it in a statement of its own, and take its outputs with =>.",
    )


def _function(scope: Scope, call: tree.CallExpr, function: Pou) -> FunctionCall | None:
    scope.calls.setdefault(function, call.span)
    taken = take_control(scope, call)
    if taken is None:
        return None
    call, control = taken
    matched = match_arguments(scope, call, function)
    if matched is None or missing_in_outs(scope, call, function, matched):
        return None
    arguments = pass_arguments(scope, matched, None)
    t = unaliased(function.result.type) if function.result is not None else NO_RESULT
    if arguments is None or t is UNKNOWN:
        return None
    return FunctionCall(function, arguments, t, call.span, control)


def _standard(scope: Scope, call: tree.CallExpr, expected: Type | None) -> Expr | None:
    taken = take_control(scope, call)
    if taken is None:
        return None
    call, control = taken
    if control is None:
        return _standard_value(scope, call, expected, lambda argument: argument)
    arguments: list[tuple[Variable, Expr]] = []
    checked = _standard_value(scope, call, expected, keeper(arguments))
    return checked and standard_call(scope, checked, arguments, control, expected)


def _standard_value(scope: Scope, call: tree.CallExpr, expected: Type | None, keep: Keep) -> Expr | None:
    assert isinstance(call.callee, tree.NameExpr)
    name = call.callee.name
    is_clock = name.upper() == "TIME"  # the lexer lets it be a name only where the dialect has TIME()
    signature = standard_function("__NOW" if is_clock else name)
    if signature is not None and signature.outputs:
        _no_result(scope, call, signature.name)
        return None
    if signature is not None and (is_clock or scope.is_stdlib or not name.startswith("__")):
        return standard_calls.check(scope, call, signature, expected, keep)
    conversion = conversion_functions.parse(name)
    if conversion is not None:
        return conversion_functions.check(scope, call, conversion, expected, keep)
    _unknown(scope, call.callee, name)
    return None


def _unknown(scope: Scope, callee: tree.Expr, name: str) -> None:
    world, key, add = scope.world, name.casefold(), scope.diagnostics.add
    if key in world.pou_declarations:
        kind = world.pou_declarations[key].kind
        hint = "Declare an instance of it in VAR, and call that." if kind is PouKind.FUNCTION_BLOCK else None
        add("E0411", f"`{name}` is a {kind.value}, and cannot be called itself.", callee.span, hint)
    elif key in world.type_declarations:
        add("E0411", f"`{name}` is a type, and cannot be called.", callee.span)
    else:
        known = [d.name.text for d in world.pou_declarations.values() if d.kind is PouKind.FUNCTION]
        near = suggest(name, [*known, *function_names()])
        add("E0207", f"There is no function `{name}`.", callee.span, f"Did you mean `{near}`?" if near else None)


# ---------------------------------------------------------------------------------------------------- blocks


def _block(scope: Scope, call: tree.CallExpr, instance: Expr, t: BlockType) -> CallBlock | None:
    block = t.pou
    declarations.declare_pou(scope.world, block.name.casefold())
    scope.calls.setdefault(block, call.span)
    taken = take_control(scope, call)
    if taken is None:
        return None
    call, control = taken
    matched: list[ArgumentMatch] | None = match_arguments(scope, call, block)
    if matched is None or missing_in_outs(scope, call, block, matched):
        return None
    arguments = pass_arguments(scope, matched, instance)
    return None if arguments is None else CallBlock(instance, block, arguments, call.span, control)
