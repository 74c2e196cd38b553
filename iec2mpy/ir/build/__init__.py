"""From the checked program to the IR."""

from __future__ import annotations

from iec2mpy.ir import nodes as n
from iec2mpy.ir.build.context import TRUE, Context
from iec2mpy.ir.build.edges import find_edge
from iec2mpy.ir.build.places import storage_place
from iec2mpy.ir.build.statements import lower_block
from iec2mpy.ir.build.stores import assign_initial, fill_initial
from iec2mpy.ir.walk import statements
from iec2mpy.semantics import typed as t
from iec2mpy.syntax.tree import PouKind, Section


def build(application: t.Application) -> n.Module:
    """The IR of every POU that the programs reach."""
    bodies: dict[t.Pou, n.Body] = {}
    for program in application.programs:
        _build_reached(program.pou, bodies)
    return n.Module(
        (*application.globals.values(), *application.direct.values()),
        tuple(application.storages),
        tuple(application.tasks),
        tuple(n.ProgramRun(p.name, p.pou, p.task, bool(p.retain)) for p in application.programs),
        bodies,
    )


def _build_reached(pou: t.Pou, bodies: dict[t.Pou, n.Body]) -> None:
    """Callees first; the checker has refused circles of calls."""
    if pou in bodies:
        return
    body = _build_body(pou)
    for statement in statements(body.block):
        if isinstance(statement, n.Call):
            _build_reached(statement.pou, bodies)
    bodies[pou] = body


def _build_body(pou: t.Pou) -> n.Body:
    context = Context(pou)
    for variable in _fresh_variables(pou):
        if variable.by_reference:
            fill_initial(context, variable)
        else:
            assign_initial(context, storage_place(variable))
    if pou.en is not None and pou.kind is not PouKind.PROGRAM:
        # 6.6.1.5, rules 1 and 5: the body runs only where the call has not given FALSE
        context.values[pou.en] = TRUE
    if pou.eno is not None:
        # 6.6.1.5, rule 2: TRUE unless the body says otherwise
        context.emit(n.Store(storage_place(pou.eno), TRUE))
    for edge in pou.edges:
        find_edge(context, edge)
    lower_block(context, pou.body)
    return n.Body(pou, context.statements, context.locals, tuple(context.hidden))


def _fresh_variables(pou: t.Pou) -> list[t.Variable]:
    """What starts anew at each call: VAR_TEMP, and of a function everything that is not passed in (6.6.2.2)."""
    sections = {Section.TEMP}
    if pou.kind is PouKind.FUNCTION:
        sections |= {Section.VAR, Section.OUTPUT}
    fresh = [v for v in pou.variables.values() if v.section in sections and not v.constant]
    return [*fresh, pou.result] if pou.result is not None else fresh
