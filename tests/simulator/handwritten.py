"""Programs written by hand, as the compiler writes them: one text for the portable form, two for viper's."""

from __future__ import annotations

_HEAD = """
from array import array
import micropython
from micropython import const
from mcu_runtime.arithmetic import f32, real_to_int
from mcu_runtime.faults import INDEX, RANGE, ZERO, loop_check
from mcu_runtime.strings import str_concat

_NOW = const(1)
_LOOP = const(2)
_SITE = const(3)
_command = const(8)
_count = const(9)
_total = const(10)
_time = const(11)
_kept = const(12)
_slow = const(13)
_x = const(1)
_text = const(2)

V = array("i", [0] * 16)
O = ["", 0.0, ""]


def reset():
    for slot in range(8, 16):
        V[slot] = 0
    V[_total] = -5
    O[_x] = 0.5
    O[_text] = "ä"

{decorator}
def main():
    v = {pointer}
    o = O
    v[_count] = v[_count] + 1
    v[_kept] = v[_kept] + 1
    v[_total] = {wrapped}
    v[_time] = v[_NOW]
    command = {command}
    if command == 1:
        v[_SITE] = 12
        raise ZERO
    if command == 2:
        v[_SITE] = 13
        while command == 2:
            v[_LOOP] = v[_LOOP] - 1
            if v[_LOOP] == 0:
                loop_check(V)
    if command == 3:
        o[_x] = f32(o[_x] * 0.1)
    if command == 4:
        o[_text] = str_concat(o[_text], "€")
    if command == 5:
        v[_SITE] = 14
        v[_total] = int(real_to_int(o[_x], -100, 100))
    if command == 6:
        o[9999] = 1

{decorator}
def slow():
    v = {pointer}
    v[_slow] = v[_slow] + 1


def task_main():
    main()


def task_slow():
    slow()


TASKS = (("main", 10000, 1, task_main), ("slow", 25000, 2, task_slow))
UNTIMED = None
RETAIN = (((12, 13),), ())
INPUTS = (("%IW0", 8),)
OUTPUTS = ()
HASH = "0"
"""

# The sum wraps as DINT does: that is what the forms have to differ in.
_PORTABLE = {
    "decorator": "",
    "pointer": "V",
    "wrapped": "(v[_total] * 3 + 0x80000000 & 0xFFFFFFFF) - 0x80000000",
    "command": "v[_command]",
}
_VIPER64 = {
    "decorator": "@micropython.viper",
    "pointer": "ptr32(V)",
    "wrapped": "((v[_total] << 32) >> 32) * 3",
    "command": "(v[_command] << 32) >> 32",
}
_VIPER32 = {
    "decorator": "@micropython.viper",
    "pointer": "ptr32(V)",
    "wrapped": "v[_total] * 3",
    "command": "v[_command]",
}

PROGRAMS = {
    engine: _HEAD.format_map(form)
    for engine, form in {
        "cpython": _PORTABLE,
        "micropython": _PORTABLE,
        "viper": _VIPER64,
        "viper32": _VIPER32,
    }.items()
}

COMMAND, COUNT, TOTAL, TIME, KEPT, SLOW = (("V", slot) for slot in range(8, 14))
X, TEXT = ("O", 1), ("O", 2)
