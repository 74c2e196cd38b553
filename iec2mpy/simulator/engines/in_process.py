"""The engines that run in this process: `cpython`, and `viper32`, which interprets what boards get."""

from __future__ import annotations

import builtins
from collections.abc import Callable, Iterable, Sequence
from types import ModuleType
from typing import Any

from iec2mpy.simulator.engines.base import EngineError, Place, Stored
from iec2mpy.simulator.engines.simulated import Simulated

Load = Callable[[str], dict[str, Any]]
"""From a program's text to its names."""


class InProcessEngine:
    """`base.Engine` for a program in this process."""

    def __init__(self, name: str, load: Load, text: str, *failures: type[BaseException]) -> None:
        """`failures`: what the program's execution may raise that is no `Exception`."""
        self._name = name
        self._failures = (Exception, *failures)
        self._simulated = self._guarded("load", lambda: Simulated(load(text)))

    @property
    def period(self) -> int:
        return self._simulated.period

    def restart(self, cold: bool) -> None:
        self._guarded("restart", lambda: self._simulated.restart(cold))

    def scan(self, n: int) -> tuple[str, int] | None:
        return self._guarded("execute", lambda: self._simulated.scan(n))

    def read(self, places: Sequence[Place]) -> list[Stored]:
        return self._simulated.read(list(places))

    def write(self, items: Iterable[tuple[str, int, Stored]]) -> None:
        self._simulated.write(list(items))

    def close(self) -> None:
        """There is nothing to end."""

    def _guarded(self, doing: str, call: Callable[[], Any]) -> Any:
        try:
            return call()
        except self._failures as error:
            raise EngineError(f"the engine {self._name} could not {doing} the program: {error}") from error


def start_cpython(text: str) -> InProcessEngine:
    """A program in the portable form, executed by this Python."""
    return InProcessEngine("cpython", _executed, text)


def start_viper32(text: str) -> InProcessEngine:
    """A program in the viper form for boards, interpreted."""
    from iec2mpy.simulator.viper32 import ViperFault, load

    return InProcessEngine("viper32", lambda program: load(program, "program.py"), text, ViperFault)


def _executed(text: str) -> dict[str, Any]:
    namespace: dict[str, Any] = {"__name__": "program", "__builtins__": {**vars(builtins), "__import__": _import}}
    exec(compile(text, "program.py", "exec"), namespace)
    return namespace


def _micropython() -> ModuleType:
    """What the portable form takes from MicroPython's module."""
    module = ModuleType("micropython")
    vars(module)["const"] = lambda value: value
    return module


_MICROPYTHON = _micropython()


def _import(name: str, *rest: Any) -> ModuleType:
    return _MICROPYTHON if name == "micropython" else builtins.__import__(name, *rest)
