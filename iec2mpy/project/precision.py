"""What a board's floats make of LREAL: MicroPython on boards has single precision."""

from __future__ import annotations

from collections.abc import Iterator

from iec2mpy.ir import nodes as n
from iec2mpy.semantics.typed import Variable
from iec2mpy.semantics.types import LREAL, ArrayType, StructType, Type, base_type
from iec2mpy.source.diagnostics import Diagnostics


def warn_of_lreal(module: n.Module, diagnostics: Diagnostics) -> None:
    """One warning, at the first variable of the user's program that holds an LREAL."""
    for variable in _variables(module):
        if not variable.span.file.is_stdlib and _holds_lreal(variable.type):
            diagnostics.add(
                "W0301",
                f"`{variable.name}` is LREAL, and this board calculates in single precision: about seven digits.",
                variable.span,
                "LINT counts exactly, up to 19 digits.",
            )
            return


def _variables(module: n.Module) -> Iterator[Variable]:
    yield from module.globals
    for pou in module.bodies:
        yield from pou.variables.values()
        if pou.result is not None:
            yield pou.result


def _holds_lreal(t: Type) -> bool:
    t = base_type(t)
    if isinstance(t, ArrayType):
        return _holds_lreal(t.element)
    if isinstance(t, StructType):
        return any(_holds_lreal(field.type) for field in t.fields.values())
    return t is LREAL
