"""Declarations: global variables, and the variables of each POU, with the rules of their sections (6.5.2, 6.6.3.2)."""

from __future__ import annotations

from collections.abc import Iterator

from iec2mpy.semantics.addresses import is_complete, unnamed_variable
from iec2mpy.semantics.conversions import same_type
from iec2mpy.semantics.defaults import default_value
from iec2mpy.semantics.initial_values import initial_value
from iec2mpy.semantics.scope import UNKNOWN, GlobalDeclaration, GlobalScope, Scope
from iec2mpy.semantics.type_specs import is_open, open_array, resolve_type
from iec2mpy.semantics.typed import EdgeInput, Pou, Value, Variable
from iec2mpy.semantics.types import (
    BOOL,
    DINT,
    AliasType,
    ArrayType,
    BlockType,
    OpenArrayType,
    RefType,
    StructType,
    Type,
    holds_instance,
    holds_reference,
    unaliased,
)
from iec2mpy.source.diagnostics import Related
from iec2mpy.source.dialects import with_dialects
from iec2mpy.source.spans import Span
from iec2mpy.source.suggest import suggest
from iec2mpy.syntax import tree
from iec2mpy.syntax.tree import PouKind, Retention, Section

_RETENTION = {Retention.RETAIN: True, Retention.NON_RETAIN: False, None: None}
_RETAINABLE = frozenset((Section.VAR, Section.STATIC, Section.INPUT, Section.OUTPUT, Section.GLOBAL))
"""The sections that RETAIN may qualify (6.5.6.2)."""
_CONSTANT = frozenset((Section.VAR, Section.STATIC, Section.GLOBAL, Section.EXTERNAL))


# --------------------------------------------------------------------------------------------------- globals


def shared_constant(world: GlobalScope, key: str) -> Variable | None:
    """The constant of that name that is declared outside of POUs and configurations: TYPE declarations may use it."""
    declared = world.global_declarations.get(key)
    if declared is None or not declared.shared or not declared.section.constant:
        return None
    return global_variable(world, key)


def global_variable(world: GlobalScope, key: str) -> Variable | None:
    """The global variable of that name, or None."""
    if key in world.globals or key not in world.global_declarations:
        return world.globals.get(key)
    declared = world.global_declarations[key]
    scope = Scope(world, is_stdlib=declared.name.span.file.is_stdlib)
    if key in world.active:
        world.diagnostics.add("E0705", f"The value of `{declared.name.text}` depends on itself.", declared.name.span)
        return Variable(declared.name.text, UNKNOWN, Section.GLOBAL, declared.name.span, 0)
    world.active.add(key)
    _check_qualifiers(scope, declared.section)
    t = resolve_type(scope, declared.declaration.type)
    if t is not UNKNOWN and declared.section.constant and holds_instance(t):
        _no_instance(scope, declared.declaration.span, "a CONSTANT section")
        t = UNKNOWN
    initial = initial_value(scope, t, declared.declaration.initial)
    world.globals[key] = _variable(declared.section, declared.declaration, declared.name, t, initial)
    world.active.discard(key)
    if declared.declaration.location is not None:
        _locate(scope, declared.declaration.location, world.globals[key])
    return world.globals[key]


def declare_globals(world: GlobalScope, sections: list[tree.VarSection]) -> None:
    """All global variables, and those sections' variables that have an address and no name."""
    for key in world.global_declarations:
        global_variable(world, key)
    for section in sections:
        for declaration in section.declarations:
            if not declaration.names:
                _unnamed(Scope(world), declaration)


def collect_globals(world: GlobalScope, section: tree.VarSection, shared: bool) -> None:
    """Note the names of a VAR_GLOBAL section."""
    for declaration in section.declarations:
        for name in declaration.names:
            first = world.global_declarations.get(name.key)
            if first is not None:
                report_duplicate(world, name, first.name.span)
            else:
                world.global_declarations[name.key] = GlobalDeclaration(section, declaration, name, shared)


def report_duplicate(world: GlobalScope, name: tree.Name, first: Span) -> None:
    """Say that a name is declared a second time."""
    hint = None if name.text == first.text else "Letter case does not make names differ."
    world.diagnostics.add(
        "E0202",
        f"`{name.text}` is declared twice.",
        name.span,
        hint,
        [Related(first, f"The first `{first.text}` is here.")],
    )


# ------------------------------------------------------------------------------------------------------ POUs


