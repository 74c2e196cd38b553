"""Registers: wrap-around, shifts, division, signs, boxing."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from iec2mpy.simulator.viper32 import ViperFault, stats
from iec2mpy.simulator.viper32.machine import floor_divide

from .texts import loaded, result

LOW, HIGH = -(2**31), 2**31 - 1
INT = "def f(a: int, b: int) -> int:"
UINT = "def f(a: uint, b: uint) -> uint:"
words = st.integers(LOW, HIGH)


@pytest.mark.parametrize(
    ("body", "head", "arguments", "expected"),
    [
        ("return a + b", INT, (HIGH, 1), LOW),
        ("return a - b", INT, (LOW, 1), HIGH),
        ("return a * b", INT, (65536, 65536), 0),
        ("return a * b", INT, (HIGH, HIGH), 1),
        ("return a << b", INT, (1, 31), LOW),
        ("return a << 4", INT, (0x12345678, 0), 0x23456780),
        ("return a >> b", INT, (LOW, 31), -1),
        ("return a >> b", UINT, (LOW, 31), 1),
        ("return a + b", UINT, (-1, 2), 1),
        ("return a - b", UINT, (0, 1), 0xFFFFFFFF),
        ("return a | b", UINT, (LOW, 1), 0x80000001),
        ("return 0 - a", INT, (LOW, 0), LOW),
        ("return -(a + b)", INT, (3, 4), -7),
        ("return ~(a + b)", INT, (3, 4), -8),
        ("return a // b", INT, (-7, 2), -4),
        ("return a // b", INT, (7, -2), -4),
        ("return a % b", INT, (-7, 3), 2),
        ("return a % b", INT, (7, -3), -2),
        ("return a % -3", INT, (7, 0), -2),
        ("u = uint(a)\nreturn int(u + b)", INT, (HIGH, HIGH), -2),
        ("u = uint(a)\nreturn a + u", INT, (-1, 0), -2),
        ("u = uint(b)\nreturn a % u", INT, (-7, -3), -1),
        ("return int(bool(a))", INT, (5, 0), 5),
        ("return int(bool(max(a, b)))", INT, (5, 0), 1),
        ("return 1 << 31 << b", INT, (0, 0), LOW),
    ],
)
def test_wrap_around(body: str, head: str, arguments: tuple[int, int], expected: int) -> None:
    assert result(body, head, *arguments) == expected


@given(words, words)
def test_comparisons_go_by_the_type(a: int, b: int) -> None:
    body = "return a < b"
    assert result(body, "def f(a: int, b: int) -> bool:", a, b) is (a < b)
    assert result(body, "def f(a: uint, b: uint) -> bool:", a, b) is (a % 2**32 < b % 2**32)


@pytest.mark.parametrize("count", [-1, 32, 33])
@pytest.mark.parametrize("body", ["return a << b", "return a >> b", "return a << (b + 0)"])
def test_shift_counts_outside_of_a_word(body: str, count: int) -> None:
    with pytest.raises(ViperFault, match=f"shift count {count} ") as caught:
        result(body, INT, 1, count)
    assert caught.value.line == 9
    assert caught.value.filename == "program.py"


@pytest.mark.parametrize("body", ["return a // b", "return a % b", "return a // 0", "return a % 0"])
def test_division_by_0(body: str) -> None:
    with pytest.raises(ViperFault, match="division by 0"):
        result(body, INT, 5, 0)


@pytest.mark.parametrize(("a", "b"), [(LOW, 10), (HIGH, -2), (LOW + 8, 10)])
def test_quotients_that_boards_get_wrong(a: int, b: int) -> None:
    with pytest.raises(ViperFault, match="division overflow"):
        result("return a // b", INT, a, b)
    if b == 10:
        with pytest.raises(ViperFault, match="division overflow"):
            result("return a // 10", INT, a, 0)


@pytest.mark.parametrize("body", ["return a // b", "return a // -1", "return a % b", "return a % -1"])
def test_lowest_number_by_minus_one(body: str) -> None:
    """It wraps on ARM, and ends the process on x86."""
    with pytest.raises(ViperFault, match="division overflow"):
        result(body, INT, LOW, -1)


def test_quotients_next_to_these() -> None:
    assert result("return a // 10", INT, LOW + 9, 0) == (LOW + 9) // 10
    assert result("return (a >> 1) // 10", INT, LOW, 0) == (LOW >> 1) // 10


@given(st.integers(-(2**29), 2**29), words.filter(bool))
def test_quotients_round_down(a: int, b: int) -> None:
    if abs(a) + abs(b) <= HIGH:
        assert floor_divide(a, b) == a // b


@pytest.mark.parametrize(
    ("header", "expected"),
    [
        ("range(3)", [0, 1, 2]),
        ("range(5, 1, -2)", [5, 3]),
        ("range(a, b)", [7, 8]),
        ("range(b, a, -1)", [9, 8]),
        ("range(uint(a), uint(b))", [7, 8]),
        ("range(b, a)", []),
    ],
)
def test_counting_loops(header: str, expected: list[int]) -> None:
    body = f"s = []\nfor i in {header}:\n    s.append(i)\n    i = i\nreturn s"
    assert result(body, "def f(a: int, b: int):", 7, 9) == expected


def test_a_loop_that_counts_over_the_top_goes_on() -> None:
    body = "n = 0\nfor i in range(a, b, 2):\n    n += 1\n    if n == 3: return i\nreturn n"
    assert result(body, INT, HIGH - 1, HIGH) == LOW + 2
    assert result(body, INT, HIGH - 4, HIGH - 1) == 2


def test_end_of_a_range_is_evaluated_first() -> None:
    body = "s = []\nfor i in range(int(bool(s.append(1))), int(bool(s.append(2)))): pass\nreturn s"
    assert result(body, "def f():") == [2, 1]


def test_boxing_is_counted() -> None:
    module = loaded("return a + b", INT)
    f = module["f"]
    assert callable(f)
    stats.reset()
    f(1, 2)
    assert stats.boxed == 0
    f(2**30 - 1, 1)
    f(-(2**30), -1)
    assert stats.boxed == 2
    f(-(2**30), 0)
    assert stats.boxed == 2


def test_arguments_of_calls_are_boxed() -> None:
    stats.reset()
    assert result("return max(a, u, -1)", "def f(a: int, u: uint):", 5, LOW) == 0x80000000
    assert stats.boxed == 1


def test_a_constant_argument_loses_its_cast() -> None:
    assert result("return [uint(-1)]", "def f():") == [-1]
    assert result("x = uint(-1)\nreturn [x]", "def f():") == [0xFFFFFFFF]


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("if a and b: return 1", 0),
        ("if a or b: return 1", 1),
        ("if not b and (a or b): return 1", 1),
        ("return a and b", 0),
        ("return a or b", 5),
        ("return b or a < 9 or b", 1),
        ("return (a > 3) and a", 5),
        ("return a if b else 7", 7),
        ("return 1 if b < a < 9 else 2", 1),
        ("return int(b < a < 5)", 0),
        ("x = a == 5\nif x: return 1", 1),
        ("a, b = b, a\nreturn a - b", -5),
        ("x = y = a\nreturn x + y", 10),
        ("while a > 2: a -= 1\nelse: b = 9\nreturn a + b", 11),
        ("try:\n    raise ValueError\nexcept (KeyError, ValueError):\n    return 3", 3),
        ("try:\n    b = a // 2\nfinally:\n    b += 2\nreturn b", 4),
        ("x, y = divmod(a, 3)\nreturn int(y)", 2),
        ("assert a == 5\nreturn 1", 1),
        ("pass", 0),
    ],
)
def test_control_flow(body: str, expected: int) -> None:
    assert result(body, INT, 5, 0) == expected


def test_a_return_type_makes_an_object() -> None:
    assert result("pass", "def f() -> bool:") is False
    assert result("pass", "def f():") is None
    assert result("return None", "def f() -> uint:") == 0
    assert result("return bool(a)", "def f(a: int) -> bool:", 4) is True


@pytest.mark.parametrize("argument", [1.0, "1", None, []])
def test_what_is_no_int(argument: object) -> None:
    with pytest.raises(TypeError):
        result("return a", "def f(a: int) -> int:", argument)


def test_arguments_are_truncated() -> None:
    assert result("return a", "def f(a: int) -> int:", 2**32 + 5) == 5
    assert result("return a", "def f(a: uint) -> uint:", -1) == 0xFFFFFFFF
    assert result("return a", "def f(a: int) -> int:", True) == 1


def test_a_local_that_was_not_assigned() -> None:
    with pytest.raises(ViperFault, match="read before assignment") as caught:
        result("if a: x = 1\nreturn x", "def f(a: int) -> int:", 0)
    assert caught.value.line == 10


def test_no_handler_sees_a_fault_of_the_model() -> None:
    with pytest.raises(ViperFault):
        result("try:\n    return a // b\nexcept:\n    return 1", INT, 1, 0)
