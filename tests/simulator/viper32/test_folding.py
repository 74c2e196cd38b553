"""What the parser works out before anything is typed."""

from __future__ import annotations

import ast

import pytest

from iec2mpy.simulator.viper32 import ViperError
from iec2mpy.simulator.viper32.folding import fold


def folded(text: str) -> str:
    return ast.unparse(fold(ast.parse(text)))


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("x = 1 + 2 * 3", "x = 7"),
        ("x = 1 + 2 + y", "x = 1 + 2 + y"),
        ("x = (1 + 2) + y", "x = 3 + y"),
        ("x = 1 - (2 + 3) - 4", "x = -8"),
        ("x = y + 1 * 2", "x = y + 2"),
        ("x = 1 << 31 << y", "x = 1 << 31 << y"),
        ("x = 7 // 2 % 3", "x = 0"),
        ("x = 1 // 0", "x = 1 // 0"),
        ("x = 1 << -1", "x = 1 << -1"),
        ("x = 2 ** 3 ** 2", "x = 512"),
        ("x = ~5", "x = -6"),
        ("x = ~1.5", "x = ~1.5"),
        ("x = 0.1 + 0.2", "x = 0.30000000000000004"),
        ("x = True + 1", "x = True + 1"),
        ("x = not 0", "x = True"),
        ("x = 0 or y", "x = y"),
        ("x = y or 0", "x = y or 0"),
        ("x = 1 or y", "x = 1"),
        ("x = 1 and y and 2 and z", "x = y and z"),
        ("if 0:\n    x\nelse:\n    y", "y"),
        ("if 1:\n    x\nelif z:\n    y", "x"),
        ("while 0:\n    x", "pass"),
        ("_A = const(3)\nB = const(_A * 2)\nx = _A + B + y", "pass\nB = 6\nx = 3 + 6 + y"),
        ("_T = const((1, 2))\nx = _T", "pass\nx = (1, 2)"),
        ("def f(y):\n    _A = const(1)\n    return _A\nx = _A", "def f(y):\n    pass\n    return 1\nx = 1"),
    ],
)
def test_folds(text: str, expected: str) -> None:
    assert folded(text) == expected


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("x = const(y)", "SyntaxError: not a constant"),
        ("x = 1\n_A = const(3)\n_A = 4", "SyntaxError: can't assign to expression"),
    ],
)
def test_refused(text: str, message: str) -> None:
    with pytest.raises(ViperError) as caught:
        folded(text)
    assert caught.value.message == message
    assert caught.value.line == len(text.splitlines())
