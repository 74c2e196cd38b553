"""Programs from text, for the tests of the backends."""

from __future__ import annotations

from iec2mpy.backends import GeneratedProgram, Target
from iec2mpy.backends.layout import Layout, lay_out
from iec2mpy.backends.target import PORTABLE
from iec2mpy.ir import nodes as n
from iec2mpy.project.compile import check_files, compile_files, lower
from iec2mpy.source.spans import SourceFile


def lowered(text: str) -> n.Module:
    return lower(check_files([SourceFile("main.st", text)]))


def laid_out(text: str) -> Layout:
    return lay_out(lowered(text))


def generated(text: str, target: Target = PORTABLE) -> GeneratedProgram:
    return compile_files([SourceFile("main.st", text)], target)
