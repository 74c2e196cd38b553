"""The conformance cases, as far as the checker decides them: what must be an error is one on its line, and what must
run has none. Cases of what is not there yet say so, and none of them may raise an exception."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest

from tests.conformance.suite import not_covered
from tests.semantics.checking import check_text

_CASES = Path(__file__).parents[1] / "conformance"
_PARTS = ("part1", "part2", "part3", "part4", "part5")
_NOT_YET = "E09"


def _listed(part: str) -> set[str]:
    """The cases that are listed as not covered: only these may say that something is not there yet."""
    return {name for of_part, name in not_covered() if of_part == part}


def _cases(part: str, key: str) -> list[dict]:
    text = (_CASES / part / "visible.toml").read_text(encoding="utf-8")
    return [case for case in tomllib.loads(text)["case"] if key in case and "source" in case]


@pytest.mark.parametrize("part", _PARTS)
def test_errors_are_found_on_their_line(part: str) -> None:
    missed: list[str] = []
    not_yet: set[str] = set()
    for case in _cases(part, "error"):
        found = [(d.code, d.span.line) for d in check_text(case["source"])[1].items if d.span and d.code[0] == "E"]
        if any(line == case["error"]["line"] for _, line in found):
            continue
        if any(code.startswith(_NOT_YET) for code, _ in found):
            not_yet.add(case["id"])
        else:
            missed.append(f"{case['id']}: {found}")
    assert missed == []
    assert not_yet <= _listed(part)


@pytest.mark.parametrize("part", _PARTS)
def test_programs_that_run_have_no_errors(part: str) -> None:
    refused: list[str] = []
    not_yet: set[str] = set()
    for case in _cases(part, "steps"):
        found = [d for d in check_text(case["source"])[1].items if d.code[0] == "E"]
        if found and all(d.code.startswith(_NOT_YET) for d in found):
            not_yet.add(case["id"])
        elif found:
            refused.append(f"{case['id']}: {[d.message for d in found]}")
    assert refused == []
    assert not_yet <= _listed(part)
