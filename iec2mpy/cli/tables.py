"""The table of a simulation's values, once at its end or live."""

from __future__ import annotations

from collections.abc import Sequence

from rich.table import Table

from iec2mpy.simulator.values import show
from iec2mpy.simulator.watching import Watched

_COLOURS = {True: "bold green", False: "dim"}
_HEADINGS = {"input": "Inputs", "output": "Outputs", "watched": "Watched"}


def values_table(watched: Sequence[Watched], values: Sequence[object], title: str) -> Table:
    """One row a variable, under a heading for inputs, outputs, and what is watched."""
    table = Table(title=title, title_justify="left", box=None, show_header=False, pad_edge=False, padding=(0, 2, 0, 0))
    group = ""
    for variable, value in zip(watched, values, strict=True):
        if variable.group != group:
            group = variable.group
            table.add_row(f"[bold]{_HEADINGS[group]}[/bold]")
        style = _COLOURS[value] if isinstance(value, bool) else ""
        name = "" if variable.path == variable.address else variable.path
        table.add_row(f"  {variable.address or name}", name if variable.address else "", _plain(value), style=style)
    return table


def _plain(value: object) -> str:
    """As a case file writes it, without the quotes of durations and names; brackets are no markup."""
    text = value if isinstance(value, str) else show(value)
    return text.replace("[", r"\[")
