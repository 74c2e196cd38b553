"""Variables in expressions: their parts, and who may read, write or call them (figure 13 of 6.6.3.4.2)."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from enum import Enum
from pathlib import PurePath

from iec2mpy.semantics import addresses, declarations, expressions, loose, parts
from iec2mpy.semantics.coercion import describe, typed_literal
from iec2mpy.semantics.conversions import is_integer
from iec2mpy.semantics.names import unknown_name
from iec2mpy.semantics.scope import UNKNOWN, Scope
from iec2mpy.semantics.signatures import parameter_key
from iec2mpy.semantics.typed import (
    CharacterRef,
    Constant,
    Dereference,
    DirectRef,
    ElementRef,
    Expr,
    FieldRef,
    Variable,
    VariableRef,
)
from iec2mpy.semantics.types import (
    NULL_TYPE,
    ArrayType,
    BlockType,
    EnumType,
    OpenArrayType,
    RefType,
    StringType,
    StructType,
    Type,
    unaliased,
)
from iec2mpy.source.diagnostics import Related
from iec2mpy.source.dialects import accepts, require, with_dialects
from iec2mpy.source.spans import Span
from iec2mpy.source.suggest import suggest
from iec2mpy.syntax import tree
from iec2mpy.syntax.tree import PouKind, Section


class Use(Enum):
    """What is done with a variable."""

    READ = "read"
    WRITE = "written"
    CALL = "called"
    IN_OUT = "given to an in-out"
    REFER = "referred to"


def reference(scope: Scope, expr: tree.Expr, use: Use) -> Expr | None:
    """The variable, or the part of one, that `expr` names, if it may be used so; else None, after a diagnostic."""
    finder = _FINDERS.get(type(expr))
    if finder is None:
        _no_variable(scope, expr, use)
        return None
    return finder(scope, expr, use)


def _no_variable(scope: Scope, expr: tree.Expr, use: Use) -> None:
    if use is Use.REFER:
        scope.diagnostics.add(
            "E0608", "REF takes a variable, and this is a value.", expr.span, "Only variables and their parts are kept."
        )
    elif use is Use.IN_OUT:
        scope.diagnostics.add(
            "E0406",
            "An in-out needs a variable, and this is a value.",
            expr.span,
            "Store the value in a variable, and give that.",
        )
    elif use is Use.CALL:
        scope.diagnostics.add(
            "E0411", "This cannot be called.", expr.span, "Only functions and instances of blocks are called."
        )
    else:
        scope.diagnostics.add(
            "E0603", "This is no variable.", expr.span, "Only variables and their parts can be assigned."
        )


# -------------------------------------------------------------------------------------------- whole variables


def _name(scope: Scope, expr: tree.NameExpr, use: Use) -> Expr | None:
    key = expr.name.casefold()
    variable = scope.locals.get(key)
    if variable is None and scope.pou is None:
        # outside of POUs a name is a constant, or a global variable whose address is an initial value (6.4.4.10.2)
        known = declarations.global_variable if use is Use.REFER else declarations.shared_constant
        variable = known(scope.world, key)
    if variable is None and scope.pou is not None and accepts(expr.span.file, "global-without-external"):
        variable = declarations.global_variable(scope.world, key)
    if variable is None:
        if scope.enumerations_with(key) and use is not Use.READ:
            _no_variable(scope, expr, use)
        else:
            unknown_name(scope, expr)
        return None
    if variable.type is UNKNOWN or not _may_use(scope, variable, use, expr.span):
        return None
    found = variable.target or variable
    if use is Use.REFER:
        found.referred = expr.span
    return VariableRef(found, unaliased(found.type), expr.span)


def _may_use(scope: Scope, variable: Variable, use: Use, span: Span) -> bool:
    if use in (Use.READ, Use.CALL):
        return True
    add = scope.diagnostics.add
    if variable.constant:
        add("E0507", f"`{variable.name}` is a constant: it cannot be {use.value}.", span, None, [_declared(variable)])
        return False
    if use is Use.REFER and _is_temporary(scope, variable):
        add(
            "E0608",
            f"`{variable.name}` is only there while `{_owner(scope)}` runs: it cannot be referred to.",
            span,
            "Declare it in VAR of a PROGRAM or FUNCTION_BLOCK.",
            [_declared(variable)],
        )
        return False
    if use in (Use.REFER, Use.IN_OUT) and scope.pou is not None and variable is scope.pou.eno:
        # 6.6.1.5, rules 7 and 8: only the body itself sets it
        message = f"`{variable.name}` belongs to the call: it cannot be {use.value}."
        hint = "Copy it to a variable of VAR, and use that."
        add(_REFUSALS[use], message, span, hint, [_declared(variable)])
        return False
    if variable.section is Section.INPUT and not accepts(span.file, "written-input"):
        code = _REFUSALS.get(use, "E0604")
        hint = (
            "Copy it to a variable of VAR or VAR_TEMP, and change that."
            if use is Use.WRITE
            else "Give it a copy in a variable of VAR."
        )
        message = f"`{variable.name}` is an input of `{_owner(scope)}`: it cannot be {use.value} here."
        add(code, message, span, with_dialects("written-input", hint), [_declared(variable)])
        return False
    located = (variable.target or variable).address
    if located and located.startswith("%I"):
        add(
            "E0604",
            f"`{variable.name}` is the input {located}: it cannot be {use.value}.",
            span,
            None,
            [_declared(variable)],
        )
        return False
    if variable in scope.controls:
        add(
            "E0602",
            f"`{variable.name}` counts the passes of this FOR: it cannot be {use.value} in its body.",
            span,
            "Use EXIT to leave the loop, or WHILE to count yourself.",
            [Related(scope.controls[variable], "The loop is here.")],
        )
        return False
    if variable is _result_of(scope):
        scope.result_assigned = True
    return True


_REFUSALS = {Use.READ: "E0605", Use.IN_OUT: "E0606", Use.REFER: "E0608"}
"""The codes for what a section forbids; E0604 for the others."""


def _is_temporary(scope: Scope, variable: Variable) -> bool:
    """VAR_TEMP, and any variable inside of a function (6.4.4.10.3)."""
    in_function = scope.pou is not None and scope.pou.kind is PouKind.FUNCTION
    is_global = variable.owner is None or variable.section is Section.EXTERNAL
    return variable.section is Section.TEMP or (in_function and not is_global)


def _result_of(scope: Scope) -> Variable | None:
    return scope.pou.result if scope.pou is not None else None


def _owner(scope: Scope) -> str:
    return scope.pou.name if scope.pou is not None else ""


def _declared(variable: Variable) -> Related:
    return Related(variable.span, f"`{variable.name}` is declared here.")


def _is_list_of(scope: Scope, key: str, member: str) -> bool:
    """Whether a global variable is declared in the file of that name, and nothing else has that name."""
    declared = scope.world.global_declarations.get(member)
    if declared is None or key in scope.world.global_declarations:
        return False
    return PurePath(declared.name.span.file.path).stem.casefold() == key


def _direct(scope: Scope, expr: tree.DirectVariable, use: Use) -> Expr | None:
    variable = addresses.direct_variable(scope, expr)
    if variable is None or variable.type is UNKNOWN:
        return None
    if use is Use.REFER:
        hint = f"Declare a variable AT {expr.text}, and refer to that."
        scope.diagnostics.add("E0608", f"REF takes a variable, and {expr.text} is an address.", expr.span, hint)
        return None
    if use in (Use.WRITE, Use.IN_OUT) and expr.area == "I":
        scope.diagnostics.add("E0604", f"{expr.text} is an input: it cannot be {use.value}.", expr.span)
        return None
    return DirectRef(variable, unaliased(variable.type), expr.span)


# ---------------------------------------------------------------------------------------------------- parts


def _member(scope: Scope, expr: tree.MemberExpr, use: Use) -> Expr | None:
    if isinstance(expr.base, tree.NameExpr) and expr.base.name.casefold() not in scope.locals:
        key = expr.base.name.casefold()
        declaration = scope.world.pou_declarations.get(key)
        if declaration is not None and declaration.kind is PouKind.FUNCTION:
            scope.diagnostics.add(
                "E0204",
                f"`{declaration.name.text}` is a function: nothing of it is left after a call.",
                expr.span,
                f"Take the output in the call: {declaration.name.text}(…, {expr.name.text} => variable).",
            )
            return None
        if _is_list_of(scope, key, expr.name.key):
            message = f"`{expr.base.name}` is not declared: it is a file with global variables."
            instead = f"Write `{expr.name.text}` alone, which VAR_EXTERNAL declares."
            if not require("qualified-global", scope.diagnostics, "E0201", message, expr.base.span, instead):
                return None
            return _name(scope, tree.NameExpr(expr.name.text, expr.span), use)
    base = _base(scope, expr.base, use)
    if base is None:
        return None
    t = base.type
    if isinstance(t, BlockType):
        return _of_instance(scope, expr, base, t, use)
    if not isinstance(t, StructType):
        scope.diagnostics.add(
            "E0307",
            f"This is {describe(t)}, which has no member `{expr.name.text}`.",
            expr.name.span,
            "Structures and instances have members.",
        )
        return None
    field = t.fields.get(expr.name.key)
    if field is None:
        _unknown_member(scope, t, expr.name, (f.name for f in t.fields.values()))
        return None
    if use is Use.REFER and t.storage is not None:
        message = f"`{field.name}` shares its storage with other members of {t}: it cannot be referred to."
        scope.diagnostics.add("E0608", message, expr.span, "Refer to the whole structure.")
        return None
    return _field(base, field, expr.span)


def _base(scope: Scope, expr: tree.Expr, use: Use) -> Expr | None:
    """The instance or structure that a part is taken of. What matters for an instance is what is done with its parts,
    not with itself: its outputs are read, its inputs written, whatever section it stands in, except for VAR_INPUT."""
    if not isinstance(expr, (tree.NameExpr, tree.MemberExpr, tree.IndexExpr)):
        return reference(scope, expr, use)
    found = reference(scope, expr, Use.CALL)
    if found is None or _holds_instance(found):
        return found
    return reference(scope, expr, use) if use not in (Use.CALL, Use.READ) else found


def _holds_instance(expr: Expr) -> bool:
    t = expr.type
    while isinstance(t, (ArrayType, OpenArrayType)):
        t = unaliased(t.element)
    return isinstance(t, BlockType)


def _field(base: Expr, field: Variable, span: Span) -> Expr | None:
    return None if field.type is UNKNOWN else FieldRef(base, field, unaliased(field.type), span)


def _unknown_member(scope: Scope, t: Type, name: tree.Name, known: object) -> None:
    near = suggest(name.text, list(known))  # type: ignore[call-overload]
    scope.diagnostics.add(
        "E0204", f"{t} has no member `{name.text}`.", name.span, f"Did you mean `{near}`?" if near else None
    )


_ALLOWED: Mapping[Section, frozenset[Use]] = {
    Section.INPUT: frozenset((Use.WRITE,)),  # case 1b of figure 13: not read
    Section.OUTPUT: frozenset((Use.READ,)),  # case 4b: not written; an in-out would write it
}
"""What may be done with the variables of an instance from outside of its block."""


def _of_instance(scope: Scope, expr: tree.MemberExpr, base: Expr, t: BlockType, use: Use) -> Expr | None:
    declarations.declare_pou(scope.world, t.pou.name.casefold())
    name = expr.name
    variable = t.pou.variables.get(parameter_key(t.pou, name.key))
    if variable is None:
        _unknown_member(scope, t, name, (v.name for v in t.pou.variables.values() if v.section in _ALLOWED))
        return None
    if variable.section is not None and use in _ALLOWED.get(variable.section, ()):
        return _field(base, variable, expr.span)
    _refused(scope, expr, variable, t, use)
    return None


def _refused(scope: Scope, expr: tree.MemberExpr, variable: Variable, t: BlockType, use: Use) -> None:
    section = variable.section.value if variable.section else ""
    code, hint = _REFUSALS.get(use, "E0604"), None
    if variable.section is Section.INPUT:
        hint = "Read the variable that was given to it."
    elif variable.section is Section.OUTPUT:
        hint = "Only the block itself writes its outputs." if use is Use.WRITE else "Copy it to a variable first."
    elif variable.section is Section.IN_OUT:
        hint = "Use the variable that was given to the in-out in the call."
    else:
        hint = f"Only the inputs and outputs of {t} are for others."
    message = f"`{variable.name}` is {section} of {t}: it cannot be {use.value} from outside."
    scope.diagnostics.add(code, message, expr.name.span, hint, [_declared(variable)])


def _element(scope: Scope, expr: tree.IndexExpr, use: Use) -> Expr | None:
    base = _base(scope, expr.base, use)
    indices = [_index(scope, index) for index in expr.indices]
    if base is None:
        return None
    t = base.type
    if isinstance(t, StringType):
        return _character(scope, expr, base, t, indices, use)
    if not isinstance(t, (ArrayType, OpenArrayType)):
        scope.diagnostics.add(
            "E0307",
            f"This is {describe(t)}, which has no elements.",
            expr.span,
            "Only arrays and strings have subscripts.",
        )
        return None
    if len(indices) != t.dimensions:
        scope.diagnostics.add(
            "E0306", f"This array has {_dimensions(t.dimensions)}, and {len(indices)} given.", expr.span
        )
        return None
    checked = [index for index in indices if index is not None]
    if len(checked) != len(indices) or (isinstance(t, ArrayType) and not _inside(scope, checked, t)):
        return None
    return ElementRef(base, tuple(checked), unaliased(t.element), expr.span)


def _character(
    scope: Scope, expr: tree.IndexExpr, base: Expr, t: StringType, indices: Sequence[Expr | None], use: Use
) -> Expr | None:
    """A character of a string, by its position from 1 (6.4.2.2)."""
    if use is Use.REFER:
        message = "A character of a string cannot be referred to."
        scope.diagnostics.add("E0608", message, expr.span, "Refer to the whole string.")
        return None
    if use is Use.IN_OUT:
        scope.diagnostics.add(
            "E0406",
            "An in-out needs a variable, and this is a character of one.",
            expr.span,
            "Store the character in a variable, and give that.",
        )
        return None
    if len(indices) != 1:
        scope.diagnostics.add("E0306", f"A string has 1 subscript, and {len(indices)} given.", expr.span)
        return None
    index = indices[0]
    if index is None:
        return None
    if isinstance(index, Constant) and not 1 <= int(index.value) <= t.length:
        scope.diagnostics.add(
            "E0502",
            f"There is no character {index.value}: the string has up to {t.length}.",
            index.span,
            "The first character has the number 1.",
        )
        return None
    return CharacterRef(base, index, t.character, expr.span)


def _dimensions(count: int) -> str:
    return "1 subscript" if count == 1 else f"{count} subscripts"


def _index(scope: Scope, expr: tree.Expr) -> Expr | None:
    index = expressions.check(scope, expr)
    if index is None:
        return None
    index = loose.as_number(index)
    if not is_integer(index.type) or isinstance(index.type, EnumType):
        scope.diagnostics.add(
            "E0305", f"A subscript must be an integer, but this is {describe(index.type)}.", index.span
        )
        return None
    return typed_literal(scope, index)


def _inside(scope: Scope, indices: Sequence[Expr], t: ArrayType) -> bool:
    """Whether all constant subscripts are within the bounds."""
    for index, (low, high) in zip(indices, t.bounds, strict=True):
        if isinstance(index, Constant) and not low <= int(index.value) <= high:
            scope.diagnostics.add(
                "E0502", f"The subscript {index.value} is out of bounds: the array has {low}..{high}.", index.span
            )
            return False
    return True


def _dereferenced(scope: Scope, expr: tree.DerefExpr, use: Use) -> Expr | None:
    """`base^` can be used as the variable itself (6.4.4.10.3), whatever is done with it."""
    base = expressions.check(scope, expr.base)
    if base is None:
        return None
    if not isinstance(base.type, RefType) or base.type is NULL_TYPE:
        scope.diagnostics.add(
            "E0315",
            f"`^` follows a reference, but this is {describe(base.type)}.",
            expr.span,
            None if base.type is NULL_TYPE else f"Write `{expr.base.span.text}` alone.",
        )
        return None
    target = unaliased(base.type.target)
    if isinstance(target, BlockType):
        declarations.declare_pou(scope.world, target.pou.name.casefold())
    return Dereference(base, target, expr.span)


_FINDERS: Mapping[type, Callable[..., Expr | None]] = {
    tree.NameExpr: _name,
    tree.DirectVariable: _direct,
    tree.MemberExpr: _member,
    tree.IndexExpr: _element,
    tree.PartExpr: parts.part,
    tree.DerefExpr: _dereferenced,
}
