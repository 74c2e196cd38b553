"""What viper refuses, and what a board would do without a word."""

from __future__ import annotations

import sys

_PACKAGE = __name__.rpartition(".")[0]


class ViperError(Exception):
    """The compiler refuses the text.

    `message` is MicroPython's own sentence with its kind of error before it, or one of ours, which starts with
    `viper32:`; `line` counts from 1.
    """

    def __init__(self, message: str, line: int) -> None:
        super().__init__(f"{message} (line {line})")
        self.message = message
        self.line = line


class ViperFault(BaseException):
    """Running code did what corrupts memory on a board, or what differs from chip to chip. `line` is that of the text.

    Not an `Exception`: no handler in the program or in the runtime would see it on a board, so none may here.
    """

    def __init__(self, message: str, line: int, filename: str) -> None:
        super().__init__(f"{message} ({filename}, line {line})")
        self.message = message
        self.line = line
        self.filename = filename


def fault(message: str) -> ViperFault:
    """The fault at the line of the translated text that is being executed."""
    frame = sys._getframe(1)
    while frame.f_back is not None and str(frame.f_globals.get("__name__")).startswith(_PACKAGE):
        frame = frame.f_back
    return ViperFault(message, frame.f_lineno, frame.f_code.co_filename)


def unassigned(error: UnboundLocalError) -> ViperFault:
    """A read of a local before its first assignment: on a board it yields what the register or the stack held."""
    trace = error.__traceback__
    assert trace is not None
    return ViperFault(f"read before assignment: {error}", trace.tb_lineno, trace.tb_frame.f_code.co_filename)
