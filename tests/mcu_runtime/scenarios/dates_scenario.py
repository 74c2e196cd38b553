from support import raises

from mcu_runtime.date_texts import date_to_str, str_to_date
from mcu_runtime.dates import concat_date, concat_tod, day_of, month_of, parts, year_of
from mcu_runtime.faults import RANGE

FAULT = RANGE.__class__
ALL = (-0x8000000000000000, 0x7FFFFFFFFFFFFFFF)
DAY = 86_400_000_000_000


def test_days_follow_each_other():
    # over the ends of a century that is a leap year and of one that is none, and over 1970
    for start, end in ((-719162, -718000), (-400, 400), (10950, 11700), (46000, 48000), (2932000, 2932897)):
        before = None
        for days in range(start, end):
            year, month, day = parts(days)
            assert concat_date(year, month, day) == days
            if before is not None:
                assert (year, month, day) > before
                assert day == 1 or day == before[2] + 1
            before = (year, month, day)


def test_parts():
    assert parts(0) == (1970, 1, 1)
    assert parts(-1) == (1969, 12, 31)
    assert (year_of(19782), month_of(19782), day_of(19782)) == (2024, 2, 29)
    assert parts(-719162) == (1, 1, 1)
    assert parts(2932896) == (9999, 12, 31)


def test_days_that_no_calendar_has():
    for date in ((2023, 2, 29), (1900, 2, 29), (2024, 4, 31), (2024, 13, 1), (2024, 0, 1), (2024, 1, 0), (2024, 1, 32)):
        assert raises(FAULT, concat_date, *date) is RANGE
    raises(FAULT, concat_date, 0, 1, 1)
    raises(FAULT, concat_date, 10000, 1, 1)
    assert concat_date(2000, 2, 29) == 11016


def test_times_of_day():
    assert concat_tod(23, 59, 59, 999) == 86399999
    for time in ((24, 0, 0, 0), (0, 60, 0, 0), (0, 0, 60, 0), (0, 0, 0, 1000), (-1, 0, 0, 0)):
        assert raises(FAULT, concat_tod, *time) is RANGE


def test_texts():
    for value, name, text in (
        (19782, "DATE", "D#2024-02-29"),
        (-719162, "DATE", "D#0001-01-01"),
        (45000000, "TOD", "TOD#12:30:00"),
        (1, "TOD", "TOD#00:00:00.001"),
        (-1, "DT", "DT#1969-12-31-23:59:59.999"),
        (DAY, "LDATE", "LD#1970-01-02"),
        (1, "LTOD", "LTOD#00:00:00.000000001"),
        (1_500_000, "LTOD", "LTOD#00:00:00.001500"),
        (DAY + 500_000_000, "LDT", "LDT#1970-01-02-00:00:00.500"),
    ):
        assert date_to_str(value, name) == text
        assert str_to_date(text, name, *ALL) == value


def test_other_forms_of_literals():
    assert str_to_date(" date#2024-2-29 ", "DATE", *ALL) == 19782
    assert str_to_date("Time_Of_Day#1_2:30:00.5", "TOD", *ALL) == 45000500
    assert str_to_date("LDT#1970-01-01-00:00:00.000_000_5", "LDT", *ALL) == 500
    assert str_to_date("TOD#00:00:00.0009", "TOD", *ALL) == 0
    assert str_to_date("TOD#00:00:01", "LTOD", *ALL) == 1_000_000_000


def test_no_literals():
    for text in (
        "", "2024-02-29", "D#2024-02", "D#2024-02-30", "D#2024-02-29-", "DT#2024-02-29-12:30:00", "T#5s",
        "D#2024-02-_9", "D#+2024-02-29", "D#2024-02-29 x",
    ):  # fmt: skip
        assert raises(FAULT, str_to_date, text, "DATE", *ALL) is RANGE
    for text in ("TOD#12:30", "TOD#24:00:00", "TOD#12:60:00", "TOD#12:00:60", "TOD#12:00:00.", "TOD#12:00:00.5.5"):
        assert raises(FAULT, str_to_date, text, "TOD", *ALL) is RANGE
    raises(FAULT, str_to_date, "D#2024-02-29", "DATE", 0, 100)
