"""Checks the tables of project and board files against what may stand in them, which is written down as data."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from iec2mpy.project.toml_text import TomlText
from iec2mpy.source.diagnostics import Diagnostics
from iec2mpy.source.suggest import suggest


@dataclass(frozen=True, slots=True)
class Key:
    """What a key may hold. `form` is a key of `_FORMS`; `example` is a value as a user would write it."""

    form: str
    example: str
    required: bool = False
    choices: tuple[str, ...] = ()
    low: int | None = None
    high: int | None = None


Schema = Mapping[str, Key]

# form: (what it is called in a message, whether a value has it)
_FORMS = {
    "text": ("a text in quotes", lambda v: isinstance(v, str) and v.strip() != ""),
    "truth": ("true or false", lambda v: isinstance(v, bool)),
    "number": ("a whole number", lambda v: isinstance(v, int) and not isinstance(v, bool)),
    "pin": ("the number of a pin, or its name in quotes", lambda v: type(v) in (int, str) and v != ""),
    "texts": ("a list of texts", lambda v: _is_list_of(v, str)),
    "range": ("two whole numbers, the lower one first", lambda v: _is_list_of(v, int) and len(v) == 2 and v[0] < v[1]),
    "table": ("a table", lambda v: isinstance(v, dict)),
    "notes": ("a table of texts", lambda v: isinstance(v, dict) and all(isinstance(x, str) for x in v.values())),
}


def _is_list_of(value: Any, kind: type) -> bool:
    return isinstance(value, list) and all(isinstance(v, kind) and not isinstance(v, bool) for v in value)


def read_table(toml: TomlText, path: Sequence[str], schema: Schema, diagnostics: Diagnostics) -> dict[str, Any]:
    """The values of a table that are as `schema` says; what is not gets a diagnostic, and is left out.

    `path` names the table (empty for the whole file). What is missing in a table that is missing itself is not told:
    reading the table around it has told that.
    """
    table: Any = toml.data
    for name in path:
        table = table.get(name) if isinstance(table, dict) else None
    if not isinstance(table, dict):
        return {}
    where = f"[{_shown(path)}]" if path else "the file"
    good: dict[str, Any] = {}
    for name, value in table.items():
        if name not in schema:
            hint = suggestion(name, schema, "The keys are")
            diagnostics.add("E0832", f"There is no key `{name}` in {where}.", toml.key_span(*path, name), hint)
        elif _fits(toml, (*path, name), schema[name], value, diagnostics):
            good[name] = value
    for name, key in schema.items():
        if key.required and name not in table:
            span = toml.key_span(*path)
            diagnostics.add("E0834", f"The key `{name}` is missing in {where}.", span, f"Add `{name} = {key.example}`.")
    return good


def _fits(toml: TomlText, path: Sequence[str], key: Key, value: Any, diagnostics: Diagnostics) -> bool:
    words, has_form = _FORMS[key.form]
    span = toml.value_span(*path)
    name = path[-1]
    if not has_form(value):
        diagnostics.add("E0833", f"`{name}` must be {words}.", span, f"Write for example `{name} = {key.example}`.")
    elif key.choices and value not in key.choices:
        hint = suggestion(value, key.choices, "It can be")
        diagnostics.add("E0833", f"`{name}` cannot be `{value}`.", span, hint)
    elif (key.low is not None and value < key.low) or (key.high is not None and value > key.high):
        diagnostics.add("E0833", f"`{name}` must be from {key.low} to {key.high}; here it is {value}.", span)
    else:
        return True
    return False


def suggestion(name: str, known: Sequence[str] | Mapping[str, Any], otherwise: str) -> str:
    """`Did you mean …?`, or all names that there are, after the words `otherwise`."""
    close = suggest(name, known)
    if close:
        return f"Did you mean `{close}`?"
    return f"{otherwise} {', '.join(f'`{k}`' for k in known)}."


def _shown(path: Sequence[str]) -> str:
    return ".".join(p if p.replace("_", "").isalnum() else f'"{p}"' for p in path)
