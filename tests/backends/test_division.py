"""Division and MOD at the edges of every integer type: by variables, by constants, and of constants."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from iec2mpy.backends.target import ENGINE_TARGETS
from iec2mpy.project.compile import compile_files
from iec2mpy.semantics import arithmetic
from iec2mpy.semantics import types as ty
from iec2mpy.semantics.types import ElementaryType
from iec2mpy.simulator.session import Simulation
from iec2mpy.source.spans import SourceFile

_TYPES = (ty.SINT, ty.INT, ty.DINT, ty.USINT, ty.UINT, ty.UDINT)


def _edges(of: ElementaryType) -> list[int]:
    """Numbers of a type around which a division may go wrong: the limits, half of them, and the smallest ones."""
    half = of.high // 2
    near = {of.low, of.low + 1, of.low + 9, of.low // 2, -10, -7, -2, -1, 0, 1, 2, 7, 10, half, half + 1, of.high - 1}
    return sorted(n for n in near | {of.high} if of.low <= n <= of.high)


def _text(of: ElementaryType) -> str:
    """`q` and `r` by a variable; `q0`, `r0`, … by each edge; `p0`, … each edge by a variable."""
    divisors = [n for n in _edges(of) if n != 0]
    variables = ["a", "b", "q", "r", *(f"{name}{number}" for number in range(len(divisors)) for name in "qrp")]
    statements = ["q := a / b;", "r := a MOD b;"]
    for number, constant in enumerate(divisors):
        literal = f"{of.name}#{constant}"
        statements += [f"q{number} := a / {literal};", f"r{number} := a MOD {literal};", f"p{number} := {literal} / b;"]
    declarations = "\n".join(f"{name} : {of.name} := 1;" for name in variables)
    body = "\n".join(statements)
    return f"PROGRAM main\nVAR\n{declarations}\nEND_VAR\n{body}\nEND_PROGRAM\n"


def _expected(of: ElementaryType, a: int, b: int) -> Iterator[tuple[str, object]]:
    yield "q", arithmetic.binary("/", a, b, of, of)
    yield "r", arithmetic.binary("MOD", a, b, of, of)
    for number, constant in enumerate(n for n in _edges(of) if n != 0):
        yield f"q{number}", arithmetic.binary("/", a, constant, of, of)
        yield f"r{number}", arithmetic.binary("MOD", a, constant, of, of)
        yield f"p{number}", arithmetic.binary("/", constant, b, of, of)


@pytest.mark.parametrize("engine", ENGINE_TARGETS)
@pytest.mark.parametrize("of", _TYPES, ids=lambda of: of.name)
def test_division(of: ElementaryType, engine: str) -> None:
    generated = compile_files([SourceFile("division.st", _text(of))], ENGINE_TARGETS[engine])
    with Simulation(generated, engine) as simulation:
        for a in _edges(of):
            for b in _edges(of):
                if b == 0:
                    continue
                simulation.set("main.a", a)
                simulation.set("main.b", b)
                assert simulation.scan() is None
                expected = list(_expected(of, a, b))
                found = [(name, simulation.get(f"main.{name}")) for name, _ in expected]
                assert found == expected, f"{a} by {b}"
