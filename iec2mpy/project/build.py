"""Building a project: what a board runs, and what tools on the host need to know of it, in the folder `build/`."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from iec2mpy.backends import GeneratedProgram, Target
from iec2mpy.backends.allocation import first_allocation
from iec2mpy.backends.mpy import compile_mpy
from iec2mpy.backends.target import PORTABLE_BOARD, VIPER32
from iec2mpy.project.binding import LocatedVariable, bind_channels
from iec2mpy.project.compile import check_files, generate, lower
from iec2mpy.project.config import Project
from iec2mpy.project.precision import warn_of_lreal
from iec2mpy.semantics.packing import bit_size
from iec2mpy.semantics.types import value_type
from iec2mpy.source.diagnostics import CompileError, Diagnostic, Diagnostics
from iec2mpy.source.files import read_sources
from iec2mpy.source.spans import SourceFile, Span

BUILD_FOLDER = "build"
_TARGETS = {"viper": VIPER32, "portable": PORTABLE_BOARD}


@dataclass(frozen=True, slots=True)
class Build:
    """What was built. `files` are the contents by file name; `on_board` names those that go to the board.

    `allocates`: the first source line that makes an object in a scan, or None.
    """

    program: GeneratedProgram
    files: dict[str, bytes]
    on_board: tuple[str, ...]
    allocates: Span | None
    warnings: tuple[Diagnostic, ...]

    @property
    def board_files(self) -> dict[str, bytes]:
        return {name: self.files[name] for name in self.on_board}


def load_sources(project: Project) -> list[SourceFile]:
    """The project's program text; paths are shown from where the project was named. Raises CompileError."""
    return read_sources(project.sources, project.root, project.dialect)


def build_project(project: Project, emitter: str | None = None) -> Build:
    """Compiles a project for its board, in the form that it or the caller names. Raises CompileError."""
    checked = check_files(load_sources(project), project.interval)
    target = _target(project, emitter or project.emitter)
    module = lower(checked)
    program = generate(module, target)
    diagnostics = Diagnostics()
    board = bind_channels(project.board, _located(program), diagnostics)
    if diagnostics.has_errors:
        raise CompileError(diagnostics.items)
    warn_of_lreal(module, diagnostics)
    arch = project.board.chip.arch if target.form == "viper" else None
    files = {
        "program.py": program.text.encode(),
        "program.mpy": compile_mpy(program.text, "program.py", arch),
        "program.names": program.names.encode(),
        "program.map.json": program.map.to_json().encode(),
        "board.py": board.encode(),
    }
    warnings = (*project.warnings, *checked.warnings, *diagnostics.items)
    on_board = ("program.mpy", "program.names", "board.py")
    return Build(program, files, on_board, first_allocation(module, target), warnings)


def write_build(build: Build, folder: Path) -> list[Path]:
    """Writes the files; gives their paths. Raises OSError."""
    folder.mkdir(parents=True, exist_ok=True)
    paths = []
    for name, content in build.files.items():
        path = folder / name
        path.write_bytes(content)
        paths.append(path)
    return paths


def _target(project: Project, emitter: str) -> Target:
    if emitter == "viper" and not project.board.chip.native:
        hint = f'MicroPython for the {project.board.chip.title} compiles no native code: use `emitter = "portable"`.'
        raise CompileError([Diagnostic("E0833", f"The board {project.board.name} cannot run viper code.", None, hint)])
    return _TARGETS[emitter]


def _located(program: GeneratedProgram) -> list[LocatedVariable]:
    """The variables in I and Q: those in M are plain memory."""
    found = []
    for variable, array, slot in program.located:
        assert variable.address is not None
        if variable.address[1] in "IQ":
            # of a value that is more than one slot only the name is known, and no channel takes it
            stored = value_type(variable.type) or variable.type
            bits = bit_size(variable.type) if array == "B" else None
            found.append(LocatedVariable(variable.name, variable.address, str(stored), slot, variable.span, bits))
    return found
