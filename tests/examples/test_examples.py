"""The examples: without errors and warnings, built for their board, passing on every engine, and shown as they are."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from iec2mpy.backends.target import ENGINE_TARGETS
from iec2mpy.cli import main

ROOT = Path(__file__).parents[2]
EXAMPLES = sorted(path.parent for path in (ROOT / "examples").glob("*/iec2mpy.toml"))


def test_there_are_examples() -> None:
    assert [path.name for path in EXAMPLES] == ["blink", "motor", "tank", "traffic_light"]


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.name)
def test_no_errors_and_no_warnings(example: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", str(example)]) == 0
    captured = capsys.readouterr()
    assert (captured.out, captured.err) == ("No errors.\n", "")


@pytest.mark.parametrize("engine", ENGINE_TARGETS)
@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.name)
def test_tests_pass(example: Path, engine: str, capsys: pytest.CaptureFixture[str]) -> None:
    code = main(["test", str(example), "--engine", engine])
    assert code == 0, capsys.readouterr().out


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.name)
def test_readme_shows_each_address(example: Path) -> None:
    readme = (example / "README.md").read_text(encoding="utf-8")
    sources = "".join(path.read_text(encoding="utf-8") for path in example.glob("src/*.st"))
    assert set(re.findall(r"%[IQ][XW][\d.]+", sources)) <= set(re.findall(r"%[IQ][XW][\d.]+", readme))


def test_demo_is_as_the_readme_shows_it(tmp_path: Path, monkeypatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.chdir(tmp_path)
    recipe = (ROOT / "Makefile").read_text(encoding="utf-8").partition("$(BIN)/iec2mpy run examples/tank ")[2]
    options = recipe.partition("\n\n")[0].replace("\\\n", " ").replace("$(DEMO)", "build/demo").split()
    (tmp_path / "build" / "demo").mkdir(parents=True)
    assert main(["run", str(ROOT / "examples" / "tank"), *options]) == 0
    shown = [line.rstrip() for line in capsys.readouterr().out.splitlines()]
    assert "\n".join(shown) in (ROOT / "README.md").read_text(encoding="utf-8")
    assert (tmp_path / "build/demo/tank.csv").read_text(encoding="utf-8").count("\n") == 6001
    assert (tmp_path / "build/demo/tank.svg").stat().st_size > 10_000
