"""The conformance cases, as far as the checker decides them: what must be an error is one on its line, and what must
run has none. Cases of what is not there yet say so, and none of them may raise an exception."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest

from tests.semantics.checking import check_text

_CASES = Path(__file__).parents[1] / "conformance"
_PARTS = ("part1", "part2", "part3", "part4", "part5")
_NOT_YET = "E09"

# how many cases of each part end with "not supported yet": a number that only falls
_OUT_OF_SCOPE = {
    "error": {"part1": 8, "part2": 8, "part3": 69, "part4": 33, "part5": 31},
    "steps": {"part1": 57, "part2": 102, "part3": 109, "part4": 104, "part5": 101},
}


def _cases(part: str, key: str) -> list[dict]:
    text = (_CASES / part / "visible.toml").read_text(encoding="utf-8")
    return [case for case in tomllib.loads(text)["case"] if key in case and "source" in case]


@pytest.mark.parametrize("part", _PARTS)
def test_errors_are_found_on_their_line(part: str) -> None:
    missed: list[str] = []
    not_yet = 0
    for case in _cases(part, "error"):
        found = [(d.code, d.span.line) for d in check_text(case["source"])[1].items if d.span and d.code[0] == "E"]
        if any(line == case["error"]["line"] for _, line in found):
            continue
        if any(code.startswith(_NOT_YET) for code, _ in found):
            not_yet += 1
        else:
            missed.append(f"{case['id']}: {found}")
    assert missed == []
    assert not_yet == _OUT_OF_SCOPE["error"][part]


@pytest.mark.parametrize("part", _PARTS)
def test_programs_that_run_have_no_errors(part: str) -> None:
    refused: list[str] = []
    not_yet = 0
    for case in _cases(part, "steps"):
        found = [d for d in check_text(case["source"])[1].items if d.code[0] == "E"]
        if found and all(d.code.startswith(_NOT_YET) for d in found):
            not_yet += 1
        elif found:
            refused.append(f"{case['id']}: {[d.message for d in found]}")
    assert refused == []
    assert not_yet == _OUT_OF_SCOPE["steps"][part]
