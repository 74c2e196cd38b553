"""The PLC as a user of the REPL has it, in a directory that looks like a board's file system.

On Linux (no pins, no timer) it runs in a thread, on MicroPython as on CPython; with `fake_machine.py` in the place of
`machine`, as on a board.
"""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from iec2mpy.simulator.engines.child import find_micropython
from tests.mcu_runtime.board_folder import PROGRAM, deploy

FAKE_MACHINE = (Path(__file__).parent / "scenarios" / "fake_machine.py").read_text()
HOSTS = ("cpython", "micropython")


def run(host: str, root: Path, script: str) -> str:
    """What the script prints, with `root` as the file system; nothing else may be said."""
    (root / "script.py").write_text("import sys\nsys.path.insert(0, '')\n" + script)
    command = [sys.executable, "-P"] if host == "cpython" else [find_micropython()]
    done = subprocess.run([*command, "script.py"], cwd=root, capture_output=True, text=True, timeout=30, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stderr == ""
    return done.stdout


@pytest.fixture(params=HOSTS)
def host(request: pytest.FixtureRequest) -> str:
    return request.param


@pytest.fixture
def linux(host: str, tmp_path: Path) -> Path:
    """A machine without pins."""
    deploy(tmp_path)
    if host == "cpython":
        (tmp_path / "machine.py").write_text("")
    return tmp_path


@pytest.fixture
def board(tmp_path: Path) -> Path:
    deploy(tmp_path)
    (tmp_path / "machine.py").write_text(FAKE_MACHINE)
    return tmp_path


START = "import main, time\nfrom plc import *\nimport plc\n"
# A clock that the test moves itself: `now`, in us.
CLOCK = """
import sys
sys.path.insert(0, "plc-1")
import mcu_runtime.clock
now = 0
mcu_runtime.clock.ticks_us = lambda: now
"""


def test_runs_in_a_thread(host: str, linux: Path) -> None:
    said = run(
        host,
        linux,
        START
        + """
before = read("main.count")
plc.start()  # it runs already
time.sleep(0.3)
count = read("main.count")
print(before >= 1, 20 <= count <= 32, status()["running"], status()["fault"], status()["start"] == "")
write("main.button", True)
time.sleep(0.05)
print(read("main.lamp"), read("main.colour"), read("MAIN.X"), read("main.s"))
plc.stop()
plc.stop()
count = read("main.count")
time.sleep(0.05)
print(read("main.count") == count, status()["running"], status()["scans"] >= count)
""",
    )
    assert said == "True True True None True\nTrue green 0.5 text\nTrue False True\n"


def test_write_refuses(host: str, linux: Path) -> None:
    said = run(
        host,
        linux,
        START
        + """
for name, value in (("main.kept", 11), ("main.colour", "blue"), ("main.s", "longer"), ("main.nothing", 1)):
    try:
        write(name, value)
        print("written")
    except (ValueError, KeyError) as error:
        print(type(error).__name__, error.args[0])
import os
os.chdir("..")
write("main.kept", 10)
write("main.colour", "RED")
print(read("main.kept"), read("main.colour"))
plc.stop()
""",
    )
    assert said == (
        "ValueError main.kept is a INT: a whole number from 0 to 10\n"
        "ValueError main.colour is one of red, green\n"
        "ValueError main.s is a STRING: a text of at most 5 characters\n"
        "KeyError there is no variable main.nothing\n"
        "10 red\n"
    )


def test_a_fault_has_its_source_line(host: str, linux: Path) -> None:
    said = run(
        host,
        linux,
        START
        + """
write("main.kept", 3)
write("main.trip", True)
time.sleep(0.1)
print(status()["running"], status()["fault"])
plc.start()
print(status()["running"], status()["fault"], read("main.kept"))
plc.start(cold=True)  # it runs: nothing happens
print(read("main.kept"))
plc.stop()
plc.start(cold=True)
print(read("main.kept"))
plc.stop()
""",
    )
    assert said == "False zero at src/main.st:7 (main)\nTrue None 3\n3\n0\n"


def test_step(host: str, linux: Path) -> None:
    said = run(
        host,
        linux,
        START
        + """
try:
    step()
except RuntimeError as error:
    print(error)
plc.stop()
before = read("main.count")
step()
step(4)
print(read("main.count") - before)
""",
    )
    assert said == "the PLC is running: plc.stop() first\n5\n"


def test_a_step_after_an_early_scan(host: str, board: Path) -> None:
    """The timer came early, so the next deadline is more than a period away; a step scans all the same."""
    said = run(
        host,
        board,
        CLOCK
        + START
        + """
from machine import Timer
now += 6000
Timer.running.callback(Timer.running)
plc.stop()
before = read("main.count")
step(3)
print(read("main.count") - before)
""",
    )
    assert said == "3\n"


def test_run_in_the_foreground_until_a_fault(host: str, linux: Path) -> None:
    tripping = PROGRAM.replace("if V[12]:", "if V[9] == 20:")
    (linux / "plc-1" / "program.py").write_text(tripping)
    said = run(
        host,
        linux,
        """
sys.path.insert(0, "plc-1")
import plc, time
plc.run()
task = plc.status()["tasks"][0]
print(plc.status()["fault"], plc.status()["running"], task["name"], task["interval"], task["count"])
""",
    )
    assert said == "zero at src/main.st:7 (main) False main 10000 20\n"


# ------------------------------------------------------------------------------------------ on a board


def test_a_timer_drives_it(host: str, board: Path) -> None:
    said = run(
        host,
        board,
        START
        + """
from machine import Pin, Timer
print(Timer.running.period, Pin.levels[3])
Pin.levels[2] = 0  # the button is active low
for _ in range(3):
    time.sleep(0.01)
    Timer.running.callback(Timer.running)
print(read("main.count"), Pin.levels[3], read("main.lamp"))
plc.stop()
print(Timer.running, Pin.levels[3])
""",
    )
    assert said == "10 1\n4 1 True\nNone 0\n"


def test_the_timer_may_come_early(host: str, board: Path) -> None:
    said = run(
        host,
        board,
        CLOCK
        + START
        + """
from machine import Timer
now += 6000  # of 10 ms
Timer.running.callback(Timer.running)
Timer.running.callback(Timer.running)
print(read("main.count"))
plc.stop()
""",
    )
    assert said == "2\n"


def interrupted_at(count: int) -> str:
    """The program, with Ctrl-C coming while this scan runs."""
    return PROGRAM.replace("if V[12]:", f"if V[9] == {count}:\n        raise KeyboardInterrupt\n    if V[12]:")


def test_ctrl_c_in_a_callback_stops_nothing(host: str, board: Path) -> None:
    (board / "plc-1" / "program.py").write_text(interrupted_at(2))
    said = run(
        host,
        board,
        START
        + """
from machine import Timer
for _ in range(3):
    time.sleep(0.01)
    Timer.running.callback(Timer.running)
print(read("main.count"), status()["interrupted"], status()["running"])
plc.stop()
""",
    )
    assert said == "4 1 True\n"


def test_ctrl_c_ends_run(host: str, board: Path) -> None:
    (board / "plc-1" / "program.py").write_text(interrupted_at(5))
    said = run(
        host,
        board,
        """
sys.path.insert(0, "plc-1")
import plc
from machine import Pin
plc.run()
print(plc.read("main.count"), plc.read("main.lamp"), Pin.levels[3], plc.status()["fault"])
""",
    )
    assert said == "5 True 0 None\n"


# ------------------------------------------------------------------------------------------ starting

LOOK = """
import main
import plc_boot
from machine import Pin
print(plc_boot.problem(), Pin.levels)
"""


def test_without_a_program(host: str, board: Path) -> None:
    (board / "active").unlink()
    assert run(host, board, "import main, plc_boot\nprint(plc_boot.problem())") == "\n"


def test_two_failed_starts_leave_it_stopped(host: str, board: Path) -> None:
    log = "with open('log', 'a') as log:\n    log.write('started ')\n"
    (board / "plc-1" / "program.py").write_text(log + "1 // 0\n")
    for _ in range(3):
        said = run(host, board, LOOK)
        assert said.startswith("ZeroDivisionError: ")
        assert said.endswith("{3: 0}\n")
    assert (board / "log").read_text() == "started started "
    (board / "plc-1" / "program.py").write_text(PROGRAM)
    said = run(host, board, "import main, plc\nprint(plc.status()['running'], plc.status()['start'])\n")
    assert said.startswith("False ZeroDivisionError: ")


def test_another_program_starts_after_a_failed_one(host: str, board: Path) -> None:
    (board / "boot.txt").write_text("plc-1 2\nbad")
    deploy(board, "plc-2")
    assert run(host, board, START + "print(status()['running'], status()['start'])\nplc.stop()") == "True \n"
    assert not (board / "boot.txt").exists()


def test_a_start_that_was_cut_short_counts(host: str, board: Path) -> None:
    (board / "boot.txt").write_text("plc-1 1\nthe start did not come to its end")
    (board / "plc-1" / "program.py").write_text("import nothing_of_this_name\n")
    run(host, board, LOOK)
    state = (board / "boot.txt").read_text()
    assert state.startswith("plc-1 2\n")
    assert "nothing_of_this_name" in state


def test_a_damaged_state_file_stops_nothing(host: str, board: Path) -> None:
    for text in ("", "plc-1", "plc-1 x\n", "\n\n"):
        (board / "boot.txt").write_text(text)
        assert run(host, board, START + "print(status()['running'])\nplc.stop()") == "True\n"


def test_a_real_ctrl_c_ends_run_and_gives_the_prompt(host: str, linux: Path) -> None:
    script = "import sys\nsys.path[:0] = ['', 'plc-1']\nimport plc\n"
    script += "print('here')\nplc.run()\nprint(plc.status()['fault'])\n"
    (linux / "script.py").write_text(script)
    command = [sys.executable, "-P", "-u"] if host == "cpython" else [find_micropython()]
    command.append("script.py")
    with subprocess.Popen(command, cwd=linux, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        assert process.stdout and process.stderr
        assert process.stdout.readline() == b"here\n"
        time.sleep(0.1)
        process.send_signal(signal.SIGINT)
        assert process.stdout.read() == b"None\n"
        assert process.stderr.read() == b""
    assert process.returncode == 0
