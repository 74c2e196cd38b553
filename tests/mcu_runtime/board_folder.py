"""Makes a directory look like a board's file system with a deployed program."""

from __future__ import annotations

from pathlib import Path

import mcu_runtime
from mcu_runtime import manifest

RUNTIME = Path(mcu_runtime.__file__).parent

PROGRAM = """
from array import array
from mcu_runtime.faults import ZERO

V = array("i", [0] * 16)
O = ["", 0.0, ""]


def reset():
    for slot in range(8, 16):
        V[slot] = 0
    V[11] = 1
    O[1] = 0.5
    O[2] = "text"


def main():
    V[9] += 1
    V[10] = V[8]
    if V[12]:
        V[3] = 12
        raise ZERO


TASKS = (("main", 10000, 1, main),)
UNTIMED = None
RETAIN = (((13, 14),), ())
INPUTS = (("%IX0.0", 8),)
OUTPUTS = (("%QX0.0", 10),)
HASH = "c0ffee"
"""

NAMES = """=Colour|red:0|green:1
main.button|BOOL|V|8|0|1|
main.count|DINT|V|9|-2147483648|2147483647|
main.lamp|BOOL|V|10|0|1|
main.colour|Colour|V|11|0|1|
main.trip|BOOL|V|12|0|1|
main.kept|INT|V|13|0|10|
main.x|REAL|O|1|||
main.s|STRING|O|2|0|5|
@12|src/main.st|7|main
""".replace("|", "\t")

BOARD = """
CHANNELS = (
    ("din", 8, 2, "up", True),
    ("dout", 10, 3, False, 0),
)
"""


def deploy(root: Path, folder: str = "plc-1", program: str = PROGRAM) -> None:
    """Puts the program and the runtime there, and makes it the active one."""
    (root / folder / "mcu_runtime").mkdir(parents=True)
    for module in manifest.PACKAGE:
        _copy(module, root / folder / "mcu_runtime" / module)
    for module in manifest.FOLDER:
        _copy(module, root / folder / module)
    for module, name in manifest.ROOT.items():
        _copy(module, root / name)
    (root / folder / "program.py").write_text(program)
    (root / folder / "program.names").write_text(NAMES)
    (root / folder / "board.py").write_text(BOARD)
    (root / "main.py").write_text(manifest.MAIN)
    (root / "active").write_text(folder)


def _copy(module: str, target: Path) -> None:
    target.with_suffix(".py").write_text((RUNTIME / f"{module}.py").read_text())
