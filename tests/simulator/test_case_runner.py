"""What running a case says of each way in which it can pass or fail."""

from __future__ import annotations

from pathlib import Path

import pytest

from iec2mpy.backends.target import ENGINE_TARGETS
from iec2mpy.simulator.case_runner import ERROR, FAILED, PASSED, Outcome, run_case
from iec2mpy.simulator.cases import load_case_file

_TYPES = """\
TYPE
    Colour : (red, green);
    Pair : STRUCT a : INT; b : REAL; END_STRUCT;
END_TYPE
VAR_GLOBAL shared : INT := 4; END_VAR
PROGRAM main
VAR
    i : INT := 5; u : UDINT := 4000000000; x : BOOL := TRUE; r : REAL := 0.1; t : TIME := T#90s; s : STRING := 'hi';
    c : Colour := green; list : ARRAY[1..3] OF INT := [1, 2, 3]; table : ARRAY[1..2, 0..1] OF INT := [1, 2, 3, 4];
    p : Pair := (a := 1, b := 2.5); pairs : ARRAY[1..2] OF Pair; input AT %IX0.3 : BOOL; timer : TON;
END_VAR
VAR RETAIN kept : INT; END_VAR
kept := kept + 1;
END_PROGRAM
"""


def _run(folder: Path, source: str, rest: str, engines: tuple[str, ...] = ("cpython",)) -> Outcome:
    path = folder / "cases.toml"
    path.write_text(f"[[case]]\nid = \"one\"\nsource = '''\n{source}'''\n{rest}\n", encoding="utf-8")
    (case,) = load_case_file(path)
    return run_case(case, engines)


def _step(folder: Path, step: str) -> Outcome:
    return _run(folder, _TYPES, f"steps = [ {{ {step} }} ]")


@pytest.mark.parametrize(
    "expected",
    [
        '"main.i" = 5',
        '"MAIN.I" = 5',
        '"main.u" = 4000000000',
        '"main.x" = true',
        '"main.r" = 0.1000009',
        '"main.t" = "T#1m30s"',
        '"main.t" = "TIME#90000ms"',
        '"main.s" = "hi"',
        '"main.c" = "GREEN"',
        '"main.list" = [1, 2, 3]',
        '"main.list[2]" = 2',
        '"main.table" = [[1, 2], [3, 4]]',
        '"main.table[2,0]" = 3',
        '"main.p" = { b = 2.5 }',
        '"main.p" = { A = 1, b = 2.5 }',
        '"main.pairs" = [{ a = 0 }, { a = 0, b = 0.0 }]',
        '"main.timer" = { q = false, et = "T#0s" }',
        '"shared" = 4',
        '"%IX0.3" = false',
    ],
)
def test_values_that_are_there(expected: str, tmp_path: Path) -> None:
    outcome = _step(tmp_path, f"expect = {{ {expected} }}")
    assert (outcome.outcome, outcome.message) == (PASSED, "")


@pytest.mark.parametrize(
    ("expected", "said"),
    [
        ('"main.i" = 6', "step 1: main.i: expected 6, found 5"),
        ('"main.x" = false', "step 1: main.x: expected false, found true"),
        ('"main.r" = 0.10001', "step 1: main.r: expected 0.10001, found 0.1"),
        ('"main.t" = "T#1m"', 'step 1: main.t: expected "T#1m", found "T#1m30s"'),
        ('"main.c" = "red"', 'step 1: main.c: expected "red", found "green"'),
        ('"main.list" = [1, 0, 0]', "main.list[2]: expected 0, found 2; main.list[3]: expected 0, found 3"),
        ('"main.table" = [[1, 2], [3, 5]]', "main.table[2,1]: expected 5, found 4"),
        ('"main.p" = { a = 7 }', "main.p.a: expected 7, found 1"),
    ],
)
def test_values_that_differ(expected: str, said: str, tmp_path: Path) -> None:
    outcome = _step(tmp_path, f"expect = {{ {expected} }}")
    assert outcome.outcome == FAILED
    assert said in outcome.message


@pytest.mark.parametrize(
    ("step", "said"),
    [
        ('expect = { "main.ii" = 6 }', "main has no ii"),
        ('set = { "other.i" = 6 }', "there is no other"),
        ('expect = { "%QX9.9" = true }', "the program has nothing at %QX9.9"),
        ('set = { "main.i" = 40000 }', "main.i is INT: 40000 is not in -32768..32767"),
        ('set = { "main.i" = "five" }', "main.i is INT: 'five' is no integer"),
        ('expect = { "main.t" = 5 }', "main.t is TIME: 5 is no duration"),
        ('expect = { "main.c" = "blue" }', "'blue' is none of red, green"),
        ('expect = { "main.list" = [1, 2] }', "main.list is an array of 3"),
        ('expect = { "main.p" = { z = 1 } }', "main.p has no field z"),
        ('expect = { "main.list[4]" = 1 }', "4 is not in 1..3"),
    ],
)
def test_values_that_cannot_be(step: str, said: str, tmp_path: Path) -> None:
    outcome = _step(tmp_path, step)
    assert outcome.outcome == ERROR
    assert said in outcome.message


