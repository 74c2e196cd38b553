"""Whether the pins of a board can do what its channels ask of them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from iec2mpy.project.channels import KINDS, Channel
from iec2mpy.project.chips import Chip
from iec2mpy.source.diagnostics import Diagnostic, Diagnostics, Related


@dataclass(frozen=True, slots=True)
class BoardPins:
    """`terminals`: GPIOs that can be wired to. `onboard`: pins that end in a part of the board, such as its LED, and
    what that is. `internal`: pins that the board needs for itself, and what for. Names of pins stand beside numbers."""

    terminals: frozenset[int]
    onboard: Mapping[int | str, str]
    internal: Mapping[int | str, str]


def check_pins(chip: Chip, pins: BoardPins, channels: Iterable[Channel], diagnostics: Diagnostics) -> None:
    """Reports pins that the board lacks, that cannot do what is asked, and that two channels share.

    Only what a project adds gets warnings: those of the board's own table are known, and its notes say them.
    """
    good: list[Channel] = []
    for channel in channels:
        if not _exists(chip, pins, channel, diagnostics):
            continue
        clash = next(filter(None, (_clash(chip, channel, other) for other in good)), None)
        if clash:
            diagnostics.add(clash.code, clash.message, channel.span, clash.hint, clash.related)
        elif _can_do(chip, channel, diagnostics):
            good.append(channel)
            if channel.from_project and channel.pin not in pins.onboard:
                _warn(chip, channel, diagnostics)
    pwm = [c for c in good if c.kind == "pwm"]
    if len(pwm) > chip.pwm_outputs:
        message = f"The {chip.title} has {chip.pwm_outputs} PWM outputs, but there are {len(pwm)} PWM channels."
        diagnostics.add("E0841", message, pwm[-1].span, "Make some of them digital outputs.")


def displaced_channels(chip: Chip, channels: Iterable[Channel]) -> dict[str, Channel]:
    """The board's own channels that cannot be there beside the project's: by address, the one that took the pin."""
    everything = list(channels)
    wanted = [c for c in everything if c.from_project]
    return {
        c.address: winner
        for c in everything
        if not c.from_project
        for winner in [next((w for w in wanted if _clash(chip, c, w)), None)]
        if winner
    }


def _clash(chip: Chip, channel: Channel, other: Channel) -> Diagnostic | None:
    """Why two channels cannot both be there, or None."""
    message = hint = ""
    code = "E0841"
    if channel.pin == other.pin:
        code = "E0838"
        message = f"{channel.address} and {other.address} are both on pin {channel.pin}."
        hint = "Give one of them another pin. A pin can be one channel only."
    elif isinstance(channel.pin, int) and isinstance(other.pin, int) and _one_slice(chip, channel, other):
        pair = f"The pins of {channel.address} ({channel.pin}) and {other.address} ({other.pin})"
        if channel.pin % 2 == other.pin % 2:
            message = f"{pair} share one PWM output."
            hint = "Choose another pin."
        elif channel.freq != other.freq:
            message = f"{pair} share one PWM generator, which has one frequency."
            hint = "Give both the same `freq`, or choose another pin."
    if not message:
        return None
    return Diagnostic(code, message, channel.span, hint, (Related(other.span, f"{other.address} is here"),))


def _one_slice(chip: Chip, channel: Channel, other: Channel) -> bool:
    if not chip.pwm_slices or channel.kind != "pwm" or other.kind != "pwm":
        return False
    return (int(channel.pin) // 2 - int(other.pin) // 2) % chip.pwm_slices == 0


def _exists(chip: Chip, pins: BoardPins, channel: Channel, diagnostics: Diagnostics) -> bool:
    pin = channel.pin
    if pin in pins.internal:
        hint = f"Use one of the pins {ranges(pins.terminals)}."
        diagnostics.add("E0839", f"Pin {pin} is not free: {pins.internal[pin]}.", channel.span, hint)
    elif pin in pins.terminals or pin in pins.onboard:
        return True
    elif isinstance(pin, str):
        names = [f'"{p}"' for p in pins.onboard if isinstance(p, str)]
        hint = f"The names are {', '.join(names)}." if names else "Write the number of the GPIO."
        diagnostics.add("E0839", f"The board has no pin with the name `{pin}`.", channel.span, hint)
    else:
        owner = f"The {chip.title}" if pin not in chip.pins else "The board"
        message = f"{owner} has no pin {pin}." if pin not in chip.pins else f"Pin {pin} is on no terminal of the board."
        diagnostics.add("E0839", message, channel.span, f"The pins are {ranges(pins.terminals)}.")
    return False


def _can_do(chip: Chip, channel: Channel, diagnostics: Diagnostics) -> bool:
    pin, title = channel.pin, KINDS[channel.kind].title
    message = hint = None
    if KINDS[channel.kind].area == "Q" and pin in chip.input_only:
        message = f"Pin {pin} of the {chip.title} can only be an input, but {channel.address} is a {title}."
        hint = f"The pins {ranges(chip.input_only)} are inputs only. Choose another pin."
    elif channel.kind == "adc" and pin not in chip.adc:
        message = f"Pin {pin} of the {chip.title} has no ADC, so it cannot be the analog input {channel.address}."
        hint = f"The pins with an ADC are {ranges(chip.adc)}."
    elif channel.kind == "din" and channel.pull != "none" and pin in chip.input_only:
        message = f"Pin {pin} of the {chip.title} has no pull resistor, but {channel.address} asks for one."
        hint = 'Write `pull = "none"`, and wire a resistor of 10 kilohms if the contact needs one.'
    elif channel.kind == "pwm" and isinstance(pin, str):
        message = f"The pin `{pin}` is not one of the chip's own, and has no PWM."
        hint = "Choose a pin with a number."
    elif channel.kind == "pwm" and not chip.pwm_frequency[0] <= channel.freq <= chip.pwm_frequency[1]:
        low, high = chip.pwm_frequency
        message = f"The {chip.title} has no PWM of {channel.freq} Hz."
        hint = f"`freq` can be from {low} to {high}."
    if message is None:
        return True
    diagnostics.add("E0840", message, channel.span, hint)
    return False


def _warn(chip: Chip, channel: Channel, diagnostics: Diagnostics) -> None:
    if channel.pin in chip.strapping:
        message = f"The {chip.title} reads pin {channel.pin} to know how to start: what is wired there can hinder it."
        diagnostics.add("W0831", message, channel.span, "Choose another pin if you can.")
    elif channel.kind == "adc" and channel.pin in chip.adc_wifi:
        message = f"Pin {channel.pin} gives no analog values while WiFi is on."
        hint = f"The pins {ranges(chip.adc - chip.adc_wifi)} always do."
        diagnostics.add("W0832", message, channel.span, hint)


def ranges(numbers: Iterable[int]) -> str:
    """`0 to 22, 26 to 28` for those numbers."""
    parts: list[list[int]] = []
    for number in sorted(numbers):
        if parts and parts[-1][1] == number - 1:
            parts[-1][1] = number
        else:
            parts.append([number, number])
    return ", ".join(str(a) if a == b else f"{a}, {b}" if b == a + 1 else f"{a} to {b}" for a, b in parts)
