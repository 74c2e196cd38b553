"""From files of program text to a generated program: all stages in their order."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from iec2mpy import backends, ir, passes, semantics, syntax
from iec2mpy.backends import GeneratedProgram, Target, TooLarge
from iec2mpy.semantics.stdlib import stdlib_files
from iec2mpy.semantics.typed import Application
from iec2mpy.source.diagnostics import CompileError, Diagnostic, Diagnostics
from iec2mpy.source.spans import SourceFile

DEFAULT_INTERVAL_US = 10_000
"""The cycle of the implicit task, where the program has no CONFIGURATION."""


@dataclass(frozen=True, slots=True)
class Checked:
    """A program without errors, and the warnings that it got."""

    application: Application
    warnings: list[Diagnostic]


def check_files(files: Sequence[SourceFile], interval_us: int = DEFAULT_INTERVAL_US) -> Checked:
    """The checked program of all files together, with the standard blocks that they use.

    Raises CompileError with every diagnostic, warnings included.
    """
    diagnostics = Diagnostics()
    units = [syntax.parse(file, diagnostics) for file in (*files, *stdlib_files(file.text for file in files))]
    application = semantics.check(units, diagnostics, interval_us)
    if application is None or diagnostics.has_errors:
        raise CompileError(diagnostics.items)
    return Checked(application, diagnostics.items)


def lower(checked: Checked) -> ir.Module:
    """The optimised IR of a checked program."""
    return passes.run(ir.build(checked.application))


def generate(module: ir.Module, target: Target) -> GeneratedProgram:
    """The program for a target. Raises CompileError where it does not fit."""
    try:
        return backends.generate(module, target)
    except TooLarge as error:
        raise CompileError([Diagnostic("E0846", str(error))]) from None


def compile_files(
    files: Sequence[SourceFile], target: Target, interval_us: int = DEFAULT_INTERVAL_US
) -> GeneratedProgram:
    """The generated program of all files together. Raises CompileError with every diagnostic."""
    return generate(lower(check_files(files, interval_us)), target)
