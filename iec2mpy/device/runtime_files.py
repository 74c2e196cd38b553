"""The files of the runtime, compiled, as they stand on a board."""

from __future__ import annotations

from collections.abc import Mapping
from importlib.resources import files

from iec2mpy.backends.mpy import compile_mpy
from iec2mpy.device.deploy import Payload
from mcu_runtime import manifest


def payload(program: Mapping[str, bytes]) -> Payload:
    """A program's files (`program.mpy` or `program.py`, `program.names`, `board.py`) with the runtime around them."""
    folder = dict(program)
    for module in manifest.PACKAGE:
        folder[f"mcu_runtime/{module}.mpy"] = _compiled(module, f"mcu_runtime/{module}")
    for module in manifest.FOLDER:
        folder[f"{module}.mpy"] = _compiled(module, module)
    root = {f"{name}.mpy": _compiled(module, name) for module, name in manifest.ROOT.items()}
    return Payload(folder, root, manifest.MAIN)


def _compiled(module: str, name_there: str) -> bytes:
    """Bytecode, which every architecture runs."""
    source = (files("mcu_runtime") / f"{module}.py").read_text(encoding="utf-8")
    return compile_mpy(source, f"{name_there}.py", architecture=None)
