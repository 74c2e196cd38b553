"""Short names for the nodes of Python's tree that translated code is made of. They get their lines from `place`."""

from __future__ import annotations

import ast


def name(identifier: str) -> ast.Name:
    return ast.Name(identifier, ast.Load())


def constant(value: object) -> ast.Constant:
    return ast.Constant(value)  # type: ignore[arg-type]


def call(function: str, *arguments: ast.expr) -> ast.Call:
    return ast.Call(name(function), list(arguments), [])


def binary(left: ast.expr, operator: ast.operator, right: ast.expr) -> ast.BinOp:
    return ast.BinOp(left, operator, right)


def compare(left: ast.expr, *rest: tuple[ast.cmpop, ast.expr]) -> ast.Compare:
    return ast.Compare(left, [operator for operator, _ in rest], [operand for _, operand in rest])


def choose(test: ast.expr, when_true: ast.expr, when_false: ast.expr) -> ast.IfExp:
    return ast.IfExp(test, when_true, when_false)


def bind(identifier: str, value: ast.expr) -> ast.NamedExpr:
    return ast.NamedExpr(ast.Name(identifier, ast.Store()), value)


def subscript(base: ast.expr, index: ast.expr) -> ast.Subscript:
    return ast.Subscript(base, index, ast.Load())


def assign(target: str, value: ast.expr) -> ast.Assign:
    return ast.Assign([ast.Name(target, ast.Store())], value)


def assign_all(targets: list[str], value: ast.expr) -> ast.Assign:
    return ast.Assign([ast.Tuple([ast.Name(target, ast.Store()) for target in targets], ast.Store())], value)


def store(base: ast.expr, index: ast.expr, value: ast.expr) -> ast.Assign:
    return ast.Assign([ast.Subscript(base, index, ast.Store())], value)


def is_simple(node: ast.expr) -> bool:
    """It may be written twice: it costs little, and evaluating it again gives the same."""
    return isinstance(node, ast.Name | ast.Constant)


def place(node: ast.AST, source: ast.expr | ast.stmt | ast.excepthandler) -> None:
    """Gives the lines of `source` to `node` and to those below it that have none."""
    if "lineno" in node._attributes:
        if hasattr(node, "lineno"):
            return
        ast.copy_location(node, source)
    for child in ast.iter_child_nodes(node):
        place(child, source)
