"""Reads program text from files."""

from __future__ import annotations

import codecs
from collections.abc import Iterable
from os import PathLike, fspath
from pathlib import Path

from iec2mpy.source.diagnostics import CompileError, Diagnostic
from iec2mpy.source.spans import STRICT, SourceFile

_OTHER_ENCODINGS = (
    (codecs.BOM_UTF32_LE, "UTF-32"),  # before UTF-16, as it starts with the same two bytes
    (codecs.BOM_UTF32_BE, "UTF-32"),
    (codecs.BOM_UTF16_LE, "UTF-16"),
    (codecs.BOM_UTF16_BE, "UTF-16"),
)


def load_file(path: str | PathLike[str], home: str | PathLike[str] = "", dialect: str = STRICT) -> SourceFile:
    """The text of one file, whose name is shown as it is given here. Lines end with `\\n`, whatever the file has.
    `home` is the folder of its project, `dialect` that of the program.

    Raises CompileError with E0001 where it cannot be read, with E0002 where it is not UTF-8 (with or without a mark).
    """
    shown = fspath(path)
    try:
        data = Path(path).read_bytes()
    except OSError as error:
        raise CompileError([_unreadable(Path(path), shown, error)]) from None
    except ValueError:  # a NUL in the name
        raise CompileError([Diagnostic("E0001", f"`{shown!r}` cannot be the name of a file.")]) from None
    try:
        text = _decode(data, shown)
    except _WrongEncoding as problem:
        raise CompileError([problem.diagnostic]) from None
    lines = text.replace("\r\n", "\n").replace("\r", "\n")
    return SourceFile(shown, lines, home=fspath(home), dialect=dialect)


def read_sources(
    paths: Iterable[str | PathLike[str]], home: str | PathLike[str] = "", dialect: str = STRICT
) -> list[SourceFile]:
    """All of these files, of the project in the folder `home`, in one dialect.

    Raises one CompileError with what is wrong with any of them.
    """
    files: list[SourceFile] = []
    problems: list[Diagnostic] = []
    for path in paths:
        try:
            files.append(load_file(path, home, dialect))
        except CompileError as error:
            problems += error.diagnostics
    if problems:
        raise CompileError(problems)
    return files


def _unreadable(path: Path, shown: str, error: OSError) -> Diagnostic:
    if isinstance(error, FileNotFoundError):
        return Diagnostic("E0001", f"There is no file `{shown}`.", hint="Check the name and the folder.")
    if isinstance(error, IsADirectoryError) or path.is_dir():
        return Diagnostic("E0001", f"`{shown}` is a folder, not a file.", hint="Name the files in it.")
    if isinstance(error, PermissionError):
        return Diagnostic("E0001", f"`{shown}` may not be read.", hint="Its permissions do not allow it.")
    return Diagnostic("E0001", f"`{shown}` cannot be read: {error.strerror or error}.")


class _WrongEncoding(Exception):
    def __init__(self, diagnostic: Diagnostic) -> None:
        super().__init__(diagnostic.message)
        self.diagnostic = diagnostic


def _decode(data: bytes, shown: str) -> str:
    hint = "Save it as UTF-8 in your editor."
    for mark, name in _OTHER_ENCODINGS:
        if data.startswith(mark):
            raise _WrongEncoding(Diagnostic("E0002", f"`{shown}` is {name}, not UTF-8.", hint=hint))
    if b"\0" in data[:1000]:
        raise _WrongEncoding(
            Diagnostic("E0002", f"`{shown}` is no text: it has bytes of value 0.", hint="Program text is UTF-8.")
        )
    try:
        return data.removeprefix(codecs.BOM_UTF8).decode("utf-8")
    except UnicodeDecodeError as error:
        start = error.start + (len(codecs.BOM_UTF8) if data.startswith(codecs.BOM_UTF8) else 0)
        line = data.count(b"\n", 0, start) + 1
        byte = start - data.rfind(b"\n", 0, start)
        message = f"`{shown}` is not UTF-8: byte {byte} of line {line} is 0x{data[start]:02X}."
        raise _WrongEncoding(Diagnostic("E0002", message, hint=hint)) from None
