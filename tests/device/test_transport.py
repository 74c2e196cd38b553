"""Ports that cannot be opened, and things behind ports that are no MicroPython."""

from __future__ import annotations

import errno
import os
import pty
import select
import threading
import tty
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
import serial

from iec2mpy.device import transport
from iec2mpy.device.deploy import deploy
from iec2mpy.device.errors import (
    BoardFailed,
    LineBroken,
    NoAnswer,
    NotMicroPython,
    PortBusy,
    PortForbidden,
    PortMissing,
    WrongRelease,
)
from iec2mpy.device.inspect import survey
from iec2mpy.device.transport import connect
from tests.device.board import Board
from tests.device.programs import counting


@contextmanager
def something_else(answer: Callable[[bytes], bytes]) -> Iterator[str]:
    """A port with something behind it that answers what `answer` makes of each bit of what it hears."""
    host, slave = pty.openpty()
    tty.setraw(slave)
    ended = threading.Event()

    def serve() -> None:
        while not ended.is_set():
            if select.select([host], [], [], 0.05)[0]:
                os.write(host, answer(os.read(host, 4096)))

    thread = threading.Thread(target=serve, daemon=True)
    thread.start()
    try:
        yield os.ttyname(slave)
    finally:
        ended.set()
        thread.join()
        os.close(slave)
        os.close(host)


@pytest.fixture
def impatient(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(transport, "_ANSWER_TIMEOUT", 1)


def test_port_that_is_not_there() -> None:
    with pytest.raises(PortMissing, match="There is no port /dev/ttyNONE") as caught:
        connect("/dev/ttyNONE")
    assert "plugged in" in caught.value.hint


def test_file_that_is_no_port(tmp_path: Path) -> None:
    path = tmp_path / "notes.txt"
    path.write_text("hello")
    with pytest.raises(PortMissing, match="is not a serial port"):
        connect(str(path))


def test_port_with_a_wrong_scheme() -> None:
    with pytest.raises(PortMissing, match="There is no port nonsense://x"):
        connect("nonsense://x")


def test_port_in_use(board: Board) -> None:
    with serial.Serial(board.port, exclusive=True), pytest.raises(PortBusy, match="in use"):
        connect(board.port)


def test_port_that_may_not_be_opened(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*args: object, **options: object) -> None:
        raise serial.SerialException(errno.EACCES, "could not open port: Permission denied")

    monkeypatch.setattr(serial, "serial_for_url", refuse)
    with pytest.raises(PortForbidden, match="may not open") as caught:
        connect("/dev/ttyACM0")
    assert "dialout" in caught.value.hint


@pytest.mark.usefixtures("impatient")
def test_board_that_does_not_answer() -> None:
    with something_else(lambda heard: b"") as port, pytest.raises(NoAnswer, match="Nothing answers"):
        connect(port)


@pytest.mark.usefixtures("impatient")
def test_loop_of_the_line_is_no_board() -> None:
    """A wire from TX to RX sends back what it gets: that is not an answer either."""
    with something_else(lambda heard: heard) as port, pytest.raises(NoAnswer):
        connect(port)


@pytest.mark.usefixtures("impatient")
def test_board_without_micropython() -> None:
    with something_else(lambda heard: b"ERROR\r\n") as port, pytest.raises(NotMicroPython, match="not MicroPython"):
        connect(port)


def test_board_is_left_at_its_prompt(board: Board) -> None:
    connect(board.port).leave()
    with serial.Serial(board.port, timeout=2) as line:
        line.write(b"print(6*7)\r\n")
        assert b"42" in line.read_until(b"42")


def test_error_on_the_board_is_a_sentence(board: Board) -> None:
    link = connect(board.port)
    with pytest.raises(BoardFailed, match=r"The board reports: ZeroDivisionError"):
        link.run("1/0")
    assert link.ask("print(1)") == 1
    link.leave()


def test_unplugged_board(board: Board) -> None:
    link = connect(board.port)
    board.unplug()
    with pytest.raises(LineBroken, match="broke"):
        link.run("print(1)")
    link.leave()


def test_files_arrive_byte_by_byte(board: Board) -> None:
    data = bytes(range(256)) * 5 + b"\x04\x03\x01'\"\\\n"
    link = connect(board.port)
    link.write_file("data.bin", data, lambda count: None)
    link.leave()
    assert (board.files / "data.bin").read_bytes() == data


def test_board_without_hashlib_checks_by_crc(make_board: Callable[..., Board]) -> None:
    board = make_board()
    (board.files / "hashlib.py").write_text("raise ImportError\n")
    link = connect(board.port)
    link.write_file("check.bin", b"123456789", lambda count: None)
    assert link.digest("check.bin") == ("crc32", 0xCBF43926)  # the check value of this CRC
    assert deploy(link, counting(1), lambda done, total: None).status["running"]
    link.leave()


class RawRepl:
    """A board with another Python: speaks the raw REPL, and prints the same text whatever it is to execute."""

    def __init__(self, prints: str) -> None:
        self._prints = prints.encode()
        self._raw = False

    def answer(self, heard: bytes) -> bytes:
        said = b""
        for byte in heard.replace(b"\x05A\x01", b"\x05"):
            if byte == 1:
                self._raw = True
                said += b"raw REPL; CTRL-B to exit\r\n>"
            elif byte == 4 and self._raw:
                said += b"OK" + self._prints + b"\x04\x04>"
            elif byte == 5:
                said += b"R\x00"  # no raw paste
        return said


def surveyed(name: str, release: tuple[int, int], mpy: int) -> str:
    return repr((name, release, mpy, "test board", "", None, [], 4096)) + "\r\n"


def test_micropython_that_is_too_old() -> None:
    old = RawRepl(surveyed("micropython", (1, 18), 0x1F05))
    with something_else(old.answer) as port:
        link = connect(port)
        with pytest.raises(WrongRelease, match=r"MicroPython 1\.18, which is too old") as caught:
            deploy(link, counting(1), lambda done, total: None)
        link.leave()
    assert "1.23 or later" in caught.value.hint


def test_other_python_with_the_same_protocol() -> None:
    with something_else(RawRepl(surveyed("circuitpython", (9, 2), 0x1306)).answer) as port:
        link = connect(port)
        with pytest.raises(NotMicroPython, match="runs circuitpython"):
            survey(link)
        link.leave()
