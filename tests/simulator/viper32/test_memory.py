"""Pointers: what they read and write, and what would corrupt a board's memory."""

from __future__ import annotations

import ast
from array import array

import pytest

from iec2mpy.simulator.viper32 import ViperFault
from iec2mpy.simulator.viper32.bytecode import translate_module
from iec2mpy.simulator.viper32.folding import fold

from .texts import loaded, result

BASE = "def f(p: ptr32, a: int) -> int:"


def test_elements_have_the_width_of_the_pointer() -> None:
    data = array("i", [-1, 0x12345678])
    assert result("return p[0]", BASE, data, 0) == -1
    assert result("return p[1]", "def f(p: ptr16) -> int:", data) == 0xFFFF
    assert result("return p[4]", "def f(p: ptr8) -> int:", data) == 0x78
    result("p[0] = a\np[1] = a", "def f(p: ptr8, a: int):", data, 0x1FE)
    assert data.tobytes()[:4] == bytes([0xFE, 0xFE, 0xFF, 0xFF])
    result("p[1] = a", "def f(p: ptr16, a: int):", data, -2)
    assert data.tobytes()[:4] == bytes([0xFE, 0xFE, 0xFE, 0xFF])


def test_unsigned_and_bool_are_stored_as_patterns() -> None:
    data = array("i", [0, 0, 0])
    result("u = uint(a)\np[0] = u\np[1] = a < 0\np[2] = bool(a)", BASE, data, -5)
    assert list(data) == [-5, 1, -5]


def test_an_address_is_a_pointer() -> None:
    text = "x = g(uint(p) + (a << 2))\nreturn int(x)"
    module = loaded(text, BASE)
    other = "import micropython\n@micropython.viper\ndef g(p: ptr32) -> int:\n    p[1] = 9\n    return p[0] + p[-1]\n"
    exec_into(module, other)
    data = array("i", [10, 20, 30, 40])
    function = module["f"]
    assert callable(function)
    assert function(data, 1) == 30
    assert list(data) == [10, 20, 9, 40]


def exec_into(module: dict[str, object], text: str) -> None:
    """Puts the functions of `text` beside those of `module`, with the same memory."""
    exec(compile(translate_module(fold(ast.parse(text))), "other.py", "exec"), module)


@pytest.mark.parametrize("index", [4, 100, -1, 2**29])
@pytest.mark.parametrize("body", ["return p[a]", "return p[a + 0]", "x = p\nreturn x[a]", "return ptr32(p)[a]"])
def test_wild_reads(body: str, index: int) -> None:
    with pytest.raises(ViperFault, match=f"wild read: index {index} ") as caught:
        result(body, BASE, array("i", [0] * 4), index)
    assert caught.value.line == 8 + len(body.splitlines())


def test_an_index_wraps_with_the_address() -> None:
    assert result("return p[a]", BASE, array("i", [5, 6]), -(2**31) + 1) == 6


@pytest.mark.parametrize("index", [4, 100, -1, 2**29])
@pytest.mark.parametrize("body", ["p[a] = 1", "p[a + 0] = 1", "p[a] += 1", "p[a] = p[0] + 1", "ptr32(p)[a] = 1"])
def test_wild_writes(body: str, index: int) -> None:
    data = array("i", [0] * 4)
    with pytest.raises(ViperFault, match="wild"):
        result(body, BASE, data, index)
    assert list(data) == [0] * 4


def test_constant_indices() -> None:
    data = array("i", [1, 2])
    assert result("p[1] = p[0] + 4\nreturn p[1]", BASE, data, 0) == 5
    with pytest.raises(ViperFault, match="wild read: index 2 "):
        result("return p[2]", BASE, data, 0)
    with pytest.raises(ViperFault, match="wild write: index -1 "):
        result("p[-1] = 0", BASE, data, 0)


def test_buffers_of_bytes() -> None:
    data = bytearray(range(8))
    assert result("p[1] = p[0] + p[7]\nreturn p[1]", "def f(p: ptr8) -> int:", data) == 7
    assert result("return p[1]", BASE, data, 0) == 0x07060504
    assert result("return p[1]", "def f(p: ptr8) -> int:", b"ab") == ord("b")
    with pytest.raises(ViperFault, match="read-only"):
        result("p[0] = 1", "def f(p: ptr8):", b"ab")
    assert result("return p[0]", "def f(p: ptr8) -> int:", "xy") == ord("x")


def test_addresses() -> None:
    data = array("i", [0] * 4)
    assert result("return (int(p) & 3) + (a - a)", BASE, data, 0) == 0
    with pytest.raises(ViperFault, match="not a multiple of 4"):
        result("q = ptr32(uint(p) + 2)\nreturn q[0]", BASE, data, 0)
    with pytest.raises(ViperFault, match="wild read"):
        result("return p[0]", BASE, 0, 0)
    with pytest.raises(TypeError):
        result("return p[0]", BASE, 1.5, 0)


def test_two_buffers_are_far_from_each_other() -> None:
    module = loaded("return uint(q) - uint(p)", "def f(p: ptr32, q: ptr32) -> uint:")
    function = module["f"]
    assert callable(function)
    assert function(array("i", [0]), array("i", [0])) > 0x10000


def test_what_is_evaluated_first() -> None:
    """The value, then the index; for an augmented assignment the index, then the value."""
    body = """\
s = []
p[int(bool(s.append(1)))] = int(bool(s.append(2)))
p[int(bool(s.append(3)))] += int(bool(s.append(4)))
return s"""
    assert result(body, "def f(p: ptr32):", array("i", [0])) == [2, 1, 3, 4]
