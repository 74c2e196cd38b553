"""A project becomes the files that docs/internals.md names; what does not fit the board is told."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from iec2mpy.backends.target import PORTABLE
from iec2mpy.project.build import build_project, write_build
from iec2mpy.project.compile import check_files, compile_files, lower
from iec2mpy.project.config import load_project
from iec2mpy.source.diagnostics import CompileError
from iec2mpy.source.spans import SourceFile

_EXAMPLES = Path(__file__).parents[2] / "examples"


def test_files() -> None:
    build = build_project(load_project(_EXAMPLES / "blink"))
    assert set(build.files) == {"program.py", "program.mpy", "program.names", "program.map.json", "board.py"}
    assert set(build.board_files) == {"program.mpy", "program.names", "board.py"}
    text = build.files["program.py"].decode()
    namespace = {line.split(" = ")[0] for line in text.splitlines() if " = " in line}
    assert {"V", "O", "TASKS", "UNTIMED", "RETAIN", "INPUTS", "OUTPUTS", "HASH"} <= namespace
    assert "def reset():" in text
    assert "@micropython.viper" in text
    assert f'HASH = "{build.program.hash}"' in text
    assert json.loads(build.files["program.map.json"])["program"] == build.program.hash
    assert "CHANNELS" in build.files["board.py"].decode()


def test_another_emitter() -> None:
    build = build_project(load_project(_EXAMPLES / "blink"), "portable")
    assert "viper" not in build.files["program.py"].decode()
    assert build.files["program.mpy"][2] >> 2 == 0


def test_the_same_text_gives_the_same_program() -> None:
    first, second = (build_project(load_project(_EXAMPLES / "tank")) for _ in range(2))
    assert first.files == second.files


def test_written(tmp_path: Path) -> None:
    build = build_project(load_project(_EXAMPLES / "blink"))
    paths = write_build(build, tmp_path / "new" / "folder")
    assert {path.name: path.read_bytes() for path in paths} == build.files


def test_lreal_is_single_on_boards(tmp_path: Path) -> None:
    (tmp_path / "src").mkdir()
    text = "PROGRAM main\nVAR a : REAL; x, y : LREAL; END_VAR\ny := x;\nEND_PROGRAM\n"
    (tmp_path / "src" / "main.st").write_text(text)
    (tmp_path / "iec2mpy.toml").write_text('[project]\nname = "long"\nboard = "pico"\n')
    warnings = build_project(load_project(tmp_path)).warnings
    assert [(w.code, w.message.split()[0]) for w in warnings] == [("W0301", "`x`")]


def _source(text: str) -> list[SourceFile]:
    return [SourceFile("main.st", text)]


def test_all_errors_of_a_program_at_once() -> None:
    with pytest.raises(CompileError) as raised:
        compile_files(_source("PROGRAM main\nVAR a : INT; END_VAR\na := b;\na := TRUE;\nEND_PROGRAM\n"), PORTABLE)
    assert [d.span and d.span.line for d in raised.value.diagnostics] == [3, 4]


def test_too_many_variables() -> None:
    with pytest.raises(CompileError) as raised:
        compile_files(_source(_LARGE), PORTABLE)
    (diagnostic,) = raised.value.diagnostics
    assert diagnostic.code == "E0846"
    assert diagnostic.message == "The program needs 9 slots of V and 20001 of O; there are 65536 and 16384."


_LARGE = "PROGRAM main\nVAR a : ARRAY[1..20000] OF REAL; i : INT; END_VAR\na[i] := a[i];\nEND_PROGRAM\n"


def test_warnings_come_with_the_program() -> None:
    text = "PROGRAM main\nVAR a : INT; END_VAR\nCASE a OF\n1: a := 2;\n0..3: a := 3;\nEND_CASE;\nEND_PROGRAM\n"
    checked = check_files(_source(text))
    assert [d.span and d.span.line for d in checked.warnings] == [5]
    assert lower(checked).programs[0].name == "main"
