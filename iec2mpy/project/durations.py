"""Durations in project files and options: a TIME literal, as in a program (6.3.4, table 8)."""

from __future__ import annotations

import re
from fractions import Fraction

_UNITS = {"d": 86_400_000_000, "h": 3_600_000_000, "m": 60_000_000, "s": 1_000_000, "ms": 1_000, "us": 1}
_DURATION = re.compile(r"(?:T|TIME)#((?:\d[\d_]*(?:\.\d+)?(?:d|h|ms|m|s|us)_?)+)", re.IGNORECASE)
_PART = re.compile(r"(\d[\d_]*(?:\.\d+)?)(d|h|ms|m|s|us)", re.IGNORECASE)


def parse_duration(text: str) -> int | None:
    """Microseconds of `T#10ms`, `T#1m30s`, `T#1.5s`; None for what is not a duration."""
    match = _DURATION.fullmatch(text.strip())
    if match is None:
        return None
    total = sum(Fraction(number.replace("_", "")) * _UNITS[unit.lower()] for number, unit in _PART.findall(match[1]))
    return round(total)
