"""`iec2mpy deploy`, from a project's folder to a program that runs on MicroPython behind a serial line."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

import pytest
import serial

from iec2mpy.cli import main
from iec2mpy.device.transport import connect
from tests.device.board import Board

_PROGRAM = """
PROGRAM main
VAR
    lamp AT %QX0.0 : BOOL;
    count : DINT;
END_VAR
count := count + {step};
lamp := NOT lamp;
END_PROGRAM
"""


@pytest.fixture
def make_project(tmp_path: Path) -> Callable[[int], Path]:
    """A project whose program counts in steps of a given size; the form of its code runs on every chip."""

    def make(step: int) -> Path:
        folder = tmp_path / "counter"
        (folder / "src").mkdir(parents=True, exist_ok=True)
        (folder / "src" / "main.st").write_text(_PROGRAM.format(step=step))
        (folder / "iec2mpy.toml").write_text('[project]\nname = "counter"\nboard = "pico"\nemitter = "portable"\n')
        return folder

    return make


def test_deploy(board: Board, make_project: Callable[[int], Path], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["deploy", str(make_project(1)), "--port", board.port]) == 0
    assert "counter runs on" in capsys.readouterr().out
    link = connect(board.port)
    first = link.ask('import plc\nprint(plc.read("main.count"))')
    time.sleep(0.1)
    second = link.ask('print(plc.read("main.count"))')
    link.leave()
    assert 0 < first < second
    assert main(["deploy", str(make_project(1000)), "--port", board.port]) == 0
    link = connect(board.port)
    assert link.ask('import plc\nprint(plc.read("main.count"))') % 1000 == 0
    link.leave()


def test_program_with_an_error_is_not_sent(board: Board, make_project: Callable[[int], Path]) -> None:
    folder = make_project(1)
    (folder / "src" / "main.st").write_text("PROGRAM main\nx := 1;\nEND_PROGRAM\n")
    assert main(["deploy", str(folder), "--port", board.port]) == 1
    assert list(board.files.iterdir()) == []


def test_address_that_the_board_lacks(
    board: Board, make_project: Callable[[int], Path], capsys: pytest.CaptureFixture[str]
) -> None:
    folder = make_project(1)
    source = folder / "src" / "main.st"
    source.write_text(source.read_text().replace("%QX0.0", "%QX7.0"))
    assert main(["deploy", str(folder), "--port", board.port]) == 1
    err = capsys.readouterr().err
    assert "E0842" in err
    assert "lamp AT %QX7.0" in err
    assert list(board.files.iterdir()) == []


def test_program_that_faults_leaves_the_old_one(
    board: Board, make_project: Callable[[int], Path], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["deploy", str(make_project(1)), "--port", board.port]) == 0
    folder = make_project(1)
    source = folder / "src" / "main.st"
    source.write_text(source.read_text().replace("count + 1", "1 / count"))
    assert main(["deploy", str(folder), "--port", board.port]) == 1
    err = capsys.readouterr().err
    assert "E1012" in err
    assert "zero at" in err
    assert "main.st" in err
    link = connect(board.port)
    assert link.ask('import plc\nprint(plc.status()["running"])') is True
    link.leave()


def test_other_chip(board: Board, make_project: Callable[[int], Path], capsys: pytest.CaptureFixture[str]) -> None:
    folder = make_project(1)
    config = folder / "iec2mpy.toml"
    config.write_text(config.read_text().replace("portable", "viper"))
    assert main(["deploy", str(folder), "--port", board.port]) == 2
    assert "E1007" in capsys.readouterr().err


def test_port_that_is_not_there(make_project: Callable[[int], Path], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["deploy", str(make_project(1)), "--port", "/dev/ttyNONE"]) == 2
    assert "There is no port /dev/ttyNONE." in capsys.readouterr().err


def test_port_in_use(
    board: Board, make_project: Callable[[int], Path], capsys: pytest.CaptureFixture[str]
) -> None:
    with serial.Serial(board.port, exclusive=True):
        assert main(["deploy", str(make_project(1)), "--port", board.port]) == 2
    assert "in use" in capsys.readouterr().err


def test_no_port_named(
    make_project: Callable[[int], Path], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("iec2mpy.cli.deploy.usb_ports", lambda: [])
    assert main(["deploy", str(make_project(1))]) == 2
    assert "no board is plugged in" in capsys.readouterr().err
    monkeypatch.setattr("iec2mpy.cli.deploy.usb_ports", lambda: ["/dev/ttyACM0", "/dev/ttyACM1"])
    assert main(["deploy", str(make_project(1))]) == 2
    assert "/dev/ttyACM0, /dev/ttyACM1" in capsys.readouterr().err
