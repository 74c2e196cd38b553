"""Literals of durations, dates and times of day (6.3.4, 6.3.5; tables 8 and 9)."""

from __future__ import annotations

import re
from datetime import date

from iec2mpy.source.diagnostics import Diagnostics
from iec2mpy.source.spans import SourceFile, Span
from iec2mpy.syntax.tokens import Token
from iec2mpy.syntax.tree import Literal

_SECOND = 1_000_000_000
_DAY = 86_400 * _SECOND
UNITS = {"d": _DAY, "h": 3_600 * _SECOND, "m": 60 * _SECOND, "s": _SECOND, "ms": 1_000_000, "us": 1_000, "ns": 1}
"""Nanoseconds in each unit of a duration, the largest first."""

PREFIXES: dict[str, str] = {
    **dict.fromkeys(("T", "TIME", "LT", "LTIME"), "duration"),
    **dict.fromkeys(("D", "DATE", "LD", "LDATE"), "date"),
    **dict.fromkeys(("TOD", "TIME_OF_DAY", "LTOD", "LTIME_OF_DAY"), "tod"),
    **dict.fromkeys(("DT", "DATE_AND_TIME", "LDT", "LDATE_AND_TIME"), "dt"),
}
"""Each prefix with the kind of its literals."""

# What is taken for the literal, right or wrong, so that an error is about all of it.
_CHUNKS = {
    "duration": re.compile(r"[+-]?\w+(?:\.\w+)*"),
    "date": re.compile(r"\w+(?:-\w+){0,2}"),
    "tod": re.compile(r"\w+(?::\w+){0,2}(?:\.\w+)?"),
    "dt": re.compile(r"\w+(?:-\w+){0,3}(?::\w+){0,2}(?:\.\w+)?"),
}
_NUMBER = r"\d+(?:_\d+)*"
_FIXED = rf"{_NUMBER}(?:\.{_NUMBER})?"
_INTERVAL = re.compile(rf"[+-]?(?:{_FIXED}(?:ms|us|ns|d|h|m|s)_?)+(?<!_)\Z", re.IGNORECASE)
_PART = re.compile(rf"({_FIXED})(ms|us|ns|d|h|m|s)", re.IGNORECASE)
_DATE = re.compile(rf"({_NUMBER})-({_NUMBER})-({_NUMBER})\Z")
_DAYTIME = re.compile(rf"({_NUMBER}):({_NUMBER}):({_FIXED})\Z")
_EXAMPLES = {"duration": "1h30m", "date": "2024-12-31", "tod": "23:59:59", "dt": "2024-12-31-23:59:59"}
_EPOCH = date(1970, 1, 1)


class _BadLiteral(Exception):
    """`code` and the message of what is wrong with a literal, and a hint."""

    def __init__(self, code: str, message: str, hint: str | None = None) -> None:
        super().__init__(message)
        self.code = code
        self.message = message
        self.hint = hint


def read(file: SourceFile, start: int, at: int, prefix: str, diagnostics: Diagnostics) -> tuple[Token, int]:
    """The literal that starts at `start`, whose prefix and `#` end at `at`: its token, and where it ends."""
    kind = PREFIXES[prefix.upper()]
    found = _CHUNKS[kind].match(file.text, at)
    end = found.end() if found else at
    text = file.text[at:end]
    span = Span(file, start, end)
    value, bad = 0, False
    try:
        if not text:
            raise _BadLiteral(
                _code(kind), f"The value is missing behind `{prefix}#`.", f"Write `{prefix}#{_EXAMPLES[kind]}`."
            )
        value = _READERS[kind](text, span.text)
    except _BadLiteral as problem:
        diagnostics.add(problem.code, problem.message, span, problem.hint)
        bad = True
    return Token("LITERAL", span.text, start, end, file, Literal(kind, value, prefix, span), bad), end


