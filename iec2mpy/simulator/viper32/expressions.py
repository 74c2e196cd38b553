"""Expressions of viper functions: their types by viper's rules, and Python code that computes the same."""

from __future__ import annotations

import ast
from collections.abc import Callable

from iec2mpy.simulator.viper32.code import bind, call, choose, compare, constant, is_simple, name, place, subscript
from iec2mpy.simulator.viper32.errors import ViperError
from iec2mpy.simulator.viper32.floats import is_read_exactly, single
from iec2mpy.simulator.viper32.folding import truth
from iec2mpy.simulator.viper32.machine import INT_HIGH, INT_LOW, SMALL_HIGH, SMALL_LOW
from iec2mpy.simulator.viper32.native import binary_operation, comparison, is_decided, mismatch, retype, to_object
from iec2mpy.simulator.viper32.scope import Scope, refuse
from iec2mpy.simulator.viper32.values import (
    CASTS,
    NATIVE,
    NUMBERS,
    POINTERS,
    TESTABLE,
    WIDTHS,
    Kind,
    Value,
    an_object,
    immediate,
    native,
)

_FROM_OBJECT = {Kind.INT: "$int", Kind.UINT: "$uint", Kind.BOOL: "$true"} | dict.fromkeys(POINTERS, "$address")
_ELEMENT_HIGH = {Kind.PTR8: 0xFF, Kind.PTR16: 0xFFFF, Kind.PTR32: INT_HIGH}


def expression(node: ast.expr, scope: Scope) -> Value:
    translate = _TRANSLATIONS.get(type(node))
    if translate is None:
        refuse(f"{type(node).__name__} in a viper function", node)
    value = translate(node, scope)
    place(value.code, node)
    if value.bits is not None:
        place(value.bits, node)
    return value


def object_of(node: ast.expr, scope: Scope) -> ast.expr:
    """The expression as an object, as what is called or stored in a list gets it."""
    value = expression(node, scope)
    if value.immediate is not None and value.kind is Kind.UINT:
        return constant(value.immediate)  # a constant loses its cast on the way: uint(-1) is -1
    return converted(value, node)


def converted(value: Value, node: ast.expr) -> ast.expr:
    if value.kind is Kind.CAST or (value.kind in POINTERS and value.immediate is not None):
        raise ViperError("NotImplementedError: conversion to object", node.lineno)
    result = to_object(value)
    place(result, node)
    return result


def from_object(code: ast.expr, kind: Kind) -> Value:
    """What an object becomes where `kind` is declared, or cast to."""
    if kind is Kind.OBJECT:
        return an_object(code)
    return native(kind, call(_FROM_OBJECT[kind], code))


def condition(node: ast.expr, scope: Scope) -> ast.expr:
    """Code that is true when a jump on the expression is taken: `and`, `or` and `not` are jumps here, not values."""
    known = truth(node)
    if known is not None:
        result: ast.expr = constant(known)
    elif isinstance(node, ast.BoolOp):
        result = ast.BoolOp(node.op, [condition(value, scope) for value in node.values])
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
        result = ast.UnaryOp(ast.Not(), condition(node.operand, scope))
    else:
        value = expression(node, scope)
        _check_testable(value, scope)
        result = value.code
    place(result, node)
    return result


def _check_testable(value: Value, scope: Scope) -> None:
    if value.kind not in TESTABLE:
        scope.report(f"can't implicitly convert '{value.kind.shown}' to 'bool'")


def _constant(node: ast.Constant, scope: Scope) -> Value:
    value = node.value
    if isinstance(value, bool):
        return immediate(Kind.BOOL, int(value))
    if value is None:
        return Value(Kind.NONE, constant(None), 0, 0, immediate=0)
    if value == SMALL_LOW:
        # mpy-cross takes it for an int; to a compiler of 32 bits it is the negative of 2^30, which is an object
        refuse(f"the number {SMALL_LOW}: an object where the compiler itself has 32 bits", node)
    if isinstance(value, int) and SMALL_LOW <= value <= SMALL_HIGH:
        return immediate(Kind.INT, value)
    if isinstance(value, complex):
        refuse("a complex number", node)
    if isinstance(value, float) and not is_read_exactly(value):
        refuse(f"the number {value}: it is not read exactly in single precision", node)
    return an_object(constant(single(value)))


def _name(node: ast.Name, scope: Scope) -> Value:
    kind = scope.kinds.get(node.id)
    if kind is None:
        cast = CASTS.get(node.id)
        return Value(Kind.CAST, constant(None), cast=cast) if cast else an_object(name(node.id))
    if kind is Kind.CAST:
        refuse("a type used as a value", node)
    if kind is Kind.UNBOUND:
        scope.report(f"local '{node.id}' used before type known")
    return native(kind, name(node.id), in_local=True) if kind in NATIVE else Value(kind, name(node.id))