def test_restarts(tmp_path: Path) -> None:
    steps = """steps = [
  { set = { "main.i" = 9, "%IX0.3" = true }, scans = 3, expect = { "main.kept" = 3, "main.i" = 9 } },
  { restart = "warm", expect = { "main.kept" = 4, "main.i" = 5, "main.input" = true } },
  { restart = "cold", set = { "main.i" = 8 }, expect = { "main.kept" = 1, "main.i" = 8, "main.input" = true } },
]"""
    outcome = _run(tmp_path, _TYPES, steps, tuple(ENGINE_TARGETS))
    assert (outcome.outcome, outcome.message) == (PASSED, "")


def test_run_counts_scans_of_the_interval(tmp_path: Path) -> None:
    steps = 'interval = "T#20ms"\nsteps = [ { run = "T#90ms", expect = { "main.kept" = 4 } } ]'
    assert _run(tmp_path, _TYPES, steps).outcome == PASSED


_DIVISION = "PROGRAM main\nVAR n, x : INT; END_VAR\nn := n + 1;\nx := 1 / (2 - n);\nEND_PROGRAM\n"


@pytest.mark.parametrize(
    ("steps", "outcome", "said"),
    [
        ('{ scans = 2, fault = "zero" }', PASSED, ""),
        ('{ scans = 2, fault = "zero" }, { restart = "cold", expect = { "main.n" = 1 } }', PASSED, ""),
        ('{ scans = 2, fault = "index" }', FAILED, "expected the fault `index`, found zero: a division by zero"),
        ('{ scans = 1, fault = "zero" }', FAILED, "expected the fault `zero`, and nothing stopped the program"),
        ("{ scans = 2, expect = { } }", FAILED, "a fault stopped the program: zero: a division by zero"),
        ("{ scans = 2 }", FAILED, "line 4, in main"),
    ],
)
def test_faults(steps: str, outcome: str, said: str, tmp_path: Path) -> None:
    result = _run(tmp_path, _DIVISION, f"steps = [ {steps} ]", tuple(ENGINE_TARGETS))
    assert result.outcome == outcome, result.message
    assert said in result.message


@pytest.mark.parametrize(
    ("line", "outcome", "said"),
    [(3, PASSED, ""), (2, FAILED, "expected an error (name) on line 2; found: cases.toml (one), line 3: E0201:")],
)
def test_expected_error(line: int, outcome: str, said: str, tmp_path: Path) -> None:
    source = "PROGRAM main\nVAR x : INT; END_VAR\ny := 1;\nEND_PROGRAM\n"
    result = _run(tmp_path, source, f'error = {{ line = {line}, about = "name" }}')
    assert result.outcome == outcome
    assert said in result.message


def test_program_without_the_expected_error(tmp_path: Path) -> None:
    source = "PROGRAM main\nVAR x : INT; END_VAR\nEND_PROGRAM\n"
    result = _run(tmp_path, source, 'error = { line = 2, about = "syntax" }')
    assert (result.outcome, "it compiles without an error" in result.message) == (FAILED, True)


def test_what_is_not_supported_yet_is_not_the_expected_error(tmp_path: Path) -> None:
    source = "PROGRAM main\nVAR x : RTC; END_VAR\nEND_PROGRAM\n"
    result = _run(tmp_path, source, 'error = { line = 2, about = "type" }')
    assert result.outcome == FAILED
    assert result.diagnostics[0].code.startswith("E09")


def test_error_in_one_of_several_files(tmp_path: Path) -> None:
    (tmp_path / "a.st").write_text("FUNCTION f : INT\nf := 1;\nEND_FUNCTION\n", encoding="utf-8")
    (tmp_path / "b.st").write_text("PROGRAM main\nx := f();\nEND_PROGRAM\n", encoding="utf-8")
    path = tmp_path / "cases.toml"
    for file, outcome in (("b.st", PASSED), ("a.st", FAILED)):
        error = f'error = {{ line = 2, about = "name", file = "{file}" }}'
        path.write_text(f'[[case]]\nid = "e"\nfiles = ["a.st", "b.st"]\n{error}\n', encoding="utf-8")
        (case,) = load_case_file(path)
        assert run_case(case, ("cpython",)).outcome == outcome


def test_fault_of_the_compiler_is_one_outcome(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object) -> None:
        raise AssertionError("oops")

    monkeypatch.setattr("iec2mpy.simulator.case_runner.check_files", fail)
    result = _step(tmp_path, "")
    assert result.outcome == ERROR
    assert result.message == "a fault of iec2mpy itself, please report it: AssertionError: oops"
