"""Configurations: tasks, and the programs that they run (6.8); without one, a task of its own runs all programs."""

from __future__ import annotations

from collections.abc import Sequence

from iec2mpy.semantics.coercion import describe
from iec2mpy.semantics.conversions import UNTYPED_INT, is_integer
from iec2mpy.semantics.declarations import report_duplicate
from iec2mpy.semantics.expressions import check
from iec2mpy.semantics.scope import GlobalScope, Scope
from iec2mpy.semantics.typed import Constant, Pou, ProgramInstance, Task
from iec2mpy.semantics.types import TIME, UINT, Type
from iec2mpy.source.suggest import suggest
from iec2mpy.syntax import tree
from iec2mpy.syntax.tree import PouKind, Retention

_MICROSECONDS = 1000
"""In a millisecond, the unit of TIME."""
MAX_PRIORITY = 65_535


def tasks_and_programs(world: GlobalScope, interval_us: int) -> tuple[list[Task], list[ProgramInstance]]:
    """What the configuration says, or else one task "main" with the period `interval_us` over all programs."""
    programs = [pou for pou in world.pous.values() if pou.kind is PouKind.PROGRAM]
    if not world.configurations:
        return _implicit(programs, interval_us)
    configuration = world.configurations[0]
    for other in world.configurations[1:]:
        _not_yet(world, "A second CONFIGURATION", other.name)
    for other in configuration.resources[1:]:
        _not_yet(world, "A second RESOURCE", other.name or configuration.name)
    if not configuration.resources:
        return [], []
    resource = configuration.resources[0]
    tasks = _tasks(world, resource.tasks)
    return list(tasks.values()), _programs(world, resource.programs, tasks)


def _implicit(programs: Sequence[Pou], interval_us: int) -> tuple[list[Task], list[ProgramInstance]]:
    if not programs:
        return [], []
    task = Task("main", interval_us, 0, programs[0].span)
    return [task], [ProgramInstance(pou.name, pou, task, pou.span) for pou in programs]


def _not_yet(world: GlobalScope, what: str, name: tree.Name) -> None:
    world.diagnostics.add("E0918", f"{what} is not supported yet.", name.span)


# -------------------------------------------------------------------------------------------------------- tasks


def _tasks(world: GlobalScope, declarations: Sequence[tree.TaskDecl]) -> dict[str, Task]:
    tasks: dict[str, Task] = {}
    for declaration in declarations:
        first = tasks.get(declaration.name.key)
        if first is not None:
            report_duplicate(world, declaration.name, first.span)
            continue
        # a task that is wrong is kept, so that programs WITH it are not reported, too
        tasks[declaration.name.key] = _task(world, declaration)
    return tasks


def _task(world: GlobalScope, declaration: tree.TaskDecl) -> Task:
    given: dict[str, tree.Argument] = {}
    single = False
    for argument in declaration.arguments:
        name = argument.name.text.upper() if argument.name else ""
        if name == "SINGLE":
            world.diagnostics.add("E0918", "A task that an event starts (SINGLE) is not supported yet.", argument.span)
            single = True
        elif name not in ("INTERVAL", "PRIORITY"):
            world.diagnostics.add(
                "E0401",
                f"A task has no `{argument.name.text if argument.name else argument.span.text}`.",
                argument.span,
                "It has INTERVAL and PRIORITY.",
            )
        elif name in given:
            world.diagnostics.add("E0402", f"{name} is given twice.", argument.span)
        else:
            given[name] = argument
    if "INTERVAL" not in given and not single:  # that PRIORITY is there is a matter of the grammar (table 63)
        world.diagnostics.add(
            "E0801",
            f"The task `{declaration.name.text}` has no INTERVAL.",
            declaration.span,
            "Write INTERVAL := T#10ms.",
        )
    interval = _interval(world, given.get("INTERVAL"))
    priority = _priority(world, given.get("PRIORITY"))
    return Task(declaration.name.text, interval, priority, declaration.name.span)


def _value(world: GlobalScope, argument: tree.Argument | None, t: Type) -> tuple[Constant, tree.Expr] | None:
    if argument is None or argument.value is None:
        return None
    value = check(Scope(world), argument.value, t)
    if value is None:
        return None
    if not isinstance(value, Constant):
        world.diagnostics.add("E0918", "A task whose settings are variables is not supported yet.", argument.value.span)
        return None
    return value, argument.value


def _interval(world: GlobalScope, argument: tree.Argument | None) -> int:
    """In microseconds; 0 where it is wrong."""
    found = _value(world, argument, TIME)
    if found is None:
        return 0
    value, expr = found
    if value.type is not TIME:
        hint = f"Write T#{expr.span.text}ms." if value.type is UNTYPED_INT else None
        world.diagnostics.add("E0301", f"INTERVAL is TIME, but this is {describe(value.type)}.", expr.span, hint)
        return 0
    if int(value.value) <= 0:
        world.diagnostics.add("E0802", "A task needs an INTERVAL of at least 1 ms.", expr.span)
    return int(value.value) * _MICROSECONDS


def _priority(world: GlobalScope, argument: tree.Argument | None) -> int:

    found = _value(world, argument, UINT)
    if found is None:
        return 0
    value, expr = found
    if not (value.type is UNTYPED_INT or is_integer(value.type)) or not 0 <= int(value.value) <= MAX_PRIORITY:
        world.diagnostics.add("E0802", f"A PRIORITY is a number from 0 (most urgent) to {MAX_PRIORITY}.", expr.span)
        return 0
    return int(value.value)


# ----------------------------------------------------------------------------------------------------- programs


def _programs(
    world: GlobalScope, declarations: Sequence[tree.ProgramDecl], tasks: dict[str, Task]
) -> list[ProgramInstance]:
    instances: dict[str, ProgramInstance] = {}
    for declaration in declarations:
        name = declaration.name
        if name.key in instances:
            report_duplicate(world, name, instances[name.key].span)
            continue
        pou = _program_type(world, declaration.type)
        task = tasks.get(declaration.task.key) if declaration.task is not None else None
        if declaration.task is not None and task is None:
            near = suggest(declaration.task.text, (t.name for t in tasks.values()))
            world.diagnostics.add(
                "E0201",
                f"There is no task `{declaration.task.text}`.",
                declaration.task.span,
                f"Did you mean `{near}`?"
                if near
                else f"Declare it: TASK {declaration.task.text}(INTERVAL := T#10ms, PRIORITY := 1);",
            )
        for connection in declaration.connections:
            world.diagnostics.add("E0918", "Connections of a program are not supported yet.", connection.span)
        if pou is not None:
            retain = None if declaration.retention is None else declaration.retention is Retention.RETAIN
            instances[name.key] = ProgramInstance(name.text, pou, task, name.span, retain)
    return list(instances.values())


def _program_type(world: GlobalScope, name: tree.Name) -> Pou | None:
    pou = world.pous.get(name.key)
    if pou is not None and pou.kind is PouKind.PROGRAM:
        return pou
    known = [p.name for p in world.pous.values() if p.kind is PouKind.PROGRAM]
    near = suggest(name.text, known)
    message = f"There is no PROGRAM `{name.text}`."
    if pou is not None:
        message = f"`{name.text}` is a {pou.kind.value}, and no PROGRAM."
    world.diagnostics.add("E0203", message, name.span, f"Did you mean `{near}`?" if near else None)
    return None
