"""Partial access of bit strings (6.6.1.3, table 17): `w.%X3`, `w.%B1`, `dw.%W1`, and `w.3` for a bit."""

from __future__ import annotations

from collections.abc import Mapping

from iec2mpy.semantics import references
from iec2mpy.semantics.coercion import describe
from iec2mpy.semantics.scope import Scope
from iec2mpy.semantics.typed import Expr, PartRef
from iec2mpy.semantics.types import BOOL, BYTE, DWORD, WORD, ElementaryType, Kind, base_type
from iec2mpy.syntax import tree

_PARTS: Mapping[str, ElementaryType] = {"X": BOOL, "B": BYTE, "W": WORD, "D": DWORD}
"""The type of a part by its size prefix."""
_NAMES = {"X": "bit", "B": "byte", "W": "word", "D": "double word"}


def part(scope: Scope, expr: tree.PartExpr, use: references.Use) -> Expr | None:
    """The part of a variable that `expr` names; None after a diagnostic."""
    if isinstance(expr.base, tree.DirectVariable):
        hint = f"Give it a name: VAR name AT {expr.base.text} : … ; END_VAR, and take the part of that."
        scope.diagnostics.add("E0607", f"{expr.base.text} is an address: its parts have no names.", expr.span, hint)
        return None
    if use is references.Use.REFER:
        message = "A part of a bit string cannot be referred to."
        scope.diagnostics.add("E0608", message, expr.span, "Refer to the whole.")
        return None
    if use is references.Use.IN_OUT:
        hint = "Copy it to a variable, give that, and copy it back after the call."
        scope.diagnostics.add("E0606", "A part of a bit string cannot be given to an in-out.", expr.span, hint)
        return None
    base = references.reference(scope, expr.base, use)
    if base is None:
        return None
    whole = base_type(base.type)
    if not isinstance(whole, ElementaryType) or whole.kind is not Kind.BITS:
        message = f"This is {describe(base.type)}: only bit strings such as WORD have bits and bytes that can be named."
        scope.diagnostics.add("E0307", message, expr.span)
        return None
    t = _PARTS.get(expr.size)
    count = whole.bits // t.bits if t is not None else 1
    if t is None or count < 2:
        _no_part(scope, expr, whole)
        return None
    if expr.index >= count:
        name = _NAMES[expr.size]
        scope.diagnostics.add(
            "E0513", f"{describe(whole)} has no {name} {expr.index}: its {name}s are 0 to {count - 1}.", expr.span
        )
        return None
    return PartRef(base, expr.index * t.bits, t, expr.span)


def _no_part(scope: Scope, expr: tree.PartExpr, whole: ElementaryType) -> None:
    smaller = [f"%{size}" for size, t in _PARTS.items() if t.bits < whole.bits]
    scope.diagnostics.add(
        "E0513",
        f"`%{expr.size}` is no part of {describe(whole)}: a part is smaller than the whole.",
        expr.span,
        f"It has {' and '.join(smaller)}.",
    )
