"""Direct addresses (6.5.5): one variable for each address, and what is not supported yet about their overlapping."""

from __future__ import annotations

from collections.abc import Mapping

from iec2mpy.semantics.conversions import same_type
from iec2mpy.semantics.defaults import default_value
from iec2mpy.semantics.scope import UNKNOWN, GlobalScope, Scope
from iec2mpy.semantics.typed import Value, Variable
from iec2mpy.semantics.types import (
    BOOL,
    BYTE,
    DWORD,
    WORD,
    ArrayType,
    ElementaryType,
    StructType,
    Type,
    unaliased,
    value_type,
)
from iec2mpy.source.diagnostics import Related
from iec2mpy.source.spans import Span
from iec2mpy.syntax import tree

_TYPES: Mapping[str, ElementaryType] = {"X": BOOL, "B": BYTE, "W": WORD, "D": DWORD}
"""The type of an address by its size (table 16), where no declaration gives it another."""


def is_supported(scope: Scope, location: tree.DirectVariable) -> bool:
    """Whether the address is one that this compiler has; reports the others."""
    if location.size == "L":
        scope.diagnostics.add("E0915", f"{location.text} has 64 bits: this is not supported yet.", location.span)
    # an address without numbers (%I*) is one that the parser has reported
    return location.size != "L" and bool(location.path)


def direct_variable(scope: Scope, expr: tree.DirectVariable) -> Variable | None:
    """The variable of an address in an expression; it has the type that a declaration gives the address."""
    if not is_supported(scope, expr):
        return None
    world = scope.world
    found = world.direct.get(expr.text)
    if found is None:
        declared = next((v.type for v in world.located if v.address == expr.text), None)
        t = declared or _TYPES[expr.size]
        found = unnamed_variable(world, expr, t, default_value(t) if t is not UNKNOWN else 0, expr.span)
    return found


def unnamed_variable(
    world: GlobalScope, location: tree.DirectVariable, t: Type, initial: Value, span: Span
) -> Variable:
    """The variable that has no name but its address."""
    variable = Variable(location.text, t, tree.Section.GLOBAL, span, initial, address=location.text)
    world.direct[location.text] = variable
    return variable


def locate(scope: Scope, variable: Variable) -> None:
    """Record a variable that is declared at an address; all that are there must have one type."""
    world = scope.world
    other = next((v for v in world.located if v.address == variable.address), None)
    if other is not None and UNKNOWN not in (other.type, variable.type) and not same_type(other.type, variable.type):
        scope.diagnostics.add(
            "E0917",
            f"{variable.address} has two types, {other.type} and {variable.type}: this is not supported yet.",
            variable.span,
            None,
            [Related(other.span, f"Here it is {other.type}.")],
        )
        return
    world.located.append(variable)


# ------------------------------------------------------------------------------------------------- overlaps


def report_overlaps(world: GlobalScope) -> None:
    """Report addresses that are different and share storage, such as %MB20 and %MW10."""
    places: dict[str, list[tuple[int, int, Variable]]] = {}
    for variable in [*world.located, *world.direct.values()]:
        extent = _extent(variable)
        if extent is not None:
            places.setdefault(extent[0], []).append((extent[1], extent[2], variable))
    for group in places.values():
        group.sort(key=lambda place: (place[0], place[1]))
        end, last = -1, None
        for start, stop, variable in group:
            if last is not None and start < end and variable.address != last.address:
                _report_overlap(world, variable, last)
            if stop > end:
                end, last = stop, variable


def _report_overlap(world: GlobalScope, a: Variable, b: Variable) -> None:
    first, second = sorted((a, b), key=lambda v: (v.span.file.path, v.span.start))
    world.diagnostics.add(
        "E0917",
        f"{second.address} and {first.address} share storage: this is not supported yet.",
        second.span,
        None,
        [Related(first.span, f"{first.address} is here.")],
    )


def _extent(variable: Variable) -> tuple[str, int, int] | None:
    """The group of addresses that can overlap, with the first bit and the one after the last."""
    address = variable.address or ""
    area, size = address[1], address[2]
    path = [int(part) for part in address[3:].split(".")]
    if size == "X" and len(path) == 2:
        start = path[0] * 8 + path[1]
    elif len(path) == 1:
        start = path[0] * _TYPES[size].bits
    else:
        return None  # hierarchical addresses are places of their own
    # a channel of a board overlaps only those of its kind: bits with their bytes, words with words
    group = area if area == "M" else area + ("bits" if size in "XB" else "words")
    return group, start, start + max(_bits(variable.type), _TYPES[size].bits)


def _bits(t: Type) -> int:
    t = unaliased(t)
    if isinstance(t, ArrayType):
        count = _bits(t.element)
        for length in t.lengths:
            count *= length
        return count
    if isinstance(t, StructType):
        return sum(_bits(field.type) for field in t.fields.values())
    single = value_type(t)
    return single.bits if isinstance(single, ElementaryType) else 8 * (single.length if single else 1)
