"""Assignments of viper functions: to locals, through pointers, to objects."""

from __future__ import annotations

import ast

from iec2mpy.simulator.viper32.code import assign, assign_all, call, constant, is_simple, name, store, subscript
from iec2mpy.simulator.viper32.expressions import (
    checked_index,
    converted,
    count,
    elements,
    expression,
    load_element,
    object_index,
    operation,
)
from iec2mpy.simulator.viper32.folding import truth
from iec2mpy.simulator.viper32.native import retype
from iec2mpy.simulator.viper32.scope import Scope, refuse
from iec2mpy.simulator.viper32.values import NUMBERS, WIDTHS, Kind, Value, an_object

_Code = list[ast.stmt]
_STORED = NUMBERS | {Kind.BOOL}


def assignment(node: ast.Assign, scope: Scope) -> _Code:
    if len(node.targets) == 1 and _is_pairwise(node.targets[0], node.value):
        assert isinstance(node.value, ast.Tuple) and isinstance(node.targets[0], ast.Tuple)
        values = [expression(item, scope) for item in node.value.elts]
        kept, code = _kept_all(values, scope)
        for target, value in zip(node.targets[0].elts, kept, strict=True):
            code += _assign(target, value, scope)
        return code
    value = expression(node.value, scope)
    code = []
    if len(node.targets) > 1 and not is_simple(value.code):
        value, code = _kept(value, scope)
    for target in node.targets:
        code += _assign(target, value, scope)
    return code


def annotated_assignment(node: ast.AnnAssign, scope: Scope) -> _Code:
    """Viper takes no type from an annotation of a local."""
    return [ast.Pass()] if node.value is None else _assign(node.target, expression(node.value, scope), scope)


def augmented_assignment(node: ast.AugAssign, scope: Scope) -> _Code:
    """The target's base and index are evaluated once, before the operand."""
    target = node.target
    if isinstance(target, ast.Name):
        loaded = expression(ast.copy_location(ast.Name(target.id, ast.Load()), target), scope)
        result = operation(node.op, loaded, expression(node.value, scope), scope, inplace=True)
        return _assign(target, result, scope)
    base, code = _simplified(expression(target.value, scope), scope)
    if isinstance(target, ast.Attribute):
        loaded = an_object(ast.Attribute(_with_attributes(base, target), target.attr, ast.Load()))
        result = operation(node.op, loaded, expression(node.value, scope), scope, inplace=True)
        return [*code, _store_attribute(base.code, target.attr, converted(result, target))]
    if base.kind is Kind.OBJECT:
        index, more = _simplified(an_object(object_index(target.slice, scope)), scope)
        loaded = an_object(subscript(base.code, index.code))
        result = operation(node.op, loaded, expression(node.value, scope), scope, inplace=True)
        return [*code, *more, store(base.code, index.code, converted(result, target))]
    index, more = _simplified(expression(target.slice, scope), scope)
    loaded = load_element(base, index, scope)
    result = operation(node.op, loaded, expression(node.value, scope), scope)
    return [*code, *more, *_store_element(base, index, result, scope)]


def assign_local(identifier: str, value: Value, scope: Scope) -> _Code:
    """A local has the type of what is assigned to it first."""
    kind = scope.kinds[identifier]
    if kind is Kind.UNBOUND:
        kind = scope.kinds[identifier] = value.kind
    elif kind is not value.kind:
        scope.report(f"local '{identifier}' has type '{kind.shown}' but source is '{value.kind.shown}'")
    if kind in WIDTHS:
        view = call("$view", value.code, constant(WIDTHS[kind]))
        return [assign_all([identifier, elements(identifier), count(identifier)], view)]
    return [assign(identifier, value.code)]


def assign_object(target: ast.expr, code: ast.expr, scope: Scope) -> _Code:
    """An object from elsewhere, such as an iterator."""
    return _assign(target, an_object(code), scope)


def _is_pairwise(target: ast.expr, value: ast.expr) -> bool:
    """`a, b = c, d` makes no tuple, for two and for three; a tuple of constants is one object."""
    return (
        isinstance(target, ast.Tuple)
        and isinstance(value, ast.Tuple)
        and len(target.elts) == len(value.elts) in (2, 3)
        and not any(isinstance(item, ast.Starred) for item in (*target.elts, *value.elts))
        and not _has_parentheses(target)
        and not _has_parentheses(value)
        and truth(value) is None
    )


