"""The table of a simulation's values, once at its end or live."""

from __future__ import annotations

from collections.abc import Sequence

from rich.console import Group
from rich.markup import escape
from rich.table import Table
from rich.text import Text

from iec2mpy.simulator.values import show
from iec2mpy.simulator.watching import Watched

_COLOURS = {True: "green", False: "dim"}
_HEADINGS = {"inputs": "Inputs", "outputs": "Outputs", "watched": "Watched"}


def values_table(watched: Sequence[Watched], values: Sequence[object], title: str) -> Group:
    """One row a variable, under a heading for inputs, outputs, and what is watched."""
    table = Table(box=None, show_header=False, pad_edge=False, padding=(0, 2, 0, 0))
    group = ""  # of the row before
    for variable, value in zip(watched, values, strict=True):
        if variable.group != group:
            group = variable.group
            table.add_row(_HEADINGS[group], style="bold")
        style = _COLOURS[value] if isinstance(value, bool) else ""
        names = [variable.address or variable.path]
        names.append(variable.path if variable.path not in names else "")
        table.add_row(f"  {escape(names[0])}", escape(names[1]), _plain(value), style=style)
    return Group(Text(title, style="bold"), table)


def _plain(value: object) -> str:
    """As a case file writes it, without the quotes of durations and names."""
    return escape(value if isinstance(value, str) else show(value))
