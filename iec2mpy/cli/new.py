"""`iec2mpy new`: a project that builds, runs and passes its tests at once."""

from __future__ import annotations

import re
from pathlib import Path

import click

from iec2mpy.cli.support import UserError
from iec2mpy.project.boards import board_names
from iec2mpy.source.suggest import suggest

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_-]*")

_PROGRAM = """\
(* A lamp that blinks, and blinks faster while the button is pressed. *)
PROGRAM main
VAR
    button AT %IX0.0 : BOOL;
    lamp   AT %QX0.0 : BOOL;
    pause  : TIME;
    timer  : TON;
END_VAR

IF button THEN
    pause := T#100ms;
ELSE
    pause := T#500ms;
END_IF;

(* The timer's own output starts it anew, so Q is TRUE for one scan each time the pause is over. *)
timer(IN := NOT timer.Q, PT := pause);
IF timer.Q THEN
    lamp := NOT lamp;
END_IF;
END_PROGRAM
"""

_TESTS = """\
# Tests of the program: `iec2mpy test` runs them. A scan is 10 ms here, and the first one is at time 0.

[[case]]
id = "blinks"
title = "The lamp comes on after half a second"
files = ["../src/main.st"]
steps = [
  { run = "T#500ms", expect = { "main.lamp" = false } },
  { scans = 1, expect = { "main.lamp" = true } },
]

[[case]]
id = "faster-with-the-button"
title = "With the button pressed it comes on after a tenth of a second"
files = ["../src/main.st"]
steps = [
  { set = { "%IX0.0" = true }, run = "T#100ms", expect = { "%QX0.0" = false } },
  { scans = 1, expect = { "%QX0.0" = true } },
]
"""

_README = """\
# {name}

| command | does |
| --- | --- |
| `iec2mpy run` | simulates the program on this computer, until Ctrl-C |
| `iec2mpy test` | runs the tests in `tests/` |
| `iec2mpy build` | builds the files for the board into `build/` |
| `iec2mpy deploy --port PORT` | puts them on the board, and starts the program |

The program is in `src/`, the board and its channels in `iec2mpy.toml`; `iec2mpy boards {board}` shows what
`%IX0.0` and `%QX0.0` are on the board.
"""


_HELP = """Make a new project in DIR, a folder that does not exist yet or is empty.

\b
Example:
  iec2mpy new hello --board pico
  cd hello
  iec2mpy run

It holds a small program that blinks a lamp, with two tests, and builds, runs and passes as it is.
"""


@click.command("new", help=_HELP)
@click.argument("folder", metavar="DIR", type=click.Path(path_type=Path))
@click.option("--board", metavar="BOARD", required=True, help="The program's board; `iec2mpy boards` lists them.")
def command(folder: Path, board: str) -> None:
    name = _project_name(folder)
    _refuse_other_content(folder)
    _known_board(board)
    for path, text in _files(name, board).items():
        target = folder / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text, encoding="utf-8")
    click.echo(f"Made the project {name} in {folder}. What to do next:\n")
    if folder.resolve() != Path.cwd():
        click.echo(f"  cd {folder}")
    click.echo("  iec2mpy run     see it run on this computer\n  iec2mpy test    run its tests")


def _project_name(folder: Path) -> str:
    """The folder's own name: it becomes the project's, and that of a folder on the board."""
    name = folder.resolve().name
    if not _NAME.fullmatch(name):
        raise UserError(
            f"`{name}` cannot be the name of a project: it starts with a letter, and has letters, digits, `_` and `-`"
        )
    return name


def _known_board(name: str) -> None:
    names = board_names()
    if name not in names:
        near = suggest(name, names)
        advice = f"did you mean `{near}`?" if near else f"the boards are {', '.join(names)}"
        raise UserError(f"there is no board `{name}`; {advice}")


def _refuse_other_content(folder: Path) -> None:
    if folder.exists() and not folder.is_dir():
        raise UserError(f"{folder} is a file; name a folder that does not exist yet")
    if folder.is_dir() and any(folder.iterdir()):
        raise UserError(f"{folder} is not empty; name a folder that does not exist yet")


def _files(name: str, board: str) -> dict[str, str]:
    return {
        "iec2mpy.toml": f'[project]\nname = "{name}"\nboard = "{board}"\n',
        "src/main.st": _PROGRAM,
        "tests/main.toml": _TESTS,
        "README.md": _README.format(name=name, board=board),
        ".gitignore": "build/\n",
    }