def value_of(text: str) -> tuple[str, int] | None:
    """The kind and the nanoseconds of a literal that stands alone, as in a project file or a case file: `T#1m30s`. None
    for everything else."""
    text = text.strip()
    prefix, separator, _ = text.partition("#")
    if not separator or prefix.upper() not in PREFIXES:
        return None
    diagnostics = Diagnostics()
    token, end = read(SourceFile("", text), 0, len(prefix) + 1, prefix, diagnostics)
    if diagnostics.has_errors or end < len(text) or token.value is None:
        return None
    return PREFIXES[prefix.upper()], int(token.value.value)


def _code(kind: str) -> str:
    return "E0108" if kind == "duration" else "E0109"


def _fixed(text: str, unit: int) -> int:
    """A number with or without a fraction, times `unit`, rounded down: exact, as no float is involved."""
    whole, _, fraction = text.replace("_", "").partition(".")
    return int(whole) * unit + (int(fraction) * unit // 10 ** len(fraction) if fraction else 0)


def _duration(text: str, shown: str) -> int:
    if not _INTERVAL.match(text) or len(text) > 200:
        raise _BadLiteral("E0108", f"`{shown}` is no duration.", _duration_hint(text))
    parts: list[tuple[str, str]] = _PART.findall(text)
    order = list(UNITS)
    total = 0
    last = -1
    for number, unit in parts:
        place = order.index(unit.lower())
        if place <= last:
            raise _BadLiteral(
                "E0108", f"`{shown}`: units go from the largest to the smallest, each once.", "Such as `T#1d2h3m4s5ms`."
            )
        last = place
        total += _fixed(number, UNITS[unit.lower()])
    for number, unit in parts[:-1]:
        if "." in number:
            raise _BadLiteral(
                "E0108", f"`{shown}`: only the last unit can have a fraction; `{number}{unit}` is not the last."
            )
    return -total if text.startswith("-") else total


def _duration_hint(text: str) -> str:
    if re.fullmatch(rf"[+-]?{_FIXED}", text):
        return f"The unit is missing: `{text}ms`, `{text}s`, `{text}m`, `{text}h` or `{text}d`."
    return "Write numbers with the units d, h, m, s, ms, us, ns, without spaces: `T#1h30m`, `T#1.5s`."


def _date(text: str, shown: str) -> int:
    found = _DATE.match(text)
    if not found:
        raise _BadLiteral("E0109", f"`{shown}` is no date.", "A date is year, month and day: `D#2024-12-31`.")
    year, month, day = (int(number.replace("_", "")) if len(number) < 9 else 0 for number in found.groups())
    if not 1 <= month <= 12:
        raise _BadLiteral("E0110", f"`{shown}`: there is no month {month}.", "The order is year, month, day.")
    try:
        return (date(year, month, day) - _EPOCH).days * _DAY
    except ValueError:
        raise _BadLiteral("E0110", f"`{shown}`: there is no day {day} in month {month} of year {year}.") from None


def _daytime(text: str, shown: str) -> int:
    found = _DAYTIME.match(text)
    if not found or len(text) > 100:
        raise _BadLiteral(
            "E0109", f"`{shown}` is no time of day.", "Hours, minutes and seconds are all written: `TOD#15:36:00`."
        )
    hours, minutes = (int(number.replace("_", "")) for number in found.groups()[:2])
    seconds = _fixed(found.group(3), _SECOND)
    for name, value, limit in (("hour", hours, 24), ("minute", minutes, 60), ("second", seconds // _SECOND, 60)):
        if value >= limit:
            raise _BadLiteral("E0110", f"`{shown}`: there is no {name} {value}; it goes from 0 to {limit - 1}.")
    return (hours * 3600 + minutes * 60) * _SECOND + seconds


def _date_and_time(text: str, shown: str) -> int:
    found = re.match(r"(\w+-\w+-\w+)-([\w:.]+)\Z", text)
    if not found:
        raise _BadLiteral("E0109", f"`{shown}` is no date with a time.", "Write it like `DT#2024-12-31-23:59:59`.")
    return _date(found.group(1), shown) + _daytime(found.group(2), shown)


_READERS = {"duration": _duration, "date": _date, "tod": _daytime, "dt": _date_and_time}
