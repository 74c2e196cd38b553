"""`iec2mpy check`: diagnostics, and nothing else."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import click

from iec2mpy.cli.support import dialect_option, exit_code, show_diagnostics
from iec2mpy.source.diagnostics import CompileError, Diagnostic

_HELP = """Look for errors in a program, and build nothing.

PATH is a project's folder, or source files that make one program; without it, the project in this folder.

\b
Examples:
  iec2mpy check
  iec2mpy check examples/tank examples/motor
  iec2mpy check main.st valves.st
  iec2mpy check --format sarif > errors.sarif

`text` is for people, and goes to stderr. `json` and `sarif` go to stdout, for editors and for code review.
"""


@click.command("check", help=_HELP)
@click.argument("paths", metavar="[PATH]...", nargs=-1, type=click.Path(path_type=Path))
@click.option("--format", "form", type=click.Choice(["text", "json", "sarif"]), default="text", show_default=True)
@dialect_option
def command(paths: tuple[Path, ...], form: str, dialect: str | None) -> None:
    diagnostics = [d for group in _programs(paths) for d in _check(group, dialect)]
    if form == "text":
        show_diagnostics(diagnostics)
    else:
        from iec2mpy.source import formats

        click.echo(formats.to_json(diagnostics) if form == "json" else formats.to_sarif(diagnostics))
    code = exit_code(diagnostics)
    if form == "text" and code == 0:
        click.echo("No errors." if not diagnostics else "No errors, only warnings.")
    raise click.exceptions.Exit(code)


def _programs(paths: Sequence[Path]) -> list[list[Path]]:
    """Each folder is a program of its own; all files together are one."""
    files = [path for path in paths if not path.is_dir()]
    groups = [[path] for path in paths if path.is_dir()] + ([files] if files else [])
    return groups or [[]]


def _check(paths: Sequence[Path], dialect: str | None) -> Sequence[Diagnostic]:
    """All that is said of one program; of a project also what its board lacks."""
    from iec2mpy.project.build import build_project
    from iec2mpy.project.compile import check_files
    from iec2mpy.project.config import load_project
    from iec2mpy.source.files import read_sources
    from iec2mpy.source.spans import STRICT

    try:
        if paths and not paths[0].is_dir():
            return check_files(read_sources(paths, dialect=dialect or STRICT)).warnings
        return build_project(load_project(paths[0] if paths else Path(), dialect=dialect)).warnings
    except CompileError as error:
        return error.diagnostics
