"""Durations outside of programs."""

from __future__ import annotations

import pytest

from iec2mpy.project.durations import parse_duration


@pytest.mark.parametrize(
    ("text", "microseconds"),
    [
        ("T#10ms", 10_000),
        ("t#1.5s", 1_500_000),
        ("TIME#1h30m", 5_400_000_000),
        (" T#1d_2h_3m_4s_5ms_6us ", 93_784_005_006),
        ("T#-5ms", -5_000),
        ("10ms", None),
        ("T#10", None),
        ("T#", None),
        ("T#1s 2", None),
        ("D#2024-01-01", None),
        ("", None),
    ],
)
def test_duration(text: str, microseconds: int | None) -> None:
    assert parse_duration(text) == microseconds
