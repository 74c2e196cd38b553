"""Dialects: what other systems accept beyond the standard. The grammar takes all of it; whoever meets an extension asks
here whether the dialect of its file has it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from iec2mpy.source.diagnostics import Diagnostics
from iec2mpy.source.spans import STRICT, SourceFile, Span

CODESYS, TWINCAT, MATIEC, OPENPLC = "codesys", "twincat", "matiec", "openplc"
DIALECTS = (STRICT, CODESYS, TWINCAT, MATIEC, OPENPLC)
"""MATIEC, and OpenPLC, which uses it, keep to the second edition; their Inline C is refused."""

_CODESYS_FAMILY = (CODESYS, TWINCAT)


@dataclass(frozen=True, slots=True)
class Extension:
    """Something that the standard does not have. `example` shows it in the documentation."""

    what: str
    example: str
    dialects: Sequence[str] = _CODESYS_FAMILY


EXTENSIONS: Mapping[str, Extension] = {
    "end-without-semicolon": Extension(
        "no `;` after END_IF and its like, and after END_STRUCT", "IF a THEN b := 1; END_IF"
    ),
    "string-in-parentheses": Extension("the length of a STRING in round brackets", "s : STRING(80);"),
    "constant-input": Extension("VAR_INPUT CONSTANT: an input like any other", "VAR_INPUT CONSTANT k : REAL; END_VAR"),
    "short-circuit": Extension(
        "AND_THEN and OR_ELSE: the right side is evaluated only where the left one does not decide",
        "i < 9 AND_THEN a[i]",
    ),
    "time-call": Extension("TIME(): the time since the controller started", "t := TIME();"),
    "static-variables": Extension(
        "VAR_STAT: variables that keep their values, in functions too", "VAR_STAT n : INT; END_VAR"
    ),
    "set-reset-assignment": Extension("S= and R=: set, or reset, where the right side is TRUE", "lamp S= button;"),
    "bare-array": Extension("initial values of an ARRAY without brackets", "a : ARRAY[1..3] OF INT := 1, 2, 3;"),
    "global-without-external": Extension("a global variable is known in all POUs, without VAR_EXTERNAL", "n := n + 1;"),
    "qualified-global": Extension("a global variable behind the name of its list, which is its file's", "GVL.n := 1;"),
    "written-input": Extension("a block or function writes its own inputs", "x := ABS(x);"),
    "bits-are-numbers": Extension(
        "BYTE, WORD and DWORD are numbers; integers and bit strings convert to each other where none is narrower",
        "w := w + 1;",
    ),
    "exponent-without-point": Extension("a number with an exponent and no decimal point", "x := 2E-3;"),
}
"""Each by the name that the compiler has for it."""


def accepts(file: SourceFile, extension: str) -> bool:
    """Whether the dialect of a file has an extension."""
    return file.dialect in EXTENSIONS[extension].dialects


def require(
    extension: str, diagnostics: Diagnostics, code: str, message: str, span: Span, instead: str | None = None
) -> bool:
    """Whether the dialect of the file at `span` has an extension. Where not, the diagnostic with this code and message
    tells what to write `instead`, and which dialects have it."""
    if accepts(span.file, extension):
        return True
    diagnostics.add(code, message, span, with_dialects(extension, instead))
    return False


def with_dialects(extension: str, hint: str | None = None) -> str:
    """A hint that also names the dialects that have an extension."""
    names = EXTENSIONS[extension].dialects
    who = f"The dialects {' and '.join(names)} accept" if len(names) > 1 else f"The dialect {names[0]} accepts"
    return f"{hint + ' ' if hint else ''}{who} it: `--dialect {names[0]}`."
