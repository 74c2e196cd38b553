"""Dates and times of day: literals, arithmetic and conversions on values (tables 9, 26, 35, 36)."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from iec2mpy.semantics import calendar
from iec2mpy.semantics.arithmetic import ArithmeticFault, binary, builtin, convert
from iec2mpy.semantics.typed import Constant
from iec2mpy.semantics.types import (
    DATE,
    DINT,
    DT,
    DWORD,
    ELEMENTARY,
    LDATE,
    LDT,
    LTIME,
    LTOD,
    MOMENTS,
    TIME,
    TOD,
    ElementaryType,
    StringType,
)
from mcu_runtime.date_texts import date_to_str, str_to_date
from mcu_runtime.dates import concat_date, parts
from tests.semantics.checking import codes_of, value_of

TYPES = [t for t in ELEMENTARY.values() if t.kind in MOMENTS]
CALENDAR = st.integers(calendar.DAY * DATE.low, calendar.DAY * (DATE.high + 1) - 1)
"""Nanoseconds of the years 1 to 9999."""


def _value(moment: int, of: ElementaryType) -> int | None:
    """The moment as a value of the type, or None where it has none."""
    try:
        found = convert(moment // 1_000_000, DT, of) if of is not DT else moment // 1_000_000
    except ArithmeticFault:
        return None
    assert isinstance(found, int)
    return found


@given(CALENDAR, st.sampled_from(TYPES))
def test_texts_are_read_back(moment: int, of: ElementaryType) -> None:
    value = _value(moment, of)
    if value is not None:
        text = calendar.text(value, of)
        assert calendar.parse(text, of) == value
        assert convert(text, StringType(), of) == value
        assert (date_to_str(value, of.name), str_to_date(text, of.name, of.low, of.high)) == (text, value)


@given(st.integers(-(10**8), 10**8))
def test_the_calendar_of_the_runtime_is_the_same(days: int) -> None:
    found = parts(days)
    assert found == calendar.parts_of_date(days)
    if 1 <= found[0] <= 9999:
        assert concat_date(*found) == days == calendar.date_of(*found)


@given(st.integers(TOD.low, TOD.high), st.integers(TIME.low, TIME.high))
def test_a_time_of_day_goes_round(time: int, by: int) -> None:
    later = binary("+", time, by, TOD, TIME)
    assert isinstance(later, int)
    assert TOD.low <= later <= TOD.high
    assert binary("-", later, by, TOD, TIME) == time


@given(st.integers(-(10**15), 10**15), st.integers(TIME.low, TIME.high))
def test_a_difference_undoes_a_sum(stamp: int, by: int) -> None:
    later = binary("+", stamp, by, DT, TIME)
    assert binary("-", later, stamp, DT, DT) == by
    assert binary("-", later, by, DT, TIME) == stamp


def test_conversions() -> None:
    assert convert(-1, DT, DATE) == -1
    assert convert(-1, DT, TOD) == 86_399_999
    assert convert(1, DATE, DT) == 86_400_000
    assert convert(calendar.DAY + 5, LDT, LDATE) == calendar.DAY
    assert convert(5, LTIME, LTOD) == 5
    assert convert(2, DATE, DINT) == 172_800
    assert convert(-1, DINT, DATE) == -1
    assert convert(-1, DATE, DWORD) == 0x1_0000_0000 - 86_400
    for value, source, to in ((-1, TIME, TOD), (2_932_896, DATE, LDT), (30_000, DATE, DINT), (86_400_000, DWORD, TOD)):
        with pytest.raises(ArithmeticFault, match="range"):
            convert(value, source, to)


def test_functions() -> None:
    assert builtin("DAY_OF_WEEK", [19_782], DINT) == 4  # 2024-02-29, a Thursday
    assert builtin("CONCAT_DATE_LTOD", [1, 5], LDT) == calendar.DAY + 5
    for name, arguments, result in (
        ("CONCAT_DATE", [2023, 2, 29], DATE),
        ("CONCAT_DATE", [10**30, 1, 1], DATE),
        ("CONCAT_TOD", [24, 0, 0, 0], TOD),
        ("CONCAT_LDT", [1600, 1, 1, 0, 0, 0, 0], LDT),
    ):
        with pytest.raises(ArithmeticFault, match="range"):
            builtin(name, arguments, result)


@pytest.mark.parametrize(
    ("literal", "of", "value"),
    [
        ("D#1970-01-02", DATE, 1),
        ("TIME_OF_DAY#00:00:01.5", TOD, 1500),
        ("DT#1969-12-31-23:59:59.9999", DT, -1),
        ("LD#1970-01-02", LDATE, calendar.DAY),
        ("LTOD#00:00:00.000000001", LTOD, 1),
        ("LDATE_AND_TIME#1970-01-01-00:00:00.1", LDT, 100_000_000),
    ],
)
def test_literals(literal: str, of: ElementaryType, value: int) -> None:
    found = value_of("", literal, of.name)
    assert isinstance(found, Constant)
    assert (found.value, found.type) == (value, of)


def test_constants_are_folded() -> None:
    found = value_of("", "DT#2024-02-29-00:00:00 - DT#2024-02-28-23:00:00", "TIME")
    assert isinstance(found, Constant)
    assert found.value == 3_600_000


@pytest.mark.parametrize(
    ("variables", "body", "code"),
    [
        ("a : TOD;", "a := a + a;", "E0303"),
        ("a : TOD;", "a := a + 5;", "E0303"),
        ("a : TOD; t : TIME;", "a := t + a;", "E0302"),
        ("a : DATE;", "a := a + T#24h;", "E0303"),
        ("a : DT;", "a := a - a;", "E0301"),
        ("a : DT; b : LDT; t : TIME;", "t := a - b;", "E0303"),
        ("a : TOD; t : LTIME;", "a := a + t;", "E0303"),
        ("a : DATE;", "a := a * 2;", "E0302"),
        ("a : DATE; b : TOD; c : BOOL;", "c := a = b;", "E0303"),
        ("a : DATE;", "a := 5;", "E0301"),
        ("a : DATE;", "a := DATE#5;", "E0109"),
        ("a : LDT;", "a := LDT#1600-01-01-00:00:00;", "E0501"),
    ],
)
def test_wrong(variables: str, body: str, code: str) -> None:
    assert codes_of(variables, body) == [code]
