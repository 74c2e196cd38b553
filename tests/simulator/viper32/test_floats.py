"""Floats of single precision, in viper functions, in bytecode, at module level."""

from __future__ import annotations

import math
import struct

import numpy
import pytest
from hypothesis import given
from hypothesis import strategies as st

from iec2mpy.simulator.viper32 import ViperError, load
from iec2mpy.simulator.viper32.floats import ARITHMETIC, COMPARISON, single

from .texts import PREAMBLE, result

singles = st.floats(width=32)


def same(a: float, b: float) -> bool:
    return (math.isnan(a) and math.isnan(b)) or struct.pack("d", a) == struct.pack("d", b)


@given(singles, singles, st.sampled_from(["Add", "Sub", "Mult", "Div"]))
def test_as_hardware_computes(a: float, b: float, name: str) -> None:
    if name == "Div" and b == 0.0:
        with pytest.raises(ZeroDivisionError):
            ARITHMETIC[name](a, b)
        return
    with numpy.errstate(all="ignore"):
        x, y = numpy.float32(a), numpy.float32(b)
        expected = float({"Add": x + y, "Sub": x - y, "Mult": x * y}[name] if name != "Div" else x / y)
    assert same(ARITHMETIC[name](a, b), expected)


@given(st.integers(), singles.filter(math.isfinite))
def test_an_int_beside_a_float_is_rounded(a: int, b: float) -> None:
    assert same(ARITHMETIC["Add"](a, b), ARITHMETIC["Add"](ARITHMETIC["Add"](a, 0.0), b))
    assert COMPARISON["Lt"](a, b) == COMPARISON["Lt"](ARITHMETIC["Add"](a, 0.0), b)


def test_large_ints() -> None:
    assert COMPARISON["Eq"](16777217, 16777216.0)
    assert ARITHMETIC["Div"](16777217, 1) == 16777216.0
    assert ARITHMETIC["Mult"](10**400, 1.0) == math.inf


def test_powers() -> None:
    assert ARITHMETIC["Pow"](1e38, 2) == math.inf
    assert ARITHMETIC["Pow"](1e200, 2.0) == math.inf
    assert ARITHMETIC["Pow"](-1e200, 3.0) == -math.inf
    assert ARITHMETIC["Pow"](2, 70) == 2**70


def test_each_operation_is_rounded() -> None:
    third = single(0.1)
    expected = single(single(16777216.0 + 1.0) * third)
    assert result("return (a + b) * 0.1", "def f(a, b):", 16777216.0, 1.0) == expected
    module = load(PREAMBLE + "def f(a, b):\n    a += b\n    return a * 0.1\nX = 0.1 * f(2.0, 1.0)\n", "b.py")
    function = module["f"]
    assert callable(function)
    assert function(16777216.0, 1.0) == expected
    assert module["X"] == single(third * single(3.0 * third))


def test_what_comes_back_is_rounded() -> None:
    text = PREAMBLE + "def g(x):\n    return x\n@micropython.viper\ndef f(o):\n    return o()\ny = float('0.1')\n"
    module = load(text, "c.py")
    function = module["f"]
    assert callable(function)
    assert function(lambda: 0.1) == single(0.1) == module["y"]


def test_constants_are_folded_in_double_and_then_rounded() -> None:
    assert result("return 16777217.0 - 1.0", "def f():") == 16777216.0
    assert result("o = 0.1\nreturn o", "def f():") == single(0.1)


@pytest.mark.parametrize("literal", ["443.221741", "3.14159274", "16777217.0", "1e10", "1e-20", "1e39", "0.1 + 0.2"])
def test_literals_that_boards_do_not_read_exactly(literal: str) -> None:
    """443.221741 becomes 443.22177 on a board."""
    for text in (f"@micropython.viper\ndef f():\n    return {literal}\n", f"x = {literal}\n"):
        with pytest.raises(ViperError, match="it is not read exactly in single precision"):
            load("import micropython\n" + text, "d.py")


@pytest.mark.parametrize("literal", ["0.0", "443.2217", "1.6777216e7", "9e9", "1e-9", "-16777216e9"])
def test_literals_that_they_do(literal: str) -> None:
    assert load(f"x = {literal}\n", "e.py")["x"] == single(float(literal))


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("return int(a < b) | int(a == b) << 1 | int(a >= b) << 2", 1),
        ("o = [a]\no[0] += b\nreturn int(round(o[0]))", 4),
        ("o = [a]\no[0] = o[0] / b - a\nreturn int(round(o[0] * 4.0))", -4),
        ("return int(round(-a))", -2),
    ],
)
def test_objects_in_viper(body: str, expected: int) -> None:
    assert result(body, "def f(a, b) -> int:", 1.5, 2.5) == expected


def test_a_float_is_not_cast() -> None:
    with pytest.raises(TypeError, match="can't convert float to int"):
        result("return int(a)", "def f(a) -> int:", 1.5)
