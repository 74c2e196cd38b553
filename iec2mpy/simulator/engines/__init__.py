"""The engines: what executes a generated program in virtual time."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from iec2mpy.simulator.engines.base import Engine, EngineError, EngineUnavailable, Place, Stored
from iec2mpy.simulator.engines.in_process import start_cpython, start_viper32
from iec2mpy.simulator.engines.micropython_linux import MicroPythonEngine

_STARTERS: Mapping[str, Callable[[str], Engine]] = {
    "cpython": start_cpython,
    "micropython": MicroPythonEngine,
    "viper": MicroPythonEngine,
    "viper32": start_viper32,
}

ENGINES = tuple(_STARTERS)


def start(name: str, text: str) -> Engine:
    """An engine with the program in it, restarted cold. `text` is in the form that `ENGINE_TARGETS` has for the name.

    Raises EngineUnavailable where the engine is not installed, and EngineError where it does not take the program.
    """
    return _STARTERS[name](text)


__all__ = ["ENGINES", "Engine", "EngineError", "EngineUnavailable", "Place", "Stored", "start"]
