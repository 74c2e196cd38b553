"""Values as they are stored, and as they are shown."""

from __future__ import annotations

import pytest

from iec2mpy.backends.coding import decode, encode, format_duration, parse_duration
from iec2mpy.semantics.arithmetic import NANOSECONDS

_COLOURS = {"red": 0, "green": 1}


@pytest.mark.parametrize(
    ("kind", "shown", "low", "high", "raw"),
    [
        ("bool", True, 0, 1, 1),
        ("integer", -5, -128, 127, -5),
        ("unsigned32", 0xFFFFFFFF, 0, 0xFFFFFFFF, -1),
        ("unsigned32", 7, 0, 0xFFFFFFFF, 7),
        ("real", 0.5, 0, 0, 0.5),
        ("duration", "T#-1s500ms", -(1 << 31), (1 << 31) - 1, -1500),
        ("integer64", (1 << 64) - 1, 0, (1 << 64) - 1, (1 << 64) - 1),
        ("lreal", 0.1, 0, 0, 0.1),
        ("ltime", "LT#-1us5ns", -(1 << 63), (1 << 63) - 1, -1005),
        ("string", "abc", 0, 3, "abc"),
        ("enum", "green", 0, 0, 1),
    ],
)
def test_both_ways(kind: str, shown: object, low: int, high: int, raw: object) -> None:
    assert encode(kind, shown, low, high, _COLOURS) == raw
    assert decode(kind, raw, _COLOURS) == shown


def test_single_precision() -> None:
    assert encode("real", 0.1, 0, 0, {}) == 0.10000000149011612
    with pytest.raises(ValueError, match="too large for REAL"):
        encode("real", 1e39, 0, 0, {})


@pytest.mark.parametrize(
    ("milliseconds", "text"),
    [(0, "T#0ms"), (1, "T#1ms"), (90_061_001, "T#1d1h1m1s1ms"), (3_600_000, "T#1h"), (-500, "T#-500ms")],
)
def test_durations(milliseconds: int, text: str) -> None:
    assert format_duration("T", milliseconds * NANOSECONDS, "ms") == text
    assert parse_duration(text) == milliseconds * NANOSECONDS


@pytest.mark.parametrize(
    ("text", "milliseconds"),
    [("time#1.5s", 1500), ("T#1h_30m", 5_400_000), (" t#2d ", 172_800_000), ("T#1_000ms", 1000)],
)
def test_other_spellings_of_durations(text: str, milliseconds: int) -> None:
    assert parse_duration(text) == milliseconds * NANOSECONDS


def test_long_durations() -> None:
    assert format_duration("LT", -1_000_002_003, "ns") == "LT#-1s2us3ns"
    assert format_duration("LT", 0, "ns") == "LT#0ns"
    assert parse_duration("LT#1s_2us3ns") == 1_000_002_003


@pytest.mark.parametrize("text", ["", "T#", "5s", "T#5", "T#s", "T#1x"])
def test_no_durations(text: str) -> None:
    with pytest.raises(ValueError, match="no duration"):
        parse_duration(text)


def test_a_number_that_no_name_of_the_enumeration_has() -> None:
    assert decode("enum", 9, _COLOURS) == 9