def _binary(node: ast.BinOp, scope: Scope) -> Value:
    left = expression(node.left, scope)
    return operation(node.op, left, expression(node.right, scope), scope)


def operation(operator: ast.operator, left: Value, right: Value, scope: Scope, inplace: bool = False) -> Value:
    """An arithmetic operation of two values of any types."""
    if is_decided(left.kind, right.kind):
        return binary_operation(operator, left, right, scope)
    if left.kind is Kind.OBJECT and right.kind is Kind.OBJECT:
        prefix = "$i" if inplace else "$"
        return an_object(call(f"{prefix}{type(operator).__name__}", left.code, right.code))
    return mismatch(left, right, scope)


def _unary(node: ast.UnaryOp, scope: Scope) -> Value:
    operand = expression(node.operand, scope)
    if operand.kind is Kind.OBJECT:
        return an_object(ast.UnaryOp(node.op, operand.code))
    if operand.kind not in NUMBERS:
        scope.report(f"can't do unary op of '{operand.kind.shown}'")
        return operand
    if isinstance(node.op, ast.Not):
        scope.report("'not' not implemented")
        return operand
    if isinstance(node.op, ast.UAdd):
        return operand
    if operand.in_local:
        sign = "-" if isinstance(node.op, ast.USub) else "~"
        refuse(f"unary {sign} of a local: it overwrites the local in MicroPython before August 2026", node)
    if isinstance(node.op, ast.USub):
        zero = Value(operand.kind, constant(0), 0, 0)
        return binary_operation(ast.Sub(), zero, operand, scope)
    return binary_operation(ast.BitXor(), operand, immediate(Kind.INT, -1), scope)


def _bool(node: ast.BoolOp, scope: Scope) -> Value:
    values: list[Value] = []
    for item in node.values:
        values.append(expression(item, scope))
        if item is not node.values[-1]:
            _check_testable(values[-1], scope)
    kind = values[-1].kind
    same = [_merged(value, kind, node, scope) for value in values]
    code = ast.BoolOp(node.op, [value.code for value in same])
    return native(kind, code) if kind in NATIVE else Value(kind, code)


def _merged(value: Value, kind: Kind, node: ast.expr, scope: Scope) -> Value:
    """`value`, where viper takes the type from the other branch and leaves the register as it is."""
    if value.kind in NATIVE and kind in NATIVE:
        return retype(value, kind, scope)
    if value.kind is not kind and scope.error is None:
        refuse(f"a value that is '{value.kind.shown}' or '{kind.shown}': viper does not convert one to the other", node)
    return value


def _choice(node: ast.IfExp, scope: Scope) -> Value:
    test = condition(node.test, scope)
    when_true = expression(node.body, scope)
    when_false = expression(node.orelse, scope)
    when_true = _merged(when_true, when_false.kind, node, scope)
    kind = when_false.kind
    code = choose(test, when_true.code, when_false.code)
    low, high = min(when_true.low, when_false.low), max(when_true.high, when_false.high)
    return Value(kind, code, low, high)


def _compare(node: ast.Compare, scope: Scope) -> Value:
    left = expression(node.left, scope)
    results: list[Value] = []
    rest = list(zip(node.ops, node.comparators, strict=True))
    for position, (operator, item) in enumerate(rest):
        right = expression(item, scope)
        if position + 1 < len(rest) and not is_simple(right.code):
            temporary = scope.fresh()
            bound = Value(right.kind, bind(temporary, right.code), right.low, right.high)
            results.append(comparison(operator, left, bound, scope))
            left = Value(right.kind, name(temporary), right.low, right.high)
        else:
            results.append(comparison(operator, left, right, scope))
            left = right
    if len(results) == 1:
        return results[0]
    for result in results[:-1]:
        _check_testable(result, scope)
    code = ast.BoolOp(ast.And(), [result.code for result in results])
    kind = results[0].kind
    return an_object(code) if kind is Kind.OBJECT else Value(Kind.BOOL, compare(code, (ast.NotEq(), constant(0))), 0, 1)


def _call(node: ast.Call, scope: Scope) -> Value:
    if isinstance(node.func, ast.Attribute):
        callee: ast.expr = _attribute(node.func, scope).code
    else:
        function = expression(node.func, scope)
        if function.kind is Kind.CAST:
            assert function.cast is not None
            return _cast(node, function.cast, scope)
        if function.kind is not Kind.OBJECT and scope.error is None:
            refuse(f"a call of '{function.kind.shown}'", node)
        callee = function.code
    for argument in node.args:
        if isinstance(argument, ast.Starred):
            refuse("a call with *", node)
    arguments = [object_of(argument, scope) for argument in node.args]
    keywords = []
    for keyword in node.keywords:
        if keyword.arg is None:
            refuse("a call with **", node)
        keywords.append(ast.keyword(keyword.arg, object_of(keyword.value, scope)))
    code = ast.Call(callee, arguments, keywords)
    rounded = isinstance(callee, ast.Name) and callee.id in scope.viper_functions
    return an_object(code if rounded else call("$single", code))


