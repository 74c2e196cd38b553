"""`iec2mpy boards`: which boards there are, and what their terminals are called in a program."""

from __future__ import annotations

from collections import Counter

import click
from rich.console import Console
from rich.table import Table

from iec2mpy.project.boards import Board, board_names, load_board
from iec2mpy.project.channels import KINDS, Channel
from iec2mpy.source.suggest import suggest

_HELP = """List the boards, or show one with its channels.

A channel connects an address of a program, such as %IX0.0, with a terminal of the board.

\b
Examples:
  iec2mpy boards            all boards
  iec2mpy boards pico       the terminals of the Raspberry Pi Pico
"""


@click.command("boards", help=_HELP)
@click.argument("name", required=False)
def command(name: str | None) -> None:
    console = Console(highlight=False)
    names = board_names()
    if name is None:
        _print_all(console, [load_board(n) for n in names])
    elif name in names:
        _print_one(console, load_board(name))
    else:
        near = suggest(name, names)
        advice = f"Did you mean `{near}`?" if near else f"The boards are {', '.join(names)}."
        raise click.UsageError(f"There is no board `{name}`. {advice}")


def _print_all(console: Console, boards: list[Board]) -> None:
    table = Table(box=None, pad_edge=False)
    for heading in ("board", "is", "chip", "channels"):
        table.add_column(heading)
    for board in boards:
        counts = Counter(channel.kind for channel in board.channels.values())
        channels = ", ".join(f"{counts[kind]} {kind}" for kind in KINDS if counts[kind])
        table.add_row(board.name, board.title, board.chip.title, channels)
    console.print(table)
    console.print("\ndin, dout: digital inputs and outputs; adc: analog inputs; pwm: analog outputs by PWM.")
    console.print("`iec2mpy boards NAME` shows the channels of a board.")


def _print_one(console: Console, board: Board) -> None:
    console.print(f"[bold]{board.title}[/bold] ({board.name}): {board.chip.title}\n")
    table = Table(box=None, pad_edge=False)
    for heading in ("address", "terminal", "is", "how"):
        table.add_column(heading)
    for channel in board.channels.values():
        table.add_row(channel.address, channel.label, KINDS[channel.kind].title, _how(channel))
    console.print(table)
    console.print("\nA variable at a digital channel is a BOOL; at an analog one INT, UINT or WORD.")
    for note in board.notes:
        console.print(note)
    console.print(f"\nMicroPython: {board.flash}")
    console.print(f"The facts are from {' and '.join(board.sources)}.", soft_wrap=True)
    console.print("Change or add channels in a project's iec2mpy.toml.")


def _how(channel: Channel) -> str:
    """What a user must know to wire it."""
    if channel.kind == "din":
        pull = {"up": "pull-up, ", "down": "pull-down, ", "none": ""}[channel.pull]
        return f"{pull}TRUE when {'low' if channel.invert else 'high'}"
    if channel.kind == "dout":
        return f"TRUE gives {'low' if channel.invert else 'high'}, safe: {'TRUE' if channel.safe else 'FALSE'}"
    scale = f"{channel.low} to {channel.high}"
    return scale if channel.kind == "adc" else f"{scale}, {channel.freq} Hz, safe: {channel.safe}"
