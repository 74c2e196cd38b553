"""What MicroPython's parser works out before viper's compiler sees the text.

It puts in the values of `X = const(…)`, folds operations on numbers (never a part of a chain: in `1 + 2 + x` nothing is
folded, in `(1 + 2) + x` a sum is), and drops operands of `and` and `or` that are decided. Code under a condition that
is constant is not compiled at all, so what it assigns is no local.
"""

from __future__ import annotations

import ast
import copy
import operator
from collections.abc import Callable
from typing import Any, TypeVar

from iec2mpy.simulator.viper32.errors import ViperError

_OPERATIONS: dict[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.BitOr: operator.or_,
    ast.BitXor: operator.xor,
    ast.BitAnd: operator.and_,
    ast.LShift: operator.lshift,
    ast.RShift: operator.rshift,
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: operator.mod,
    ast.Pow: operator.pow,
    ast.MatMult: operator.matmul,
}
_CHAINS: tuple[tuple[type[ast.operator], ...], ...] = (
    (ast.BitOr,),
    (ast.BitXor,),
    (ast.BitAnd,),
    (ast.LShift, ast.RShift),
    (ast.Add, ast.Sub),
    (ast.Mult, ast.MatMult, ast.Div, ast.Mod, ast.FloorDiv),
    (ast.Pow,),
)
"""Operators that stand in one rule of MicroPython's grammar."""

_Node = TypeVar("_Node", bound=ast.AST)


def fold(tree: ast.Module) -> ast.Module:
    """`tree` after the parser's work; ViperError where `const()` has no constant, or a constant is assigned to."""
    return _Folder({}).visit(tree)


def truth(node: ast.expr) -> bool | None:
    """What a condition is known to be, or None."""
    if isinstance(node, ast.Constant):
        return bool(node.value)
    if isinstance(node, ast.Tuple) and all(truth(item) is not None for item in node.elts):
        return bool(node.elts)
    return None


def _is_number(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and type(node.value) in (int, float)


def _const_argument(node: ast.expr) -> ast.expr | None:
    """`x` of `const(x)`."""
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "const" and not node.keywords:
        return node.args[0] if len(node.args) == 1 else None
    return None


def _starts_with(node: ast.BinOp, left: ast.expr) -> bool:
    """Whether no parenthesis stands before `left`."""
    return (node.lineno, node.col_offset) == (left.lineno, left.col_offset)


def _chain(node: ast.BinOp) -> list[ast.BinOp]:
    """The operations of one grammar rule, the last one first."""
    rule = next(rule for rule in _CHAINS if isinstance(node.op, rule))
    operations = [node]
    left = node.left
    while isinstance(left, ast.BinOp) and isinstance(left.op, rule) and _starts_with(node, left):
        operations.append(left)
        left = left.left
    return operations


class _Folder(ast.NodeTransformer):
    def __init__(self, constants: dict[str, ast.expr]) -> None:
        self._constants = constants

    def visit_Name(self, node: ast.Name) -> ast.expr:
        known = self._constants.get(node.id)
        if known is None:
            return node
        if not isinstance(node.ctx, ast.Load):
            raise ViperError("SyntaxError: can't assign to expression", node.lineno)
        return ast.copy_location(copy.deepcopy(known), node)

    def visit_Assign(self, node: ast.Assign) -> ast.stmt:
        target = node.targets[0]
        argument = _const_argument(node.value)
        if argument is None or len(node.targets) > 1 or not isinstance(target, ast.Name):
            return self._visited(node)
        value = self.visit(argument)
        if not isinstance(value, ast.Constant | ast.Tuple) or truth(value) is None:
            raise ViperError("SyntaxError: not a constant", node.lineno)
        self.visit(target)
        self._constants[target.id] = value
        if target.id.startswith("_"):
            return ast.copy_location(ast.Pass(), node)
        node.value = value
        return node

    def visit_BinOp(self, node: ast.BinOp) -> ast.expr:
        operations = _chain(node)
        for operation in operations:
            operation.right = self.visit(operation.right)
        first = operations[-1]
        first.left = self.visit(first.left)
        if not _is_number(first.left) or not all(_is_number(operation.right) for operation in operations):
            return node
        result = first.left.value  # type: ignore[attr-defined]
        try:
            for operation in reversed(operations):
                result = _OPERATIONS[type(operation.op)](result, operation.right.value)  # type: ignore[attr-defined]
        except (ArithmeticError, ValueError, TypeError):
            return node
        return node if isinstance(result, complex) else ast.copy_location(ast.Constant(result), node)

    def visit_UnaryOp(self, node: ast.UnaryOp) -> ast.expr:
        node.operand = self.visit(node.operand)
        if isinstance(node.op, ast.Not):
            known = truth(node.operand)
            return node if known is None else ast.copy_location(ast.Constant(not known), node)
        if not _is_number(node.operand):
            return node
        number = node.operand.value  # type: ignore[attr-defined]
        if isinstance(node.op, ast.Invert):
            return node if isinstance(number, float) else ast.copy_location(ast.Constant(~number), node)
        return ast.copy_location(ast.Constant(-number if isinstance(node.op, ast.USub) else number), node)

    def visit_BoolOp(self, node: ast.BoolOp) -> ast.expr:
        node = self._visited(node)
        decisive = isinstance(node.op, ast.Or)
        kept: list[ast.expr] = []
        for value in node.values[:-1]:
            known = truth(value)
            if known is decisive:
                kept.append(value)
                break
            if known is None:
                kept.append(value)
        else:
            kept.append(node.values[-1])
        node.values = kept
        return kept[0] if len(kept) == 1 else node

    def visit_If(self, node: ast.If) -> ast.stmt | list[ast.stmt]:
        node = self._visited(node)
        known = truth(node.test)
        if known is None:
            return node
        return (node.body if known else node.orelse) or ast.copy_location(ast.Pass(), node)

    def visit_While(self, node: ast.While) -> ast.stmt | list[ast.stmt]:
        node = self._visited(node)
        if truth(node.test) is not False:
            return node
        return node.orelse or ast.copy_location(ast.Pass(), node)

    def _visited(self, node: _Node) -> _Node:
        self.generic_visit(node)
        return node
