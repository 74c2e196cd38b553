"""The line to a board: mpremote's transport, without a soft reset, so that a PLC that runs there is not disturbed."""

from __future__ import annotations

import ast
import base64
import errno
import struct
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import serial
from mpremote.transport import TransportError, TransportExecError
from mpremote.transport_serial import SerialTransport

from iec2mpy.device.errors import (
    BoardFailed,
    BoardFull,
    LineBroken,
    NoAnswer,
    NotMicroPython,
    PortBusy,
    PortError,
    PortForbidden,
    PortMissing,
)
from iec2mpy.device.ports import usb_ports

_RAW_REPL = b"raw REPL; CTRL-B to exit\r\n"
_PROMPT = b">>> "
_ANSWER_TIMEOUT = 5  # seconds until a board has to answer to Ctrl-A
_READ_TIMEOUT = 10  # seconds that a byte may be late: a board's flash can be busy for some of them
_BLOCK = 384  # bytes of a file that are sent at once: 512 characters of base64

# Said on the board. `f` and the other names live in the REPL's globals, which the soft reset at the end clears.
_OPEN = "from binascii import a2b_base64 as b\nf=open({path!r},'wb')"
_WRITE = "f.write(b({data!r}))"
_CLOSE = "f.close()"
_DIGEST = """
import binascii
try:
 import hashlib
 h=hashlib.sha256()
except (ImportError,AttributeError):
 h=None
c=0
b=bytearray(512)
with open({path!r},'rb') as f:
 while 1:
  n=f.readinto(b)
  if not n:
   break
  m=memoryview(b)[:n]
  if h:
   h.update(m)
  else:
   c=binascii.crc32(m,c)
print(('sha256',binascii.hexlify(h.digest()).decode()) if h else ('crc32',c))
"""
_REMOVE_TREE = """
import os
def r(p):
 try:
  d=[e[0] for e in os.ilistdir(p)] if os.stat(p)[0]&0x4000 else None
 except OSError:
  return
 if d is None:
  os.remove(p)
 else:
  for n in d:
   r(p+'/'+n)
  os.rmdir(p)
r({path!r})
"""


class Link:
    """An open line to a board in its raw REPL. Its methods raise LineBroken, BoardFailed, BoardFull."""

    def __init__(self, port: str, transport: SerialTransport) -> None:
        self.port = port
        self._transport = transport

    def run(self, code: str) -> str:
        """Executes Python on the board; what it prints."""
        with self._talking():
            return self._transport.exec(code).decode("utf-8", "replace")

    def ask(self, code: str) -> Any:
        """Executes Python that prints one value, and gives that."""
        text = self.run(code)
        try:
            return ast.literal_eval(text.strip())
        except (ValueError, SyntaxError):
            raise BoardFailed(f"The board's answer is not understood: {text.strip()[:80]!r}.", _TRY_AGAIN) from None

    def write_file(self, path: str, data: bytes, advance: Callable[[int], None]) -> None:
        """Writes a file; `advance` is told how many bytes more have been written."""
        self.run(_OPEN.format(path=path))
        try:
            for start in range(0, len(data), _BLOCK):
                block = data[start : start + _BLOCK]
                self.run(_WRITE.format(data=base64.b64encode(block)))
                advance(len(block))
        except (BoardFull, BoardFailed):
            self.run("try:\n f.close()\nexcept OSError:\n pass")
            raise
        self.run(_CLOSE)

    def digest(self, path: str) -> tuple[str, str | int]:
        """("sha256", hexadecimal digits) of a file, or ("crc32", number) where the board has no hashlib."""
        return self.ask(_DIGEST.format(path=path))

    def remove(self, path: str) -> None:
        """Removes a file or a whole folder, if there is one."""
        self.run(_REMOVE_TREE.format(path=path))

    def restart(self, timeout: int) -> None:
        """Soft reset: `main.py` runs. Returns in the raw REPL again, when the prompt has come.

        From the raw REPL, MicroPython would not run `main.py`; and Ctrl-C before the prompt would end it.
        """
        with self._talking():
            self._transport.exit_raw_repl()
            self._await_prompt(_ANSWER_TIMEOUT)
            self._transport.serial.write(b"\x04")
            self._await_prompt(timeout)
            _enter_raw_repl(self._transport, self.port)

    def leave(self) -> None:
        """Back to the friendly REPL, and closes the port."""
        serial_port: Any = self._transport.serial
        try:
            self._transport.exit_raw_repl()
            self._transport.close()
        except OSError:
            serial_port.close()  # the line is gone, but the port is still open here

    def _await_prompt(self, timeout: int) -> None:
        text = self._transport.read_until(1, _PROMPT, timeout=timeout, timeout_overall=timeout)
        if not text.endswith(_PROMPT):
            raise NoAnswer(f"The board on {self.port} does not come back to its prompt.", _POWER_CYCLE)

    @contextmanager
    def _talking(self) -> Iterator[None]:
        """Errors of the line and of the board become ours."""
        try:
            yield
        except TransportExecError as error:
            raise _board_error(error.error_output) from None
        except (TransportError, OSError, struct.error):
            hint = "Look at the cable, and deploy again. The program that was on the board is still there."
            raise LineBroken(f"The line to the board on {self.port} broke.", hint) from None


