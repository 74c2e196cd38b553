"""Statements of viper functions, and the functions as a whole."""

from __future__ import annotations

import ast
from collections.abc import Callable, Sequence

from iec2mpy.simulator.viper32.assignments import (
    annotated_assignment,
    assign_local,
    assign_object,
    assignment,
    augmented_assignment,
)
from iec2mpy.simulator.viper32.code import assign, call, constant, name, place
from iec2mpy.simulator.viper32.errors import ViperError
from iec2mpy.simulator.viper32.expressions import condition, expression, from_object, object_of, operation
from iec2mpy.simulator.viper32.folding import truth
from iec2mpy.simulator.viper32.native import comparison, mismatch, to_object
from iec2mpy.simulator.viper32.scope import Scope, local_names, refuse
from iec2mpy.simulator.viper32.values import KINDS_BY_NAME, Kind, Value, an_object, immediate

_Code = list[ast.stmt]


def translate_function(node: ast.FunctionDef, viper_functions: frozenset[str]) -> ast.FunctionDef:
    """The function in Python, on the same lines. It takes objects and gives an object, as on a board."""
    arguments = node.args
    if arguments.vararg or arguments.kwarg or arguments.defaults or arguments.kwonlyargs or arguments.posonlyargs:
        refuse(f"{node.name}() has parameters that are optional, or marked by / or *", node)
    kinds = dict.fromkeys(local_names(node.body), Kind.UNBOUND)
    for parameter in arguments.args:
        kinds[parameter.arg] = _declared(parameter.annotation, node)
    parameters = {parameter.arg: kinds[parameter.arg] for parameter in arguments.args}
    scope = Scope(kinds, _declared(node.returns, node), viper_functions)
    entry = [line for identifier, kind in parameters.items() for line in _entry(identifier, kind, scope)]
    body = _suite(node.body, scope)
    if scope.error is not None:
        raise ViperError(scope.error, scope.error_line or node.lineno)
    body.append(ast.Return(_nothing(scope.result)))
    handler = ast.ExceptHandler(name("UnboundLocalError"), "$error", [_raise(call("$unassigned", name("$error")))])
    guarded = ast.Try([*entry, *body], [handler], [], [])
    signature = ast.arguments([ast.arg(each) for each in parameters], [], None, [], [], None, [])
    # Python wants `global` before the name's first use; viper's compiler does not care where it stands.
    declared = [each for statement in node.body for each in ast.walk(statement) if isinstance(each, ast.Global)]
    result = ast.FunctionDef(node.name, signature, [*_globals(declared), guarded], [], None, None)
    place(result, node)
    return result


def _globals(statements: Sequence[ast.Global]) -> _Code:
    names = sorted({each for statement in statements for each in statement.names})
    return [ast.Global(names)] if names else []


def _declared(annotation: ast.expr | None, function: ast.FunctionDef) -> Kind:
    if annotation is None:
        return Kind.OBJECT
    if not isinstance(annotation, ast.Name):
        raise ViperError("SyntaxError: annotation must be an identifier", function.lineno)
    kind = KINDS_BY_NAME.get(annotation.id)
    if kind is None:
        raise ViperError(f"ViperTypeError: unknown type '{annotation.id}'", function.lineno)
    return kind


def _entry(identifier: str, kind: Kind, scope: Scope) -> _Code:
    """Converts an argument."""
    return [] if kind is Kind.OBJECT else assign_local(identifier, from_object(name(identifier), kind), scope)


def _nothing(kind: Kind) -> ast.expr:
    """The result of a function that ends without one: the register is 0."""
    if kind is Kind.OBJECT:
        return constant(None)
    return constant(False) if kind is Kind.BOOL else constant(0)


def _raise(code: ast.expr) -> ast.Raise:
    return ast.Raise(code, None)


