"""The model and a real MicroPython compute the same."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from hypothesis import HealthCheck, given, settings

from iec2mpy.simulator.viper32 import load

from .machine64 import Micropython
from .random_programs import RESULT, Program, programs
from .sample_tank import SCANS, TEXT


@pytest.fixture(scope="module")
def micropython() -> Iterator[Micropython]:
    with Micropython() as machine:
        yield machine


@settings(max_examples=150, deadline=None, suppress_health_check=list(HealthCheck))
@given(programs())
def test_random_functions(micropython: Micropython, program: Program) -> None:
    expected = micropython.value(program.host, RESULT)
    names = load(program.board, "random.py")
    assert eval(RESULT, names) == expected


def test_sample(micropython: Micropython) -> None:
    """A function block with an address as its base, wrap-free arithmetic, floats in a list, a fault."""
    expected = micropython.value(TEXT + SCANS, "trace")
    names = load(TEXT + SCANS, "tank.py")
    assert names["trace"] == expected
    assert ("fault", "index") in expected
    assert any(entry[1] for entry in expected if entry[0] != "fault")


def test_quotient_of_the_runtime_overflows(micropython: Micropython) -> None:
    """With 64 bits: -2**63 // 10 is wrong, as MicroPython adds 1 - 10 first. So the model faults with 32."""
    text = "import micropython\n@micropython.viper\ndef f(a: int, b: int) -> int:\n    return a // b\n"
    assert micropython.value(text, "f(-(1 << 63), 10)") == 922337203685477579
    assert micropython.value(text, "f(-(1 << 63) + 9, 10)") == (-(1 << 63) + 9) // 10


def test_unary_operators_overwrite_a_local(micropython: Micropython) -> None:
    """Until August 2026, so the model refuses them."""
    text = "import micropython\n@micropython.viper\ndef f(a: int) -> int:\n    b = -a\n    return a\n"
    assert micropython.value(text, "f(5)") == -5