def declare_pou(world: GlobalScope, key: str) -> Scope:
    """The scope of a POU with all its variables, declared when it is first asked for."""
    if key in world.scopes:
        return world.scopes[key]
    pou, declaration = world.pous[key], world.pou_declarations[key]
    scope = Scope(world, pou, declaration.span.file.is_stdlib)
    world.scopes[key] = scope
    world.active.add(f"pou {key}")
    if declaration.result is not None:
        t = resolve_type(scope, declaration.result)
        if t is not UNKNOWN and holds_instance(t):
            _no_instance(scope, declaration.result.span, "the result of a function")
            t = UNKNOWN
        pou.result = Variable(
            pou.name, t, Section.VAR, pou.span, default_value(t) if t is not UNKNOWN else 0, owner=pou
        )
        scope.locals[key] = pou.result
    for section in declaration.sections:
        _declare_section(scope, pou, section)
    world.active.discard(f"pou {key}")
    return scope


def _declare_section(scope: Scope, pou: Pou, section: tree.VarSection) -> None:
    if section.section is Section.GLOBAL:
        if pou.kind is not PouKind.PROGRAM:  # those of programs are reported where they are collected
            scope.diagnostics.add(
                "E0708", f"A {pou.kind.value} has no VAR_GLOBAL.", section.span, "Write it outside of POUs."
            )
        return
    if section.retention is not None and pou.kind is PouKind.FUNCTION:
        scope.diagnostics.add(
            "E0702", f"A FUNCTION keeps nothing between calls: it has no {section.retention.value}.", section.span
        )
    _check_qualifiers(scope, section)
    for declaration in section.declarations:
        if not declaration.names:
            if pou.kind is PouKind.PROGRAM and section.section is Section.VAR:
                _unnamed(scope, declaration)
            elif declaration.location is not None:
                _no_address(scope, pou, declaration.location)
            continue
        _declare(scope, pou, section, declaration)


def _check_qualifiers(scope: Scope, section: tree.VarSection) -> None:
    name = section.section.value
    if section.retention is not None and section.section not in _RETAINABLE:
        scope.diagnostics.add(
            "E0702",
            f"{name} cannot be {section.retention.value}.",
            section.span,
            "RETAIN goes with VAR, VAR_INPUT, VAR_OUTPUT and VAR_GLOBAL.",
        )
    if section.constant and section.section not in _CONSTANT:
        hint = "CONSTANT goes with VAR, VAR_GLOBAL and VAR_EXTERNAL."
        if section.section is Section.INPUT:
            hint = with_dialects("constant-input", hint)
        scope.diagnostics.add("E0702", f"{name} cannot be CONSTANT.", section.span, hint)


def _declare(scope: Scope, pou: Pou, section: tree.VarSection, declaration: tree.VarDecl) -> None:
    spec = declaration.type
    if isinstance(spec, tree.ArraySpec) and is_open(spec.bounds[0]) and _may_be_open(pou, section.section):
        t = open_array(scope, spec)
    else:
        t = resolve_type(scope, spec)
    if t is not UNKNOWN and not _may_hold(scope, pou, section, declaration, t):
        t = UNKNOWN
    initial = _initial(scope, section, declaration, t)
    may_have_edge = _may_have_edge(scope, pou, section, declaration, t)
    for name in declaration.names:
        if name.key in scope.locals:
            report_duplicate(scope.world, name, scope.locals[name.key].span)
            continue
        variable = _variable(section, declaration, name, t, initial)
        variable.owner = pou
        pou.variables[name.key] = variable
        if isinstance(t, OpenArrayType):
            variable.limits = tuple(_limits(pou, variable, number + 1) for number in range(t.dimensions))
        scope.locals[name.key] = variable
        _check_control(scope, variable)
        if declaration.edge is not None and may_have_edge:
            _add_edge(pou, variable, declaration.edge)
        if t is not UNKNOWN and isinstance(unaliased(t), BlockType):
            _check_instance_name(scope, pou, name)
        if section.section is Section.EXTERNAL:
            _bind_external(scope, variable)
        if declaration.location is not None:
            if pou.kind is PouKind.PROGRAM and section.section is Section.VAR:
                _locate(scope, declaration.location, variable)
            else:
                _no_address(scope, pou, declaration.location)


def _may_be_open(pou: Pou, section: Section) -> bool:
    """Whether ARRAY[*] may stand there (6.5.3)."""
    if pou.kind is PouKind.FUNCTION:
        return section in (Section.INPUT, Section.OUTPUT, Section.IN_OUT)
    return pou.kind is PouKind.FUNCTION_BLOCK and section is Section.IN_OUT


