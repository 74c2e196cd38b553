"""Module level, and the functions that MicroPython compiles to bytecode: Python, but for floats of single precision."""

from __future__ import annotations

import ast
from typing import TypeVar

from iec2mpy.simulator.viper32.code import assign, call, constant, is_simple, name, place
from iec2mpy.simulator.viper32.errors import ViperError
from iec2mpy.simulator.viper32.floats import COMPARISON, is_read_exactly, single
from iec2mpy.simulator.viper32.functions import translate_function
from iec2mpy.simulator.viper32.scope import refuse

_DECORATORS = ("bytecode", "native", "viper")
_Node = TypeVar("_Node", bound=ast.AST)


def translate_module(tree: ast.Module) -> ast.Module:
    """`tree`, after folding, in Python: viper functions as registers compute them, all else in single precision."""
    viper = frozenset(
        node.name for node in tree.body if isinstance(node, ast.FunctionDef) and _emitter(node) == "viper"
    )
    return _Translator(viper).visit(tree)


def _emitter(node: ast.FunctionDef | ast.AsyncFunctionDef) -> str | None:
    """What a decorator of `micropython` asks for. Only the compiler sees these."""
    for decorator in node.decorator_list:
        if not (isinstance(decorator, ast.Attribute) and isinstance(decorator.value, ast.Name)):
            continue
        if decorator.value.id == "micropython":
            if decorator.attr not in _DECORATORS:
                raise ViperError("SyntaxError: invalid micropython decorator", node.lineno)
            return decorator.attr
    return None


class _Translator(ast.NodeTransformer):
    def __init__(self, viper_functions: frozenset[str]) -> None:
        self._viper_functions = viper_functions
        self._temporaries = 0

    def visit_FunctionDef(self, node: ast.FunctionDef) -> ast.stmt:
        emitter = _emitter(node)
        if emitter == "viper":
            if len(node.decorator_list) > 1:
                raise ViperError("viper32: a second decorator of a viper function", node.lineno)
            return translate_function(node, self._viper_functions)
        if emitter is not None:
            node.decorator_list = [each for each in node.decorator_list if not _is_emitter(each)]
        node.returns = None  # MicroPython does not evaluate annotations
        for parameter in (*node.args.args, *node.args.kwonlyargs, node.args.vararg, node.args.kwarg):
            if parameter is not None:
                parameter.annotation = None
        return self._visited(node)

    def visit_AnnAssign(self, node: ast.AnnAssign) -> ast.stmt:
        if node.value is None:
            return ast.copy_location(ast.Pass(), node)
        return ast.copy_location(ast.Assign([node.target], self.visit(node.value)), node)

    def visit_Constant(self, node: ast.Constant) -> ast.expr:
        if isinstance(node.value, float) and not is_read_exactly(node.value):
            refuse(f"the number {node.value}: it is not read exactly in single precision", node)
        return ast.copy_location(constant(single(node.value)), node)

    def visit_JoinedStr(self, node: ast.JoinedStr) -> ast.expr:
        return node

    def visit_BinOp(self, node: ast.BinOp) -> ast.expr:
        return self._placed(call(f"${type(node.op).__name__}", self.visit(node.left), self.visit(node.right)), node)

    def visit_Compare(self, node: ast.Compare) -> ast.expr:
        node = self._visited(node)
        operator = type(node.ops[0]).__name__
        if len(node.ops) > 1 or operator not in COMPARISON:
            return node
        return self._placed(call(f"${operator}", node.left, node.comparators[0]), node)

    def visit_Call(self, node: ast.Call) -> ast.expr:
        return self._placed(call("$single", self._visited(node)), node)

    def visit_AugAssign(self, node: ast.AugAssign) -> list[ast.stmt]:
        """The target's base and index are evaluated once."""
        target = node.target
        code: list[ast.stmt] = []
        if isinstance(target, ast.Subscript):
            target.value = self._kept(self.visit(target.value), code)
            target.slice = self._kept(self.visit(target.slice), code)
            loaded: ast.expr = ast.Subscript(target.value, target.slice, ast.Load())
        elif isinstance(target, ast.Attribute):
            target.value = self._kept(self.visit(target.value), code)
            loaded = ast.Attribute(target.value, target.attr, ast.Load())
        else:
            loaded = name(target.id)
        result = call(f"$i{type(node.op).__name__}", loaded, self.visit(node.value))
        code.append(ast.Assign([target], result))
        for line in code:
            place(line, node)
        return code

    def _kept(self, value: ast.expr, code: list[ast.stmt]) -> ast.expr:
        if is_simple(value):
            return value
        self._temporaries += 1
        identifier = f"${self._temporaries}"
        code.append(assign(identifier, value))
        return name(identifier)

    def _placed(self, result: ast.expr, source: ast.expr) -> ast.expr:
        place(result, source)
        return result

    def _visited(self, node: _Node) -> _Node:
        self.generic_visit(node)
        return node


def _is_emitter(node: ast.expr) -> bool:
    return isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == "micropython"
