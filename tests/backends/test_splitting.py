"""Large bodies: every function stays below the limit, and does the same."""

from __future__ import annotations

import re

import pytest

from iec2mpy.backends.target import ENGINE_TARGETS, VIPER32
from iec2mpy.simulator.session import Simulation
from tests.backends.compiling import generated

_LIMIT = 300
_VARIABLES = "VAR x : DINT; a : ARRAY[0..9] OF DINT; i : INT; k : INT := 3; END_VAR\n"


def _statements(count: int) -> str:
    return "".join(f"x := x + {number % 7};\na[{number % 10}] := x;\n" for number in range(count))


def _added(count: int) -> int:
    return sum(number % 7 for number in range(count))


def _main(body: str) -> str:
    return f"PROGRAM main\n{_VARIABLES}{body}END_PROGRAM\n"


_PROGRAMS: dict[str, tuple[str, int]] = {
    "statements": (_main(_statements(500)), _added(500)),
    "a return in the middle": (
        _main(f"{_statements(200)}IF x > 0 THEN RETURN; END_IF;\n{_statements(200)}"),
        _added(200),
    ),
    "large branches": (
        _main(f"IF x = 0 THEN\n{_statements(300)}ELSIF x = 1 THEN\n{_statements(300)}ELSE\n{_statements(5)}END_IF;\n"),
        _added(300),
    ),
    "a case with many large groups": (
        _main("CASE k OF\n" + "".join(f"{group}:\n{_statements(20)}" for group in range(60)) + "END_CASE;\n"),
        _added(20),
    ),
    "a case with many small groups": (
        _main("CASE k OF\n" + "".join(f"{group}: x := {group};\n" for group in range(600)) + "END_CASE;\n"),
        3,
    ),
    "a loop that is left in the middle": (
        _main(
            f"FOR i := 0 TO 3 DO\n{_statements(150)}IF i = 2 THEN EXIT; END_IF;\n{_statements(150)}"
            f"a[i] := i;\nEND_FOR;\n"
        ),
        5 * _added(150),
    ),
    "a block with two instances": (
        f"FUNCTION_BLOCK B\n{_VARIABLES}IF x >= 0 THEN\n{_statements(300)}END_IF;\nEND_FUNCTION_BLOCK\n"
        "PROGRAM main\nVAR b, c : B; x : DINT; END_VAR\nb(); c(); c();\nx := 1;\nEND_PROGRAM\n",
        1,
    ),
    "temporaries that live on": (
        _main("".join(f"x := x + ABS(a[k] - a[{number % 10}]) MOD 3 + {number % 2};\n" for number in range(400))),
        200,
    ),
}


def _sizes(text: str) -> list[int]:
    """Lines of code of each function."""
    functions = re.split(r"^def ", text, flags=re.MULTILINE)[1:]
    return [sum(bool(re.match(r" +[^# ]", line)) for line in function.splitlines()) for function in functions]


@pytest.mark.parametrize("name", _PROGRAMS)
def test_no_function_is_too_large(name: str) -> None:
    sizes = _sizes(generated(_PROGRAMS[name][0], VIPER32).text)
    assert max(sizes) <= _LIMIT
    assert len(sizes) > 3


@pytest.mark.parametrize("engine", ENGINE_TARGETS)
@pytest.mark.parametrize("name", _PROGRAMS)
def test_the_parts_do_the_same(name: str, engine: str) -> None:
    text, expected = _PROGRAMS[name]
    with Simulation(generated(text, ENGINE_TARGETS[engine]), engine) as simulation:
        assert simulation.scan() is None
        assert simulation.get("main.x") == expected
        if name == "a block with two instances":
            assert [simulation.get("main.b.x"), simulation.get("main.c.x")] == [_added(300), 2 * _added(300)]


def test_a_small_body_is_one_function() -> None:
    assert "__1" not in generated(_main(_statements(50)), VIPER32).text