def _limits(pou: Pou, variable: Variable, dimension: int) -> tuple[Variable, Variable]:
    """What holds the limits of a dimension of an ARRAY[*]. The names are none that a program can write."""
    low, high = (
        Variable(f"{variable.name} {what} {dimension}", DINT, None, variable.span, 0, owner=pou)
        for what in ("low", "high")
    )
    pou.variables |= {low.key: low, high.key: high}
    return low, high


def _variable(
    section: tree.VarSection, declaration: tree.VarDecl, name: tree.Name, t: Type, initial: Value
) -> Variable:
    return Variable(name.text, t, section.section, name.span, initial, section.constant, _RETENTION[section.retention])


def _initial(scope: Scope, section: tree.VarSection, declaration: tree.VarDecl, t: Type) -> Value:
    if declaration.initial is not None and section.section in (Section.EXTERNAL, Section.IN_OUT):
        what = "an in-out is the caller's variable" if section.section is Section.IN_OUT else "the VAR_GLOBAL has it"
        scope.diagnostics.add(
            "E0701", f"{section.section.value} has no initial values: {what}.", declaration.initial.span
        )
        return 0
    if section.section in (Section.EXTERNAL, Section.IN_OUT):
        return default_value(t) if t is not UNKNOWN else 0
    return initial_value(scope, t, declaration.initial)


# ------------------------------------------------------------------------------------------------- EN and ENO

_CONTROLS = {"en": ("EN", Section.INPUT), "eno": ("ENO", Section.OUTPUT)}


def _check_control(scope: Scope, variable: Variable) -> None:
    """EN and ENO mean one thing in every call, so a POU can declare them in one way only (6.6.1.5)."""
    parameters = (Section.INPUT, Section.OUTPUT, Section.IN_OUT)
    if variable.key not in _CONTROLS or variable.section not in parameters or variable.type is UNKNOWN:
        return
    name, section = _CONTROLS[variable.key]
    if variable.section is not section or variable.type is not BOOL:
        message = f"{name} is declared in {section.value}, as BOOL, or not at all."
        hint = "Every function and block has EN and ENO. Give another variable another name."
        scope.diagnostics.add("E0713", message, variable.span, hint)


# ------------------------------------------------------------------------------------------------------ edges


def _may_have_edge(scope: Scope, pou: Pou, section: tree.VarSection, declaration: tree.VarDecl, t: Type) -> bool:
    """Whether R_EDGE or F_EDGE is right here: only at a BOOL input of what keeps its values (6.6.3.2)."""
    if declaration.edge is None or t is UNKNOWN:
        return False
    word = declaration.edge.value
    if t is not BOOL:
        why = f"{word} goes with BOOL, and this is {t}"
    elif section.section is not Section.INPUT:
        why = f"{word} goes with VAR_INPUT, and this is {section.section.value}"
    elif pou.kind is PouKind.FUNCTION:
        why = f"a FUNCTION keeps nothing between calls: it cannot have {word}"
    else:
        return True
    hint = "Find the edge with an instance of R_TRIG or F_TRIG in a PROGRAM or FUNCTION_BLOCK."
    scope.diagnostics.add("E0710", f"{why[0].upper()}{why[1:]}.", declaration.span, hint)
    return False


def _add_edge(pou: Pou, variable: Variable, edge: tree.Edge) -> None:
    """The memory of the edge; no name of a program can be that of it, as none has two `_` in a row (6.1.2)."""
    name = f"__{variable.name}"
    memory = Variable(name, BOOL, Section.VAR, variable.span, 0, retain=variable.retain, owner=pou)
    pou.variables[memory.key] = memory
    pou.edges.append(EdgeInput(variable, edge, memory))


# -------------------------------------------------------------------------------------------------- instances


def _may_hold(scope: Scope, pou: Pou, section: tree.VarSection, declaration: tree.VarDecl, t: Type) -> bool:
    """Whether a variable of the type may stand in the section; instances of blocks may not everywhere (6.6.3.2)."""
    if section.section is Section.IN_OUT and isinstance(unaliased(t), RefType):
        # 6.4.4.10.3
        scope.diagnostics.add(
            "E0712",
            "A reference cannot stand in VAR_IN_OUT.",
            declaration.span,
            "Give it to VAR_INPUT: what it refers to can be written there, too.",
        )
        return False
    blocks = list(_blocks_in(t))
    if not blocks or section.section in (Section.IN_OUT, Section.EXTERNAL):
        return True
    if section.section in (Section.INPUT, Section.OUTPUT):
        scope.diagnostics.add(
            "E0915",
            f"An instance of a block in {section.section.value} is not supported yet.",
            declaration.span,
            "VAR_IN_OUT can take one.",
        )
        return False
    if section.constant or section.section is Section.TEMP or pou.kind is PouKind.FUNCTION:
        where = "a FUNCTION" if pou.kind is PouKind.FUNCTION else section.section.value
        _no_instance(scope, declaration.span, "a CONSTANT section" if section.constant else where)
        return False
    for block in blocks:
        key = block.pou.name.casefold()
        if f"pou {key}" in scope.world.active:
            scope.diagnostics.add(
                "E0705",
                f"`{block.name}` contains an instance of itself.",
                declaration.span,
                "Pass the other instance as VAR_IN_OUT.",
            )
            return False
        declare_pou(scope.world, key)
    return True


