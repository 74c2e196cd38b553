"""Every example compiles to machine code for every chip; and what mpy-cross refuses is told."""

from __future__ import annotations

from pathlib import Path

import pytest

from iec2mpy.backends.mpy import MpyCrossError, compile_mpy
from iec2mpy.backends.target import PORTABLE_BOARD, VIPER32
from iec2mpy.project.compile import compile_files
from iec2mpy.source.files import load_file

_EXAMPLES = sorted(Path(__file__).parents[2].glob("examples/*/src"))
_ARCHITECTURES = {"armv6m": 4, "armv7emsp": 7, "xtensawin": 10, "rv32imc": 11}
"""With the numbers that the header of a `.mpy` has for them."""


@pytest.mark.parametrize("folder", _EXAMPLES, ids=lambda folder: folder.parent.name)
def test_examples(folder: Path) -> None:
    sources = [load_file(path) for path in sorted(folder.glob("*.st"))]
    viper = compile_files(sources, VIPER32).text
    for architecture, number in _ARCHITECTURES.items():
        code = compile_mpy(viper, "program.py", architecture)
        assert code[:2] == b"M\x06"
        assert code[2] >> 2 == number
    portable = compile_mpy(compile_files(sources, PORTABLE_BOARD).text, "program.py", None)
    assert portable[2] >> 2 == 0


def test_there_are_examples() -> None:
    assert len(_EXAMPLES) >= 4


def test_refused() -> None:
    with pytest.raises(MpyCrossError, match="SyntaxError"):
        compile_mpy("def f(:\n", "program.py", None)
