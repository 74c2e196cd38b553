"""What `main.py` of a board runs: starts the program in the folder that the file `active` names.

It stands at the root of the file system as `plc_boot`, imports nothing at first, and leaves the PLC stopped when two
starts in a row have failed, so that a board can always be reached again. `boot.txt` holds the folder, how many starts
of it have failed, and why; a start that ends well removes it.
"""

import os
import sys

_ACTIVE = "active"
_STATE = "boot.txt"
_TRIES = 2


def run():
    """Start the PLC. Does nothing where no program was deployed."""
    folder = _read(_ACTIVE).strip()
    if not folder:
        return
    sys.path.insert(0, folder)
    _outputs_safe()  # a soft reset leaves pins as they were, and loading the program takes a while
    failed = _failed(folder)
    if failed >= _TRIES:
        return
    _note(folder, failed + 1, "the start did not come to its end")  # true if a reset comes now
    try:
        import plc

        plc.start()
    except Exception as error:
        _note(folder, failed + 1, "%s: %s" % (type(error).__name__, error))
        _outputs_safe()
        return
    except KeyboardInterrupt:
        _forget()
        raise
    _forget()


def problem():
    """Why the PLC was not started; "" where nothing is known against it."""
    return _read(_STATE).partition("\n")[2]


def _failed(folder):
    """How many starts of this folder have failed since the last good one."""
    name, _, count = _read(_STATE).partition("\n")[0].rpartition(" ")
    return int(count) if name == folder and count.isdigit() else 0


def _note(folder, count, why):
    try:
        with open(_STATE, "w") as file:
            file.write("%s %d\n%s" % (folder, count, why))
    except OSError:  # a full file system is no reason not to start
        pass


def _forget():
    try:
        os.remove(_STATE)
    except OSError:
        pass


def _outputs_safe():
    """As far as the folder allows: it is what may be broken."""
    try:
        import board
        import machine

        from mcu_runtime.process_image import ProcessImage

        ProcessImage(board.CHANNELS, machine)
    except Exception:
        pass


def _read(path):
    try:
        with open(path) as file:
            return file.read()
    except OSError:
        return ""
