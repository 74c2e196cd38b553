"""Arithmetic of objects where a float has single precision.

The host computes in double and each result is rounded: for + - * / and the square root this gives exactly what single
hardware gives, as a double has more than twice the digits. An int that meets a float becomes a single first.
"""

from __future__ import annotations

import math
import operator
from array import array
from collections.abc import Callable
from decimal import Decimal
from typing import Any

_cell = array("f", [0.0])
_INTEGERS = (int, bool)


def single(value: Any) -> Any:
    """`value`, rounded to single precision if it is a float; too large gives infinity."""
    if type(value) is float:
        _cell[0] = value
        return _cell[0]
    return value


def is_read_exactly(literal: float) -> bool:
    """Whether every MicroPython reads these digits as the nearest single: it takes them times or divided by a power of
    ten, in single precision, and that rounds only once if both are exact."""
    if math.isinf(literal):
        return True
    _, digits, exponent = Decimal(repr(literal)).normalize().as_tuple()
    assert isinstance(exponent, int)
    return int("".join(map(str, digits))) <= 1 << 24 and abs(exponent) <= 9


def _as_single(number: float) -> float:
    """A number as a float of single precision."""
    try:
        _cell[0] = number
    except OverflowError:
        return math.inf if number > 0 else -math.inf
    return _cell[0]


def _matched(a: Any, b: Any) -> tuple[Any, Any]:
    """Both, after an int beside a float has become one."""
    if type(a) is float and type(b) in _INTEGERS:
        return a, _as_single(b)
    if type(b) is float and type(a) in _INTEGERS:
        return _as_single(a), b
    return a, b


def _arithmetic(function: Callable[[Any, Any], Any]) -> Callable[[Any, Any], Any]:
    def operate(a: Any, b: Any) -> Any:
        if type(a) is not type(b):
            a, b = _matched(a, b)
        result = function(a, b)
        if type(result) is float:
            _cell[0] = result
            return _cell[0]
        return result

    return operate


def _comparison(function: Callable[[Any, Any], Any]) -> Callable[[Any, Any], Any]:
    def compare(a: Any, b: Any) -> Any:
        if type(a) is not type(b):
            a, b = _matched(a, b)
        return function(a, b)

    return compare


def _true_division(a: Any, b: Any) -> Any:
    if type(a) in _INTEGERS and type(b) in _INTEGERS:
        return _as_single(a) / _as_single(b)
    return a / b


def _power(a: Any, b: Any) -> Any:
    try:
        return a**b
    except OverflowError:  # pow() of C gives infinity, and MicroPython passes it on
        return -math.inf if a < 0 and math.fmod(b, 2.0) != 0.0 else math.inf


def _inplace_power(a: Any, b: Any) -> Any:
    return _power(a, b) if type(a) is float else operator.ipow(a, b)


def _inplace_division(a: Any, b: Any) -> Any:
    return _true_division(a, b) if type(a) in (float, *_INTEGERS) else operator.itruediv(a, b)


ARITHMETIC = {
    name: _arithmetic(function)
    for name, function in {
        "Add": operator.add,
        "Sub": operator.sub,
        "Mult": operator.mul,
        "Div": _true_division,
        "FloorDiv": operator.floordiv,
        "Mod": operator.mod,
        "Pow": _power,
        "LShift": operator.lshift,
        "RShift": operator.rshift,
        "BitAnd": operator.and_,
        "BitOr": operator.or_,
        "BitXor": operator.xor,
        "MatMult": operator.matmul,
    }.items()
}
"""By the name of the operator's class in `ast`."""

INPLACE = {
    name: _arithmetic(function)
    for name, function in {
        "Add": operator.iadd,
        "Sub": operator.isub,
        "Mult": operator.imul,
        "Div": _inplace_division,
        "FloorDiv": operator.ifloordiv,
        "Mod": operator.imod,
        "Pow": _inplace_power,
        "LShift": operator.ilshift,
        "RShift": operator.irshift,
        "BitAnd": operator.iand,
        "BitOr": operator.ior,
        "BitXor": operator.ixor,
        "MatMult": operator.imatmul,
    }.items()
}

COMPARISON = {
    name: _comparison(function)
    for name, function in {
        "Lt": operator.lt,
        "LtE": operator.le,
        "Gt": operator.gt,
        "GtE": operator.ge,
        "Eq": operator.eq,
        "NotEq": operator.ne,
        "Is": operator.is_,
        "IsNot": operator.is_not,
        "In": lambda a, b: a in b,
        "NotIn": lambda a, b: a not in b,
    }.items()
}
