"""Dates and times of day (tables 35 and 36). A DATE is days since 1970-01-01, a TOD milliseconds since midnight."""

from mcu_runtime.faults import RANGE

_DAYS_TO_1970 = 719468  # from 0000-03-01
_CYCLE = 146097  # days of 400 years


def concat_date(year, month, day):
    """The DATE of year, month and day; faults `range` where there is no such day."""
    if 1 <= year <= 9999 and 1 <= month <= 12 and 1 <= day <= 31:
        # a year begins in March, so that the day that comes and goes is its last one
        y = year - 1 if month <= 2 else year
        cycle = y // 400
        y -= 400 * cycle
        in_year = (153 * (month + 9 if month <= 2 else month - 3) + 2) // 5 + day - 1
        days = _CYCLE * cycle + 365 * y + y // 4 - y // 100 + in_year - _DAYS_TO_1970
        if day_of(days) == day:
            return days
    raise RANGE


def concat_tod(hour, minute, second, millisecond):
    """The TOD of its parts; faults `range` where there is no such time."""
    if 0 <= hour < 24 and 0 <= minute < 60 and 0 <= second < 60 and 0 <= millisecond < 1000:
        return ((hour * 60 + minute) * 60 + second) * 1000 + millisecond
    raise RANGE


def parts(days):
    """(year, month, day) of a DATE."""
    days += _DAYS_TO_1970
    cycle = days // _CYCLE
    days -= cycle * _CYCLE
    y = (days - days // 1460 + days // 36524 - days // 146096) // 365
    days -= 365 * y + y // 4 - y // 100
    month = (5 * days + 2) // 153
    day = days - (153 * month + 2) // 5 + 1
    month = month + 3 if month < 10 else month - 9
    return y + 400 * cycle + (1 if month <= 2 else 0), month, day


def year_of(days):
    return parts(days)[0]


def month_of(days):
    return parts(days)[1]


def day_of(days):
    return parts(days)[2]


def floor_quotient(a, b):
    """`a` / `b`, rounded down."""
    return a // b


def floor_rest(a, b):
    """What `floor_quotient` leaves."""
    return a % b
