"""What differs between CPython, MicroPython for Linux, and boards: the one place that knows.

`const` is taken by MicroPython's compiler before anything runs; elsewhere it gives its argument.
"""

import gc
import sys
import time

try:
    from micropython import const
except ImportError:

    def const(value):
        return value


IS_BOARD = sys.platform not in ("linux", "darwin", "win32")

if hasattr(time, "ticks_us"):
    ticks_us = time.ticks_us
    ticks_diff = time.ticks_diff
    sleep_us = time.sleep_us
    collect = gc.collect

else:

    def ticks_us():
        return time.perf_counter_ns() // 1000

    def ticks_diff(end, start):
        return end - start

    def sleep_us(us):
        time.sleep(us / 1_000_000)

    def collect():
        """CPython frees what is not in a cycle at once."""