def _blocks_in(t: Type) -> Iterator[BlockType]:
    while isinstance(t, (AliasType, ArrayType, OpenArrayType)):
        t = t.target if isinstance(t, AliasType) else t.element
    if isinstance(t, BlockType):
        yield t
    elif isinstance(t, StructType):
        for field in t.fields.values():
            yield from _blocks_in(field.type)


def _no_instance(scope: Scope, span: Span, where: str) -> None:
    scope.diagnostics.add(
        "E0703",
        f"An instance of a block cannot stand in {where}: it must keep its values.",
        span,
        "Declare it in VAR of a PROGRAM or FUNCTION_BLOCK.",
    )


def _check_instance_name(scope: Scope, pou: Pou, name: tree.Name) -> None:
    function = scope.world.pou_declarations.get(name.key)
    if function is not None and function.kind is PouKind.FUNCTION:
        scope.diagnostics.add(
            "E0706",
            f"The instance `{name.text}` has the name of a function.",
            name.span,
            "Give it another name.",
            [Related(function.name.span, "The function is here.")],
        )


# --------------------------------------------------------------------------------------- external and located


def _bind_external(scope: Scope, variable: Variable) -> None:
    """VAR_EXTERNAL means the global variable of its name, with its type (6.5.2.2)."""
    target = global_variable(scope.world, variable.key)
    if target is None:
        near = suggest(variable.name, (d.name.text for d in scope.world.global_declarations.values()))
        hint = f"Did you mean `{near}`?" if near else f"Declare it in VAR_GLOBAL {variable.name} : … ; END_VAR."
        scope.diagnostics.add("E0209", f"There is no global variable `{variable.name}`.", variable.span, hint)
        variable.type = UNKNOWN
        return
    where = [Related(target.span, "The global variable is declared here.")]
    if UNKNOWN not in (target.type, variable.type) and not same_type(target.type, variable.type):
        scope.diagnostics.add(
            "E0311",
            f"`{variable.name}` is {target.type}, and here it is {variable.type}.",
            variable.span,
            f"Write {target.type}.",
            where,
        )
        variable.type = UNKNOWN
        return
    if target.constant and not variable.constant:
        scope.diagnostics.add(
            "E0511",
            f"The global variable `{variable.name}` is a constant.",
            variable.span,
            "Declare it in VAR_EXTERNAL CONSTANT.",
            where,
        )
    variable.target = target
    variable.initial = target.initial


def _no_address(scope: Scope, pou: Pou, location: tree.DirectVariable) -> None:
    if is_complete(location):
        scope.diagnostics.add(
            "E0704",
            f"A variable of the {pou.kind.value} `{pou.name}` cannot have an address here.",
            location.span,
            "Addresses belong in VAR of a PROGRAM and in VAR_GLOBAL.",
        )


def _locate(scope: Scope, location: tree.DirectVariable, variable: Variable) -> None:
    if not is_complete(location):
        return
    if variable.type is not UNKNOWN and (what := _without_address(variable.type)):
        scope.diagnostics.add("E0704", f"{what} has no address.", location.span)
        return
    variable.address = location.text
    scope.world.located.append(variable)


def _without_address(t: Type) -> str | None:
    """What a variable of the type is or holds that cannot stand at an address."""
    if holds_instance(t):
        return "An instance of a block"
    return "A reference" if holds_reference(t) else None


def _unnamed(scope: Scope, declaration: tree.VarDecl) -> None:
    """`AT %QW5 : WORD := 16#FF00;`"""
    location = declaration.location
    assert location is not None
    t = resolve_type(scope, declaration.type)
    if t is UNKNOWN or not is_complete(location):
        return
    variable = unnamed_variable(
        scope.world, location, t, initial_value(scope, t, declaration.initial), declaration.span
    )
    scope.world.located.append(variable)
