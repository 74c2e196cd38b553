"""Loading a module: its text is folded, translated, compiled and executed."""

from __future__ import annotations

import ast
import builtins
from types import ModuleType
from typing import Any

from iec2mpy.simulator.viper32.bytecode import translate_module
from iec2mpy.simulator.viper32.errors import ViperError
from iec2mpy.simulator.viper32.folding import fold
from iec2mpy.simulator.viper32.machine import builtins_for
from iec2mpy.simulator.viper32.memory import Memory

_RUNTIME = "mcu_runtime"


def load(text: str, filename: str) -> dict[str, object]:
    """Executes `text` as the module `filename`, and gives its namespace.

    ViperError where MicroPython's compiler refuses the text, or the model does; ViperFault where executing it does what
    no board should; otherwise what the text raises. Lines in tracebacks are those of `text`.
    """
    try:
        tree = ast.parse(text, filename)
    except SyntaxError as error:
        raise ViperError("SyntaxError: invalid syntax", error.lineno or 1) from error
    code = compile(translate_module(fold(tree)), filename, "exec")
    namespace: dict[str, object] = {
        "__name__": filename.rpartition("/")[2].removesuffix(".py"),
        "__builtins__": builtins_for(Memory(), _import_module),
    }
    exec(code, namespace)
    return namespace


def _micropython() -> ModuleType:
    """The module of that name: what its decorators do, the translation has done."""
    module = ModuleType("micropython")
    module.const = lambda value: value  # type: ignore[attr-defined]
    return module


_MICROPYTHON = _micropython()


def _import_module(name: str, *details: Any) -> ModuleType:
    """`import` of a loaded module: it sees the runtime, `array` and `micropython`, and nothing else."""
    if name == "micropython":
        return _MICROPYTHON
    if name == "array" or f"{name}.".startswith(f"{_RUNTIME}."):
        return builtins.__import__(name, *details)
    raise ImportError(f"no module named '{name}'")
