"""Projects for the tests of this folder."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest


@pytest.fixture
def make_project(tmp_path: Path) -> Callable[..., Path]:
    """Makes a project with one source: its folder, from the lines behind `[project]` and `name`."""

    def make(lines: str = "", board: str = "pico") -> Path:
        (tmp_path / "src").mkdir(exist_ok=True)
        (tmp_path / "src" / "main.st").write_text("PROGRAM main\nEND_PROGRAM\n")
        text = f'[project]\nname = "test"\nboard = "{board}"\n{lines}\n'
        (tmp_path / "iec2mpy.toml").write_text(text)
        return tmp_path

    return make
