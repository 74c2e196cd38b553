"""A board for tests: the real MicroPython for Linux behind a serial port.

MicroPython runs with a terminal of its own in an empty folder, its file system. A second terminal, bridged to the
first, gives the host a device name, as a USB port would. When MicroPython ends, which is what a soft reset does on
Linux, it is started again with `main.py`, as a board starts.
"""

from __future__ import annotations

import os
import pty
import select
import shutil
import subprocess
import sys
import termios
import threading
import tty
from collections.abc import Callable
from pathlib import Path

_BOOT = "import os\ntry:\n os.stat('main.py')\n m=1\nexcept OSError:\n m=0\nif m:\n exec(open('main.py').read())\n"

# Takes the terminal as its own, so that Ctrl-C there is a signal, and becomes MicroPython.
_LAUNCH = "import fcntl,os,sys,termios; fcntl.ioctl(0,termios.TIOCSCTTY,0); os.execv(sys.argv[1],sys.argv[1:])"


class Board:
    """`port` is the host's device; `files` the folder that is the board's file system.

    `boot` is Python that runs before `main.py`, to make the board special. `on_bytes(n)` is called with the number of
    bytes that the host has sent so far; `unplug()` may be called from there.
    """

    def __init__(self, files: Path, boot: str = "") -> None:
        self.files = files
        self.starts = 0
        self.on_bytes: Callable[[int], None] = lambda count: None
        self._boot = boot + _BOOT
        self._sent = 0
        self._ended = threading.Event()
        self._plug_in()

    def _plug_in(self) -> None:
        self._host, self._host_slave = pty.openpty()
        tty.setraw(self._host_slave)
        self.port = os.ttyname(self._host_slave)
        self._ended.clear()
        self._start()
        self._thread = threading.Thread(target=self._bridge, daemon=True)
        self._thread.start()

    def _start(self) -> None:
        program = shutil.which("micropython")
        assert program, "micropython is not installed: pip install 'iec2mpy[dev]'"
        self._chip, slave = pty.openpty()
        tty.setraw(slave)
        modes = termios.tcgetattr(slave)
        modes[3] |= termios.ISIG  # Ctrl-C interrupts what runs
        termios.tcsetattr(slave, termios.TCSANOW, modes)
        self._process = subprocess.Popen(
            [sys.executable, "-c", _LAUNCH, program, "-i", "-c", self._boot],
            cwd=self.files,
            stdin=slave,
            stdout=slave,
            stderr=slave,
            start_new_session=True,
        )
        os.close(slave)
        self.starts += 1

    def _bridge(self) -> None:
        while not self._ended.is_set():
            ready, _, _ = select.select([self._host, self._chip], [], [], 0.1)
            if self._host in ready:
                data = os.read(self._host, 4096)
                self._sent += len(data)
                self.on_bytes(self._sent)
                if self._ended.is_set():
                    return
                os.write(self._chip, data)
            if self._chip in ready:
                try:
                    data = os.read(self._chip, 4096)
                except OSError:  # MicroPython ended
                    data = b""
                if data:
                    os.write(self._host, data)
                else:
                    os.close(self._chip)
                    self._process.wait()
                    if not self._ended.is_set():
                        self._start()

    def unplug(self) -> None:
        """The line is cut: the host's port is gone. MicroPython runs on."""
        self._ended.set()
        if self._thread is not threading.current_thread():
            self._thread.join()
        os.close(self._host_slave)
        os.close(self._host)

    def power_cycle(self) -> None:
        """Off and on again: what is in the file system is all that stays. The port may have another name then."""
        self.close()
        self.on_bytes = lambda count: None
        self._plug_in()

    def close(self) -> None:
        if not self._ended.is_set():
            self.unplug()
        self._process.kill()
        self._process.wait()
        self._thread.join()
