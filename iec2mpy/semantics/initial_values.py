"""Initial values: those of types, of fields and of declarations, merged in one place (6.5.1.3, 6.4.4)."""

from __future__ import annotations

from collections.abc import Sequence

from iec2mpy.semantics import constants, declarations, expressions
from iec2mpy.semantics.coercion import coerce
from iec2mpy.semantics.defaults import default_value, element_count, nested
from iec2mpy.semantics.scope import UNKNOWN, Scope
from iec2mpy.semantics.signatures import parameter_key
from iec2mpy.semantics.typed import (
    Address,
    Constant,
    ElementRef,
    Expr,
    FieldRef,
    ReferenceTo,
    Value,
    Variable,
    VariableRef,
)
from iec2mpy.semantics.types import (
    ArrayType,
    BlockType,
    StructType,
    Type,
    unaliased,
)
from iec2mpy.source.suggest import suggest
from iec2mpy.syntax import tree


def initial_value(scope: Scope, t: Type, initial: tree.Initial | None) -> Value:
    """The complete initial value of a variable of type `t` that is declared with `initial`."""
    if t is UNKNOWN:
        return 0
    return default_value(t) if initial is None else _merged(scope, t, default_value(t), initial)


def _merged(scope: Scope, t: Type, default: Value, initial: tree.Initial) -> Value:
    """`default` with what `initial` says instead."""
    shape = unaliased(t)
    if isinstance(initial, tree.ArrayInitial):
        if isinstance(shape, ArrayType):
            return _array(scope, shape, initial)
        _wrong_shape(scope, t, initial, "a list in square brackets is for an array")
        return default
    if isinstance(initial, tree.StructInitial):
        if isinstance(shape, StructType) and shape.storage is not None:
            # 6.4.4.7.2
            message = f"{t} has no initial values: its members share their storage."
            scope.diagnostics.add("E0701", message, initial.span, "Assign to one of its members in the body.")
            return default
        if isinstance(shape, (StructType, BlockType)):
            assert isinstance(default, dict)
            return _members(scope, shape, default, initial)
        _wrong_shape(scope, t, initial, "a list of members is for a structure or an instance")
        return default
    if isinstance(shape, (ArrayType, StructType, BlockType)):
        how = "in square brackets: [1, 2, 3]" if isinstance(shape, ArrayType) else "by name: (x := 1, y := 2)"
        _wrong_shape(scope, t, initial, f"its values are listed {how}")
        return default
    if isinstance(initial, tree.RefExpr):
        value = _address(scope, t, initial)
    else:
        value = constants.scalar(scope, initial, t, "An initial value")
    return default if value is None else value


def _address(scope: Scope, t: Type, initial: tree.RefExpr) -> Address | None:
    """REF(variable) of a variable that is already declared (6.4.4.10.2)."""
    checked = expressions.check(scope, initial)
    reference = checked and coerce(scope, checked, t)
    if not isinstance(reference, ReferenceTo):
        return None
    found = _way_to(reference.target)
    if found is None:
        scope.diagnostics.add(
            "E0505",
            "An initial value must be constant, and where this variable is changes while the program runs.",
            initial.span,
            "Assign the reference in the body.",
        )
    return found


def _way_to(target: Expr) -> Address | None:
    """Where a variable or a part of it is, or None where that depends on more than the instance that holds it."""
    if isinstance(target, VariableRef):
        is_own = target.variable.section is not tree.Section.IN_OUT
        return Address(target.variable, (), target.type) if is_own else None
    if not isinstance(target, (FieldRef, ElementRef)):
        return None
    base = _way_to(target.base)
    if base is None:
        return None
    if isinstance(target, FieldRef):
        return Address(base.variable, (*base.steps, target.field), target.type)
    number, array = 0, target.base.type
    assert isinstance(array, ArrayType)
    for index, (low, _), length in zip(target.indices, array.bounds, array.lengths, strict=True):
        if not isinstance(index, Constant):
            return None
        number = number * length + int(index.value) - low
    return Address(base.variable, (*base.steps, number), target.type)


def _wrong_shape(scope: Scope, t: Type, initial: tree.Initial, why: str) -> None:
    scope.diagnostics.add("E0709", f"This is no initial value for {t}: {why}.", initial.span)


def _members(
    scope: Scope, t: StructType | BlockType, default: dict[str, Value], initial: tree.StructInitial
) -> dict[str, Value]:
    values, members = dict(default), t.fields if isinstance(t, StructType) else _declared(scope, t)
    seen: set[str] = set()
    for item in initial.fields:
        key = parameter_key(t.pou, item.name.key) if isinstance(t, BlockType) else item.name.key
        member = members.get(key)
        if member is None:
            near = suggest(item.name.text, (m.name for m in members.values()))
            scope.diagnostics.add(
                "E0204",
                f"{t} has no member `{item.name.text}`.",
                item.name.span,
                f"Did you mean `{near}`?" if near else None,
            )
        elif isinstance(t, BlockType) and member.section not in (tree.Section.INPUT, tree.Section.OUTPUT):
            scope.diagnostics.add(
                "E0604",
                f"`{member.name}` is not an input or output of {t}: it gets no initial value from outside.",
                item.name.span,
            )
        elif key in seen:
            scope.diagnostics.add("E0202", f"`{member.name}` gets two initial values.", item.name.span)
        else:
            seen.add(key)
            values[key] = _merged(scope, member.type, member.initial, item.value) if member.type is not UNKNOWN else 0
    return values


def _declared(scope: Scope, t: BlockType) -> dict[str, Variable]:
    declarations.declare_pou(scope.world, t.pou.name.casefold())
    return t.pou.variables


# ------------------------------------------------------------------------------------------------- arrays


def _array(scope: Scope, t: ArrayType, initial: tree.ArrayInitial) -> Value:
    """The elements in order, the rightmost subscript fastest; what the list leaves out has its type's value."""
    wanted = element_count(t.lengths)
    values = _listed(scope, t, initial.items, wanted)
    if len(values) != wanted:
        # neither is an error, and the user is warned of both (6.4.4.5.2)
        kept = "the last ones are ignored" if len(values) > wanted else "the others keep the default"
        scope.diagnostics.add(
            "W0501",
            f"{len(values)} initial values for {wanted} elements: {kept}.",
            initial.span,
            "[3, 5(0)] stands for [3, 0, 0, 0, 0, 0].",
        )
        values = [*values[:wanted], *[default_value(t.element)] * (wanted - len(values))]
    return nested(values, t.lengths)


def _listed(scope: Scope, t: ArrayType, items: Sequence[tree.Initial | tree.Repeat], wanted: int) -> list[Value]:
    default = default_value(t.element)
    values: list[Value] = []
    for item in items:
        if not isinstance(item, tree.Repeat):
            values.append(_merged(scope, t.element, default, item))
            continue
        count = constants.integer(scope, item.count, "The number of repetitions")
        if count is None or count < 0:
            continue
        repeated = _listed(scope, t, item.values, wanted) if item.values else [default]
        # no more than one value too many: the excess is only counted to say that there is some
        values += repeated * min(count, wanted + 1)
    return values
