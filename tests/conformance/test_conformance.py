"""Every conformance case that the language covers so far passes on every engine, and no other does."""

from __future__ import annotations

from functools import lru_cache

import pytest

from iec2mpy.backends.target import ENGINE_TARGETS
from iec2mpy.simulator.case_runner import PASSED, Programs, run_case, run_steps
from tests.conformance.suite import CaseKey, all_cases, not_covered

ENGINES = tuple(ENGINE_TARGETS)
_COVERED = [key for key in all_cases() if key not in not_covered()]
_WITH_STEPS = [key for key in _COVERED if all_cases()[key].error is None]
_WITH_ERROR = [key for key in _COVERED if all_cases()[key].error is not None]


def _name(key: CaseKey) -> str:
    return "/".join(key)


@lru_cache(maxsize=4)
def _programs(key: CaseKey) -> Programs:
    """The engines of a case follow each other: its program is compiled once."""
    return Programs(all_cases()[key])


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("key", _WITH_STEPS, ids=_name)
def test_steps(key: CaseKey, engine: str) -> None:
    outcome = run_steps(all_cases()[key], _programs(key), engine)
    assert outcome.outcome == PASSED, outcome.message


@pytest.mark.parametrize("key", _WITH_ERROR, ids=_name)
def test_error(key: CaseKey) -> None:
    outcome = run_case(all_cases()[key], ENGINES)
    assert outcome.outcome == PASSED, outcome.message


@pytest.mark.parametrize("key", list(not_covered()), ids=_name)
def test_not_covered_yet(key: CaseKey) -> None:
    """A case that starts to pass leaves the list: `python -m tests.conformance.update` writes it anew."""
    assert key in all_cases(), f"{_name(key)} is in not_covered.toml, but there is no such case"
    outcome = run_case(all_cases()[key], ENGINES)
    assert outcome.outcome != PASSED, f"{_name(key)} passes: take it out of not_covered.toml"
