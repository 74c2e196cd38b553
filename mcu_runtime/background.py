"""Runs the controller beside the REPL: from a timer on boards, from a thread on Linux.

MicroPython for Linux has no timers, and its REPL runs no callbacks while it waits for input.
"""

from mcu_runtime.ports import sleep_us

_LONGEST_SLEEP_US = 20_000  # so that `stop` does not wait long
_SHORTEST_SLEEP_US = 100  # so that others get the lock


class _NoLock:
    """A timer's callback runs between two bytecodes of the REPL: nothing to wait for."""

    def __enter__(self):
        return self

    def __exit__(self, *error):
        return False


class TimerBackground:
    def __init__(self, machine):
        self._machine = machine
        self._timer = None
        self.lock = _NoLock()

    def start(self, work, period_us):
        """Calls `work` every `period_us`, or more often."""
        self._timer = self._new_timer()
        self._timer.init(
            mode=self._machine.Timer.PERIODIC,
            period=max(1, period_us // 1000),
            callback=lambda timer: work(),
        )

    def _new_timer(self):
        try:
            return self._machine.Timer(0)  # on ESP32 a virtual timer ticks every 10 ms, or there is none
        except ValueError:
            return self._machine.Timer(-1)  # RP2 has only virtual timers, which count microseconds

    def stop(self):
        if self._timer:
            self._timer.deinit()
            self._timer = None


class ThreadBackground:
    def __init__(self):
        import _thread

        self._thread = _thread
        self._ended = None
        self._stopping = False
        self.lock = _thread.allocate_lock()

    def start(self, work, period_us):
        """Calls `work` over and over; it returns how long nothing is to do, in us."""
        self._stopping = False
        self._ended = self._thread.allocate_lock()
        self._ended.acquire()
        self._thread.start_new_thread(self._loop, (work, self._ended))

    def _loop(self, work, ended):
        while not self._stopping:
            with self.lock:
                idle = work()
            sleep_us(max(_SHORTEST_SLEEP_US, min(idle, _LONGEST_SLEEP_US)))
        ended.release()

    def stop(self):
        self._stopping = True
        if self._ended:
            self._ended.acquire()  # until the thread has ended
            self._ended = None


def background(machine):
    """What this host has."""
    return TimerBackground(machine) if hasattr(machine, "Timer") else ThreadBackground()
