"""Faults: the run-time errors that stop the controller, or that a call with ENO catches.

Each is made once, so that raising one allocates nothing. They are objects of built-in classes: MicroPython adds to the
traceback of an exception at each function that it passes, and only those classes let go of it (`__traceback__ = None`).
Nothing else that runs on a board raises an AssertionError, so `except Catchable` catches faults and no more.
"""

from mcu_runtime.ports import const, ticks_diff, ticks_us
from mcu_runtime.slots import LOOP as _LOOP_SLOT

# Every engine has the same limit in virtual time, and reaches it in about a second at most.
_VIRTUAL_PASSES = const(100_000)
_REAL_PASSES = const(1_000)
_LIMIT_US = const(500_000)


Catchable = AssertionError

ZERO = Catchable("zero")
INDEX = Catchable("index")
RANGE = Catchable("range")
NULL = Catchable("NULL")
RECURSION = Catchable("recursion")
LOOP = RuntimeError("loop")  # ENO does not catch it: the scan has already taken too long
_FAULTS = (ZERO, INDEX, RANGE, NULL, RECURSION, LOOP)

_real = False
_started = 0


def kind_of(error):
    """The word that users see for a fault; None for what is none."""
    for fault in _FAULTS:
        if error is fault:
            return error.args[0]
    return None


def forget_tracebacks():
    """After one was caught: what it passed through must not stay with it."""
    for fault in _FAULTS:
        fault.__traceback__ = None


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
