"""Writes not_covered.toml and docs/conformance.md anew from a run of all cases: `python -m tests.conformance.update`.

A case whose program has a construct that is not supported yet is listed under the compiler's own words for it. Any
other case that does not pass is listed under what went wrong; such a group is a fault to be mended, or a correction of
the case to be written down.
"""

from __future__ import annotations

import json
from collections import defaultdict
from collections.abc import Iterable, Mapping
from concurrent.futures import ProcessPoolExecutor

from iec2mpy.backends.target import ENGINE_TARGETS
from iec2mpy.simulator.case_runner import PASSED, Outcome, run_case
from tests.conformance import statement
from tests.conformance.suite import NOT_COVERED, PARTS, CaseKey, all_cases

_HEAD = """\
# The conformance cases that are not covered yet, by part, and by the reason. A case in this list that passes fails the
# tests. `python -m tests.conformance.update` writes the list anew.
"""
_NOT_YET = "E09"


def reason(outcome: Outcome) -> str:
    """Why a case is not covered: the first construct that is not supported yet, or else the message."""
    not_yet = [d.message for d in outcome.diagnostics if d.code.startswith(_NOT_YET)]
    return not_yet[0] if not_yet else outcome.message


def as_toml(reasons: Mapping[CaseKey, str]) -> str:
    """The file's text: parts in order, the largest group of each part first."""
    lines = [_HEAD]
    for part in PARTS:
        groups: dict[str, list[str]] = defaultdict(list)
        for (of_part, name), why in reasons.items():
            if of_part == part:
                groups[why].append(name)
        lines.append(f"[{part}]")
        for why, names in sorted(groups.items(), key=lambda group: (-len(group[1]), group[0])):
            lines += [f"{_quoted(why)} = [", *(f"  {_quoted(name)}," for name in names), "]"]
        lines.append("")
    return "\n".join(lines)


def _quoted(text: str) -> str:
    return json.dumps(text, ensure_ascii=False)


def _run(key: CaseKey) -> tuple[CaseKey, str | None]:
    outcome = run_case(all_cases()[key], tuple(ENGINE_TARGETS))
    return key, None if outcome.outcome == PASSED else reason(outcome)


def main(keys: Iterable[CaseKey]) -> None:
    with ProcessPoolExecutor() as pool:
        results = dict(pool.map(_run, keys, chunksize=16))
    reasons = {key: why for key, why in results.items() if why is not None}
    NOT_COVERED.write_text(as_toml(reasons), encoding="utf-8")
    statement.write()
    print(f"{len(results) - len(reasons)} cases are covered, {len(reasons)} are not yet: {NOT_COVERED}")


if __name__ == "__main__":
    main(list(all_cases()))
