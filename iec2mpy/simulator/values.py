"""Compares what a case expects with what a variable has, and shows values as a case file writes them."""

from __future__ import annotations

import json
import math
import tomllib
from collections.abc import Mapping, Sequence

from iec2mpy.backends.memory_map import BadValue, Leaf, MemoryMap, Node

_NOT_AS_WRITTEN = ("bool", "integer", "unsigned32", "integer64", "real", "lreal")

REAL_TOLERANCE = 1e-5
"""REAL values are compared to 1 part in 100,000."""


def differences(memory_map: MemoryMap, node: Node, expected: object, found: object) -> list[str]:
    """A sentence for each single value of `node` that is not as expected. Of a structure only the members that
    `expected` names are compared. Raises BadValue where the variable can never have the value."""
    if isinstance(node, Leaf):
        # written and read again, `T#1500ms` and `T#1s500ms` look the same
        ((_, raw),) = memory_map.encode(node, expected)
        if _same(memory_map.decode(node, raw), found):
            return []
        return [f"{node.path}: expected {show(expected)}, found {show(found)}"]
    if node.items is not None and isinstance(expected, Sequence) and len(expected) == len(node.items):
        assert isinstance(found, Sequence)
        parts = zip(node.items, expected, found, strict=True)
        return [d for item, e, f in parts for d in differences(memory_map, item, e, f)]
    if node.items is None and isinstance(expected, Mapping):
        assert isinstance(found, Mapping)
        fields = {name.casefold(): name for name in node.fields}
        unknown = [name for name in expected if name.casefold() not in fields]
        if not unknown:
            names = ((fields[name.casefold()], value) for name, value in expected.items())
            return [d for n, value in names for d in differences(memory_map, node.fields[n], value, found[n])]
    memory_map.encode(node, expected)  # says what is wrong with it
    raise BadValue(f"{node.path} cannot be compared with {show(expected)}")


def _same(expected: object, found: object) -> bool:
    if isinstance(expected, float) and isinstance(found, float):
        both_nan = math.isnan(expected) and math.isnan(found)
        return both_nan or math.isclose(expected, found, rel_tol=REAL_TOLERANCE)
    return expected == found


def show(value: object) -> str:
    """A value as a case file writes it; a REAL with the seven digits that it has."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float):
        text = f"{value:.7g}"
        return text if any(c in text for c in ".en") else f"{text}.0"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, Mapping):
        return f"{{ {', '.join(f'{name} = {show(part)}' for name, part in value.items())} }}"
    if isinstance(value, Sequence):
        return f"[{', '.join(map(show, value))}]"
    return str(value)


def parse_value(node: Node, text: str) -> object:
    """The value that a user wrote on a command line for a variable: as in a case file, but texts without quotes, and
    TRUE and FALSE in any letter case. What is wrong with it is found when it is written."""
    if isinstance(node, Leaf) and node.variable.kind not in _NOT_AS_WRITTEN:
        return text
    lower = text.strip().lower()
    try:
        return tomllib.loads(f"value = {lower if lower in ('true', 'false') else text.strip()}")["value"]
    except tomllib.TOMLDecodeError:
        return text
