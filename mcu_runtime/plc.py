"""The PLC, as a user of the REPL sees it: `import plc`, then `plc.start()`, `plc.status()`, `plc.read("main.motor")`.

Goes into a deployed folder, beside the program that it runs. It never prints.
"""

import os

import board
import machine
import program

from mcu_runtime.background import background
from mcu_runtime.clock import RealClock
from mcu_runtime.controller import Controller
from mcu_runtime.names import Names
from mcu_runtime.ports import collect, sleep_us, ticks_diff, ticks_us
from mcu_runtime.process_image import ProcessImage

_COLLECT_EVERY_US = 1_000_000


def _folder():
    """Where this file is, also after a change of the current directory."""
    folder = __file__.rpartition("/")[0]
    return folder if folder.startswith("/") else os.getcwd().rstrip("/") + "/" + folder


# MicroPython for Linux has no pins: the program runs there on what is written to its variables.
_io = ProcessImage(board.CHANNELS if hasattr(machine, "Pin") else (), machine)
_controller = Controller(program, _io, RealClock())
_names = Names(_folder() + "/program.names")
_background = background(machine)
_running = False
_early = 0
_collected = ticks_us()
_collecting = 0


def start(cold=False):
    """Run in the background, until `stop()`: the REPL stays free. RETAIN variables keep their values, unless `cold`.

    The first scan runs here, so that a fault in it is known when this returns. Does nothing while the PLC runs.
    """
    global _running, _early
    if _running and not _controller.fault:
        return
    stop()
    tick = _controller.tick()
    _early = tick // 2  # a timer may come a little before the clock says so, and would else miss a whole period
    _controller.restart(cold)
    _controller.resume()
    _controller.poll()
    _running = True
    _background.start(_work, tick)


def stop():
    """Stop: outputs go to their safe values."""
    global _running
    _background.stop()
    _running = False
    _controller.stop()


def run(cold=False):
    """Run in the foreground, with the least jitter, until Ctrl-C or a fault."""
    stop()
    _controller.restart(cold)
    _controller.resume()
    try:
        while not _controller.fault and not _controller.interrupted:
            _controller.poll()
            _collect()
            idle = _controller.until_due()
            if idle > 0:
                sleep_us(idle)
    except KeyboardInterrupt:
        pass
    finally:
        _controller.stop()


def step(n=1):
    """Scan n times, each one period later than the one before, whatever the clock says. Only while it is stopped."""
    if _running:
        raise RuntimeError("the PLC is running: plc.stop() first")
    _controller.align()
    for _ in range(n):
        _controller.scan()


def read(name):
    """The value of a variable, such as `main.motor` or `main.level[3]`."""
    place = _names.resolve(name)
    with _background.lock:
        stored = place.load(program)
    return place.decode(stored)


def write(name, value):
    """Set a variable. ValueError if its type does not have this value."""
    place = _names.resolve(name)
    stored = place.encode(value)
    with _background.lock:
        place.store(program, stored)


def status():
    """What the PLC does: `fault` is None or a text with the source line, times are in us."""
    return {
        "running": _running and not _controller.fault,
        "fault": _fault(),
        "start": _start_problem(),
        "scans": _controller.scans,
        "interrupted": _controller.interrupted,
        "program": program.HASH,
        "tasks": [
            {
                "name": task.name,
                "interval": task.interval,
                "count": task.count,
                "overruns": task.overruns,
                "last": task.last,
                "min": task.shortest,
                "max": task.longest,
            }
            for task in _controller.tasks
        ],
    }


def _fault():
    if not _controller.fault:
        return None
    kind, site = _controller.fault
    place = _names.place(site)
    return kind + (" at " + place if place else "") + (": " + _controller.detail if _controller.detail else "")


def _start_problem():
    """Why the last start at power-on failed; "" where it did not."""
    try:
        import plc_boot
    except ImportError:  # started by hand
        return ""
    return plc_boot.problem()


def _work():
    """Called in the background. Gives the microseconds until there is something to do."""
    try:
        _controller.poll(_early)
        _collect()
    except KeyboardInterrupt:  # meant for the REPL, and came while a callback ran
        pass
    return _controller.until_due()


def _collect():
    """Collect garbage now and then, where there is time: else it happens in a scan."""
    global _collected, _collecting
    now = ticks_us()
    if ticks_diff(now, _collected) > _COLLECT_EVERY_US and _controller.until_due() > _collecting:
        collect()
        _collected = ticks_us()
        _collecting = ticks_diff(_collected, now)
