"""The function `reset`: initial values for everything, as few calls as runs of equal or different values allow."""

from __future__ import annotations

from itertools import groupby

from iec2mpy.backends.forms import pattern
from iec2mpy.backends.layout import FIRST, FIRST_OBJECT, Layout
from iec2mpy.backends.names import SlotNames
from iec2mpy.backends.statements import literal, literals
from iec2mpy.backends.target import Target
from iec2mpy.backends.values import flat_values

_RUN = 8
"""So many equal values in a row are filled in, not listed."""


def reset_lines(
    layout: Layout, target: Target, names: SlotNames, runtime: dict[str, set[str]]
) -> list[str]:
    """The text of `reset`; what it needs of the runtime is added to `runtime`."""
    lines = ["", "def reset():", "    # cold start: every variable gets its initial value"]
    for array, first in (("V", FIRST), ("O", FIRST_OBJECT)):
        values: list[object] = [0] * layout.size.v if array == "V" else [None] * layout.size.o
        for declared, value, at, homes in layout.storages():
            stored = flat_values(layout, declared, value, array, at, homes)
            values[at.of(array) : at.of(array) + len(stored)] = stored
        if array == "V":
            for constant, slot in layout.constants.items():
                values[slot] = pattern(constant)
        else:
            for constant, slot in layout.object_constants.items():
                values[slot] = constant
        lines += _fills(array, first, values, target, names, runtime)
    return [*lines, ""]


def _fills(
    array: str, first: int, values: list[object], target: Target, names: SlotNames, runtime: dict[str, set[str]]
) -> list[str]:
    lines: list[str] = []
    pending: list[object] = []
    start = first

    def flush() -> None:
        if pending:
            runtime.setdefault("memory", set()).add("put")
            lines.append(f"    put({array}, {start}, {literals(pending, target, names)})")

    at = first
    for _, group in groupby(values[first:], key=lambda value: (type(value), repr(value))):
        run = list(group)
        if len(run) >= _RUN:
            flush()
            pending = []
            runtime.setdefault("memory", set()).add("fill")
            lines.append(f"    fill({array}, {at}, {len(run)}, {literal(run[0], target, names)})")
        else:
            if not pending:
                start = at
            pending += run
        at += len(run)
    flush()
    return lines
