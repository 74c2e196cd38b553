"""Small programs as the generator makes them, written by hand: `main.count` grows by `step` each 10 ms."""

from __future__ import annotations

from iec2mpy.backends.mpy import compile_mpy
from iec2mpy.device.deploy import Payload
from iec2mpy.device.runtime_files import payload

_PORTABLE = """
from array import array
import micropython
from mcu_runtime import faults

V = array("i", [0] * 10)
O = [None]


def reset():
    V[8] = V[9] = 0


reset()

{decorator}
def main():
    {body}


TASKS = (("fast", 10000, 1, main),)
UNTIMED = None
RETAIN = ((), ())
INPUTS = (("%IX0.0", 9),)
OUTPUTS = ()
HASH = "{hash}"
"""
_NAMES = "main.count\tDINT\tV\t8\t-2147483648\t2147483647\t\nmain.button\tBOOL\tV\t9\t0\t1\t\n"


def _payload(name: str, program: bytes) -> Payload:
    return payload({name: program, "program.names": _NAMES.encode(), "board.py": b"CHANNELS = ()\n"})


def counting(step: int) -> Payload:
    """In the portable form."""
    text = _PORTABLE.format(decorator="", body=f"V[8] += {step}", hash=f"step{step}")
    return _payload("program.py", text.encode())


def counting_viper(architecture: str) -> Payload:
    """In the viper form, compiled for an architecture."""
    body = "v = ptr32(V)\n    v[8] += 1"
    text = _PORTABLE.format(decorator="@micropython.viper", body=body, hash="viper")
    return _payload("program.mpy", compile_mpy(text, "program.py", architecture))


def faulting() -> Payload:
    """Divides by zero in its first scan."""
    text = _PORTABLE.format(decorator="", body="raise faults.ZERO", hash="fault")
    return _payload("program.py", text.encode())


def not_loading() -> Payload:
    """Cannot be imported."""
    return _payload("program.py", b"import no_such_module\n")
