"""How values look, and how they are read from a command line."""

from __future__ import annotations

import math

import pytest

from iec2mpy.backends.memory_map import Leaf, MappedVariable, MemoryMap
from iec2mpy.simulator.values import differences, parse_value, show


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (True, "true"),
        (5, "5"),
        (0.1, "0.1"),
        (3.0, "3.0"),
        (1.0e20, "1e+20"),
        (16777216.0, "1.677722e+07"),
        (math.inf, "inf"),
        ('say "hi"', '"say \\"hi\\""'),
        ([1, [True]], "[1, [true]]"),
        ({"a": 1, "b": "x"}, '{ a = 1, b = "x" }'),
    ],
)
def test_show(value: object, text: str) -> None:
    assert show(value) == text


def _leaf(kind: str) -> Leaf:
    array = "O" if kind in ("real", "string") else "V"
    variable = MappedVariable("main.x", kind.upper(), kind, array, 8, -(1 << 31), (1 << 31) - 1)
    return Leaf(variable, "main.x", 8)


@pytest.mark.parametrize(
    ("kind", "text", "value"),
    [
        ("bool", "TRUE", True),
        ("bool", "false", False),
        ("bool", "1", 1),
        ("integer", "-5", -5),
        ("integer", "0xFF", 255),
        ("integer", "five", "five"),
        ("real", "2.5", 2.5),
        ("real", "1e3", 1000.0),
        ("duration", "T#5s", "T#5s"),
        ("string", "5", "5"),
        ("enum", "red", "red"),
    ],
)
def test_parse_value(kind: str, text: str, value: object) -> None:
    assert parse_value(_leaf(kind), text) == value


@pytest.mark.parametrize(
    ("expected", "found", "same"),
    [
        (1.0, 1.000009, True),
        (1.0, 1.00002, False),
        (0.0, 1e-30, False),
        (1000000, 1000009.0, True),
        (math.nan, math.nan, True),
        (math.inf, math.inf, True),
        (math.inf, 1.0, False),
    ],
)
def test_real_to_one_part_in_100_000(expected: float, found: float, same: bool) -> None:
    leaf = _leaf("real")
    memory_map = MemoryMap([leaf.variable], {}, [], "main")
    assert (differences(memory_map, leaf, expected, found) == []) is same