def _suite(statements: Sequence[ast.stmt], scope: Scope) -> _Code:
    """As far as the first statement with an error."""
    result: _Code = []
    for statement in statements:
        translate = _TRANSLATIONS.get(type(statement))
        if translate is None:
            refuse(f"{type(statement).__name__} in a viper function", statement)
        code = translate(statement, scope)
        for line in code:
            place(line, statement)
        result += code
        if scope.error is not None:
            scope.error_line = scope.error_line or statement.lineno
            break
    return result or [ast.Pass()]


def _expression_statement(node: ast.Expr, scope: Scope) -> _Code:
    if isinstance(node.value, ast.Constant):
        return []
    code = expression(node.value, scope).code
    if isinstance(code, ast.Call) and isinstance(code.func, ast.Name) and code.func.id == "$single":
        code = code.args[0]  # nobody sees the result
    return [ast.Expr(code)]


def _if(node: ast.If, scope: Scope) -> _Code:
    test = condition(node.test, scope)
    body = _suite(node.body, scope)
    return [ast.If(test, body, _suite(node.orelse, scope) if node.orelse else [])]


def _loop_body(statements: Sequence[ast.stmt], scope: Scope) -> _Code:
    scope.loops += 1
    body = _suite(statements, scope)
    scope.loops -= 1
    return body


def _while(node: ast.While, scope: Scope) -> _Code:
    """Viper's compiler comes to the condition after the body."""
    body = _loop_body(node.body, scope)
    test = condition(node.test, scope)
    return [ast.While(test, body, _suite(node.orelse, scope) if node.orelse else [])]


def _for(node: ast.For, scope: Scope) -> _Code:
    loop = _counted(node, scope)
    if loop is not None:
        return loop
    iterable = expression(node.iter, scope)
    if iterable.kind is not Kind.OBJECT and scope.error is None:
        refuse(f"a loop over '{iterable.kind.shown}'", node)
    item = scope.fresh()
    body = assign_object(node.target, name(item), scope) + _loop_body(node.body, scope)
    return [_for_loop(item, iterable.code, body, node, scope)]


def _for_loop(item: str, iterable: ast.expr, body: _Code, node: ast.For, scope: Scope) -> ast.For:
    otherwise = _suite(node.orelse, scope) if node.orelse else []
    return ast.For(ast.Name(item, ast.Store()), iterable, body, otherwise, None)


def _counted(node: ast.For, scope: Scope) -> _Code | None:
    """`for x in range(…)` with a constant step counts in a register: the end is evaluated before the start, and both
    are numbers of one type."""
    call_ = node.iter
    if not (isinstance(node.target, ast.Name) and isinstance(call_, ast.Call) and isinstance(call_.func, ast.Name)):
        return None
    if call_.func.id != "range" or not 1 <= len(call_.args) <= 3 or call_.keywords:
        return None
    if any(isinstance(argument, ast.Starred) for argument in call_.args):
        return None
    first, last = (call_.args[0], call_.args[1]) if len(call_.args) > 1 else (ast.Constant(0), call_.args[0])
    step = _step(call_.args[2]) if len(call_.args) == 3 else 1
    if step is None:
        return None
    end = expression(last, scope)
    start = expression(first, scope) if len(call_.args) > 1 else immediate(Kind.INT, 0)
    item = scope.fresh()
    started = Value(start.kind, name(item), start.low)
    if node.target.id in scope.kinds:
        body = assign_local(node.target.id, started, scope)
    else:
        body = [assign(node.target.id, to_object(started))]
    body += _loop_body(node.body, scope)
    following = operation(ast.Add(), Value(start.kind, constant(0)), immediate(Kind.INT, step), scope)
    comparison(ast.Lt(), following, end, scope)
    values = call("$urange" if start.kind is Kind.UINT else "$range", end.code, start.code, constant(step))
    return [_for_loop(item, values, body, node, scope)]


def _step(node: ast.expr) -> int | None:
    """A step that the compiler knows, and not 0."""
    if isinstance(node, ast.Constant) and type(node.value) is int and node.value != 0:
        return node.value
    return None


