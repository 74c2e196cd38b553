"""Types as they are written become types (6.4.4)."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from iec2mpy.semantics import constants, initial_values, structures
from iec2mpy.semantics.conversions import INTEGER_KINDS, type_named
from iec2mpy.semantics.defaults import default_value
from iec2mpy.semantics.scope import UNKNOWN, GlobalScope, Scope
from iec2mpy.semantics.signatures import is_planned_block
from iec2mpy.semantics.stdlib import block_names
from iec2mpy.semantics.typed import Variable
from iec2mpy.semantics.types import (
    DEFAULT_STRING_LENGTH,
    ELEMENTARY,
    INT,
    AliasType,
    ArrayType,
    ElementaryType,
    EnumType,
    Kind,
    OpenArrayType,
    RefType,
    StringType,
    StructType,
    SubrangeType,
    Type,
    unaliased,
)
from iec2mpy.source.diagnostics import Related
from iec2mpy.source.spans import Span
from iec2mpy.source.suggest import suggest
from iec2mpy.syntax import tree

_NAMED_KINDS = INTEGER_KINDS | {Kind.BITS}
"""What named values may be made of (11.2a)."""
MAX_ELEMENTS = 32_000
"""More elements than any board has room for: 4 bytes each."""


def resolve_type(scope: Scope, spec: tree.TypeSpec, name: str | None = None) -> Type:
    """The type meant; `name` is that of its TYPE declaration. What is wrong has been reported, and gives UNKNOWN."""
    return _RESOLVERS[type(spec)](scope, spec, name)


def named_type(world: GlobalScope, key: str) -> Type | None:
    """The type declared by that (case-folded) name in a TYPE declaration or as a function block, or None."""
    if key in world.block_types:
        return world.block_types[key]
    if key in world.types or key not in world.type_declarations:
        return world.types.get(key)
    declaration = world.type_declarations[key]
    if key in world.active:
        name = declaration.name
        world.diagnostics.add(
            "E0705",
            f"The type `{name.text}` contains itself.",
            name.span,
            "A type can hold only types other than itself.",
        )
        return UNKNOWN
    world.active.add(key)
    world.types[key] = _declared_type(Scope(world), declaration)
    world.active.discard(key)
    return world.types[key]


def _declared_type(scope: Scope, declaration: tree.TypeDecl) -> Type:
    name, initial = declaration.name.text, declaration.initial
    t = resolve_type(scope, declaration.type, name)
    if t is UNKNOWN:
        return t
    if isinstance(t, StructType) and t.name == name:
        return t
    default = initial_values.initial_value(scope, t, initial) if initial is not None else default_value(t)
    # an enumeration or a subrange that this declaration makes has the initial value itself; an alias adds it to another
    if isinstance(t, EnumType) and not isinstance(declaration.type, tree.NamedTypeSpec):
        if isinstance(default, int) and default != t.default:
            t = EnumType(t.name, t.base, t.values, default, t.open)
        _register(scope.world.enumerators, t)
        return t
    if isinstance(t, SubrangeType) and not isinstance(declaration.type, tree.NamedTypeSpec):
        return SubrangeType(name, t.base, t.low, t.high, default) if isinstance(default, int) else t
    return AliasType(name, t, default)


def _register(enumerators: dict[str, list[EnumType]], t: EnumType) -> None:
    for value in t.values:
        enumerators.setdefault(value.casefold(), []).append(t)


# ------------------------------------------------------------------------------------------------- by name


def _named(scope: Scope, spec: tree.NamedTypeSpec, name: str | None) -> Type:
    world, text = scope.world, spec.name.text
    t = type_named(text) or named_type(world, spec.name.key)
    if t is not None:
        return t
    if is_planned_block(text):
        scope.diagnostics.add("E0916", f"The standard block {text.upper()} is not supported yet.", spec.span)
    elif spec.name.key in world.pou_declarations:
        kind = world.pou_declarations[spec.name.key].kind
        if kind is tree.PouKind.PROGRAM:
            scope.diagnostics.add(
                "E0707",
                f"`{text}` is a PROGRAM: no variable can be of that type.",
                spec.span,
                "Make it a FUNCTION_BLOCK, or run it from a CONFIGURATION.",
            )
        else:
            scope.diagnostics.add("E0208", f"`{text}` is a function, and no type.", spec.span)
    else:
        known = [*ELEMENTARY, "STRING", "WSTRING", *(d.name.text for d in world.type_declarations.values())]
        known += [*(t.name for t in world.block_types.values()), *block_names()]
        near = suggest(text, known)
        scope.diagnostics.add(
            "E0203",
            f"There is no type `{text}`.",
            spec.span,
            f"Did you mean `{near}`?" if near else "Declare it in TYPE … END_TYPE, or as a FUNCTION_BLOCK.",
        )
    return UNKNOWN


# ---------------------------------------------------------------------------------------- written out


def _string(scope: Scope, spec: tree.StringSpec, name: str | None) -> Type:
    if spec.length is None:
        return StringType(wide=spec.wide)
    length = constants.integer(scope, spec.length, "The length of a string")
    if length is None:
        return UNKNOWN
    if not 1 <= length <= DEFAULT_STRING_LENGTH:
        scope.diagnostics.add(
            "E0509",
            f"A {StringType(wide=spec.wide)} cannot have {length} characters.",
            spec.length.span,
            f"Write 1 to {DEFAULT_STRING_LENGTH}.",
        )
        return UNKNOWN
    return StringType(length, spec.wide)


def _limits(scope: Scope, low: tree.Expr, high: tree.Expr, what: str, span: Span) -> tuple[int, int] | None:
    first, last = constants.integer(scope, low, what), constants.integer(scope, high, what)
    if first is None or last is None:
        return None
    if first > last:
        scope.diagnostics.add(
            "E0506", f"The limits {first}..{last} hold no value.", span, "Write the smaller limit first."
        )
        return None
    return first, last


def _base(scope: Scope, name: tree.Name, what: str, kinds: frozenset[Kind] = INTEGER_KINDS) -> ElementaryType | None:
    t = type_named(name.text)
    if isinstance(t, ElementaryType) and t.kind in kinds:
        return t
    scope.diagnostics.add(
        "E0310",
        f"{what} is made of an integer type, and `{name.text}` is none.",
        name.span,
        "Use INT, DINT, UINT or their like.",
    )
    return None


def _subrange(scope: Scope, spec: tree.SubrangeSpec, name: str | None) -> Type:
    base = _base(scope, spec.base, "A subrange")
    if base is None:
        return UNKNOWN
    limits = _limits(scope, spec.low, spec.high, "A limit of a subrange", spec.low.span.to(spec.high.span))
    if limits is None:
        return UNKNOWN
    for value, expr in zip(limits, (spec.low, spec.high), strict=True):
        if not base.low <= value <= base.high:
            scope.diagnostics.add("E0501", f"{value} is no {base}: it has {base.low} to {base.high}.", expr.span)
            return UNKNOWN
    low, high = limits
    return SubrangeType(name or f"{base} ({low}..{high})", base, low, high, low)


def _enumeration(scope: Scope, spec: tree.EnumSpec, name: str | None) -> Type:
    base = INT if spec.base is None else _base(scope, spec.base, "A type with named values", _NAMED_KINDS)
    if base is None:
        return UNKNOWN
    # a value may be written with the names before it (6.4.4.3.2)
    values: dict[str, int] = {}
    seen: dict[str, tree.Name] = {}
    inner = Scope(scope.world, scope.pou, locals=dict(scope.locals))
    number = 0
    for item in spec.items:
        if item.name.key in seen:
            _duplicate(scope, item.name, seen[item.name.key].span, "value")
            continue
        seen[item.name.key] = item.name
        if item.value is not None:
            given = constants.scalar(inner, item.value, base, "The number of an enumerated value")
            if given is None:
                return UNKNOWN
            number = int(given)
        if not base.low <= number <= base.high:
            scope.diagnostics.add("E0501", f"{number} is no {base}: it has {base.low} to {base.high}.", item.span)
            return UNKNOWN
        values[item.name.text] = number
        constant = Variable(item.name.text, base, tree.Section.VAR, item.name.span, number, constant=True)
        inner.locals[item.name.key] = constant
        number += 1
    if not values:
        return UNKNOWN  # a list that could not be read
    title = name or f"({', '.join(values)})"
    t = EnumType(title, base, values, next(iter(values.values())), open=spec.base is not None)
    if name is None:
        _register(scope.enumerators, t)
    return t


def open_array(scope: Scope, spec: tree.ArraySpec) -> Type:
    """`ARRAY[*]`, for a parameter that may be one."""
    element = resolve_type(scope, spec.element)
    if element is UNKNOWN:
        return UNKNOWN
    if not all(is_open(bound) for bound in spec.bounds):
        message = "An array has either all of its limits, or * for each of them."
        scope.diagnostics.add("E0714", message, spec.span)
        return UNKNOWN
    return OpenArrayType(element, len(spec.bounds))


def is_open(bound: tree.ArrayBound) -> bool:
    """Whether it is `*`."""
    return bound.low is None


def _array(scope: Scope, spec: tree.ArraySpec, name: str | None) -> Type:
    bounds: list[tuple[int, int]] = []
    for bound in spec.bounds:
        if bound.low is None or bound.high is None:
            _no_open_array(scope, spec)
            return UNKNOWN
        limits = _limits(scope, bound.low, bound.high, "A limit of an array", bound.span)
        if limits is None:
            return UNKNOWN
        bounds.append(limits)
    element = resolve_type(scope, spec.element)
    if element is UNKNOWN:
        return UNKNOWN
    t = ArrayType(element, tuple(bounds))
    if _count(t) > MAX_ELEMENTS:
        scope.diagnostics.add("E0512", f"An array of {_count(t)} elements is too large for a controller.", spec.span)
        return UNKNOWN
    return t


def _no_open_array(scope: Scope, spec: tree.ArraySpec) -> None:
    scope.diagnostics.add(
        "E0714",
        "The limits of this array are missing.",
        spec.span,
        "Only parameters may be ARRAY[*]: VAR_IN_OUT, and VAR_INPUT and VAR_OUTPUT of a FUNCTION.",
    )


def _count(t: Type) -> int:
    t = unaliased(t)
    if not isinstance(t, ArrayType):
        return 1
    count = _count(t.element)
    for length in t.lengths:
        count *= length
    return count


def _reference(scope: Scope, spec: tree.RefSpec, name: str | None) -> Type:
    target = resolve_type(scope, spec.target)
    return target if target is UNKNOWN else RefType(target)


def _struct(scope: Scope, spec: tree.StructSpec, name: str | None) -> Type:
    t = StructType(name or "STRUCT")
    for field in spec.fields:
        element = resolve_type(scope, field.type)
        initial = initial_values.initial_value(scope, element, field.initial)
        relative = structures.relative_offset(scope, field)
        for field_name in field.names:
            first = t.fields.get(field_name.key)
            if first is not None:
                _duplicate(scope, field_name, first.span, "member")
            else:
                member = Variable(field_name.text, element, None, field_name.span, initial, relative=relative)
                t.fields[field_name.key] = member
    structures.lay_out(scope, t, spec)
    return t


def _duplicate(scope: Scope, name: tree.Name, first: Span, what: str) -> None:
    scope.diagnostics.add(
        "E0202",
        f"There are two {what}s named `{name.text}`.",
        name.span,
        "Letter case does not make names differ.",
        [Related(first, f"The first `{first.text}` is here.")],
    )


_RESOLVERS: Mapping[type, Callable[..., Type]] = {
    tree.NamedTypeSpec: _named,
    tree.StringSpec: _string,
    tree.SubrangeSpec: _subrange,
    tree.EnumSpec: _enumeration,
    tree.ArraySpec: _array,
    tree.StructSpec: _struct,
    tree.RefSpec: _reference,
}
