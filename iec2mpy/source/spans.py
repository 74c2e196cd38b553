"""Source files, and places in them."""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import PurePath

STRICT = "strict"
"""The dialect that is the standard itself."""


@dataclass(frozen=True, eq=False)
class SourceFile:
    """One file of program text. `path` is as the user wrote it: it is what messages show.

    `home` is the folder of its project, in the same way: what is built names the file from there (`name`), so that the
    same project gives the same program wherever it lies. `dialect` says what it may have beyond the standard
    (`source/dialects.py`).
    """

    path: str
    text: str = field(repr=False)
    is_stdlib: bool = False
    home: str = ""
    dialect: str = STRICT

    @cached_property
    def name(self) -> str:
        """The path from the project's folder, with `/` between its parts; of a file without a project, its path."""
        path = PurePath(self.path)
        return (path.relative_to(self.home) if self.home and path.is_relative_to(self.home) else path).as_posix()

    @cached_property
    def line_starts(self) -> list[int]:
        """Offset of the first character of each line."""
        starts = [0]
        find = self.text.find
        at = find("\n")
        while at >= 0:
            starts.append(at + 1)
            at = find("\n", at + 1)
        return starts

    def line_column(self, offset: int) -> tuple[int, int]:
        """Line and column of an offset, both counted from 1."""
        line = bisect_right(self.line_starts, offset)
        return line, offset - self.line_starts[line - 1] + 1

    def line_text(self, line: int) -> str:
        """The text of a line (from 1), without its end."""
        start = self.line_starts[line - 1]
        end = self.line_starts[line] if line < len(self.line_starts) else len(self.text)
        return self.text[start:end].rstrip("\r\n")


@dataclass(frozen=True, slots=True)
class Span:
    """Characters `start` to `end` (exclusive) of a file."""

    file: SourceFile
    start: int
    end: int

    @property
    def line(self) -> int:
        return self.file.line_column(self.start)[0]

    @property
    def column(self) -> int:
        return self.file.line_column(self.start)[1]

    @property
    def text(self) -> str:
        return self.file.text[self.start : self.end]

    def to(self, other: Span) -> Span:
        """From the start of this one to the end of the other."""
        return Span(self.file, self.start, max(self.end, other.end))
