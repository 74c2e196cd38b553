"""FOR, WHILE and REPEAT as one kind of loop, with a count of passes where no bound is proven."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from iec2mpy.ir import nodes as n
from iec2mpy.ir.build.checks import check_range, outside
from iec2mpy.ir.build.context import FALSE, TRUE, Context
from iec2mpy.ir.build.expressions import lower_all, lower_expr, stored_type
from iec2mpy.ir.build.packed import PackedPlace
from iec2mpy.ir.build.places import lower_place
from iec2mpy.ir.build.stores import assign
from iec2mpy.semantics import typed as t
from iec2mpy.semantics import types as ty

_LARGE = 100
"""A FOR with more statements than that keeps its control variable in its slot only."""

LowerBlock = Callable[[Context, Iterable[t.Stmt]], None]

_UNCOUNTED_PASSES = 1000
"""A FOR with at most so many passes, none of them holding another loop, needs no count."""


def lower_while(context: Context, statement: t.While, lower_block: LowerBlock) -> None:
    with context.block() as body:
        context.emit(n.Tick(context.site))
        condition = lower_expr(context, statement.condition)
        simple = len(body) == 1
        if not simple:
            context.emit(n.If(n.Not(condition, ty.BOOL), (n.Break(),), ()))
        lower_block(context, statement.body)
    context.emit(n.While(condition if simple else TRUE, tuple(body)))


def lower_repeat(context: Context, statement: t.Repeat, lower_block: LowerBlock) -> None:
    """CONTINUE goes on with the condition, so a loop that has one tests it at the top, from the second pass on."""
    at_top = _has(statement.body, t.Continue)
    again = context.new_local(ty.BOOL, 0, 1)
    if at_top:
        context.emit(n.SetLocal(again, FALSE))
    with context.block() as body:
        context.emit(n.Tick(context.site))
        if at_top:
            with context.block() as test:
                _break_if(context, statement.until)
            context.emit(n.If(again, tuple(test), ()))
            context.emit(n.SetLocal(again, TRUE))
        lower_block(context, statement.body)
        if not at_top:
            _break_if(context, statement.until)
    context.emit(n.While(TRUE, tuple(body)))


def _break_if(context: Context, condition: t.Expr) -> None:
    context.line(condition.span)
    context.emit(n.If(lower_expr(context, condition), (n.Break(),), ()))


def lower_for(context: Context, statement: t.For, lower_block: LowerBlock) -> None:
    """Bounds and step are evaluated once. The control variable ends with the first value that is not inside."""
    control = lower_place(context, statement.control, lower_expr)
    value_type = stored_type(statement.control.type)
    assert isinstance(value_type, ty.ElementaryType)
    start, end, step = (
        v if isinstance(v, n.Const) else context.spill(v)
        for v in lower_all(context, (statement.start, statement.end, statement.step))
    )
    if not isinstance(step, n.Const) or step.number == 0:
        _for_any_step(context, statement, control, start, end, step, lower_block)
        return
    upwards = step.number > 0
    # the next value of a narrow counter fits a machine word, and then no test can overflow
    headroom = value_type.bits < 32 or (isinstance(end, n.Const) and _fits(end.number + step.number, value_type))
    low, high = (start, end) if upwards else (end, start)
    next_value = _counter(context, value_type, start, end, step.number) if headroom else context.new_local(value_type)
    current = context.new_local(value_type, _lowest(low, value_type), _highest(high, value_type))
    go_on = context.new_local(ty.BOOL, 0, 1)
    context.emit(n.SetLocal(next_value, start))
    inside = n.Op("le" if upwards else "ge", next_value, end, ty.BOOL)
    if not headroom:
        context.emit(n.SetLocal(go_on, inside))
        inside = go_on
    with context.block() as body:
        if not _is_bounded(statement, start, end, step):
            context.emit(n.Tick(context.site))
        _give_control(context, control, next_value, inside)
        context.emit(n.SetLocal(current, next_value))
        if not headroom:
            context.emit(n.SetLocal(go_on, _room(next_value, end, step, upwards)))
        advanced = n.Op("add", next_value, n.Const(step.number, next_value.type), next_value.type)
        context.emit(n.SetLocal(next_value, n.Wrap(advanced, next_value.type)))
        if _is_large(statement.body):
            lower_block(context, statement.body)
        else:
            with context.bound(statement.control, current):
                lower_block(context, statement.body)
    context.emit(n.While(TRUE, tuple(body)))


def _for_any_step(
    context: Context,
    statement: t.For,
    control: n.Place | PackedPlace,
    start: n.Expr,
    end: n.Expr,
    step: n.Expr,
    lower_block: LowerBlock,
) -> None:
    """The step's sign is known only at run time. What is left to go is compared with the step, without a sign: so no
    test can overflow."""
    value_type = start.type
    next_value, go_on = context.new_local(value_type), context.new_local(ty.BOOL, 0, 1)
    upwards = context.spill(n.Op("ge", step, n.Const(0, value_type), ty.BOOL))
    below, above = n.Op("le", next_value, end, ty.BOOL), n.Op("ge", next_value, end, ty.BOOL)
    context.emit(n.SetLocal(next_value, start))
    context.emit(n.SetLocal(go_on, n.Select(upwards, below, above, ty.BOOL)))
    with context.block() as body:
        context.emit(n.Tick(context.site))
        _give_control(context, control, next_value, go_on)
        room = n.Select(upwards, _room(next_value, end, step, True), _room(next_value, end, step, False), ty.BOOL)
        context.emit(n.SetLocal(go_on, room))
        context.emit(n.SetLocal(next_value, n.Wrap(n.Op("add", next_value, step, value_type), value_type)))
        lower_block(context, statement.body)
    context.emit(n.While(TRUE, tuple(body)))


def _give_control(context: Context, control: n.Place | PackedPlace, value: n.Local, inside: n.Expr) -> None:
    """The next value for the control variable, and the end of the loop. One of a subrange never has another value: a
    pass with one faults, and where the first value that is not inside is none of its own, it keeps the last."""
    declared, value_type = control.type, stored_type(control.type)
    with context.block() as stores:
        assign(context, control, value_type, n.Wrap(value, value_type))
    if not isinstance(declared, ty.SubrangeType):
        context.emit_all(stores)
        context.emit(n.If(n.Not(inside, ty.BOOL), (n.Break(),), ()))
        return
    last = n.If(n.Not(outside(value, declared.low, declared.high), ty.BOOL), tuple(stores), ())
    context.emit(n.If(n.Not(inside, ty.BOOL), (last, n.Break()), ()))
    check_range(context, value, declared.low, declared.high, "range")
    context.emit_all(stores)


def _room(value: n.Expr, end: n.Expr, step: n.Expr, upwards: bool) -> n.Expr:
    """Whether another step stays inside: the way left, as an unsigned number, is at least a step."""
    left, right = (end, value) if upwards else (value, end)
    unsigned = ty.ULINT if value.type.in_objects else ty.UDINT
    way = n.Wrap(n.Op("sub", left, right, value.type), unsigned)
    if isinstance(step, n.Const):
        size: n.Expr = n.Const(abs(step.number), unsigned)
    else:
        size = n.Wrap(step if upwards else n.Op("sub", n.Const(0, step.type), step, step.type), unsigned)
    return n.Op("ge", way, size, ty.BOOL)


def _counter(context: Context, value_type: ty.ElementaryType, start: n.Expr, end: n.Expr, step: int) -> n.Local:
    """The local that counts: from the start to one step beyond the end."""
    bounds = [_lowest(start, value_type), _highest(start, value_type)]
    bounds += [_lowest(end, value_type) + step, _highest(end, value_type) + step]
    counted = ty.DINT if value_type.bits < 32 else value_type
    return context.new_local(counted, min(bounds), max(bounds))


def _fits(value: int, value_type: ty.ElementaryType) -> bool:
    return value_type.low <= value <= value_type.high


def _lowest(value: n.Expr, value_type: ty.ElementaryType) -> int:
    return value.number if isinstance(value, n.Const) else value_type.low


def _highest(value: n.Expr, value_type: ty.ElementaryType) -> int:
    return value.number if isinstance(value, n.Const) else value_type.high


def _is_bounded(statement: t.For, start: n.Expr, end: n.Expr, step: n.Const) -> bool:
    if not (isinstance(start, n.Const) and isinstance(end, n.Const)):
        return False
    passes = (end.number - start.number) // step.number + 1
    return passes <= _UNCOUNTED_PASSES and not _has(statement.body, t.For, t.While, t.Repeat, through_loops=True)


def _is_large(body: Iterable[t.Stmt]) -> bool:
    """Whether the backends may have to split the body: in several functions it has no locals in common."""
    return sum(1 for _ in _all(body)) > _LARGE


def _all(body: Iterable[t.Stmt]) -> Iterator[t.Stmt]:
    """The statements, and those inside of them."""
    for statement in body:
        yield statement
        for block in _inner(statement):
            yield from _all(block)


def _inner(statement: t.Stmt) -> list[tuple[t.Stmt, ...]]:
    match statement:
        case t.If(branches, otherwise):
            return [block for _, block in branches] + [otherwise]
        case t.Case(_, groups, otherwise):
            return [block for _, block in groups] + [otherwise]
        case t.For() | t.While() | t.Repeat():
            return [statement.body]
        case _:
            return []


def _has(body: Iterable[t.Stmt], *kinds: type, through_loops: bool = False) -> bool:
    """Whether the statements, or those inside of their branches, have one of a kind."""
    for statement in body:
        if isinstance(statement, kinds):
            return True
        if isinstance(statement, (t.For, t.While, t.Repeat)) and not through_loops:
            continue
        if any(_has(block, *kinds, through_loops=through_loops) for block in _inner(statement)):
            return True
    return False
