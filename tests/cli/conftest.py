"""Fixtures for the tests of the commands."""

from tests.device.conftest import board, make_board

__all__ = ["board", "make_board"]
