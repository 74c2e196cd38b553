"""The LALR tables of `st.lark`.

Lark makes them, which takes some tenths of a second; `st.tables.json` beside the grammar keeps them, so that a start of
the compiler costs some milliseconds. The file names the grammar that it was made of by its hash: one that does not fit
is not used. `python -c "from iec2mpy.syntax.tables import write; write()"` writes it anew.
"""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

START_RULES = ("body", "section", "type_block", "result_type", "configuration")
_GRAMMAR = Path(__file__).with_name("st.lark")
_TABLES = Path(__file__).with_name("st.tables.json")


@dataclass(frozen=True, slots=True)
class Rule:
    """A production: what it makes, of how many symbols, and the name of its action (None passes its one value on)."""

    origin: str
    length: int
    action: str | None


@dataclass(frozen=True, slots=True)
class Tables:
    """`states[s][terminal]` is `n >= 0` to shift and go to state n, or `-1 - r` to reduce by rule r; `states[s][rule]`
    is the state to go to. `starts` and `ends` are the first and last states of each start rule."""

    states: tuple[dict[str, int], ...]
    rules: tuple[Rule, ...]
    starts: dict[str, int]
    ends: dict[str, int]


@cache
def load() -> Tables:
    """The tables, from the file or, where it does not fit the grammar, from Lark."""
    digest = _digest(_GRAMMAR.read_text(encoding="utf-8"))
    data: dict[str, Any] = json.loads(_TABLES.read_text(encoding="utf-8")) if _TABLES.is_file() else {}
    if data.get("grammar") != digest:
        data = build()
    return Tables(
        tuple(data["states"]),
        tuple(Rule(origin, length, action) for origin, length, action in data["rules"]),
        data["starts"],
        data["ends"],
    )


def build() -> dict[str, Any]:
    """Make the tables with Lark. A conflict in the grammar is an exception of Lark."""
    from lark import Lark
    from lark.grammar import Rule as LarkRule
    from lark.parsers.lalr_analysis import Shift

    grammar = _GRAMMAR.read_text(encoding="utf-8")
    parser = Lark(grammar, parser="lalr", lexer="basic", start=list(START_RULES))
    table = parser.parser.parser._parse_table  # type: ignore[attr-defined]
    numbers = {state: number for number, state in enumerate(table.states)}
    rules: dict[LarkRule, int] = {}
    states: list[dict[str, int]] = []
    for actions in table.states.values():
        row: dict[str, int] = {}
        for symbol, (action, argument) in actions.items():
            row[symbol] = numbers[argument] if action is Shift else -1 - rules.setdefault(argument, len(rules))
        states.append(row)
    return {
        "grammar": _digest(grammar),
        "starts": {name: numbers[state] for name, state in table.start_states.items()},
        "ends": {name: numbers[state] for name, state in table.end_states.items()},
        "rules": [[rule.origin.name, len(rule.expansion), _action(rule)] for rule in rules],
        "states": states,
    }


def _action(rule: Any) -> str | None:
    if rule.alias is None and len(rule.expansion) == 1:
        return None
    return str(rule.alias or rule.origin.name)


def _digest(grammar: str) -> str:
    return hashlib.sha256(grammar.encode()).hexdigest()


def write() -> None:
    """Write `st.tables.json` anew."""
    data = build()
    states = ",\n".join(json.dumps(row, separators=(",", ":")) for row in data.pop("states"))
    rules = ",\n".join(json.dumps(rule, separators=(",", ":")) for rule in data.pop("rules"))
    head = json.dumps(data, indent=0)[:-2]
    text = f'{head},\n"rules": [\n{rules}\n],\n"states": [\n{states}\n]\n}}\n'
    _TABLES.write_text(text, encoding="utf-8")