def _cast(node: ast.Call, kind: Kind, scope: Scope) -> Value:
    if len(node.args) != 1 or node.keywords or isinstance(node.args[0], ast.Starred):
        refuse(f"a cast to {kind.value} takes one argument", node)
    value = expression(node.args[0], scope)
    if value.kind is Kind.OBJECT:
        return from_object(value.code, kind)
    if value.kind in (Kind.CAST, Kind.UNBOUND):
        raise ViperError("NotImplementedError: casting", node.lineno)
    return retype(value, kind, scope)


def _attribute(node: ast.Attribute, scope: Scope) -> Value:
    base = expression(node.value, scope)
    if base.kind is not Kind.OBJECT and scope.error is None:
        refuse(f"an attribute of '{base.kind.shown}'", node)
    return an_object(ast.Attribute(base.code, node.attr, ast.Load()))


def _subscript(node: ast.Subscript, scope: Scope) -> Value:
    base = expression(node.value, scope)
    if base.kind is Kind.OBJECT:
        return an_object(subscript(base.code, object_index(node.slice, scope)))
    return load_element(base, expression(node.slice, scope), scope)


def object_index(node: ast.expr, scope: Scope) -> ast.expr:
    """A subscript of an object. (Unlike an argument, a constant keeps its cast.)"""
    if isinstance(node, ast.Slice):
        refuse("a slice", node)
    return converted(expression(node, scope), node)


def load_element(base: Value, index: Value, scope: Scope) -> Value:
    """An element through a pointer, always an `int`; what lies outside of the pointer's buffer is looked up."""
    if not (index.kind is Kind.INT and index.immediate is not None) and index.kind not in NUMBERS:
        scope.report(f"can't load with '{index.kind.shown}' index")
    width = WIDTHS.get(base.kind)
    if width is None:
        scope.report(f"can't load from '{base.kind.shown}'")
        return native(Kind.INT, constant(0))
    low, high = (INT_LOW if width == 4 else 0), _ELEMENT_HIGH[base.kind]
    if not (isinstance(base.code, ast.Name) and base.in_local):
        return Value(Kind.INT, call("$load", base.code, index.code, constant(width)), low, high)
    at, inside = checked_index(base.code.id, index, scope)
    elsewhere = call("$load", name(base.code.id), at, constant(width))
    return Value(Kind.INT, choose(inside, subscript(name(elements(base.code.id)), at), elsewhere), low, high)


def elements(pointer: str) -> str:
    """The name of what a local pointer indexes."""
    return f"{pointer}$elements"


def count(pointer: str) -> str:
    """The name of how many elements there are from a local pointer on."""
    return f"{pointer}$count"


def checked_index(pointer: str, index: Value, scope: Scope) -> tuple[ast.expr, ast.expr]:
    """The index as simple code, and a test that it lies inside the buffer, which must be evaluated first."""
    at = tested = index.code
    if not is_simple(at):
        temporary = scope.fresh()
        at, tested = name(temporary), bind(temporary, index.code)
    below = (ast.Lt(), name(count(pointer)))
    return at, compare(tested, below) if index.low >= 0 else compare(constant(0), (ast.LtE(), tested), below)


def _sequence(node: ast.Tuple | ast.List, scope: Scope) -> Value:
    if any(isinstance(item, ast.Starred) for item in node.elts):
        raise ViperError("SyntaxError: *x must be assignment target", node.lineno)
    return an_object(type(node)([object_of(item, scope) for item in node.elts], ast.Load()))


def _generator(node: ast.expr, scope: Scope) -> Value:
    raise ViperError("NotImplementedError: native yield", node.lineno)


_TRANSLATIONS: dict[type[ast.expr], Callable[..., Value]] = {
    ast.Constant: _constant,
    ast.Name: _name,
    ast.BinOp: _binary,
    ast.UnaryOp: _unary,
    ast.BoolOp: _bool,
    ast.IfExp: _choice,
    ast.Compare: _compare,
    ast.Call: _call,
    ast.Attribute: _attribute,
    ast.Subscript: _subscript,
    ast.Tuple: _sequence,
    ast.List: _sequence,
    ast.Yield: _generator,
    ast.YieldFrom: _generator,
    ast.Await: _generator,
}
