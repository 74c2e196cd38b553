"""`stdlib/functions.toml`, and which files of the library a program needs."""

from __future__ import annotations

import re
import tomllib

import pytest

from iec2mpy.semantics import arithmetic
from iec2mpy.semantics.signatures import function_names, generic_members, standard_function
from iec2mpy.semantics.stdlib import block_names, stdlib_files
from iec2mpy.semantics.types import DINT, ELEMENTARY, INT, REAL, TIME, StringType
from iec2mpy.source.resources import resource_dir

DATA = tomllib.loads((resource_dir("stdlib") / "functions.toml").read_text(encoding="utf-8"))


@pytest.mark.parametrize("name", function_names())
def test_each_function_has_a_meaning(name: str) -> None:
    signature = standard_function(name)
    assert signature is not None
    if signature.operator is None and signature.inputs and not signature.outputs:
        result = {"ANY_STRING": StringType(), "INT": INT, "ANY_REAL": REAL}.get(signature.result)
        result = result or ELEMENTARY.get(signature.result, DINT)
        values = {"ANY_STRING": "abc", "ANY_REAL": 0.5}
        arguments = [2024 if p.name == "YEAR" else values.get(p.type, 1) for p in signature.inputs]
        assert arithmetic.builtin(name, arguments, result) is not None


@pytest.mark.parametrize("name", DATA["functions"])
def test_types_of_signatures_exist(name: str) -> None:
    row = DATA["functions"][name]
    results = [f"RESULT: {row['result']}"] if "result" in row else []
    for text in [*row["inputs"], *row.get("outputs", []), *results]:
        parameter, t = text.split(": ")
        assert re.fullmatch(r"[A-Z]+\d?", parameter)
        assert t in DATA["generic"] or t in ELEMENTARY


def test_typed_names() -> None:
    added = standard_function("add_time")
    assert added is not None
    assert (added.name, added.operator, added.fixed) == ("ADD", "+", TIME)
    assert standard_function("ADD_BOOL") is None
    assert standard_function("SIN_INT") is None
    assert standard_function("MUX_DINT_REAL") is not None
    assert standard_function("SEL_INT_REAL") is None


def test_positions_of_extensible_inputs() -> None:
    mux = standard_function("MUX")
    assert mux is not None
    assert [mux.position(name) for name in ("K", "in0", "IN1", "IN2", "IN10", "IN", "INX")] == [
        0,
        1,
        2,
        3,
        11,
        None,
        None,
    ]
    fifth = mux.parameter(4)
    assert fifth is not None
    assert fifth.name == "IN3"


def test_generic_types_are_nested_as_in_figure_5() -> None:
    assert set(generic_members("ANY_INT")) < set(generic_members("ANY_NUM")) < set(generic_members("ANY_MAGNITUDE"))
    assert set(generic_members("ANY_MAGNITUDE")) < set(generic_members("ANY_ELEMENTARY"))


def test_only_files_that_are_used_are_needed() -> None:
    assert stdlib_files(["x := 1;"]) == []
    assert [file.path for file in stdlib_files(["t : ton;", "c : CTU_INT; s : SR;"])] == [
        "stdlib/bistable.st",
        "stdlib/counters.st",
        "stdlib/timers.st",
    ]
    assert all(file.is_stdlib for file in stdlib_files(block_names()))
