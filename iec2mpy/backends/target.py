"""What code is generated for: its form, the width of a machine word, and the width of a float."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Target:
    """`word`: bits of viper's `int` (32 on boards, 64 on Linux); the portable form has none.

    `single`: whether the MicroPython meant computes in single precision, as those of boards do; elsewhere each REAL
    result is rounded.
    """

    form: str
    word: int
    single: bool


PORTABLE = Target("portable", 0, single=False)
"""Plain Python, for CPython and MicroPython for Linux."""
PORTABLE_BOARD = Target("portable", 0, single=True)
"""Plain Python for boards."""
VIPER64 = Target("viper", 64, single=False)
"""Viper on MicroPython for Linux."""
VIPER32 = Target("viper", 32, single=True)
"""Viper on boards."""

ENGINE_TARGETS = {"cpython": PORTABLE, "micropython": PORTABLE, "viper": VIPER64, "viper32": VIPER32}
"""The target that each engine of the simulator executes."""
