"""The project file, `iec2mpy.toml`: which board, which sources, and what is different about the board's channels."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from iec2mpy.project.boards import Board, load_board
from iec2mpy.project.channels import read_channels
from iec2mpy.project.durations import parse_duration
from iec2mpy.project.pins import check_pins, displaced_channels
from iec2mpy.project.schema import Key, Schema, read_table
from iec2mpy.project.toml_text import TomlText, parse_toml
from iec2mpy.source.diagnostics import CompileError, Diagnostic, Diagnostics
from iec2mpy.source.dialects import DIALECTS
from iec2mpy.source.spans import STRICT, SourceFile

PROJECT_FILE = "iec2mpy.toml"
EMITTERS = ("viper", "portable")

_FILE_KEYS: Schema = {"project": Key("table", "", required=True), "channels": Key("table", "")}
_PROJECT_KEYS: Schema = {
    "name": Key("text", '"tank"', required=True),
    "board": Key("text", '"pico"', required=True),
    "sources": Key("texts", '["src/*.st"]'),
    "interval": Key("text", '"T#10ms"'),
    "emitter": Key("text", '"viper"', choices=EMITTERS),
    "dialect": Key("text", '"codesys"', choices=DIALECTS),
}
_DEFAULT_SOURCES = ("src/*.st",)
_DEFAULT_INTERVAL = "T#10ms"
_SHORTEST, _LONGEST = 1_000, 60_000_000  # microseconds


@dataclass(frozen=True, slots=True)
class Project:
    """A project as its file says. `board` has the project's own channels among the others. `sources` are the files
    that the globs found, sorted. `interval` is that of a task without one, in microseconds; `emitter` the form of the
    generated code, "viper" or "portable"; `dialect` what its sources may have beyond the standard. `warnings` are what
    was noticed on reading."""

    root: Path
    name: str
    board: Board
    sources: tuple[Path, ...]
    interval: int
    emitter: str
    dialect: str
    warnings: tuple[Diagnostic, ...] = ()


def load_project(directory: Path, board: str | None = None, dialect: str | None = None) -> Project:
    """Reads the project in a directory, for another board and in another dialect than the file's where they are named.

    Raises CompileError with all that is wrong: no project file, an unknown board, pins that cannot do what is asked.
    """
    path = directory / PROJECT_FILE
    toml = parse_toml(_read_file(path))
    diagnostics = Diagnostics()
    read_table(toml, (), _FILE_KEYS, diagnostics)
    values = read_table(toml, ("project",), _PROJECT_KEYS, diagnostics)
    found = _board(toml, values, board, diagnostics)
    sources = _sources(toml, directory, values, diagnostics)
    interval = _interval(toml, values, diagnostics)
    if found is None or diagnostics.has_errors:
        raise CompileError(diagnostics.items)
    return Project(
        root=directory,
        name=values["name"],
        board=found,
        sources=sources,
        interval=interval,
        emitter=values.get("emitter", "viper" if found.chip.native else "portable"),
        dialect=dialect or values.get("dialect", STRICT),
        warnings=tuple(diagnostics.items),
    )


def dialect_of(directory: Path) -> str:
    """The dialect of the project in a directory; the standard's where there is no project, or none that can be read."""
    try:
        data = tomllib.loads((directory / PROJECT_FILE).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return STRICT
    project = data.get("project")
    dialect = project.get("dialect") if isinstance(project, dict) else None
    return dialect if dialect in DIALECTS else STRICT


def _read_file(path: Path) -> SourceFile:
    try:
        return SourceFile(str(path), path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        hint = "Make a project with `iec2mpy new DIR --board pico`, or name the folder that has one."
        error = Diagnostic("E0844", f"There is no project file `{path}`.", None, hint)
    except UnicodeDecodeError:
        error = Diagnostic("E0002", f"`{path}` is not UTF-8 text.", None, "Save it as UTF-8 in your editor.")
    except OSError as reason:
        error = Diagnostic("E0001", f"`{path}` cannot be read: {reason.strerror}.", None)
    raise CompileError([error])


def _board(toml: TomlText, values: Mapping[str, Any], named: str | None, diagnostics: Diagnostics) -> Board | None:
    """The board with the project's channels; None where it is not known, which has its diagnostic then."""
    name = named or values.get("board")
    if name is None:
        return None
    try:
        board = load_board(name, None if named else toml.value_span("project", "board"))
    except CompileError as error:
        for d in error.diagnostics:
            diagnostics.add(d.code, d.message, d.span, d.hint, d.related)
        return None
    channels = read_channels(toml, board.channels, diagnostics, from_project=True)
    displaced = displaced_channels(board.chip, channels.values())
    channels = {address: channel for address, channel in channels.items() if address not in displaced}
    check_pins(board.chip, board.pins, channels.values(), diagnostics)
    return replace(board, channels=channels, displaced=displaced)


def _sources(toml: TomlText, directory: Path, values: Mapping[str, Any], diagnostics: Diagnostics) -> tuple[Path, ...]:
    found: set[Path] = set()
    span = toml.value_span("project", "sources")
    for pattern in values.get("sources", _DEFAULT_SOURCES):
        if not pattern or Path(pattern).is_absolute() or ".." in Path(pattern).parts:
            hint = 'Name files by their place in the project, as in `sources = ["src/*.st"]`.'
            diagnostics.add("E0833", f"`{pattern}` is not inside of the project's folder.", span, hint)
            continue
        matches = {path for path in directory.glob(pattern) if path.is_file()}
        if not matches:
            hint = f"Put a program there, or change `sources` in {PROJECT_FILE}."
            diagnostics.add("E0845", f"No file of the project is `{pattern}`.", span, hint)
        found |= matches
    return tuple(sorted(found))


def _interval(toml: TomlText, values: Mapping[str, Any], diagnostics: Diagnostics) -> int:
    text = values.get("interval", _DEFAULT_INTERVAL)
    interval = parse_duration(text)
    if interval is not None and _SHORTEST <= interval <= _LONGEST:
        return interval
    span = toml.value_span("project", "interval")
    hint = 'Write for example `interval = "T#10ms"`; it can be from T#1ms to T#1m.'
    problem = "is not a duration" if interval is None else "is too short or too long"
    diagnostics.add("E0833", f"`{text}` {problem}.", span, hint)
    return 0
