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
    from lark.parsers.lalr_analysis import Shift

    grammar = _GRAMMAR.read_text(encoding="utf-8")
    parser = Lark(grammar, parser="lalr", lexer="basic", start=list(START_RULES))
    table = parser.parser.parser._parse_table  # type: ignore[attr-defined]
    numbers = _in_order(table.states, table.start_states)
    rules = {rule: number for number, rule in enumerate(sorted(parser.rules, key=str))}
    states: list[dict[str, int]] = []
    for state in numbers:
        actions = sorted(table.states[state].items(), key=_symbol)
        states.append({str(symbol): numbers[to] if kind is Shift else -1 - rules[to] for symbol, (kind, to) in actions})
    return {
        "grammar": _digest(grammar),
        "starts": {name: numbers[table.start_states[name]] for name in START_RULES},
        "ends": {name: numbers[table.end_states[name]] for name in START_RULES},
        "rules": [[str(rule.origin.name), len(rule.expansion), _action(rule)] for rule in rules],
        "states": states,
    }


def _in_order(states: dict[Any, dict[str, tuple[Any, Any]]], starts: dict[str, Any]) -> dict[Any, int]:
    """Lark's states with numbers that depend on the grammar only: Lark's own differ from one run to the next."""
    numbers: dict[Any, int] = {}
    waiting = [starts[name] for name in START_RULES]
    for state in waiting:  # grows while it is read
        if state not in numbers:
            numbers[state] = len(numbers)
            waiting += [target for _, (_, target) in sorted(states[state].items(), key=_symbol) if target in states]
    return numbers


def _symbol(entry: tuple[str, Any]) -> str:
    return entry[0]


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
