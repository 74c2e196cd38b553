"""What can go wrong between this computer and a board. Each error says what it is, and what to do."""

from __future__ import annotations

from iec2mpy.source.diagnostics import Diagnostic


class DeviceError(Exception):
    """`message` is a sentence, `hint` what to do about it. `code` is the page in `docs/errors/`."""

    code = ""

    def __init__(self, message: str, hint: str) -> None:
        super().__init__(message)
        self.message = message
        self.hint = hint

    @property
    def diagnostic(self) -> Diagnostic:
        """The same, to be shown like all other errors."""
        return Diagnostic(self.code, self.message, None, self.hint)


class PortError(DeviceError):
    """The port cannot be opened."""


class PortMissing(PortError):
    code = "E1001"


class PortBusy(PortError):
    code = "E1002"


class PortForbidden(PortError):
    code = "E1003"


class NoAnswer(DeviceError):
    code = "E1004"


class UnfitBoard(DeviceError):
    """What answers cannot run the program. Nothing was written to it."""


class NotMicroPython(UnfitBoard):
    code = "E1005"


class WrongRelease(UnfitBoard):
    """MicroPython is too old for the `.mpy` files, or too new."""

    code = "E1006"


class WrongChip(UnfitBoard):
    code = "E1007"


class BoardFull(DeviceError):
    code = "E1008"


class LineBroken(DeviceError):
    code = "E1009"


class ForeignMain(DeviceError):
    """The board has a `main.py` that is not ours."""

    code = "E1010"


class UploadDamaged(DeviceError):
    code = "E1011"


class StartFailed(DeviceError):
    """The new program did not start; the one before it is active again where there was one."""

    code = "E1012"


class BoardFailed(DeviceError):
    """MicroPython on the board raised an exception at something that we asked of it."""

    code = "E1013"
