"""What a name alone means: an enumerated value, or something that it should not be."""

from __future__ import annotations

from iec2mpy.semantics import type_specs
from iec2mpy.semantics.scope import UNKNOWN, Scope
from iec2mpy.semantics.typed import Constant
from iec2mpy.semantics.types import EnumType, Type, unaliased
from iec2mpy.source.dialects import with_dialects
from iec2mpy.source.suggest import suggest
from iec2mpy.syntax import tree


def is_enumerated(scope: Scope, expr: tree.NameExpr, expected: Type | None) -> bool:
    """Whether the name is that of an enumerated value: variables come first, then the values of the type expected."""
    key = expr.name.casefold()
    if key in scope.locals:
        return False
    wanted = _enumeration(expected)
    return bool(scope.enumerations_with(key)) or (wanted is not None and _number(wanted, key) is not None)


def _enumeration(expected: Type | None) -> EnumType | None:
    t = unaliased(expected) if expected is not None else None
    return t if isinstance(t, EnumType) else None


def enumerated_value(scope: Scope, expr: tree.NameExpr, expected: Type | None) -> Constant | None:
    """The enumerated value of that name; None after a diagnostic.

    A name that several types have means the one that `expected` has; elsewhere it is an error (6.4.4.2.1).
    """
    key = expr.name.casefold()
    wanted = _enumeration(expected)
    if wanted is not None and (value := _number(wanted, key)) is not None:
        return Constant(value, wanted, expr.span)
    types = scope.enumerations_with(key)
    if len(types) > 1:
        names = " and ".join(f"{t}#{expr.name}" for t in types[:2])
        scope.diagnostics.add(
            "E0205", f"`{expr.name}` is a value of several types.", expr.span, f"Write which one is meant: {names}."
        )
        return None
    number = _number(types[0], key)
    assert number is not None
    return Constant(number, types[0], expr.span)


def _number(t: EnumType, key: str) -> int | None:
    return next((number for name, number in t.values.items() if name.casefold() == key), None)


def qualified_value(scope: Scope, expr: tree.TypedEnumValue) -> Constant | None:
    """`Colour#red`."""
    t = type_specs.named_type(scope.world, expr.type_name.key)
    if t is UNKNOWN:
        return None
    enumeration = unaliased(t) if t is not None else None
    if not isinstance(enumeration, EnumType):
        near = suggest(expr.type_name.text, (d.name.text for d in scope.world.type_declarations.values()))
        scope.diagnostics.add(
            "E0203",
            f"There is no enumeration `{expr.type_name.text}`.",
            expr.type_name.span,
            f"Did you mean `{near}`?" if near else None,
        )
        return None
    number = _number(enumeration, expr.value.key)
    if number is not None:
        return Constant(number, enumeration, expr.span)
    unknown_value(scope, enumeration, expr.value)
    return None


def is_nothing_else(scope: Scope, expr: tree.NameExpr) -> bool:
    """Whether the program declares nothing at all by that name."""
    world, key = scope.world, expr.name.casefold()
    tables = (scope.locals, world.pou_declarations, world.type_declarations, world.global_declarations)
    return not any(key in table for table in tables)


def unknown_value(scope: Scope, t: EnumType, name: tree.Name) -> None:
    """Report a value that an enumeration does not have."""
    near = suggest(name.text, t.values)
    scope.diagnostics.add(
        "E0206",
        f"{t} has no value `{name.text}`.",
        name.span,
        f"Did you mean `{near}`?" if near else f"It has {', '.join(t.values)}.",
    )


def unknown_name(scope: Scope, expr: tree.NameExpr) -> None:
    """Report a name that stands where a value is needed, and is none."""
    world, key = scope.world, expr.name.casefold()
    add = scope.diagnostics.add
    if key in world.pou_declarations:
        kind = world.pou_declarations[key].kind.value.replace("_", " ").lower()
        hint = (
            "Call it, with its arguments in brackets."
            if kind == "function"
            else "Declare an instance of it, and use that."
        )
        add("E0208", f"`{expr.name}` is a {kind}, and has no value of its own.", expr.span, hint)
    elif key in world.type_declarations:
        add("E0208", f"`{expr.name}` is a type, and has no value.", expr.span, "Declare a variable of that type.")
    elif key in world.global_declarations:
        if scope.pou is None:
            add("E0505", f"`{expr.name}` is no constant, and a constant is needed here.", expr.span)
        else:
            message = f"`{expr.name}` is a global variable, and not declared in `{scope.pou.name}`."
            hint = f"Add VAR_EXTERNAL {expr.name} : … ; END_VAR with its type."
            add("E0201", message, expr.span, with_dialects("global-without-external", hint))
    else:
        near = suggest(expr.name, scope.visible_names())
        add(
            "E0201",
            f"`{expr.name}` is not declared.",
            expr.span,
            f"Did you mean `{near}`?" if near else "Declare it in VAR … END_VAR.",
        )
