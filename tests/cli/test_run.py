"""`iec2mpy run` in virtual time: values, traces, faults, and what is wrong with a command line."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from xml.etree import ElementTree

import pytest

from iec2mpy.backends.target import ENGINE_TARGETS
from iec2mpy.cli import main

_PROGRAM = """\
TYPE Colour : (red, green); END_TYPE
PROGRAM main
VAR
    button AT %IX0.0 : BOOL;
    lamp AT %QX0.1 : BOOL;
    count : INT;
    half : REAL;
    timer : TON;
    colour : Colour;
    list : ARRAY[1..2] OF INT;
    text : STRING;
END_VAR
timer(IN := button, PT := T#30ms);
lamp := timer.Q;
count := count + 1;
half := INT_TO_REAL(count) / 2.0;
list[2] := count;
END_PROGRAM
"""
_FAULT = "PROGRAM main\nVAR n, x : INT; END_VAR\nn := n + 1;\nx := 9 / (3 - n);\nEND_PROGRAM\n"


@pytest.fixture
def program(tmp_path: Path) -> str:
    path = tmp_path / "program.st"
    path.write_text(_PROGRAM, encoding="utf-8")
    return str(path)


def _last_values(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> dict[str, dict[str, object]]:
    assert main(["run", *arguments, "--json"]) == 0
    return json.loads(capsys.readouterr().out)


@pytest.mark.parametrize("engine", ENGINE_TARGETS)
def test_last_values(engine: str, program: str, capsys: pytest.CaptureFixture[str]) -> None:
    watched = ["main.count", "main.half", "main.timer.et", "main.colour", "main.list"]
    options = [option for path in watched for option in ("--watch", path)]
    result = _last_values([program, "--for", "T#50ms", "--engine", engine, "--set", "%IX0.0=TRUE", *options], capsys)
    assert result == {
        "name": "program",
        "scans": 5,
        "inputs": {"main.button": True},
        "outputs": {"main.lamp": True},
        "watched": {
            "main.count": 5,
            "main.half": 2.5,
            "main.timer.ET": "T#30ms",
            "main.colour": "red",
            "main.list[1]": 0,
            "main.list[2]": 5,
        },
        "fault": None,
    }


@pytest.mark.parametrize(
    ("setting", "expected"),
    [
        ("main.count=-7", -6),
        ("main.colour=green", "green"),
        ("main.timer.et=T#1s", "T#0ms"),
        ("main.list=[5, 6]", 5),
        ("main.text=say 5", "say 5"),
        ("main.button=1", True),
    ],
)
def test_set(setting: str, expected: object, program: str, capsys: pytest.CaptureFixture[str]) -> None:
    path = setting.partition("=")[0] + ("[1]" if "list" in setting else "")
    result = _last_values([program, "--scans", "1", "--set", setting, "--watch", path], capsys)
    assert expected in [*result["watched"].values(), *result["inputs"].values()]


def test_table(program: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", program, "--scans", "3", "--watch", "main.half", "--watch", "main.timer.pt"]) == 0
    rows = [line.split() for line in capsys.readouterr().out.splitlines()]
    assert rows == [
        ["program,", "after", "T#30ms", "(3", "scans)"],
        ["Inputs"],
        ["%IX0.0", "main.button", "false"],
        ["Outputs"],
        ["%QX0.1", "main.lamp", "false"],
        ["Watched"],
        ["main.half", "1.5"],
        ["main.timer.PT", "T#30ms"],
    ]


def test_trace_and_plot(program: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    table, drawing = tmp_path / "out.csv", tmp_path / "out.svg"
    watches = [option for path in ("main.half", "main.timer.et", "main.colour") for option in ("--watch", path)]
    options = ["--set", "main.button=true", *watches]
    assert main(["run", program, "--scans", "5", *options, "--trace", str(table), "--plot", str(drawing)]) == 0
    with table.open(encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    assert rows == [
        ["time_ms", "main.button", "main.lamp", "main.half", "main.timer.ET", "main.colour"],
        ["0", "1", "0", "0.5", "0", "red"],
        ["10", "1", "0", "1", "10", "red"],
        ["20", "1", "0", "1.5", "20", "red"],
        ["30", "1", "1", "2", "30", "red"],
        ["40", "1", "1", "2.5", "30", "red"],
    ]
    assert ElementTree.parse(drawing).getroot().tag == "{http://www.w3.org/2000/svg}svg"
    assert "main.half" in drawing.read_text(encoding="utf-8")
    assert [line for line in capsys.readouterr().out.splitlines() if "Written" in line] == [
        f"Written: {table}",
        f"Written: {drawing}",
    ]


@pytest.mark.parametrize("options", [[], ["--trace", "out.csv"]])
def test_fault_is_told_with_its_line(options: list[str], tmp_path: Path, monkeypatch, capsys) -> None:
    monkeypatch.chdir(tmp_path)
    Path("stops.st").write_text(_FAULT, encoding="utf-8")
    assert main(["run", "stops.st", "--scans", "9", "--watch", "main.n", *options]) == 1
    captured = capsys.readouterr()
    assert "error[zero]: A fault stopped the program in main: a division by zero." in captured.err
    assert "--> stops.st:4:1" in captured.err
    assert "x := 9 / (3 - n);" in captured.err
    assert "stopped by a fault" in captured.out


def test_fault_in_a_project_is_told_with_its_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    main(["new", str(tmp_path / "hello"), "--board", "pico"])
    source = tmp_path / "hello" / "src" / "main.st"
    source.write_text(_FAULT, encoding="utf-8")
    assert main(["run", str(tmp_path / "hello"), "--scans", "9"]) == 1
    err = capsys.readouterr().err
    assert f"--> {source}:4:1" in err
    assert "4 | x := 9 / (3 - n);" in err


def test_fault_in_json(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "stops.st"
    path.write_text(_FAULT, encoding="utf-8")
    assert main(["run", str(path), "--scans", "9", "--json"]) == 1
    result = json.loads(capsys.readouterr().out)
    assert result["scans"] is None
    assert result["fault"] == {"kind": "zero", "file": str(path), "line": 4, "pou": "main"}


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--scans", "1", "--for", "T#1s"], "take one of them"),
        (["--for", "5"], "`5` is no span of time"),
        (["--trace", "out.csv"], "need an end"),
        (["--scans", "1", "--set", "main.count"], "has no value"),
        (["--scans", "1", "--set", "main.cuont=1"], "main has no cuont; did you mean count?"),
        (["--scans", "1", "--set", "main.count=99999"], "99999 is not in -32768..32767"),
        (["--scans", "1", "--set", "main.count=many"], "main.count is INT: 'many' is no integer"),
        (["--scans", "1", "--set", "main.colour=blue"], "'blue' is none of red, green"),
        (["--scans", "1", "--watch", "other.x"], "there is no other"),
        (["--scans", "1", "--watch", "Half"], "there is no Half; did you mean main.half?"),
    ],
)
def test_wrong_usage(arguments: list[str], said: str, program: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", program, *arguments]) == 2
    assert said in capsys.readouterr().err


def test_error_of_the_program(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "bad.st"
    path.write_text("PROGRAM main\nx := 1;\nEND_PROGRAM\n", encoding="utf-8")
    assert main(["run", str(path), "--scans", "1"]) == 1
    captured = capsys.readouterr()
    assert "error[E0201]" in captured.err
    assert captured.out == ""


def test_no_project_and_no_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["run", "--scans", "1"]) == 2
    assert main(["run", "nope.st", "--scans", "1"]) == 2
    err = capsys.readouterr().err
    assert "There is no project file `iec2mpy.toml`." in err
    assert "There is no file `nope.st`." in err


def test_folder_among_files(program: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", program, str(tmp_path), "--scans", "1"]) == 2
    assert "is a folder: name one project, or only source files" in capsys.readouterr().err
