"""Traces as CSV and as drawings."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import pytest

from iec2mpy.simulator.trace import Column, Trace, draw_svg, write_csv

_LEVEL, _PUMP, _STATE = Column("main.level", "number"), Column("main.pump", "bool"), Column("main.state", "text")


def _trace(*columns: Column) -> Trace:
    trace = Trace(columns)
    values = {_LEVEL: (0.1, 1.25, 1e7), _PUMP: (False, True, True), _STATE: ("a, b", "c", "c")}
    for scan in range(3):
        trace.add(scan * 0.5, [values[column][scan] for column in columns])
    return trace


def test_csv(tmp_path: Path) -> None:
    write_csv(_trace(_LEVEL, _PUMP, _STATE), tmp_path / "out.csv")
    assert (tmp_path / "out.csv").read_text(encoding="utf-8").splitlines() == [
        "time_ms,main.level,main.pump,main.state",
        '0,0.1,0,"a, b"',
        "0.5,1.25,1,c",
        "1,1e+07,1,c",
    ]


@pytest.mark.parametrize("columns", [(_LEVEL, _PUMP, _STATE), (_LEVEL,), (_PUMP,), (_STATE,), ()])
def test_drawing_shows_what_can_be_drawn(columns: tuple[Column, ...], tmp_path: Path) -> None:
    draw_svg(_trace(*columns), tmp_path / "out.svg", "tank")
    text = (tmp_path / "out.svg").read_text(encoding="utf-8")
    ElementTree.fromstring(text)
    for column in (_LEVEL, _PUMP):
        assert (f"<!-- {column.name} -->" in text) is (column in columns)
    assert "<!-- main.state -->" not in text


def test_drawing_of_a_long_trace_is_small(tmp_path: Path) -> None:
    trace = Trace((_PUMP, _LEVEL))
    for scan in range(20_000):
        trace.add(scan * 10.0, (scan % 1000 < 500, scan / 7))
    draw_svg(trace, tmp_path / "out.svg", "tank")
    assert (tmp_path / "out.svg").stat().st_size < 100_000
