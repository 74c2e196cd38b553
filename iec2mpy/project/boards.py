"""Boards: one TOML file each, in `boards/`. Which chip a board has, which of its pins can be wired to, its channels."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from iec2mpy.project.channels import Channel, read_channels
from iec2mpy.project.chips import CHIPS, Chip
from iec2mpy.project.pins import BoardPins, check_pins
from iec2mpy.project.schema import Key, Schema, read_table, suggestion
from iec2mpy.project.toml_text import TomlText, parse_toml
from iec2mpy.source.diagnostics import CompileError, Diagnostics
from iec2mpy.source.resources import resource_dir
from iec2mpy.source.spans import SourceFile, Span

_FILE_KEYS: Schema = {
    "board": Key("table", "", required=True),
    "pins": Key("table", "", required=True),
    "channels": Key("table", ""),
}
_BOARD_KEYS: Schema = {
    "name": Key("text", '"pico"', required=True),
    "title": Key("text", '"Raspberry Pi Pico"', required=True),
    "chip": Key("text", '"rp2040"', required=True, choices=tuple(CHIPS)),
    "sources": Key("texts", '["https://…"]', required=True),
    "flash": Key("text", '"Hold BOOTSEL while you plug it in."', required=True),
    "notes": Key("texts", '["Inputs stand 3.3 V, not 5 V."]'),
}
_PIN_KEYS: Schema = {
    "terminals": Key("texts", '["0-22", "26-28"]', required=True),
    "onboard": Key("notes", '{ 25 = "the LED" }'),
    "internal": Key("notes", '{ 23 = "it sets the mode of the power supply" }'),
}
_TERMINALS = re.compile(r"(\d+)(?:-(\d+))?")


@dataclass(frozen=True, slots=True)
class Board:
    """`sources`: the vendor's pages that the facts come from. `flash`: how MicroPython gets onto it, in a sentence or
    two. `notes`: what a user must know about its terminals. `channels` by address, in the order of the file.
    `displaced`: addresses whose channel had to make room for one of the project's, and that one."""

    name: str
    title: str
    chip: Chip
    sources: tuple[str, ...]
    flash: str
    notes: tuple[str, ...]
    pins: BoardPins
    channels: Mapping[str, Channel]
    displaced: Mapping[str, Channel] = field(default_factory=dict)


def board_names() -> list[str]:
    """The names of all boards, sorted."""
    return sorted(path.stem for path in resource_dir("boards").glob("*.toml"))


def load_board(name: str, span: Span | None = None) -> Board:
    """The board with this name; raises CompileError (E0835 at `span`) where there is none."""
    names = board_names()
    if name not in names:
        diagnostics = Diagnostics()
        diagnostics.add("E0835", f"There is no board `{name}`.", span, suggestion(name, names, "The boards are"))
        raise CompileError(diagnostics.items)
    return read_board(resource_dir("boards") / f"{name}.toml")


def read_board(path: Path) -> Board:
    """The board that a file describes; raises CompileError with all that is wrong in it."""
    toml = parse_toml(SourceFile(str(path), path.read_text(encoding="utf-8")))
    diagnostics = Diagnostics()
    read_table(toml, (), _FILE_KEYS, diagnostics)
    head = read_table(toml, ("board",), _BOARD_KEYS, diagnostics)
    if "name" in head and head["name"] != path.stem:
        message = f"The board is called `{head['name']}`, but its file `{path.name}`."
        diagnostics.add("E0833", message, toml.value_span("board", "name"), "The two must be alike.")
    pins = _read_pins(toml, diagnostics)
    channels = read_channels(toml, {}, diagnostics, from_project=False)
    if "chip" in head:
        check_pins(CHIPS[head["chip"]], pins, channels.values(), diagnostics)
    if diagnostics.has_errors:
        raise CompileError(diagnostics.items)
    return Board(
        name=head["name"],
        title=head["title"],
        chip=CHIPS[head["chip"]],
        sources=tuple(head["sources"]),
        flash=head["flash"],
        notes=tuple(head.get("notes", ())),
        pins=pins,
        channels=channels,
    )


def _read_pins(toml: TomlText, diagnostics: Diagnostics) -> BoardPins:
    table = read_table(toml, ("pins",), _PIN_KEYS, diagnostics)
    terminals: set[int] = set()
    for text in table.get("terminals", ()):
        match = _TERMINALS.fullmatch(text)
        if match is None:
            hint = 'Write a number or a range, as in `["0-22", "26"]`.'
            span = toml.value_span("pins", "terminals")
            diagnostics.add("E0833", f"`{text}` names no pins.", span, hint)
        else:
            terminals.update(range(int(match[1]), int(match[2] or match[1]) + 1))
    return BoardPins(frozenset(terminals), _by_pin(table.get("onboard", {})), _by_pin(table.get("internal", {})))


def _by_pin(notes: Mapping[str, Any]) -> dict[int | str, str]:
    """Keys of a TOML table are texts: `25` means the GPIO, anything else is the name of a pin."""
    return {int(pin) if pin.isdecimal() else pin: note for pin, note in notes.items()}
