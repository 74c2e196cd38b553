"""The codes of all diagnostics. Each has a page in `docs/errors/`.

E00 files, E01 syntax, E02 names, E03 types, E04 calls, E05 constants and ranges, E06 control flow and
statements, E07 declarations, E08 configuration, project and boards, E09 what is not supported yet, E10 devices;
W for warnings, numbered likewise.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Code:
    """`about` is the word of the case files' format: syntax, type, name, range, access, const, call, decl, flow, config."""

    title: str
    about: str


CODES: dict[str, Code] = {
    "E0001": Code("file cannot be read", "config"),
    "E0002": Code("file is not UTF-8 text", "syntax"),
    "E0003": Code("file holds no program", "syntax"),
}
