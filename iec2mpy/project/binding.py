"""Which channel of the board each located variable of a program uses, as the board's `board.py` has it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from iec2mpy.project.boards import Board
from iec2mpy.project.channels import KINDS, Channel
from iec2mpy.semantics.overlaps import place_of
from iec2mpy.semantics.types import ELEMENTARY
from iec2mpy.source.diagnostics import Diagnostics
from iec2mpy.source.spans import Span


@dataclass(frozen=True, slots=True)
class LocatedVariable:
    """A variable with an address in I or Q. `type` is the name of its elementary type (that below an alias or a
    subrange); `slot` its slot of V; `span` its declaration, or its first use where it has none.

    `bits` is the size of a variable among shared bytes, each in a slot of V: its `slot` counts bits from slot 0 on."""

    name: str
    address: str
    type: str
    slot: int
    span: Span
    bits: int | None = None


@dataclass(frozen=True, slots=True)
class _Slot:
    """Where the value of a channel is: in a slot of V, from `bit` on. `in_bytes`: of a word, the high byte is in the
    next."""

    number: int
    bit: int = 0
    in_bytes: bool = False


def bind_channels(board: Board, located: Sequence[LocatedVariable], diagnostics: Diagnostics) -> str:
    """The text of `board.py`: `CHANNELS`, one row for each channel that the program uses, in the order of the board.

    Addresses that the board lacks and types that do not fit are reported; their rows are missing from the text.
    """
    used: dict[str, _Slot] = {}
    for variable in located:
        covered = list(_covered(board, variable))
        if not covered:
            message = f"The board {board.name} has no channel {variable.address}, which `{variable.name}` asks for."
            diagnostics.add("E0842", message, variable.span, _nearest(board, variable.address))
        for channel, slot in covered:
            if not _is_alone(variable, channel) or _type_fits(variable, channel, diagnostics):
                used.setdefault(channel.address, slot)
    rows = [
        f"    {_row(channel, used[address])!r},  # {address}, {channel.label}\n"
        for address, channel in board.channels.items()
        if address in used
    ]
    return f"# Made by iec2mpy for the board {board.name}.\nCHANNELS = (\n{''.join(rows)})\n"


def _covered(board: Board, variable: LocatedVariable) -> Iterator[tuple[Channel, _Slot]]:
    """The channels that a variable lies over: its own, or several, each with the bits that it has there."""
    group, first, size = place_of(variable.address)
    for channel in board.channels.values():
        other, start, count = place_of(channel.address)
        if other != group:
            continue
        if variable.bits is None and (start, count) == (first, size):
            yield channel, _Slot(variable.slot)
        elif variable.bits is not None and first <= start < first + variable.bits:
            at = variable.slot + start - first
            yield channel, _Slot(at // 8, at % 8, in_bytes=count > 8)


def _is_alone(variable: LocatedVariable, channel: Channel) -> bool:
    """Whether the variable is the channel's own; one over several, an array or a structure has bits of any type."""
    own = place_of(channel.address) == place_of(variable.address)
    return own and (variable.bits is None or variable.type in ELEMENTARY)


def _row(channel: Channel, at: _Slot) -> tuple[object, ...]:
    """A row as the runtime's process image reads it."""
    c, slot = channel, at.number
    rows: dict[str, tuple[object, ...]] = {
        "din": ("din", slot, c.pin, "" if c.pull == "none" else c.pull, c.invert),
        "dout": ("dout", slot, c.pin, c.invert, c.safe),
        "adc": ("adc", slot, c.pin, c.low, c.high),
        "pwm": ("pwm", slot, c.pin, c.freq, c.low, c.high, c.safe),
    }
    return (*rows[c.kind], *([at.bit] if at.bit else [True] if at.in_bytes else []))


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
