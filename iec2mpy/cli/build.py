"""`iec2mpy build`: the files that a board runs, with what they cost."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from iec2mpy.cli.support import dialect_option, show_diagnostics

if TYPE_CHECKING:
    from iec2mpy.project.build import Build
    from iec2mpy.source.spans import Span

_HELP = """Build what a board runs, into the folder build/ of the project.

DIR is the project's folder; without it, this one.

\b
Examples:
  iec2mpy build
  iec2mpy build hello --board esp32_devkit
  iec2mpy build hello --emitter portable

`viper` is native code, for chips that MicroPython has a native emitter for; `portable` is plain Python, which every
MicroPython runs. Among the files are the generated program as readable text (program.py), compiled for the chip
(program.mpy), and the map of its variables (program.map.json).
"""

_PURPOSES = {
    "program.py": "the generated program, to read",
    "program.mpy": "the same, compiled for the chip",
    "program.names": "the variables, for the board",
    "program.map.json": "the variables, for tools",
    "board.py": "the channels that the program uses",
}


@click.command("build", help=_HELP)
@click.argument("directory", metavar="[DIR]", required=False, default=".", type=click.Path(path_type=Path))
@click.option("--board", metavar="B", help="Build for this board instead of the project's.")
@click.option("--emitter", type=click.Choice(["viper", "portable"]), help="The form of the code.  [default: viper]")
@dialect_option
def command(directory: Path, board: str | None, emitter: str | None, dialect: str | None) -> None:
    from iec2mpy.project.build import BUILD_FOLDER, build_project, write_build
    from iec2mpy.project.config import load_project

    project = load_project(directory, board, dialect)
    build = build_project(project, emitter)
    show_diagnostics(build.warnings)
    folder = project.root / BUILD_FOLDER
    write_build(build, folder)
    board_title = f"{project.board.title} ({project.board.chip.title})"
    click.echo(f"{project.name} for {board_title}, {build.program.target.form} code, in {folder}:")
    for name, content in build.files.items():
        mark = "*" if name in build.on_board else " "
        click.echo(f"{mark} {name:17}{len(content):>8,} bytes  {_PURPOSES[name]}")
    click.echo("* goes to the board, with the runtime")
    slots = build.program.slots
    click.echo(f"Memory image: {slots.v:,} slots of V (4 bytes each), {slots.o:,} of O (objects).")
    click.echo(_about_allocation(build))


def _about_allocation(build: Build) -> str:
    where = build.allocates
    if where is None:
        return "A scan allocates nothing: the garbage collector has no work while the program runs."
    return f"A scan allocates memory, first at {_place(where)}: {where.file.line_text(where.line).strip()}"


def _place(span: Span) -> str:
    return f"{span.file.path}:{span.line}"
