"""Which channels the located variables of a program use."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from iec2mpy.project.binding import LocatedVariable, bind_channels
from iec2mpy.project.config import load_project
from iec2mpy.source.diagnostics import Diagnostic, Diagnostics
from iec2mpy.source.spans import SourceFile, Span

MakeProject = Callable[..., Path]


def bind(directory: Path, *located: tuple[str, str]) -> tuple[Any, list[Diagnostic]]:
    """The rows for variables v0, v1, … at slots 8, 9, …, each an (address, type)."""
    file = SourceFile("main.st", "\n" * len(located))
    variables = [
        LocatedVariable(f"v{n}", address, type_name, 8 + n, Span(file, n, n + 1))
        for n, (address, type_name) in enumerate(located)
    ]
    diagnostics = Diagnostics()
    names: dict[str, Any] = {}
    exec(bind_channels(load_project(directory).board, variables, diagnostics), names)
    return names["CHANNELS"], diagnostics.items


def test_a_row_of_each_kind(make_project: MakeProject) -> None:
    rows, found = bind(make_project(), ("%QW0", "UINT"), ("%QX0.0", "BOOL"), ("%IX0.1", "BOOL"), ("%IW2", "INT"))
    assert found == []
    assert rows == (
        ("din", 10, 3, "up", True),
        ("dout", 9, 25, False, 0),
        ("adc", 11, 28, 0, 32767),
        ("pwm", 8, 18, 1000, 0, 32767, 0),
    )


def test_channels_under_a_variable_among_bytes(make_project: MakeProject) -> None:
    span = Span(SourceFile("main.st", ""), 0, 0)
    located = [
        LocatedVariable("all", "%IB0", "BYTE", 8 * 8, span, bits=8),
        LocatedVariable("one", "%IX0.1", "BOOL", 8 * 8 + 1, span, bits=1),
        LocatedVariable("both", "%IW0", "ARRAY[0..1] OF INT", 8 * 9, span, bits=32),
        LocatedVariable("none", "%QB7", "BYTE", 8 * 20, span, bits=8),
    ]
    diagnostics = Diagnostics()
    names: dict[str, Any] = {}
    exec(bind_channels(load_project(make_project()).board, located, diagnostics), names)
    assert [d.code for d in diagnostics.items] == ["E0842"]
    digital = [(row[1], *row[5:]) for row in names["CHANNELS"] if row[0] == "din"]
    assert digital == [(8,), *((8, bit) for bit in range(1, 8))]
    analog = [(row[1], *row[5:]) for row in names["CHANNELS"] if row[0] == "adc"]
    assert analog == [(9, True), (11, True)]


def test_named_pin_and_no_pull(make_project: MakeProject) -> None:
    directory = make_project('[channels."%IX0.0"]\npull = "none"', board="pico_w")
    rows, _ = bind(directory, ("%QX0.0", "BOOL"), ("%IX0.0", "BOOL"))
    assert rows == (("din", 9, 2, "", True), ("dout", 8, "LED", False, 0))


def test_program_without_channels(make_project: MakeProject) -> None:
    assert bind(make_project()) == ((), [])


def test_two_variables_at_one_address_are_one_row(make_project: MakeProject) -> None:
    rows, found = bind(make_project(), ("%IX0.0", "BOOL"), ("%IX0.0", "BOOL"))
    assert found == []
    assert len(rows) == 1


@pytest.mark.parametrize(
    ("located", "lines", "code", "says", "hint"),
    [
        (("%IX5.0", "BOOL"), "", "E0842", "The board pico has no channel %IX5.0, which `v0` asks for.", "%IX0.0"),
        (("%IB0", "BYTE"), "", "E0842", "no channel %IB0", "Its addresses look like %IW0, %IX0.0"),
        (("%IW0", "BOOL"), "", "E0843", "%IW0 is an analog input, which cannot be a variable of type BOOL", "INT or"),
        (("%QX0.0", "BYTE"), "", "E0843", "%QX0.0 is a digital output", "as BOOL"),
        (("%IW0", "INT"), '[channels."%IW0"]\nrange = [0, 65535]', "E0843", "INT cannot hold all", "as UINT"),
        (("%IW0", "WORD"), '[channels."%IW0"]\nrange = [-100, 100]', "E0843", "WORD cannot hold all", "as INT"),
        (("%QX0.1", "BOOL"), '[channels."%IX1.0"]\npin = 10\nkind = "din"', "E0842", "no channel %QX0.1", "%IX1.0"),
    ],
)
def test_variable_that_does_not_fit(
    make_project: MakeProject, located: tuple[str, str], lines: str, code: str, says: str, hint: str
) -> None:
    rows, (error,) = bind(make_project(lines), located)
    assert rows == ()
    assert error.code == code
    assert says in error.message
    assert error.hint is not None
    assert hint in error.hint
