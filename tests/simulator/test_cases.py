"""Case files: what is read from them, and what is said of those that are not as the format says."""

from __future__ import annotations

from pathlib import Path

import pytest

from iec2mpy.simulator.cases import BadCase, Case, CaseFileError, ExpectedError, load_case_file


def _load(folder: Path, text: str) -> list[Case | BadCase]:
    path = folder / "cases.toml"
    path.write_text(text, encoding="utf-8")
    return load_case_file(path)


def _one(folder: Path, text: str) -> Case:
    (case,) = _load(folder, text)
    assert isinstance(case, Case), case
    return case


def _message(folder: Path, body: str) -> str:
    """What is said of the only case of a file."""
    (case,) = _load(folder, f'[[case]]\nid = "one"\n{body}\n')
    assert isinstance(case, BadCase), case
    assert (case.id, case.file) == ("one", folder / "cases.toml")
    return case.message


_STEPS = "source = ''\nsteps = [ { expect = {} } ]"


def test_defaults(tmp_path: Path) -> None:
    case = _one(tmp_path, '[[case]]\nid = "one"\nsource = "PROGRAM"\nsteps = [ { set = { "main.x" = 1 } } ]')
    assert (case.interval_us, case.features, case.files, case.error) == (10_000, (), (), None)
    (step,) = case.steps
    assert (step.number, step.scans, step.run_us, step.set) == (1, 1, None, {"main.x": 1})


def test_all_keys(tmp_path: Path) -> None:
    case = _one(
        tmp_path,
        """[[case]]
id = "all"
features = ["1.2"]
title = "A title"
files = ["a.st", "b.st"]
interval = "T#1.5ms"
tolerance = "T#20ms"
note = "why"
steps = [ { run = "T#1m30s", expect = { "%QX0.0" = true } }, { scans = 3, fault = "zero" }, { restart = "cold" } ]
""",
    )
    assert (case.features, case.title, case.files, case.interval_us) == (("1.2",), "A title", ("a.st", "b.st"), 1500)
    first, second, third = case.steps
    assert (first.scans, first.run_us, first.expect) == (None, 90_000_000, {"%QX0.0": True})
    assert (second.number, second.scans, second.fault) == (2, 3, "zero")
    assert third.restart == "cold"


def test_expected_error(tmp_path: Path) -> None:
    body = 'files = ["a.st", "b.st"]\nerror = { line = 3, about = "type", file = "b.st" }'
    case = _one(tmp_path, f'[[case]]\nid = "e"\n{body}')
    assert case.error == ExpectedError(3, "type", "b.st")


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("source = ''", "it has neither `steps` nor `error`; exactly one is needed"),
        ("steps = [ { } ]", "it has neither `source` nor `files`; exactly one is needed"),
        (f"{_STEPS}\nerror = {{ line = 1, about = 'type' }}", "it has both `steps` and `error`"),
        (f"{_STEPS}\nfeature = []", "`feature` is no key of a case (did you mean `features`?)"),
        (f"{_STEPS}\ntitle = 3", "`title` must be a text"),
        (f"{_STEPS}\ninterval = 'ten'", '`interval` must be a duration above 0, such as "T#10ms", not "ten"'),
        (f"{_STEPS}\ninterval = 'T#0s'", '`interval` must be a duration above 0, such as "T#10ms", not "T#0s"'),
        ("source = ''\nsteps = []", "`steps` is empty"),
        ("source = ''\nsteps = [ 3 ]", "step 1: a step must be a table"),
        ("source = ''\nsteps = [ {}, { expects = {} } ]", "step 2: `expects` is no key of a step (did you mean"),
        ("source = ''\nsteps = [ { scans = 1, run = 'T#1s' } ]", "step 1: it has both `scans` and `run`"),
        ("source = ''\nsteps = [ { scans = -1 } ]", "step 1: `scans` must be a whole number, 0 or more"),
        ("source = ''\nsteps = [ { scans = true } ]", "step 1: `scans` must be a whole number, 0 or more"),
        ("source = ''\nsteps = [ { restart = 'hot' } ]", 'step 1: `restart` must be "warm" or "cold", not "hot"'),
        ("source = ''\nsteps = [ { fault = 'zero' }, {} ]", "step 2: the step before it expects a fault"),
        ("source = ''\nsteps = [ { set = 3 } ]", "step 1: `set` must be a table of paths and values"),
        ("source = ''\nerror = 3", "`error` must be a table"),
        ("source = ''\nerror = { line = 0, about = 'type' }", "`error` needs `line`, a whole number from 1"),
        ("source = ''\nerror = { line = 1, about = 'types' }", "`about` must be one of syntax, type,"),
        ("source = ''\nerror = { line = 1 }", "`error.about` is missing"),
        ("files = ['a.st', 'b.st']\nerror = { line = 1, about = 'type' }", "`error` must name its `file`"),
        ("files = ['a.st']\nerror = { line = 1, about = 'type', file = 'c' }", 'the file "c", which is not in `files`'),
    ],
)
def test_malformed_case(tmp_path: Path, body: str, said: str) -> None:
    assert said in _message(tmp_path, body)


def test_other_cases_of_the_file_are_kept(tmp_path: Path) -> None:
    heads = ('id = "a"', 'id = "a"', "", 'id = "d"')
    text = "\n".join(f"[[case]]\n{head}\n{_STEPS}" for head in heads)
    first, twice, nameless, last = _load(tmp_path, text)
    assert isinstance(first, Case)
    assert isinstance(twice, BadCase)
    assert 'the id "a" is used twice; it is also that of case 1' in twice.message
    assert isinstance(nameless, BadCase)
    assert (nameless.id, "`id` is missing" in nameless.message) == ("case 3", True)
    assert isinstance(last, Case)


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"[[case]\n", "is not TOML"),
        (b"\xff\xfe", "is not UTF-8 text"),
        (b"cases = 3\n", "`cases` is no key of a case file"),
        (b"[case]\nid = 'a'\n", "a case starts with [[case]], in double brackets"),
    ],
)
def test_unreadable_file(tmp_path: Path, content: bytes, said: str) -> None:
    path = tmp_path / "cases.toml"
    path.write_bytes(content)
    with pytest.raises(CaseFileError, match=r"cases\.toml") as caught:
        load_case_file(path)
    assert said in str(caught.value)


def test_missing_file(tmp_path: Path) -> None:
    with pytest.raises(CaseFileError, match="cannot be read: No such file"):
        load_case_file(tmp_path / "none.toml")
