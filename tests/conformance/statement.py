"""Writes docs/conformance.md: the compliance statement that clause 5 of the standard asks for.

It is made of the feature index, of the cases that are covered (`not_covered.toml`), and of the compiler's own limits:
`python -m tests.conformance.statement`. `python -m tests.conformance.update` writes it, too.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from tests.conformance.implementer import LIMITS, choices
from tests.conformance.suite import HERE, PARTS, all_cases, not_covered

STATEMENT = HERE.parents[1] / "docs" / "conformance.md"
SUPPORTED, PARTLY, NOT, NO_CASE = "supported", "partly", "not", "no case"
STATES = {
    SUPPORTED: "all its cases pass on every engine",
    PARTLY: "some of its cases pass",
    NOT: "none of its cases passes",
    NO_CASE: "the index has the feature, and no case shows it alone",
}
TITLES = {
    "part1": "Architecture, common elements, data types, variables (clauses 4 to 6.5, tables 1 to 15)",
    "part2": "Addresses, program organization units, functions (6.5.5 to 6.6.2, tables 16 to 39)",
    "part3": "Function blocks, programs, classes, interfaces (6.6.3 to 6.6.8, tables 40 to 53)",
    "part4": "Sequential function charts, configurations, namespaces (6.7 to 6.9, tables 54 to 66)",
    "part5": "Languages (clauses 7 and 8, tables 67 to 76)",
}


@dataclass(frozen=True, slots=True)
class Feature:
    """A feature of the index, with the ids of its cases: those that pass, and the others."""

    id: str
    title: str
    clause: str
    passing: Sequence[str]
    others: Sequence[str]

    @property
    def state(self) -> str:
        if not self.passing:
            return NOT if self.others else NO_CASE
        return PARTLY if self.others else SUPPORTED


def features(part: str) -> list[Feature]:
    """The features of a part, in the order of its index."""
    rows = tomllib.loads((HERE / part / "features.toml").read_text(encoding="utf-8"))["feature"]
    left_out = not_covered()
    passing: dict[str, list[str]] = {}
    others: dict[str, list[str]] = {}
    for key, case in all_cases().items():
        for feature in case.features:
            (others if key in left_out else passing).setdefault(feature, []).append(case.id)
    return [
        Feature(row["id"], row["title"], row["clause"], passing.get(row["id"], []), others.get(row["id"], []))
        for row in rows
    ]


def statement() -> str:
    """The text of docs/conformance.md."""
    by_part = {part: features(part) for part in PARTS}
    return "\n".join([*_head(by_part), *_implementer_values(), *_parts(by_part), ""])


def _head(by_part: dict[str, list[Feature]]) -> Iterator[str]:
    yield "# Conformance"
    yield ""
    yield "What iec2mpy has of IEC 61131-3:2013, feature by feature, as its tests show it. This page is generated:"
    yield "`python -m tests.conformance.statement` writes it, and a test fails where it differs from the tests."
    yield ""
    yield "| state | means |"
    yield "| --- | --- |"
    yield from (f"| {state} | {meaning} |" for state, meaning in STATES.items())
    yield ""
    yield "The cases are programs with what must be observed when they run, or the error that they must give, in"
    yield "`tests/conformance/`. A case that does not pass yet stands in brackets."
    yield ""
    yield f"| part | {' | '.join(STATES)} |"
    yield f"| --- |{' ---: |' * len(STATES)}"
    for part, rows in by_part.items():
        counts = [sum(feature.state == state for feature in rows) for state in STATES]
        yield f"| {TITLES[part]} | {' | '.join(map(str, counts))} |"
    yield ""


def _implementer_values() -> Iterator[str]:
    yield "## What the standard leaves to the implementer"
    yield ""
    yield from choices()
    yield ""
    yield "| clause | limit | here |"
    yield "| --- | --- | --- |"
    yield from (f"| {' | '.join(map(_cell, row))} |" for row in LIMITS)
    yield ""


def _parts(by_part: dict[str, list[Feature]]) -> Iterator[str]:
    for part, rows in by_part.items():
        yield f"## {TITLES[part]}"
        yield ""
        yield "| feature | clause | what | state | cases |"
        yield "| --- | --- | --- | --- | --- |"
        for feature in rows:
            cases = [*feature.passing, *(f"({name})" for name in feature.others)]
            cells = (feature.id, feature.clause, feature.title, feature.state, ", ".join(cases))
            yield f"| {' | '.join(map(_cell, cells))} |"
        yield ""


def _cell(text: str) -> str:
    return text.replace("|", "\\|")


def write() -> None:
    """Write docs/conformance.md anew."""
    STATEMENT.write_text(statement(), encoding="utf-8")


if __name__ == "__main__":
    write()
    print(f"written: {STATEMENT}")
