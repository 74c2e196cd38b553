"""Chains of conditions, as IF with ELSIF and CASE have them: the first that holds runs its statements."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from iec2mpy.ir import nodes as n
from iec2mpy.ir.build.context import FALSE, TRUE, Context
from iec2mpy.semantics import types as ty

Branch = tuple[Callable[[], n.Expr], Callable[[], None]]
"""What lowers a condition, and what lowers the statements that it leads to."""

LONGEST = 30
"""So many branches stand in one nest of IF and ELSE. Longer chains are made of several, one after the other: nesting
has limits in Python, in MicroPython, and in this compiler."""


def lower_chain(context: Context, branches: Sequence[Branch], otherwise: Callable[[], None]) -> None:
    """Emits the chain. Each condition is evaluated only where none before it holds."""
    if len(branches) <= LONGEST:
        _nest(context, branches, otherwise)
        return
    # in the frame and not in a local, so that the backends can put each nest into a function of its own
    done = context.new_hidden(ty.BOOL)
    pending = n.Not(n.Load(done, ty.BOOL), ty.BOOL)
    context.emit(n.Store(done, FALSE))
    for first in range(0, len(branches), LONGEST):
        with context.block() as nest:
            context.emit(n.Store(done, TRUE))
            _nest(context, branches[first : first + LONGEST], lambda: context.emit(n.Store(done, FALSE)))
        context.emit(n.If(pending, tuple(nest), ()))
    with context.block() as last:
        otherwise()
    context.emit(n.If(pending, tuple(last), ()))


def keep_in_frame(context: Context, value: n.Expr) -> n.Expr:
    """The value as it is now, for all of a long chain."""
    assert isinstance(value.type, ty.ElementaryType)
    kept = context.new_hidden(value.type)
    context.emit(n.Store(kept, value))
    return n.Load(kept, value.type)


def _nest(context: Context, branches: Sequence[Branch], otherwise: Callable[[], None]) -> None:
    (condition, body), *rest = branches
    value = condition()
    with context.block() as then:
        body()
    with context.block() as other:
        if rest:
            _nest(context, rest, otherwise)
        else:
            otherwise()
    context.emit(n.If(value, tuple(then), tuple(other)))
