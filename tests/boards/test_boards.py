"""The boards that come with iec2mpy."""

from __future__ import annotations

from pathlib import Path

import pytest

from iec2mpy.project.boards import board_names, load_board, read_board
from iec2mpy.project.channels import KINDS
from iec2mpy.source.diagnostics import CompileError


def test_there_are_these() -> None:
    assert {"pico", "pico_w", "esp32_devkit"} <= set(board_names())


@pytest.mark.parametrize("name", board_names())
def test_board_is_complete(name: str) -> None:
    """What the examples and `iec2mpy new` use is on every board, and each kind of channel is there."""
    board = load_board(name)
    assert board.name == name
    assert {channel.kind for channel in board.channels.values()} == set(KINDS)
    assert {"%IX0.0", "%IX0.4", "%QX0.0", "%QX0.3", "%IW0", "%QW0"} <= set(board.channels)
    assert all(source.startswith("https://") for source in board.sources)


@pytest.mark.parametrize("name", board_names())
def test_labels_tell_channels_apart(name: str) -> None:
    labels = [channel.label for channel in load_board(name).channels.values()]
    assert len(set(labels)) == len(labels)


def test_pins_of_a_pico() -> None:
    """Pico data sheet, 2.1: GPIO 23, 24, 25 and 29 are for the board, 26 to 28 have the ADC."""
    pico, pico_w = load_board("pico"), load_board("pico_w")
    assert sorted(pico.pins.internal) == [23, 24, 29]
    assert list(pico.pins.onboard) == [25]
    assert sorted(pico_w.pins.internal) == [23, 24, 25, 29]
    assert list(pico_w.pins.onboard) == ["LED"]
    assert [c.pin for c in pico.channels.values() if c.kind == "adc"] == [26, 27, 28]
    assert (pico.channels["%QX0.0"].pin, pico_w.channels["%QX0.0"].pin) == (25, "LED")


def test_pins_of_an_esp32() -> None:
    """No analog input of its table is blocked by WiFi, and no pin decides how the chip starts, but for the LED's."""
    board = load_board("esp32_devkit")
    pins = {c.pin for c in board.channels.values()}
    assert pins & board.chip.strapping == {2}
    assert not {c.pin for c in board.channels.values() if c.kind == "adc"} & board.chip.adc_wifi


def test_chips_have_their_architectures() -> None:
    assert [load_board(n).chip.arch for n in ("pico", "pico_w", "esp32_devkit")] == ["armv6m", "armv6m", "xtensawin"]


def test_unknown_board() -> None:
    with pytest.raises(CompileError) as caught:
        load_board("pcio")
    (error,) = caught.value.diagnostics
    assert (error.code, error.hint) == ("E0835", "Did you mean `pico`?")


def test_bad_board_file(tmp_path: Path) -> None:
    """Board files are written by people too."""
    path = tmp_path / "mine.toml"
    path.write_text(
        '[board]\nname = "other"\ntitle = "Mine"\nchip = "rp2041"\nsources = ["x"]\nflash = "x"\n'
        '[pins]\nterminals = ["0..22"]\n[channels."%IX0.0"]\nkind = "din"\npin = 2\npul = "up"\n'
    )
    with pytest.raises(CompileError) as caught:
        read_board(path)
    found = [(d.code, d.span.line if d.span else 0) for d in caught.value.diagnostics]
    assert found == [("E0833", 2), ("E0833", 4), ("E0833", 8), ("E0832", 12)]
