"""What the commands share: which program is meant, and how what is wrong with it is shown."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

if TYPE_CHECKING:
    from iec2mpy.project.config import Project
    from iec2mpy.simulator.session import Fault
    from iec2mpy.source.diagnostics import Diagnostic
    from iec2mpy.source.spans import SourceFile

_NO_SUCH_FILE = {"E0001", "E0844"}
_NO_SUCH_BOARD = "E0835"
F = TypeVar("F", bound=Callable[..., Any])


class UserError(Exception):
    """Ends a command with a sentence on stderr. Exit code 2: the command was used wrongly, or cannot work here."""

    exit_code = 2


@dataclass(frozen=True, slots=True)
class Program:
    """The files of a program that is to be compiled. `interval_us`: the cycle where it has no task of its own.
    `project` is None where files are named instead of a project."""

    name: str
    files: Sequence[SourceFile]
    interval_us: int
    project: Project | None


def load_program(paths: Sequence[Path], dialect: str | None) -> Program:
    """The program that a command's arguments mean: a project's folder, the current one for none, or source files;
    in its own dialect, or in the one that is named.

    Raises CompileError where something cannot be read, and UserError for what is no sensible combination.
    """
    from iec2mpy.project.build import load_sources
    from iec2mpy.project.compile import DEFAULT_INTERVAL_US
    from iec2mpy.project.config import load_project
    from iec2mpy.source.files import read_sources
    from iec2mpy.source.spans import STRICT

    folders = [path for path in paths if path.is_dir()]
    if folders and len(paths) > 1:
        raise UserError(f"{folders[0]} is a folder: name one project, or only source files")
    if paths and not folders:
        return Program(paths[0].stem, read_sources(paths, dialect=dialect or STRICT), DEFAULT_INTERVAL_US, None)
    project = load_project(folders[0] if folders else Path(), dialect=dialect)
    show_diagnostics(project.warnings)
    return Program(project.name, load_sources(project), project.interval, project)


def exit_code(diagnostics: Sequence[Diagnostic]) -> int:
    """0 without errors, 1 for errors in the user's program, 2 where there is no such file or project, or where the
    command line, and no file, names a board that does not exist."""
    errors = [d for d in diagnostics if not d.code.startswith("W")]
    if any(d.code in _NO_SUCH_FILE or (d.code == _NO_SUCH_BOARD and d.span is None) for d in errors):
        return 2
    return int(bool(errors))


def show_diagnostics(diagnostics: Sequence[Diagnostic]) -> None:
    """Prints them on stderr, with their lines of source; in colours on a terminal."""
    from iec2mpy.source.render import render_text

    if diagnostics:
        # an empty line, so that what follows stands apart; click takes the colours out where there is no terminal
        click.echo(render_text(diagnostics, colour=True) + "\n", err=True)


def show_fault(fault: Fault, files: Sequence[SourceFile]) -> None:
    """Prints what stopped a program as diagnostics are printed, with the line of source where it happened."""
    from iec2mpy.source.diagnostics import Diagnostic
    from iec2mpy.source.spans import Span

    span = None
    file = next((f for f in files if f.name == fault.file), None)
    if file is not None and fault.line:
        start = file.line_starts[fault.line - 1]
        text = file.line_text(fault.line)
        span = Span(file, start + len(text) - len(text.lstrip()), start + len(text))
    where = f" in {fault.pou}" if fault.pou else ""
    meaning = fault.text.removeprefix(f"{fault.kind}: ")
    show_diagnostics([Diagnostic(fault.kind, f"A fault stopped the program{where}: {meaning}.", span)])


def engine_option(several: bool) -> Callable[[F], F]:
    """`--engine`: one, or (`several`) any number of them and `all`, as the parameter `engine` or `engines`."""
    from iec2mpy.backends.target import ENGINE_TARGETS

    names = list(ENGINE_TARGETS)
    text = "What executes the program; `viper32` computes as a board does."
    if not several:
        return click.option("--engine", type=click.Choice(names), default=names[0], show_default=True, help=text)
    return click.option(
        "--engine",
        "engines",
        type=click.Choice([*names, "all"]),
        multiple=True,
        default=[names[0]],
        show_default=True,
        callback=lambda ctx, param, chosen: names if "all" in chosen else list(dict.fromkeys(chosen)),
        help=f"{text} Can be given several times.",
    )


def dialect_option(command: F) -> F:
    """`--dialect`, as the parameter `dialect`; None where it is not given."""
    from iec2mpy.source.dialects import DIALECTS

    return click.option(
        "--dialect", type=click.Choice(DIALECTS), help="Accept what this system has beyond the standard."
    )(command)
