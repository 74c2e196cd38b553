"""Faults: the run-time errors that stop the controller. Each is made once, so that raising one allocates nothing."""

from mcu_runtime.ports import const, ticks_diff, ticks_us
from mcu_runtime.slots import LOOP as _LOOP_SLOT

# Every engine has the same limit in virtual time, and reaches it in about a second at most.
_VIRTUAL_PASSES = const(100_000)
_REAL_PASSES = const(1_000)
_LIMIT_US = const(500_000)


class Fault(Exception):
    """`kind` is the word that users see."""

    def __init__(self, kind):
        super().__init__(kind)
        self.kind = kind


ZERO = Fault("zero")
INDEX = Fault("index")
RANGE = Fault("range")
NULL = Fault("NULL")
LOOP = Fault("loop")
RECURSION = Fault("recursion")

_real = False
_started = 0


def refill(V, real):
    """Before each task: the passes that its loops may make. `real`: by the clock, else a fixed number."""
    global _real, _started
    _real = real
    if real:
        _started = ticks_us()
        V[_LOOP_SLOT] = _REAL_PASSES
    else:
        V[_LOOP_SLOT] = _VIRTUAL_PASSES


def loop_check(V):
    """Called by a loop when slot LOOP has come to 0: refills it, or raises LOOP."""
    if not _real or ticks_diff(ticks_us(), _started) > _LIMIT_US:
        raise LOOP
    V[_LOOP_SLOT] = _REAL_PASSES
