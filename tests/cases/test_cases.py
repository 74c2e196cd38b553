"""Programs of our own as case files, for what the conformance cases leave out: each runs on every engine."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

import pytest

from iec2mpy.backends.target import ENGINE_TARGETS
from iec2mpy.simulator.case_runner import PASSED, Programs, run_steps
from iec2mpy.simulator.cases import BadCase, Case, cases_of, read_tables


def _cases() -> dict[str, Case]:
    found: dict[str, Case] = {}
    for path in sorted(Path(__file__).parent.glob("*.toml")):
        for case in cases_of(path, read_tables(path)):
            assert not isinstance(case, BadCase), f"{path.name}: {case.message}"
            found[f"{path.stem}/{case.id}"] = case
    return found


CASES = _cases()


@lru_cache(maxsize=4)
def _programs(name: str) -> Programs:
    """The engines of a case follow each other: its program is compiled once."""
    return Programs(CASES[name])


@pytest.mark.parametrize("engine", ENGINE_TARGETS)
@pytest.mark.parametrize("name", CASES)
def test_case(name: str, engine: str) -> None:
    outcome = run_steps(CASES[name], _programs(name), engine)
    assert outcome.outcome == PASSED, outcome.message
