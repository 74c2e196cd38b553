"""Channels: which pin stands behind a direct address, and how it is used.

A channel is one table of a board or project file, `[channels."%IX0.0"]`. A project's table adds a channel, or changes
single keys of the board's.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from iec2mpy.project.schema import Key, Schema, read_table
from iec2mpy.project.toml_text import TomlText
from iec2mpy.source.diagnostics import Diagnostics
from iec2mpy.source.spans import Span

ANALOG_RANGE = (0, 32767)
"""What an analog channel's full scale is worth unless its `range` says otherwise: it fits INT, UINT and WORD."""


@dataclass(frozen=True, slots=True)
class Kind:
    """`area` and `size` as in an address: `%IX`; `title` for people; `types` what a variable there may be."""

    title: str
    area: str
    size: str
    types: tuple[str, ...]
    keys: tuple[str, ...]
    """The keys that make sense, beside those that every channel has."""


KINDS: Mapping[str, Kind] = {
    "din": Kind("digital input", "I", "X", ("BOOL",), ("pull", "invert")),
    "dout": Kind("digital output", "Q", "X", ("BOOL",), ("invert", "safe")),
    "adc": Kind("analog input", "I", "W", ("INT", "UINT", "WORD"), ("range",)),
    "pwm": Kind("PWM output", "Q", "W", ("INT", "UINT", "WORD"), ("freq", "range", "safe")),
}

CHANNEL_KEYS: Schema = {
    "pin": Key("pin", "2"),
    "kind": Key("text", '"din"', choices=tuple(KINDS)),
    "label": Key("text", '"GP2"'),
    "pull": Key("text", '"up"', choices=("up", "down", "none")),
    "invert": Key("truth", "true"),
    "safe": Key("number", "0", low=-32768, high=65535),
    "range": Key("range", "[0, 1000]"),
    "freq": Key("number", "1000", low=1, high=100_000_000),
}

_ADDRESS = re.compile(r"%(?P<area>[IQM])(?P<size>[XBWDL]?)(?P<path>\d+(?:\.\d+)*)", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class Channel:
    """`pin` is a GPIO's number, or a name that MicroPython's `Pin` knows (`"LED"`). `low` and `high` are the values at
    0 % and at 100 % of an analog channel's scale; `safe` is written at boot, at a fault and when the PLC stops.
    `span` is where the address stands in the file that last said something about it."""

    address: str
    kind: str
    pin: int | str
    label: str
    span: Span
    pull: str = "none"
    invert: bool = False
    safe: int = 0
    low: int = ANALOG_RANGE[0]
    high: int = ANALOG_RANGE[1]
    freq: int = 1000
    from_project: bool = False


def normal_address(text: str) -> str | None:
    """`%IX0.0` for `%ix0.0` and `%I0.0`; None for what is not an address."""
    match = _ADDRESS.fullmatch(text.strip())
    if match is None:
        return None
    path = ".".join(str(int(part)) for part in match["path"].split("."))
    return f"%{match['area'].upper()}{match['size'].upper() or 'X'}{path}"


def read_channels(
    toml: TomlText, known: Mapping[str, Channel], diagnostics: Diagnostics, from_project: bool
) -> dict[str, Channel]:
    """The channels in `known` with those that the file's `[channels]` adds or changes, by address."""
    channels = dict(known)
    seen: dict[str, str] = {}
    tables: Any = toml.data.get("channels", {})
    for written in tables if isinstance(tables, dict) else {}:
        span = toml.key_span("channels", written)
        address = normal_address(written)
        if address is None:
            hint = "Write it as in a program, in quotes: `[channels.\"%IX0.0\"]`."
            diagnostics.add("E0836", f"`{written}` is not the address of a channel.", span, hint)
        elif address in seen:
            message = f"`{written}` and `{seen[address]}` are the same address."
            diagnostics.add("E0837", message, span, "Keep one of the two.")
        else:
            seen[address] = written
            values = read_table(toml, ("channels", written), CHANNEL_KEYS, diagnostics)
            channel = _channel(toml, written, address, values, known.get(address), diagnostics)
            if channel:
                channels[address] = replace(channel, span=span, from_project=from_project)
    return channels


def _channel(
    toml: TomlText,
    written: str,
    address: str,
    values: Mapping[str, Any],
    base: Channel | None,
    diagnostics: Diagnostics,
) -> Channel | None:
    span = toml.key_span("channels", written)
    table = toml.data["channels"][written]
    if not isinstance(table, dict):
        diagnostics.add("E0833", f"`{written}` must be a table.", span, f'Write `[channels."{address}"]`.')
        return None
    if base is None:
        for name in ("pin", "kind"):
            if name not in table:
                example = f"`{name} = {CHANNEL_KEYS[name].example}`"
                hint = f"The board has no channel {address} of its own, so the project must say it: {example}."
                diagnostics.add("E0834", f"The key `{name}` is missing for {address}.", span, hint)
        if "pin" not in values or "kind" not in values:
            return None
        base = Channel(address, values["kind"], values["pin"], f"pin {values['pin']}", span)
    changed = _changed(base, values)
    kind = KINDS[changed.kind]
    if not address.startswith(f"%{kind.area}{kind.size}"):
        message = f"{_a(kind.title)} cannot have the address {address}."
        hint = f"Addresses of this kind start with `%{kind.area}{kind.size}`, as in `%{kind.area}{kind.size}0`."
        diagnostics.add("E0836", message, span, hint)
        return None
    for name in values:
        if name not in (*kind.keys, "pin", "kind", "label"):
            place = toml.key_span("channels", written, name)
            hint = f"{_a(kind.title)} can have {', '.join(f'`{k}`' for k in kind.keys)}."
            diagnostics.add("E0832", f"`{name}` means nothing for {_a(kind.title).lower()}.", place, hint)
    low, high = (0, 1) if kind.size == "X" else (changed.low, changed.high)
    if not low <= changed.safe <= high:
        place = toml.value_span("channels", written, "safe")
        message = f"The safe value {changed.safe} of {address} is outside of {low} to {high}."
        diagnostics.add("E0833", message, place, f"Write `safe = {low}`.")
    if kind.size == "W" and (high > (32767 if low < 0 else 65535) or low < -32768):
        place = toml.value_span("channels", written, "range")
        message = f"The range {low} to {high} of {address} fits no type of 16 bits."
        diagnostics.add("E0833", message, place, "INT holds -32768 to 32767, UINT and WORD 0 to 65535.")
    return changed


def _changed(base: Channel, values: Mapping[str, Any]) -> Channel:
    """A channel with what a table says in place of what it had."""
    changes = {k: v for k, v in values.items() if k != "range"}
    if "pin" in values and "label" not in values and values["pin"] != base.pin:
        changes["label"] = f"pin {values['pin']}"
    if "range" in values:
        changes["low"], changes["high"] = values["range"]
        if "safe" not in values and not changes["low"] <= base.safe <= changes["high"]:
            changes["safe"] = changes["low"]
    return replace(base, **changes)


def _a(title: str) -> str:
    return f"An {title}" if title[0] in "aeiou" else f"A {title}"
