"""Which channel of the board each located variable of a program uses, as the board's `board.py` has it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from iec2mpy.project.boards import Board
from iec2mpy.project.channels import KINDS, Channel
from iec2mpy.semantics.types import ELEMENTARY
from iec2mpy.source.diagnostics import Diagnostics
from iec2mpy.source.spans import Span


@dataclass(frozen=True, slots=True)
class LocatedVariable:
    """A variable with an address in I or Q. `type` is the name of its elementary type (that below an alias or a
    subrange); `slot` its slot of V; `span` its declaration, or its first use where it has none."""

    name: str
    address: str
    type: str
    slot: int
    span: Span


def bind_channels(board: Board, located: Sequence[LocatedVariable], diagnostics: Diagnostics) -> str:
    """The text of `board.py`: `CHANNELS`, one row for each channel that the program uses, in the order of the board.

    Addresses that the board lacks and types that do not fit are reported; their rows are missing from the text.
    """
    used: dict[str, int] = {}
    for variable in located:
        channel = board.channels.get(variable.address)
        if channel is None:
            message = f"The board {board.name} has no channel {variable.address}, which `{variable.name}` asks for."
            diagnostics.add("E0842", message, variable.span, _nearest(board, variable.address))
        elif _type_fits(variable, channel, diagnostics):
            used.setdefault(variable.address, variable.slot)
    rows = [
        f"    {_row(channel, used[address])!r},  # {address}, {channel.label}\n"
        for address, channel in board.channels.items()
        if address in used
    ]
    return f"# Made by iec2mpy for the board {board.name}.\nCHANNELS = (\n{''.join(rows)})\n"


def _row(channel: Channel, slot: int) -> tuple[object, ...]:
    """A row as the runtime's process image reads it."""
    c = channel
    rows: dict[str, tuple[object, ...]] = {
        "din": ("din", slot, c.pin, "" if c.pull == "none" else c.pull, c.invert),
        "dout": ("dout", slot, c.pin, c.invert, c.safe),
        "adc": ("adc", slot, c.pin, c.low, c.high),
        "pwm": ("pwm", slot, c.pin, c.freq, c.low, c.high, c.safe),
    }
    return rows[c.kind]


def _type_fits(variable: LocatedVariable, channel: Channel, diagnostics: Diagnostics) -> bool:
    kind = KINDS[channel.kind]
    if variable.type not in kind.types:
        message = f"{channel.address} is {_a(kind.title)}, which cannot be a variable of type {variable.type}."
        hint = f"Declare `{variable.name}` as {' or '.join(kind.types)}."
        diagnostics.add("E0843", message, variable.span, hint)
        return False
    stored = ELEMENTARY[variable.type]
    if kind.size == "W" and not (stored.low <= channel.low and channel.high <= stored.high):
        span = f"{channel.low} to {channel.high}"
        message = f"{channel.address} has values from {span}, and {variable.type} cannot hold all of them."
        better = "INT" if channel.low < 0 else "UINT"
        hint = f"Declare `{variable.name}` as {better}, or change the `range` of the channel in iec2mpy.toml."
        diagnostics.add("E0843", message, variable.span, hint)
        return False
    return True


def _nearest(board: Board, address: str) -> str:
    """Why there is none, or the channels of the same kind of address, or all kinds that there are."""
    if address in board.displaced:
        winner = board.displaced[address]
        return f"Its pin went to {winner.address} of the project file. Give that another pin, or use another address."
    same = [a for a in board.channels if a[:3] == address[:3]]
    if same:
        return f"Addresses like it are {_listed(same)}. `iec2mpy boards {board.name}` shows all."
    kinds = sorted({a[:3] for a in board.channels}, key=lambda k: (k[1] != address[1], k))
    first = [next(a for a in board.channels if a.startswith(k)) for k in kinds]
    return f"Its addresses look like {_listed(first)}. `iec2mpy boards {board.name}` shows all."


def _listed(addresses: Sequence[str]) -> str:
    return ", ".join(addresses) if len(addresses) <= 3 else f"{addresses[0]}, {addresses[1]}, … {addresses[-1]}"


def _a(title: str) -> str:
    return f"an {title}" if title[0] in "aeiou" else f"a {title}"
