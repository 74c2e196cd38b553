"""What is known of a viper function while it is translated."""

from __future__ import annotations

import ast
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import NoReturn

from iec2mpy.simulator.viper32.errors import ViperError
from iec2mpy.simulator.viper32.values import Kind


@dataclass(slots=True)
class Scope:
    """`kinds`: of each local. `result`: what the function returns. `viper_functions`: of the module, whose results are
    rounded already.

    As in MicroPython an error does not end the work: the statement is finished, and the last message stands.
    """

    kinds: dict[str, Kind]
    result: Kind
    viper_functions: frozenset[str]
    error: str | None = None
    error_line: int = 0
    loops: int = 0
    _temporaries: int = field(default=0)

    def report(self, message: str) -> None:
        """A type error of viper's compiler, in its words."""
        self.error = f"ViperTypeError: {message}"

    def fresh(self) -> str:
        """A name for an intermediate result; no text can have it."""
        self._temporaries += 1
        return f"${self._temporaries}"


def refuse(message: str, node: ast.expr | ast.stmt | ast.excepthandler) -> NoReturn:
    """What MicroPython takes, or stumbles over, and generated code may not contain."""
    raise ViperError(f"viper32: {message}", node.lineno)


def local_names(body: Iterable[ast.stmt]) -> set[str]:
    """The names that a function without nested functions assigns, and does not declare global."""
    assigned: set[str] = set()
    declared: set[str] = set()
    for statement in body:
        for node in ast.walk(statement):
            if isinstance(node, ast.Name) and not isinstance(node.ctx, ast.Load):
                assigned.add(node.id)
            elif isinstance(node, ast.ExceptHandler) and node.name is not None:
                assigned.add(node.name)
            elif isinstance(node, ast.Global):
                declared.update(node.names)
    return assigned - declared
