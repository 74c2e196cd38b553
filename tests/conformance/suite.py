"""The conformance cases as they are run: corrected, and those apart that are not covered yet."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from functools import cache
from pathlib import Path

from iec2mpy.simulator.cases import BadCase, Case, cases_of, read_tables

HERE = Path(__file__).parent
PARTS = ("part1", "part2", "part3", "part4", "part5")
NOT_COVERED = HERE / "not_covered.toml"
CORRECTIONS = HERE / "corrections.toml"

CaseKey = tuple[str, str]
"""A part and the id of a case in it."""


@cache
def all_cases() -> Mapping[CaseKey, Case]:
    """Every case of every part, with its corrections."""
    corrections = _corrections()
    cases: dict[CaseKey, Case] = {}
    for part in PARTS:
        path = HERE / part / "visible.toml"
        tables = [{**table, **corrections.pop((part, table["id"]), {})} for table in read_tables(path)]
        for case in cases_of(path, tables):
            if isinstance(case, BadCase):
                raise ValueError(f"{part}/{case.id}: {case.message}")
            cases[part, case.id] = case
    if corrections:
        raise ValueError(f"{CORRECTIONS.name} corrects cases that do not exist: {sorted(corrections)}")
    return cases


def _corrections() -> dict[CaseKey, dict[str, object]]:
    data = tomllib.loads(CORRECTIONS.read_text(encoding="utf-8"))
    corrections: dict[CaseKey, dict[str, object]] = {}
    for row in data.get("correction", []):
        if not (row["clause"] and row["why"]):
            raise ValueError(f"{CORRECTIONS.name}: {row['id']} needs a clause and a reason")
        corrections[row["part"], row["id"]] = row["replace"]
    return corrections


@cache
def not_covered() -> Mapping[CaseKey, str]:
    """The reason why a case is not covered yet."""
    data = tomllib.loads(NOT_COVERED.read_text(encoding="utf-8"))
    return {(part, name): reason for part, groups in data.items() for reason, names in groups.items() for name in names}
