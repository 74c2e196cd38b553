"""Direct addresses (6.5.5): one variable for each address."""

from __future__ import annotations

from collections.abc import Mapping

from iec2mpy.semantics.defaults import default_value
from iec2mpy.semantics.scope import UNKNOWN, GlobalScope, Scope
from iec2mpy.semantics.typed import Value, Variable
from iec2mpy.semantics.types import BOOL, BYTE, DWORD, LWORD, WORD, ElementaryType, Type
from iec2mpy.source.spans import Span
from iec2mpy.syntax import tree

_TYPES: Mapping[str, ElementaryType] = {"X": BOOL, "B": BYTE, "W": WORD, "D": DWORD, "L": LWORD}
"""The type of an address by its size (table 16), where no declaration gives it another."""


def is_complete(location: tree.DirectVariable) -> bool:
    """Whether the address has numbers: one without (%I*) is one that the parser has reported."""
    return bool(location.path)


def direct_variable(scope: Scope, expr: tree.DirectVariable) -> Variable | None:
    """The variable of an address in an expression; it has the type that a declaration gives the address."""
    if not is_complete(expr):
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
