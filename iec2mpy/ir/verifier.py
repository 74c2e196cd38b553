"""The verifier: says where IR is not what `nodes.py` promises. A failure is a bug of the compiler, not of a program."""

from __future__ import annotations

from collections.abc import Iterator

from iec2mpy.ir import nodes as n
from iec2mpy.ir.walk import expressions, places, statements
from iec2mpy.semantics import types as ty


class BrokenIR(AssertionError):
    """The text names the POU and what is wrong in it."""


def verify(module: n.Module) -> None:
    """Raises BrokenIR for the first thing that is wrong."""
    for body in module.bodies.values():
        for problem in problems(body, module):
            raise BrokenIR(f"{body.pou.name}: {problem}")


def problems(body: n.Body, module: n.Module) -> Iterator[str]:
    """What is wrong in a body."""
    yield from _locals(body.block, set(), body.locals)
    yield from _jumps(body.block, in_loop=False)
    for statement in statements(body.block):
        for place in _all_places(statement):
            if isinstance(place.root, n.Self) and place.root.pou is not body.pou:
                yield f"an instance of {place.root.pou.name} is not this body's own"
        match statement:
            case n.Call(pou) if pou not in module.bodies:
                yield f"{pou.name} has no body"
            case n.Store(place, value) if not _alike(place.type, value.type):
                yield f"a {value.type} is stored to a {place.type}"
            case n.SetLocal(local, value) if local.type.in_objects != value.type.in_objects:
                yield f"a {value.type} in local {local.number}, which is {local.type}"
            case n.If(condition) | n.While(condition) | n.Guard(condition) if condition.type is not ty.BOOL:
                yield f"a condition is {condition.type}"
            case _:
                pass
        for expr in expressions(statement):
            if isinstance(expr, n.Op) and expr.right.type.in_objects != (
                expr.left.type.in_objects and expr.name not in n.SHIFTS
            ):
                yield f"{expr.name} of {expr.left.type} and {expr.right.type}"


def _all_places(statement: n.Stmt) -> Iterator[n.Place]:
    yield from places(statement)
    yield from (e.place for e in expressions(statement) if isinstance(e, (n.Load, n.Ref)))


def _alike(declared: ty.Type, stored: n.ValueType) -> bool:
    target = ty.value_type(declared)
    return target is not None and target.in_objects == stored.in_objects


def _locals(block: n.Block, known: set[int], count: int) -> Iterator[str]:
    """A local is set before it is read, on every way."""
    for statement in block:
        for expr in expressions(statement):
            if isinstance(expr, n.Local) and expr.number not in known:
                yield f"local {expr.number} is read before it is set"
        match statement:
            case n.SetLocal(local) | n.Compare(local):
                known.add(local.number)
                if local.number >= count:
                    yield f"local {local.number} is beyond the {count} of the body"
            case n.If(_, then, otherwise):
                first, second = set(known), set(known)
                yield from _locals(then, first, count)
                yield from _locals(otherwise, second, count)
                known |= first & second
            case n.Try(body) | n.While(_, body):
                yield from _locals(body, set(known), count)
            case _:
                pass


def _jumps(block: n.Block, in_loop: bool, in_try: bool = False) -> Iterator[str]:
    for statement in block:
        match statement:
            case n.Break() | n.Next() if not in_loop:
                yield "a jump out of a loop stands in none"
            case n.If(_, then, otherwise):
                yield from _jumps(then, in_loop, in_try)
                yield from _jumps(otherwise, in_loop, in_try)
            case n.Return() if in_try:
                yield "a jump leads out of what is tried"
            case n.Try(body):
                yield from _jumps(body, in_loop=False, in_try=True)
            case n.While(_, body):
                yield from _jumps(body, True, in_try)
            case _:
                pass