_TRY_AGAIN = "Try again; if it stays so, unplug the board and plug it in again."
_POWER_CYCLE = "Unplug the board, plug it in again, and try once more."


def _board_error(traceback: str) -> BoardFull | BoardFailed:
    last = traceback.strip().splitlines()[-1] if traceback.strip() else "unknown error"
    # FAT says EACCES where there is no room for the name of another file
    for full in (errno.ENOSPC, errno.EACCES):
        named = errno.errorcode[full] in last
        if named or last == f"OSError: {full}" or last.startswith(f"OSError: [Errno {full}]"):
            return full_board()
    if last.startswith("MemoryError"):
        hint = "Stop the PLC with `import plc; plc.stop()` on the board's REPL, or reset the board, and deploy again."
        return BoardFailed("The board has no memory left for receiving files.", hint)
    return BoardFailed(f"The board reports: {last}", _TRY_AGAIN)


def full_board() -> BoardFull:
    """The error for a file system without room for the program."""
    hint = "Remove files that are not needed any more, with `mpremote resume rm :NAME` say, and deploy again."
    return BoardFull("The board's file system is full.", hint)


def connect(port: str) -> Link:
    """Opens a port and enters the raw REPL of the MicroPython behind it. Raises PortError, NoAnswer, NotMicroPython."""
    try:
        transport = SerialTransport(port, timeout=_READ_TIMEOUT)
    except (TransportError, ValueError):
        raise _why_not_open(port) from None
    try:
        _enter_raw_repl(transport, port)
    except OSError:
        transport.close()
        raise LineBroken(f"The line to the board on {port} broke.", "Look at the cable, and try again.") from None
    except BaseException:
        transport.close()
        raise
    return Link(port, transport)


def _why_not_open(port: str) -> PortError:
    """mpremote does not say why a port cannot be opened: trying once more does."""
    reason: OSError | ValueError | None = None
    try:
        serial.serial_for_url(port, exclusive=True).close()
    except (OSError, ValueError) as error:  # SerialException is an OSError
        reason = error
    number = getattr(reason, "errno", None)
    if isinstance(reason, ValueError) or number == errno.ENOENT or (number is None and not Path(port).exists()):
        return PortMissing(f"There is no port {port}.", f"Is the board plugged in? {_ports_there()}")
    if number in (errno.EAGAIN, errno.EBUSY, errno.EWOULDBLOCK) or reason is None:
        hint = "Close the other program (a terminal, Thonny, mpremote), and try again."
        return PortBusy(f"The port {port} is in use by another program.", hint)
    if number in (errno.EACCES, errno.EPERM):
        hint = "On Linux, add yourself to the port's group (`sudo usermod -aG dialout $USER`) and log in again."
        return PortForbidden(f"You may not open the port {port}.", f"{hint} On Windows, another program has it.")
    return PortMissing(f"{port} is not a serial port.", _ports_there())


def _ports_there() -> str:
    names = usb_ports()
    return f"The ports there are: {', '.join(names)}." if names else "This computer sees no board on USB."


def _enter_raw_repl(transport: SerialTransport, port: str) -> None:
    """As SerialTransport.enter_raw_repl does without its reset, but it tells silence from other programs.

    Ctrl-C ends what the REPL executes, but not a PLC that a timer runs.
    """
    line: Any = transport.serial
    line.timeout = 0.2  # read_until waits as long for one byte, however short its own time is
    line.write(b"\r\x03")
    time.sleep(0.1)
    heard = line.read(line.in_waiting)
    line.write(b"\r\x01")
    heard += transport.read_until(1, _RAW_REPL, timeout=_ANSWER_TIMEOUT, timeout_overall=_ANSWER_TIMEOUT)
    line.timeout = _READ_TIMEOUT
    if heard.endswith(_RAW_REPL):
        transport.in_raw_repl = True
    elif heard.strip(b"\r\x03\x01"):
        hint = "Flash MicroPython onto the board; `iec2mpy boards NAME` says how. Is it the right port?"
        raise NotMicroPython(f"What answers on {port} is not MicroPython.", hint)
    else:
        hint = f"Is it the right port, and has the board MicroPython on it? {_POWER_CYCLE}"
        raise NoAnswer(f"Nothing answers on {port}.", hint)