def _has_parentheses(node: ast.Tuple) -> bool:
    first, last = node.elts[0], node.elts[-1]
    starts_before = (node.lineno, node.col_offset) < (first.lineno, first.col_offset)
    return starts_before and (node.end_lineno, node.end_col_offset) > (last.end_lineno, last.end_col_offset)


def _kept(value: Value, scope: Scope) -> tuple[Value, _Code]:
    """`value`, computed now and read later."""
    temporary = scope.fresh()
    return _as_name(value, temporary), [assign(temporary, value.code)]


def _kept_all(values: list[Value], scope: Scope) -> tuple[list[Value], _Code]:
    temporaries = [scope.fresh() for _ in values]
    code = assign_all(temporaries, ast.Tuple([value.code for value in values], ast.Load()))
    return [_as_name(value, at) for value, at in zip(values, temporaries, strict=True)], [code]


def _as_name(value: Value, identifier: str) -> Value:
    return Value(value.kind, name(identifier), value.low, value.high, immediate=value.immediate)


def _simplified(value: Value, scope: Scope) -> tuple[Value, _Code]:
    return (value, []) if is_simple(value.code) else _kept(value, scope)


def _assign(target: ast.expr, value: Value, scope: Scope) -> _Code:
    if isinstance(target, ast.Name):
        if target.id in scope.kinds:
            return assign_local(target.id, value, scope)
        return [assign(target.id, converted(value, target))]
    if isinstance(target, ast.Attribute):
        base = expression(target.value, scope)
        return [_store_attribute(_with_attributes(base, target), target.attr, converted(value, target))]
    if isinstance(target, ast.Subscript):
        base = expression(target.value, scope)
        if base.kind is Kind.OBJECT:
            return [store(base.code, object_index(target.slice, scope), converted(value, target))]
        return _store_element(base, expression(target.slice, scope), value, scope)
    if not isinstance(target, ast.Tuple | ast.List):
        refuse(f"an assignment to {type(target).__name__}", target)
    return _unpack(target, value, scope)


def _unpack(target: ast.Tuple | ast.List, value: Value, scope: Scope) -> _Code:
    if value.kind is not Kind.OBJECT or any(isinstance(item, ast.Starred) for item in target.elts):
        refuse("an assignment to several targets takes an object, and no *", target)
    temporaries = [scope.fresh() for _ in target.elts]
    code: _Code = [assign_all(temporaries, value.code)]
    for item, temporary in zip(target.elts, temporaries, strict=True):
        code += assign_object(item, name(temporary), scope)
    return code


def _with_attributes(base: Value, node: ast.Attribute) -> ast.expr:
    if base.kind is not Kind.OBJECT:
        refuse(f"an attribute of '{base.kind.shown}'", node)
    return base.code


def _store_attribute(base: ast.expr, attribute: str, value: ast.expr) -> ast.stmt:
    return ast.Assign([ast.Attribute(base, attribute, ast.Store())], value)


def _store_element(base: Value, index: Value, value: Value, scope: Scope) -> _Code:
    """Through a pointer. The value is computed first, then the index."""
    if index.kind not in NUMBERS:
        scope.report(f"can't store with '{index.kind.shown}' index")
    if value.kind not in _STORED:
        scope.report(f"can't store '{value.kind.shown}'")
    width = WIDTHS.get(base.kind)
    if width is None:
        scope.report(f"can't store to '{base.kind.shown}'")
    if width is None or scope.error is not None:
        return []
    element = _element_value(value, width, scope)
    code: _Code = []
    if not is_simple(element.code):
        element, code = _kept(element, scope)
    if not (isinstance(base.code, ast.Name) and base.in_local):
        arguments = (base.code, index.code, constant(width), element.code)
        return [*code, ast.Expr(call("$store", *arguments))]
    at, inside = checked_index(base.code.id, index, scope)
    elsewhere = ast.Expr(call("$store", base.code, at, constant(width), element.code))
    return [*code, ast.If(inside, [store(name(elements(base.code.id)), at, element.code)], [elsewhere])]


def _element_value(value: Value, width: int, scope: Scope) -> Value:
    """The number that Python stores in an element of `width` bytes."""
    number = retype(value, Kind.INT, scope)
    high = (1 << 8 * width) - 1
    if width == 4 or (number.low >= 0 and number.high <= high):
        return number
    masked = ast.BinOp(number.low_bits, ast.BitAnd(), constant(high))
    return Value(Kind.INT, masked, 0, high)
