"""How long a scan takes: generated code against hand-written MicroPython, in one run on MicroPython for Linux.

    python bench/scan_speed.py

The program is made of ladder rungs, additions and timers. By hand it is written as people write it: a class,
attributes, `and`, `or`; timers are objects with a method. Both do the same: their sums are compared after the run.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

from iec2mpy.backends.target import PORTABLE, VIPER64
from iec2mpy.project.compile import compile_files
from iec2mpy.source.spans import SourceFile

RUNGS, SUMS, TIMERS, SCANS = 100, 20, 10, 2000
ROOT = Path(__file__).resolve().parent.parent


def st_program() -> str:
    names = ", ".join(f"a{i}, b{i}, c{i}, q{i}" for i in range(RUNGS))
    sums = ", ".join(f"s{i}" for i in range(SUMS))
    timers = ", ".join(f"t{i}" for i in range(TIMERS))
    lines = [f"PROGRAM main\nVAR {names} : BOOL; {sums} : INT; {timers} : TON; n : INT; END_VAR", "n := n + 1;"]
    lines += [f"a{i} := n MOD {i + 2} = 0; q{i} := (a{i} OR q{i}) AND NOT b{i} OR c{i};" for i in range(2)]
    lines += [f"q{i} := (q{i - 2} OR q{i}) AND NOT b{i} OR c{i};" for i in range(2, RUNGS)]
    lines += [f"s{i} := s{i} + {i};" for i in range(SUMS)]
    lines += [f"t{i}(IN := q{i}, PT := T#{100 + i}ms);" for i in range(TIMERS)]
    return "\n".join([*lines, "END_PROGRAM", ""])


def by_hand() -> str:
    lines = [
        "class Ton:",
        "    def __init__(self):",
        "        self.q = self.running = False",
        "        self.et = self.start = 0",
        "    def __call__(self, in_, pt, now):",
        "        if not in_:",
        "            self.q = self.running = False",
        "            self.et = 0",
        "        elif not self.q:",
        "            if not self.running:",
        "                self.running = True",
        "                self.start = now",
        "            self.et = now - self.start",
        "            if self.et >= pt:",
        "                self.et = pt",
        "                self.q = True",
        "class Main:",
        "    def __init__(self):",
        "        self.n = 0",
        *(f"        self.a{i} = self.b{i} = self.c{i} = self.q{i} = False" for i in range(RUNGS)),
        *(f"        self.s{i} = 0" for i in range(SUMS)),
        *(f"        self.t{i} = Ton()" for i in range(TIMERS)),
        "    def scan(self, now):",
        "        self.n = ((self.n + 1 + 32768) & 65535) - 32768",
    ]
    for i in range(RUNGS):
        first = f"self.q{i - 2}" if i > 1 else f"self.a{i}"
        if i <= 1:
            lines.append(f"        self.a{i} = self.n % {i + 2} == 0")
        lines.append(f"        self.q{i} = ({first} or self.q{i}) and not self.b{i} or self.c{i}")
    lines += [f"        self.s{i} = ((self.s{i} + {i} + 32768) & 65535) - 32768" for i in range(SUMS)]
    lines += [f"        self.t{i}(self.q{i}, {100 + i}, now)" for i in range(TIMERS)]
    return "\n".join([*lines, ""])


DRIVER = f"""
import time, viper_form, portable_form, hand
def generated(m):
    m.reset()
    task = m.TASKS[0][3]
    V = m.V
    def scan(now):
        V[1] = now
        task()
    return scan
main = hand.Main()
scans = [("hand", main.scan), ("portable", generated(portable_form)), ("viper", generated(viper_form))]
for name, scan in scans:
    best = 1 << 30
    for round in range(5):
        start = time.ticks_us()
        for k in range({SCANS // 5}):
            scan(10 * (round * {SCANS // 5} + k))
        best = min(best, time.ticks_diff(time.ticks_us(), start))
    print(name, best / {SCANS // 5})
sums = [getattr(main, "s%d" % i) for i in range({SUMS})]
print("sums", all(viper_form.V[SLOT + i] == portable_form.V[SLOT + i] == sums[i] for i in range({SUMS})))
"""


def measure() -> dict[str, float]:
    """Microseconds a scan, by form."""
    source = [SourceFile("bench.st", st_program())]
    with tempfile.TemporaryDirectory() as folder:
        there = Path(folder)
        for name, target in (("viper_form", VIPER64), ("portable_form", PORTABLE)):
            program = compile_files(source, target)
            (there / f"{name}.py").write_text(program.text)
        slot = next(v.slot for v in program.map.variables if v.path == "main.s0")
        (there / "hand.py").write_text(by_hand())
        (there / "driver.py").write_text(DRIVER.replace("SLOT", str(slot)))
        (there / "mcu_runtime").symlink_to(ROOT / "mcu_runtime")
        done = subprocess.run(["micropython", "driver.py"], cwd=there, capture_output=True, text=True, check=True)
    *rows, check = done.stdout.splitlines()
    if check != "sums True":
        sys.exit("the forms do not agree")
    return {name: float(value) for name, value in (row.split() for row in rows)}


if __name__ == "__main__":
    times = measure()
    print(f"{RUNGS} rungs, {SUMS} additions of INT, {TIMERS} TON, a scan:")
    for name, time in times.items():
        print(f"  {name:9} {time:8.1f} us   1/{times['hand'] / time:.1f} of the time by hand")