def _jump(node: ast.Break | ast.Continue, scope: Scope) -> _Code:
    if scope.loops == 0:
        raise ViperError("SyntaxError: 'break'/'continue' outside loop", node.lineno)
    return [type(node)()]


def _return(node: ast.Return, scope: Scope) -> _Code:
    if isinstance(node.value, ast.IfExp) and truth(node.value.test) is None:
        choice = node.value
        test = condition(choice.test, scope)
        code = _return_value(choice.body, scope)
        return [ast.If(test, code, []), *_return_value(choice.orelse, scope)]
    return _return_value(node.value, scope)


def _return_value(node: ast.expr | None, scope: Scope) -> _Code:
    if node is None:
        return [ast.Return(_nothing(scope.result))]
    value = expression(node, scope)
    if value.kind is Kind.NONE:
        return [ast.Return(_nothing(scope.result))]
    if value.kind is not scope.result:
        scope.report(f"return expected '{scope.result.shown}' but got '{value.kind.shown}'")
        return []
    return [ast.Return(to_object(value))]


def _raise_statement(node: ast.Raise, scope: Scope) -> _Code:
    if node.exc is None or node.cause is not None:
        raise ViperError("NotImplementedError: native raise", node.lineno)
    value = expression(node.exc, scope)
    if value.kind is not Kind.OBJECT:
        scope.report("must raise an object")
    return [_raise(value.code)]


def _try(node: ast.Try, scope: Scope) -> _Code:
    body = _suite(node.body, scope)
    handlers = [_handler(handler, scope) for handler in node.handlers]
    otherwise = _suite(node.orelse, scope) if node.orelse else []
    return [ast.Try(body, handlers, otherwise, _suite(node.finalbody, scope) if node.finalbody else [])]


def _handler(node: ast.ExceptHandler, scope: Scope) -> ast.ExceptHandler:
    caught: ast.expr = name("Exception")  # not the model's own faults
    if node.type is not None:
        value = expression(node.type, scope)
        if value.kind is not Kind.OBJECT:
            mismatch(an_object(value.code), value, scope)
        caught = value.code
    if node.name is not None:
        assign_local(node.name, an_object(constant(None)), scope)
    body = _suite(node.body, scope)
    if node.name is not None:  # MicroPython stores None in the local at the end, which has another type
        assign_local(node.name, Value(Kind.NONE, constant(None)), scope)
    result = ast.ExceptHandler(caught, None, body)
    place(result, node)
    return result


def _assert(node: ast.Assert, scope: Scope) -> _Code:
    test = condition(node.test, scope)
    error: ast.expr = name("AssertionError")
    if node.msg is not None:
        error = ast.Call(error, [object_of(node.msg, scope)], [])
    return [ast.If(ast.UnaryOp(ast.Not(), test), [_raise(error)], [])]


def _delete(node: ast.Delete, scope: Scope) -> _Code:
    """`del` of a local stores None in it."""
    for target in node.targets:
        if not (isinstance(target, ast.Name) and target.id in scope.kinds):
            refuse("del of what is not a local", node)
        assign_local(target.id, Value(Kind.NONE, constant(None)), scope)
    return []


def _nothing_to_do(node: ast.Pass | ast.Global, scope: Scope) -> _Code:
    return [ast.Pass()]


_TRANSLATIONS: dict[type[ast.stmt], Callable[..., _Code]] = {
    ast.Expr: _expression_statement,
    ast.Assign: assignment,
    ast.AnnAssign: annotated_assignment,
    ast.AugAssign: augmented_assignment,
    ast.If: _if,
    ast.While: _while,
    ast.For: _for,
    ast.Break: _jump,
    ast.Continue: _jump,
    ast.Return: _return,
    ast.Raise: _raise_statement,
    ast.Try: _try,
    ast.Assert: _assert,
    ast.Delete: _delete,
    ast.Pass: _nothing_to_do,
    ast.Global: _nothing_to_do,
}
