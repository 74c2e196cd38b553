"""Durations in project files, case files and options: literals of TIME, as in a program (6.3.4, table 8)."""

from __future__ import annotations

from iec2mpy.source.diagnostics import Diagnostics
from iec2mpy.source.spans import SourceFile
from iec2mpy.syntax import time_literals


def parse_duration(text: str) -> int | None:
    """Microseconds of `T#10ms`, `T#1m30s`, `T#1.5s`; None for what is not a duration."""
    text = text.strip()
    prefix, separator, _ = text.partition("#")
    if not separator or time_literals.PREFIXES.get(prefix.upper()) != "duration":
        return None
    diagnostics = Diagnostics()
    token, end = time_literals.read(SourceFile("", text), 0, len(prefix) + 1, prefix, diagnostics)
    if diagnostics.has_errors or end < len(text) or token.value is None:
        return None
    return int(token.value.value) // 1_000
