"""Dates and times of day (6.3.5, tables 26, 35, 36): what their numbers mean. Pure functions on stored values.

A date is a count of days, or of nanoseconds, since 1970-01-01; a time of day one since midnight. What no calendar has
raises ValueError here; whether a result fits its type is for the caller to say.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from datetime import date, timedelta

from iec2mpy.semantics.types import DATE, DT, LDATE, LDT, LTIME, LTOD, TIME, TOD, ElementaryType, Kind
from iec2mpy.syntax.time_literals import value_of

SECOND = 1_000_000_000
DAY = 86_400 * SECOND
UNIT: Mapping[ElementaryType, int] = {
    **{TIME: 1_000_000, DATE: DAY, TOD: 1_000_000, DT: 1_000_000},
    **dict.fromkeys((LTIME, LDATE, LTOD, LDT), 1),
}
"""Nanoseconds that a stored 1 stands for."""
COUNTED: Mapping[ElementaryType, int] = {**UNIT, DATE: SECOND, DT: SECOND}
"""Nanoseconds that 1 stands for where a number becomes such a value, or such a value a number: DATE and DT count in
seconds, as in the systems that public programs were written for."""

DURATION: Mapping[ElementaryType, ElementaryType] = {
    **dict.fromkeys((DATE, TOD, DT), TIME),
    **dict.fromkeys((LDATE, LTOD, LDT), LTIME),
}
"""The duration that goes with each date or time of day (table 35)."""

TYPE_OF_PREFIX: Mapping[str, ElementaryType] = {
    **dict.fromkeys(("T", "TIME"), TIME),
    **dict.fromkeys(("LT", "LTIME"), LTIME),
    **dict.fromkeys(("D", "DATE"), DATE),
    **dict.fromkeys(("LD", "LDATE"), LDATE),
    **dict.fromkeys(("TOD", "TIME_OF_DAY"), TOD),
    **dict.fromkeys(("LTOD", "LTIME_OF_DAY"), LTOD),
    **dict.fromkeys(("DT", "DATE_AND_TIME"), DT),
    **dict.fromkeys(("LDT", "LDATE_AND_TIME"), LDT),
}
"""The types of the literals of tables 8 and 9, by their prefixes."""

_SHORT = {DATE: "D", LDATE: "LD"}
_EPOCH = date(1970, 1, 1)
_CYCLE = 146_097
"""Days after which the calendar repeats itself, 400 years."""


def sizes(source: ElementaryType, to: ElementaryType) -> tuple[int, int]:
    """Nanoseconds that 1 of the source and 1 of the target stand for; at least one of them is a date or time of day."""
    return (
        UNIT[source] if source in UNIT else COUNTED[to],
        UNIT[to] if to in UNIT else COUNTED[source],
    )


def converted(value: int, source: ElementaryType, to: ElementaryType) -> int:
    """A date or time of day as a value of another type, or a number as one of them, rounded down (table 26)."""
    size, size_of_target = sizes(source, to)
    moment = value * size
    if to.kind is Kind.DATE:
        moment -= moment % DAY
    elif to.kind is Kind.TIME_OF_DAY and source.kind is Kind.DATE_AND_TIME:
        moment %= DAY
    return moment // size_of_target


# -------------------------------------------------------------------------------------------------- parts


def parts_of_date(days: int) -> tuple[int, int, int]:
    """Year, month and day, of any day."""
    cycles, rest = divmod(days, _CYCLE)
    found = _EPOCH + timedelta(days=rest)
    return found.year + 400 * cycles, found.month, found.day


def date_of(year: int, month: int, day: int) -> int:
    """The DATE of year (1 to 9999), month and day; ValueError where there is no such day."""
    try:
        return (date(year, month, day) - _EPOCH).days
    except OverflowError:
        raise ValueError from None


def time_of_day(hour: int, minute: int, second: int, millisecond: int) -> int:
    """The TOD of its parts; ValueError where there is no such time."""
    if not (0 <= hour < 24 and 0 <= minute < 60 and 0 <= second < 60 and 0 <= millisecond < 1000):
        raise ValueError
    return ((hour * 60 + minute) * 60 + second) * 1000 + millisecond


def _joined(result: ElementaryType, day: int, time: int, of_time: ElementaryType = TOD) -> int:
    return (day * DAY + time * UNIT[of_time]) // UNIT[result]


def _time(result: ElementaryType, *time: int) -> int:
    return time_of_day(*time) * UNIT[TOD] // UNIT[result]


def _date_and_time(result: ElementaryType, year: int, month: int, day: int, *time: int) -> int:
    return _joined(result, date_of(year, month, day), time_of_day(*time))


FUNCTIONS: Mapping[str, Callable[..., int]] = {
    "CONCAT_DATE": lambda _, *date: date_of(*date),
    **dict.fromkeys(("CONCAT_TOD", "CONCAT_LTOD"), _time),
    **dict.fromkeys(("CONCAT_DT", "CONCAT_LDT"), _date_and_time),
    "CONCAT_DATE_TOD": _joined,
    "CONCAT_DATE_LTOD": lambda result, day, time: _joined(result, day, time, LTOD),
    "DAY_OF_WEEK": lambda _, days: (days + 4) % 7,
}
"""Table 36, 1 to 4 and 8. Each takes the type of the result first."""


# -------------------------------------------------------------------------------------------------- texts


def text(value: int, of: ElementaryType) -> str:
    """The literal of a date or time of day, with three, six or nine digits of a second where they are not 0."""
    days, rest = divmod(value * UNIT[of], DAY)
    seconds, fraction = divmod(rest, SECOND)
    day = "{:04}-{:02}-{:02}".format(*parts_of_date(days))
    time = f"{seconds // 3600:02}:{seconds // 60 % 60:02}:{seconds % 60:02}"
    if fraction:
        digits = f"{fraction:09}"
        time += "." + (digits[:3] if digits.endswith("000000") else digits[:6] if digits.endswith("000") else digits)
    shown = {Kind.DATE: day, Kind.TIME_OF_DAY: time, Kind.DATE_AND_TIME: f"{day}-{time}"}[of.kind]
    return f"{_SHORT.get(of, of.name)}#{shown}"


_LITERAL_KINDS = {Kind.DATE: "date", Kind.TIME_OF_DAY: "tod", Kind.DATE_AND_TIME: "dt"}


def parse(literal: str, of: ElementaryType) -> int:
    """The value of a literal that stands alone; ValueError where it is none of the type. The short and the long form of
    a type share their literals."""
    found = value_of(literal)
    if found is None or found[0] != _LITERAL_KINDS[of.kind]:
        raise ValueError
    return found[1] // UNIT[of]
