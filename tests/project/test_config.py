"""The project file."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from iec2mpy.project.config import load_project
from iec2mpy.source.diagnostics import CompileError, Diagnostic

MakeProject = Callable[..., Path]


def errors(directory: Path) -> list[Diagnostic]:
    with pytest.raises(CompileError) as caught:
        load_project(directory)
    return caught.value.diagnostics


def test_defaults(make_project: MakeProject) -> None:
    directory = make_project()
    project = load_project(directory)
    assert project.name == "test"
    assert project.board.name == "pico"
    assert project.sources == (directory / "src" / "main.st",)
    assert project.interval == 10_000
    assert project.emitter == "viper"
    assert project.dialect == "strict"
    assert project.warnings == ()


def test_everything_said(make_project: MakeProject) -> None:
    lines = 'sources = ["*.st", "src/*.st"]\ninterval = "T#1s500ms"\nemitter = "portable"\ndialect = "codesys"'
    directory = make_project(lines)
    (directory / "b.st").write_text("")
    (directory / "a.st").write_text("")
    project = load_project(directory)
    assert project.sources == (directory / "a.st", directory / "b.st", directory / "src" / "main.st")
    assert project.interval == 1_500_000
    assert project.emitter == "portable"
    assert project.dialect == "codesys"


def test_another_dialect_than_the_files(make_project: MakeProject) -> None:
    assert load_project(make_project('dialect = "twincat"'), dialect="matiec").dialect == "matiec"


def test_another_board_than_the_files(make_project: MakeProject) -> None:
    assert load_project(make_project(), board="esp32_devkit").board.name == "esp32_devkit"


def test_channel_of_the_board_changed(make_project: MakeProject) -> None:
    project = load_project(make_project('[channels."%ix0.0"]\ninvert = false\npull = "down"'))
    channel = project.board.channels["%IX0.0"]
    assert (channel.pin, channel.invert, channel.pull) == (2, False, "down")
    assert project.board.channels["%IX0.1"].invert is True


def test_channel_added(make_project: MakeProject) -> None:
    lines = '[channels."%QX1.0"]\npin = 21\nkind = "dout"\ninvert = true\nsafe = 1\nlabel = "relay"'
    channel = load_project(make_project(lines)).board.channels["%QX1.0"]
    assert (channel.kind, channel.pin, channel.invert, channel.safe) == ("dout", 21, True, 1)
    assert channel.label == "relay"
    assert channel.from_project


def test_range_of_an_analog_channel(make_project: MakeProject) -> None:
    board = load_project(make_project('[channels."%QW0"]\nrange = [10, 500]\nfreq = 50')).board
    channel = board.channels["%QW0"]
    assert (channel.low, channel.high, channel.freq) == (10, 500, 50)
    assert channel.safe == 10  # 0 is outside of the new range
    assert (board.channels["%IW0"].low, board.channels["%IW0"].high) == (0, 32767)


def test_channel_of_the_board_makes_room(make_project: MakeProject) -> None:
    board = load_project(make_project('[channels."%QW7"]\npin = 10\nkind = "pwm"')).board
    assert "%QX0.1" not in board.channels
    assert board.displaced["%QX0.1"].address == "%QW7"


def test_channel_moved_to_another_pin_has_a_new_label(make_project: MakeProject) -> None:
    board = load_project(make_project('[channels."%IX0.0"]\npin = 21')).board
    assert board.channels["%IX0.0"].label == "pin 21"


def test_several_errors_in_one_run(make_project: MakeProject) -> None:
    directory = make_project('intervall = "T#1s"\nemitter = "fast"\nsources = ["none/*.st"]', board="pcio")
    found = errors(directory)
    assert [(d.code, d.span.line if d.span else 0) for d in found] == [
        ("E0835", 3),
        ("E0832", 4),
        ("E0833", 5),
        ("E0845", 6),
    ]
    assert found[0].hint == "Did you mean `pico`?"
    assert found[1].hint == "Did you mean `interval`?"


@pytest.mark.parametrize("value", ['"10"', '"T#10"', '"10ms"', '"T#0s"', '"T#2h"', '"T#-10ms"', "10", "true"])
def test_bad_interval(make_project: MakeProject, value: str) -> None:
    assert [d.code for d in errors(make_project(f"interval = {value}"))] == ["E0833"]


@pytest.mark.parametrize("pattern", ["/etc/*.st", "../other/*.st", ""])
def test_sources_outside_of_the_project(make_project: MakeProject, pattern: str) -> None:
    assert [d.code for d in errors(make_project(f'sources = ["{pattern}"]'))] == ["E0833"]


def test_no_project_file(tmp_path: Path) -> None:
    (error,) = errors(tmp_path)
    assert error.code == "E0844"
    assert error.hint is not None
    assert "iec2mpy new" in error.hint


def test_project_file_that_is_not_text(tmp_path: Path) -> None:
    (tmp_path / "iec2mpy.toml").write_bytes(b"\xff\xfe[\x00")
    assert [d.code for d in errors(tmp_path)] == ["E0002"]


def test_project_file_that_is_a_folder(tmp_path: Path) -> None:
    (tmp_path / "iec2mpy.toml").mkdir()
    assert [d.code for d in errors(tmp_path)] == ["E0001"]


@pytest.mark.parametrize(("text", "code"), [("", "E0834"), ('project = "tank"\n', "E0833")])
def test_project_file_without_its_table(make_project: MakeProject, text: str, code: str) -> None:
    directory = make_project()
    (directory / "iec2mpy.toml").write_text(text)
    assert [d.code for d in errors(directory)] == [code]


@pytest.mark.parametrize(
    ("lines", "code", "says"),
    [
        ('[channels."IX0.0"]\npin = 2', "E0836", "is not the address of a channel"),
        ('[channels."%IW9"]\npin = 19\nkind = "din"', "E0836", "A digital input cannot have the address %IW9"),
        ('[channels."%IX1.0"]\nkind = "din"', "E0834", "The key `pin` is missing for %IX1.0"),
        ('[channels."%IX1.0"]\npin = 19\nkind = "input"', "E0833", "`kind` cannot be `input`"),
        ('[channels."%IX1.0"]\npin = true\nkind = "din"', "E0833", "`pin` must be"),
        ('[channels."%QX0.0"]\npull = "up"', "E0832", "`pull` means nothing for a digital output"),
        ('[channels."%QX0.0"]\nsafe = 5', "E0833", "The safe value 5 of %QX0.0 is outside of 0 to 1"),
        ('[channels."%IW0"]\nrange = [-1, 40000]', "E0833", "fits no type of 16 bits"),
        ('[channels."%IW0"]\nrange = [5, 5]', "E0833", "`range` must be two whole numbers, the lower one first"),
        ('[channels."%QW0"]\nfreq = 5', "E0840", "The RP2040 has no PWM of 5 Hz"),
        ('[channels."%QW0"]\npin = "LED"', "E0839", "no pin with the name `LED`"),
        ('[channels."%QX0.0"]\npin = 30', "E0839", "The RP2040 has no pin 30"),
        ('[channels."%QX0.0"]\npin = 29', "E0839", "Pin 29 is not free: it measures the supply voltage VSYS"),
        ('[channels."%IW0"]\npin = 5', "E0840", "Pin 5 of the RP2040 has no ADC"),
        ('channels = 5', "E0832", "There is no key `channels` in [project]"),
        ('[channels]\n"%IX0.0" = 5', "E0833", "`%IX0.0` must be a table"),
    ],
)
def test_bad_channel(make_project: MakeProject, lines: str, code: str, says: str) -> None:
    (error,) = errors(make_project(lines))
    assert error.code == code
    assert says in error.message
    assert error.span is not None
    assert error.span.line >= 4


def test_pwm_pins_that_share_an_output(make_project: MakeProject) -> None:
    lines = '[channels."%QW4"]\npin = 1\nkind = "pwm"\n[channels."%QW5"]\npin = 17\nkind = "pwm"'
    (error,) = errors(make_project(lines))
    assert error.code == "E0841"
    assert "share one PWM output" in error.message
    assert error.related[0].span.line == 4


@pytest.mark.parametrize(
    ("lines", "codes"),
    [
        ('[channels."%QX1.0"]\npin = 34\nkind = "dout"', ["E0840"]),
        ('[channels."%IX1.0"]\npin = 34\nkind = "din"\npull = "up"', ["E0840"]),
        ('[channels."%IX1.0"]\npin = 9\nkind = "din"', ["E0839"]),
        ('[channels."%IX1.0"]\npin = 1\nkind = "din"', ["E0839"]),
        ('[channels."%IX1.0"]\npin = 37\nkind = "din"', ["E0839"]),
        ('[channels."%IX1.0"]\npin = 24\nkind = "din"', ["E0839"]),
    ],
)
def test_pins_of_an_esp32(make_project: MakeProject, lines: str, codes: list[str]) -> None:
    assert [d.code for d in errors(make_project(lines, board="esp32_devkit"))] == codes


@pytest.mark.parametrize(
    ("lines", "codes"),
    [
        ('[channels."%IX1.0"]\npin = 34\nkind = "din"', []),
        ('[channels."%IX1.0"]\npin = 12\nkind = "din"', ["W0831"]),
        ('[channels."%IW4"]\npin = 27\nkind = "adc"', ["W0832"]),
        ('[channels."%QX0.0"]\ninvert = true', []),  # pin 2 is a strapping pin, but the LED of the board is on it
    ],
)
def test_warnings_of_an_esp32(make_project: MakeProject, lines: str, codes: list[str]) -> None:
    assert [d.code for d in load_project(make_project(lines, board="esp32_devkit")).warnings] == codes
