"""Ways through the IR: rebuild it from the leaves up, or look at all of it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

from iec2mpy.ir import nodes as n
from iec2mpy.ir.intrinsics import INTRINSICS

Rewrite = Callable[[n.Expr], n.Expr]


def map_expr(expr: n.Expr, rewrite: Rewrite) -> n.Expr:
    """The expression with `rewrite` applied to each part, parts first."""
    match expr:
        case n.Const() | n.Local() | n.Now():
            return rewrite(expr)
        case n.Load(place) | n.Ref(place):
            new = map_place(place, rewrite)
            return rewrite(expr if new is place else replace(expr, place=new))
        case n.Op(_, left, right):
            new_left, new_right = map_expr(left, rewrite), map_expr(right, rewrite)
            same = new_left is left and new_right is right
            return rewrite(expr if same else n.Op(expr.name, new_left, new_right, expr.type))
        case n.Not(operand) | n.Wrap(operand) | n.ToReal(operand):
            new = map_expr(operand, rewrite)
            return rewrite(expr if new is operand else replace(expr, operand=new))
        case n.Select(condition, then, otherwise):
            parts = (map_expr(condition, rewrite), map_expr(then, rewrite), map_expr(otherwise, rewrite))
            return rewrite(n.Select(*parts, expr.type))
        case n.Intrinsic(name, arguments):
            return rewrite(n.Intrinsic(name, tuple(map_expr(a, rewrite) for a in arguments), expr.type))


def map_place(place: n.Place, rewrite: Rewrite) -> n.Place:
    """The place with its subscripts rewritten."""
    root = place.root
    if isinstance(root, n.Deref):
        reference = map_expr(root.reference, rewrite)
        root = root if reference is root.reference else n.Deref(reference, root.type)
    steps = place.steps
    if any(isinstance(step, n.Element) for step in steps):
        steps = tuple(n.Element(map_expr(s.index, rewrite)) if isinstance(s, n.Element) else s for s in steps)
    if root is place.root and steps is place.steps:
        return place
    return n.Place(root, steps, place.type)


def map_statement_exprs(statement: n.Stmt, rewrite: Rewrite) -> n.Stmt:
    """The statement with its own expressions rewritten; blocks inside of it are left as they are."""
    match statement:
        case n.Store(place, value):
            return n.Store(map_place(place, rewrite), map_expr(value, rewrite))
        case n.SetLocal(local, value):
            return n.SetLocal(local, map_expr(value, rewrite))
        case n.Copy(target, source):
            return n.Copy(map_place(target, rewrite), map_place(source, rewrite))
        case n.Compare(local, left, right):
            return n.Compare(local, map_place(left, rewrite), map_place(right, rewrite))
        case n.Bind(reference, target):
            return n.Bind(map_place(reference, rewrite), map_place(target, rewrite))
        case n.Reset(place, value):
            return n.Reset(map_place(place, rewrite), value)
        case n.Call(pou, instance) if instance is not None:
            return n.Call(pou, map_place(instance, rewrite))
        case n.Guard(condition, fault, site):
            return n.Guard(map_expr(condition, rewrite), fault, site)
        case n.If(condition, then, otherwise):
            return n.If(map_expr(condition, rewrite), then, otherwise)
        case n.While(condition, body):
            return n.While(map_expr(condition, rewrite), body)
        case _:
            return statement


def map_statement_places(statement: n.Stmt, rewrite: Callable[[n.Place], n.Place]) -> n.Stmt:
    """The statement with every place in it rewritten, those in its expressions too; inner blocks are left alone. The
    reference that a place is reached by is rewritten before the place."""

    def in_expr(expr: n.Expr) -> n.Expr:
        return replace(expr, place=rewrite(expr.place)) if isinstance(expr, (n.Load, n.Ref)) else expr

    statement = map_statement_exprs(statement, in_expr)
    match statement:
        case n.Store(place, value):
            return n.Store(rewrite(place), value)
        case n.Copy(target, source):
            return n.Copy(rewrite(target), rewrite(source))
        case n.Compare(local, left, right):
            return n.Compare(local, rewrite(left), rewrite(right))
        case n.Bind(reference, target):
            return n.Bind(rewrite(reference), rewrite(target))
        case n.Reset(place, value):
            return n.Reset(rewrite(place), value)
        case n.Call(pou, instance) if instance is not None:
            return n.Call(pou, rewrite(instance))
        case _:
            return statement


def map_block(block: n.Block, rewrite: Callable[[n.Stmt], n.Block]) -> n.Block:
    """The block with each statement replaced by what `rewrite` makes of it, inner blocks first."""
    result: list[n.Stmt] = []
    for statement in block:
        match statement:
            case n.If(condition, then, otherwise):
                statement = n.If(condition, map_block(then, rewrite), map_block(otherwise, rewrite))
            case n.Try(body):
                statement = n.Try(map_block(body, rewrite))
            case n.While(condition, body):
                statement = n.While(condition, map_block(body, rewrite))
            case _:
                pass
        result.extend(rewrite(statement))
    return tuple(result)


def map_body(body: n.Body, rewrite: Rewrite) -> n.Body:
    """The body with every expression in it rewritten."""
    return replace(body, block=map_block(body.block, lambda s: (map_statement_exprs(s, rewrite),)))


def statements(block: n.Block) -> Iterator[n.Stmt]:
    """Every statement of the block and of the blocks inside of it, in order."""
    for statement in block:
        yield statement
        match statement:
            case n.If(_, then, otherwise):
                yield from statements(then)
                yield from statements(otherwise)
            case n.Try(body) | n.While(_, body):
                yield from statements(body)
            case _:
                pass


def reached(module: n.Module) -> list[n.Body]:
    """The bodies that the programs still reach by calls; the others were inlined wherever they were called."""
    found = {run.pou for run in module.programs}
    for pou, body in reversed(module.bodies.items()):
        if pou in found:
            found |= {s.pou for s in statements(body.block) if isinstance(s, n.Call)}
    return [body for pou, body in module.bodies.items() if pou in found]


def set_local(statement: n.Stmt) -> n.Local | None:
    """The local that a statement sets."""
    return statement.local if isinstance(statement, (n.SetLocal, n.Compare)) else None


def places(statement: n.Stmt) -> Iterator[n.Place]:
    """The places that a statement itself names (those in its expressions are in `expressions`)."""
    match statement:
        case n.Store(place) | n.Reset(place):
            yield place
        case n.Copy(target, source):
            yield target
            yield source
        case n.Compare(_, left, right):
            yield left
            yield right
        case n.Bind(reference, target):
            yield reference
            yield target
        case n.Call(_, instance) if instance is not None:
            yield instance
        case _:
            pass


def expressions(statement: n.Stmt) -> Iterator[n.Expr]:
    """Every expression of a statement, parts included; not those of the blocks inside of it."""
    for place in places(statement):
        yield from _place_expressions(place)
    match statement:
        case n.Store(_, value) | n.SetLocal(_, value):
            yield from parts(value)
        case n.Guard(condition) | n.If(condition) | n.While(condition):
            yield from parts(condition)
        case _:
            pass


def parts(expr: n.Expr) -> Iterator[n.Expr]:
    """The expression and everything in it."""
    yield expr
    match expr:
        case n.Load(place) | n.Ref(place):
            yield from _place_expressions(place)
        case n.Op(_, left, right):
            yield from parts(left)
            yield from parts(right)
        case n.Not(operand) | n.Wrap(operand) | n.ToReal(operand):
            yield from parts(operand)
        case n.Select(condition, then, otherwise):
            yield from parts(condition)
            yield from parts(then)
            yield from parts(otherwise)
        case n.Intrinsic(_, arguments):
            for argument in arguments:
                yield from parts(argument)
        case _:
            pass


def may_fault(expr: n.Expr) -> bool:
    """Whether working out the expression may raise a fault: then it counts as an effect."""
    return any(isinstance(part, n.Intrinsic) and INTRINSICS[part.name].faults for part in parts(expr))


def _place_expressions(place: n.Place) -> Iterator[n.Expr]:
    if isinstance(place.root, n.Deref):
        yield from parts(place.root.reference)
    for step in place.steps:
        if isinstance(step, n.Element):
            yield from parts(step.index)
