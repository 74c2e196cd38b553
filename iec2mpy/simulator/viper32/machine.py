"""What translated code calls while it runs: registers of 32 bits, conversions from and to objects, loops.

An `int` register is a signed Python int, a `uint` or pointer register an unsigned one, a `bool` register a signed one
(it may hold more than 0 and 1: `bool(5)` of an int is 5, as in MicroPython).
"""

from __future__ import annotations

import builtins
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import partial
from typing import Any

from iec2mpy.simulator.viper32.errors import fault, unassigned
from iec2mpy.simulator.viper32.floats import ARITHMETIC, COMPARISON, INPLACE, single
from iec2mpy.simulator.viper32.memory import Memory

INT_LOW, INT_HIGH = -0x80000000, 0x7FFFFFFF
UINT_HIGH = 0xFFFFFFFF
SMALL_LOW, SMALL_HIGH = -0x40000000, 0x3FFFFFFF
"""What an object can hold without memory from the heap."""


@dataclass(slots=True)
class Stats:
    """`boxed`: how often a native value became an object on the heap, as it lay outside of -2^30 to 2^30 - 1."""

    boxed: int = 0

    def reset(self) -> None:
        self.boxed = 0


stats = Stats()


def wrap(value: int) -> int:
    """The low 32 bits as a signed number."""
    value &= UINT_HIGH
    return value - 0x100000000 if value > INT_HIGH else value


def to_object(value: int) -> int:
    if not SMALL_LOW <= value <= SMALL_HIGH:
        stats.boxed += 1
    return value


def to_int(value: Any) -> int:
    """What a cast to `int` makes of an object: its low 32 bits. Not a float: that is a TypeError."""
    if type(value) is not int:
        if isinstance(value, float | str | bytes) or not hasattr(value, "__int__"):
            raise TypeError(f"can't convert {type(value).__name__} to int")
        value = int(value)
    return value if INT_LOW <= value <= INT_HIGH else wrap(value)


def _to_uint(value: Any) -> int:
    return to_int(value) & UINT_HIGH


def _shift_count(count: int) -> int:
    raise fault(f"shift count {count}")


def floor_divide(a: int, b: int) -> int:
    """As MicroPython computes it: it adds to `a` first, and that may leave the 32 bits, so that the quotient is wrong
    although it would fit (-2147483648 // 10, say)."""
    if b == 0:
        raise fault("division by 0")
    sum_first = a
    if a >= 0 > b:
        sum_first = a - b - 1
    elif a < 0 < b:
        sum_first = a - b + 1
    if not INT_LOW <= sum_first <= INT_HIGH or (a == INT_LOW and b == -1):
        raise fault(f"division overflow: {a} // {b}")
    return a // b


def _modulo(a: int, b: int) -> int:
    if b == 0:
        raise fault("division by 0")
    if a == INT_LOW and b == -1:
        raise fault(f"division overflow: {a} % {b}")
    return a % b


def _wrapping(start: int, end: int, step: int, low: int, high: int) -> Iterator[int]:
    value = start
    while value < end if step > 0 else value > end:
        yield value
        value += step
        if not low <= value <= high:
            value += (low - high - 1) if value > high else (high - low + 1)


def _count(low: int, high: int, end: int, start: int, step: int) -> Iterable[int]:
    """The values of a loop over `range`; the end is evaluated first. The value after the last one may wrap, and then
    the loop goes on."""
    if low <= end + step <= high:
        return range(start, end, step)
    return _wrapping(start, end, step, low, high)


_BUILTINS = """
    __build_class__ abs all any bin bool bytearray bytes callable chr classmethod complex delattr dict dir divmod
    enumerate filter float frozenset getattr globals hasattr hash hex id int isinstance issubclass iter len list
    locals map max memoryview min next object oct ord pow print property range repr reversed round set setattr slice
    sorted staticmethod str sum super tuple type zip Ellipsis NotImplemented ArithmeticError AssertionError
    AttributeError BaseException EOFError Exception GeneratorExit ImportError IndentationError IndexError KeyError
    KeyboardInterrupt LookupError MemoryError NameError NotImplementedError OSError OverflowError RuntimeError
    StopIteration SyntaxError SystemExit TypeError UnicodeError ValueError ZeroDivisionError
"""


def builtins_for(memory: Memory, import_module: Callable[..., Any]) -> dict[str, Any]:
    """The built-in names of a module: MicroPython's, and what translated code calls, by names that no text can have."""
    names: dict[str, Any] = {name: getattr(builtins, name) for name in _BUILTINS.split()}
    names |= {
        "__import__": import_module,
        "UnboundLocalError": UnboundLocalError,
        "$wrap": wrap,
        "$object": to_object,
        "$int": to_int,
        "$uint": _to_uint,
        "$true": bool,
        "$shift": _shift_count,
        "$floordiv": floor_divide,
        "$mod": _modulo,
        "$range": partial(_count, INT_LOW, INT_HIGH),
        "$urange": partial(_count, 0, UINT_HIGH),
        "$unassigned": unassigned,
        "$single": single,
        "$address": memory.address,
        "$view": memory.view,
        "$load": memory.load,
        "$store": memory.store,
    }
    names |= {f"${name}": function for name, function in (ARITHMETIC | COMPARISON).items()}
    names |= {f"$i{name}": function for name, function in INPLACE.items()}
    return names
