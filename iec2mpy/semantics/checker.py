"""From the trees of all files to a checked program."""

from __future__ import annotations

from collections.abc import Sequence

from iec2mpy.semantics.configuration import tasks_and_programs
from iec2mpy.semantics.declarations import collect_globals, declare_globals, declare_pou, report_duplicate
from iec2mpy.semantics.overlaps import share_storage
from iec2mpy.semantics.recursion import report_recursion
from iec2mpy.semantics.scope import GlobalScope, Scope
from iec2mpy.semantics.signatures import typed_block_names
from iec2mpy.semantics.statements import check_body
from iec2mpy.semantics.type_specs import named_type
from iec2mpy.semantics.typed import Application, Pou
from iec2mpy.semantics.types import BlockType
from iec2mpy.source.diagnostics import Diagnostics, Severity
from iec2mpy.syntax import tree
from iec2mpy.syntax.tree import PouKind


def check(
    units: Sequence[tree.CompilationUnit], diagnostics: Diagnostics, interval_us: int = 10_000
) -> Application | None:
    """The checked program, or None where `diagnostics` has errors.

    `units` are those of all files, of the standard blocks that the program uses, too (`stdlib.stdlib_files`).
    `interval_us` is the period of the implicit task, where there is no CONFIGURATION.
    """
    unread = [d for d in diagnostics.items if d.severity is Severity.ERROR]
    if any(d.code.startswith("E09") for d in unread):
        return None  # a part of the language that is not there yet: all that could be said follows from that
    found = Diagnostics()
    application = _checked(units, found, interval_us)
    for d in found.items:
        if not (unread and d.code in _FOLLOWING):
            diagnostics.add(d.code, d.message, d.span, d.hint, d.related)
    return None if diagnostics.has_errors else application


_FOLLOWING = frozenset(
    [
        "E0201",
        "E0203",
        "E0204",
        "E0206",
        "E0207",
        "E0208",
        "E0209",
        "E0401",
        "E0403",
        "E0404",
        "E0405",
        "E0411",
        "W0701",
    ]
)
"""What is only said of a program that could be read completely: the declaration that is missing may be one that could
not be read."""


def _checked(units: Sequence[tree.CompilationUnit], diagnostics: Diagnostics, interval_us: int) -> Application | None:
    world = GlobalScope(diagnostics)
    sections = _collect(world, units)
    for key in world.type_declarations:
        named_type(world, key)
    declare_globals(world, sections)
    for key, declaration in world.pou_declarations.items():
        if not declaration.span.file.is_stdlib:
            declare_pou(world, key)
    _check_bodies(world)
    report_recursion(world)
    storages = share_storage(world)
    tasks, programs = tasks_and_programs(world, interval_us)
    if diagnostics.has_errors:
        return None
    pous = [scope.pou for scope in world.scopes.values() if scope.pou is not None]
    return Application(world.globals, world.direct, storages, pous, tasks, programs)


# --------------------------------------------------------------------------------------------------- collecting


def _collect(world: GlobalScope, units: Sequence[tree.CompilationUnit]) -> list[tree.VarSection]:
    """Note all names. Standard blocks come last: a block of the user with such a name takes its place."""
    declarations = [declaration for unit in units for declaration in unit.declarations]
    sections: list[tree.VarSection] = []
    for declaration in sorted(declarations, key=lambda d: d.span.file.is_stdlib):
        if isinstance(declaration, tree.TypeDecl):
            if _is_new(world, declaration.name):
                world.type_declarations[declaration.name.key] = declaration
        elif isinstance(declaration, tree.PouDecl):
            _collect_pou(world, declaration)
        elif isinstance(declaration, tree.ConfigurationDecl):
            world.configurations.append(declaration)
            for section in (*declaration.sections, *(s for r in declaration.resources for s in r.sections)):
                collect_globals(world, section, shared=False)
                sections.append(section)
        else:
            collect_globals(world, declaration, shared=True)
            sections.append(declaration)
    for typed, plain in typed_block_names().items():
        block = world.block_types.get(plain.casefold())
        if block is not None and block.pou.span.file.is_stdlib:
            world.block_types.setdefault(typed.casefold(), block)
    return sections


def _is_new(world: GlobalScope, name: tree.Name) -> bool:
    first = world.type_declarations.get(name.key) or world.pou_declarations.get(name.key)
    if first is None:
        return True
    if not name.span.file.is_stdlib:
        report_duplicate(world, name, first.name.span)
    return False


def _collect_pou(world: GlobalScope, declaration: tree.PouDecl) -> None:
    if not _is_new(world, declaration.name):
        return
    key = declaration.name.key
    pou = Pou(declaration.kind, declaration.name.text, declaration.name.span)
    world.pou_declarations[key] = declaration
    world.pous[key] = pou
    for section in declaration.sections:
        if section.section is tree.Section.GLOBAL and declaration.kind is PouKind.PROGRAM:
            hint = "Write it outside of POUs."
            world.diagnostics.add("E0915", "VAR_GLOBAL in a PROGRAM is not supported yet.", section.span, hint)
            collect_globals(world, section, shared=False)
    if declaration.kind is PouKind.FUNCTION_BLOCK:
        world.block_types[key] = BlockType(pou.name, pou)


# ------------------------------------------------------------------------------------------------------- bodies


def _check_bodies(world: GlobalScope) -> None:
    """The bodies of all POUs; those of standard blocks only where they are used, which other bodies may show."""
    checked: set[str] = set()
    while pending := [key for key in world.scopes if key not in checked]:
        for key in pending:
            checked.add(key)
            _check_body(world, world.scopes[key], world.pou_declarations[key])


def _check_body(world: GlobalScope, scope: Scope, declaration: tree.PouDecl) -> None:
    pou = world.pous[declaration.name.key]
    pou.body = check_body(scope, declaration.body)
    if pou.result is not None and not scope.result_assigned and declaration.body:
        # 7.3.3.2: the result is assigned at least once
        world.diagnostics.add(
            "W0701",
            f"The function `{pou.name}` never gives its result a value.",
            declaration.name.span,
            f"Write {pou.name} := …; in its body.",
        )
