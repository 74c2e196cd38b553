"""Clocks: what says how much time has passed."""

from mcu_runtime.ports import ticks_diff, ticks_us


class RealClock:
    """The board's microsecond counter wraps after some minutes, so time is only ever taken as differences."""

    def __init__(self):
        self._last = ticks_us()

    def elapsed(self):
        """Microseconds since it was last asked."""
        now = ticks_us()
        passed = ticks_diff(now, self._last)
        self._last = now
        return passed


class VirtualClock:
    """Passes only where it is told to."""

    def __init__(self):
        self._passed = 0

    def advance(self, us):
        self._passed += us

    def elapsed(self):
        passed = self._passed
        self._passed = 0
        return passed
