"""Durations in project files, case files and options: literals of TIME, as in a program (6.3.4, table 8)."""

from __future__ import annotations

from iec2mpy.syntax.time_literals import value_of


def parse_duration(text: str) -> int | None:
    """Microseconds of `T#10ms`, `T#1m30s`, `T#1.5s`; None for what is not a duration."""
    match value_of(text):
        case ("duration", nanoseconds):
            return nanoseconds // 1_000
        case _:
            return None
