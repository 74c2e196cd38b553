"""What a simulation recorded: a row a scan, as CSV and as a drawing."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Number = int | float


@dataclass(frozen=True, slots=True)
class Column:
    """A variable that is recorded. `kind` tells how it is drawn: "bool" as a band of its own, "number" as a curve,
    "text" (of an enumeration, a string) not at all."""

    name: str
    kind: str


@dataclass(slots=True)
class Trace:
    """`times`: milliseconds at the start of each scan. `rows`: the values after it, in the order of `columns`."""

    columns: Sequence[Column]
    times: list[float] = field(default_factory=list)
    rows: list[Sequence[Number | str]] = field(default_factory=list)

    def add(self, time: float, values: Sequence[Number | str]) -> None:
        self.times.append(time)
        self.rows.append(values)

    def series(self, column: Column) -> list[Number | str]:
        """All values of one column."""
        at = self.columns.index(column)
        return [row[at] for row in self.rows]


def write_csv(trace: Trace, path: Path) -> None:
    """A head line with `time_ms` and the names, then a line a scan: BOOL as 0 and 1, durations in milliseconds."""
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["time_ms", *(c.name for c in trace.columns)])
        for time, row in zip(trace.times, trace.rows, strict=True):
            writer.writerow([_cell(time), *map(_cell, row)])


def _cell(value: Number | str) -> str:
    if isinstance(value, float):
        return f"{value:.7g}"
    return str(int(value)) if isinstance(value, bool) else str(value)


def draw_svg(trace: Trace, path: Path, title: str) -> None:
    """Curves of the numbers above, and below them a band for each BOOL, over the time in seconds.

    Raises ModuleNotFoundError where matplotlib is not installed.
    """
    # matplotlib takes a third of a second to import, and is an extra: only a drawing needs it
    from matplotlib.figure import Figure

    numbers = [c for c in trace.columns if c.kind == "number"]
    bools = [c for c in trace.columns if c.kind == "bool"]
    seconds = [t / 1000 for t in trace.times]
    heights = [3.0] * bool(numbers) + [0.3 + 0.3 * len(bools)] * bool(bools)
    figure = Figure(figsize=(9, sum(heights) + 1), layout="constrained")
    axes = figure.subplots(len(heights) or 1, 1, sharex=True, squeeze=False, height_ratios=heights or [1.0])[:, 0]
    if numbers:
        _draw_numbers(axes[0], trace, numbers, seconds)
    if bools:
        _draw_bools(axes[-1], trace, bools, seconds)
    axes[0].set_title(title)
    axes[-1].set_xlabel("time in seconds")
    figure.savefig(path, format="svg", metadata={"Date": None})


def _draw_numbers(axes: Axes, trace: Trace, columns: Sequence[Column], seconds: Sequence[float]) -> None:
    for column in columns:
        axes.plot(seconds, trace.series(column), label=column.name, linewidth=1.2)
    axes.legend(loc="best")
    axes.grid(alpha=0.3)


def _draw_bools(axes: Axes, trace: Trace, columns: Sequence[Column], seconds: Sequence[float]) -> None:
    """Each variable has the height 1; TRUE fills it to 0.8."""
    for level, column in enumerate(reversed(columns)):
        times, values = _changes(seconds, trace.series(column))
        tops = [level + 0.8 * bool(v) for v in values]
        axes.fill_between(times, level, tops, step="post", alpha=0.5)
        axes.step(times, tops, where="post", linewidth=0.8)
    axes.set_yticks([level + 0.4 for level in range(len(columns))], [c.name for c in reversed(columns)])
    axes.set_ylim(-0.1, len(columns))
    axes.grid(alpha=0.3, axis="x")


def _changes(seconds: Sequence[float], values: Sequence[Number | str]) -> tuple[list[float], list[Number | str]]:
    """Only the points where the value is another than before, with the last: a small file for a long time."""
    last = len(values) - 1
    kept = [i for i, value in enumerate(values) if i in (0, last) or value != values[i - 1]]
    return [seconds[i] for i in kept], [values[i] for i in kept]
