"""Whether a scan allocates: code that does not never waits for the garbage collector."""

from __future__ import annotations

from iec2mpy.backends.target import Target
from iec2mpy.ir import nodes as n
from iec2mpy.ir.intrinsics import INTRINSICS
from iec2mpy.ir.walk import expressions, statements
from iec2mpy.semantics import types as ty
from iec2mpy.source.spans import Span


def first_allocation(module: n.Module, target: Target) -> Span | None:
    """The first source line whose code makes an object on the heap of a board, or None where no line does.

    Real numbers, integers of 64 bits and strings are objects. In bytecode an integer of more than 31 bits is one
    too, in viper it is none.
    """
    for body in module.bodies.values():
        span = body.pou.span
        for statement in statements(body.block):
            if isinstance(statement, n.Line):
                span = statement.span
            elif any(_allocates(expr, target) for expr in expressions(statement)):
                return span
    return None


def _allocates(expr: n.Expr, target: Target) -> bool:
    match expr:
        case n.Op() | n.Not() | n.Wrap() | n.ToReal() | n.Intrinsic() | n.Now() if expr.type.in_objects:
            return True
        case n.Intrinsic(name, arguments):
            # arguments and results of a Python function are objects: a large integer is boxed
            return INTRINSICS[name].module is not None and any(_is_large(a) for a in (expr, *arguments))
        case n.Op(name) if name not in n.COMPARISONS:
            return target.form == "portable" and _is_large(expr)
        case n.Load() | n.Now():
            return target.form == "portable" and _is_large(expr)
        case _:
            return False


def _is_large(expr: n.Expr) -> bool:
    """Whether the value may not fit the 31 bits of a small integer."""
    if isinstance(expr, n.Const) or not isinstance(expr.type, ty.ElementaryType):
        return False
    return expr.type.bits == 32 and not expr.type.in_objects
