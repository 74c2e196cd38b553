"""Golden cases: small programs with the text that must come out of them, to be read side by side.

A file holds cases. Each begins with `[case name]`, then comes the program, then sections such as `[out main]`, each
with the text that is expected. `python -m tests.update_golden` writes all sections anew; look at what changes.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

_HEADING = re.compile(r"^\[(\w+)(?: ([^\]]*))?\]\n", re.MULTILINE)

Render = Callable[["GoldenCase", str], str]
"""What makes the text of a section, from the case and the words of its heading."""


@dataclass(frozen=True)
class GoldenCase:
    """`sections`: the expected texts, by the words of their headings (`out main`)."""

    file: Path
    name: str
    source: str
    sections: dict[str, str]


def read_cases(path: Path) -> Iterator[GoldenCase]:
    """The cases of a file."""
    parts = _HEADING.split(path.read_text(encoding="utf-8"))
    assert not parts[0].strip(), f"{path}: text before the first case"
    case: GoldenCase | None = None
    for word, rest, text in zip(parts[1::3], parts[2::3], parts[3::3], strict=True):
        text = text.strip("\n") + "\n"
        if word == "case":
            if case is not None:
                yield case
            case = GoldenCase(path, rest, text, {})
        else:
            assert case is not None, f"{path}: [{word}] stands in no case"
            case.sections[f"{word} {rest or ''}".strip()] = text
    if case is not None:
        yield case


def all_cases(folder: Path) -> list[object]:
    """The cases of all files in a folder, as parameters of a test."""
    files = sorted(folder.glob("*.test"))
    assert files, f"{folder} holds no cases"
    return [pytest.param(case, id=f"{file.stem}/{case.name}") for file in files for case in read_cases(file)]


def check(case: GoldenCase, render: Render) -> None:
    """Fails where a section is not what it should be."""
    assert case.sections, f"{case.name} expects nothing"
    for heading, expected in case.sections.items():
        assert render(case, heading) == expected, f"{case.file.name}: [{case.name}], [{heading}]"


def rewrite(path: Path, render: Render) -> None:
    """Writes a file with the sections that its cases have, as they are now."""
    texts = []
    for case in read_cases(path):
        sections = [f"[{heading}]\n{render(case, heading)}" for heading in case.sections]
        texts.append("\n".join([f"[case {case.name}]\n{case.source}", *sections]))
    path.write_text("\n\n".join(texts), encoding="utf-8")
