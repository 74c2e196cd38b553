"""Boards for the tests of this folder."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from tests.device.board import Board


@pytest.fixture
def make_board(tmp_path: Path) -> Iterator[Callable[..., Board]]:
    """Makes boards, each with an empty file system; ends them after the test."""
    boards: list[Board] = []

    def make(boot: str = "") -> Board:
        files = tmp_path / f"board{len(boards)}"
        files.mkdir()
        boards.append(Board(files, boot))
        return boards[-1]

    yield make
    for board in boards:
        board.close()


@pytest.fixture
def board(make_board: Callable[..., Board]) -> Board:
    """A board as it comes from the shop."""
    return make_board()
