"""The name that was probably meant."""

from __future__ import annotations

import pytest

from iec2mpy.source.suggest import suggest


@pytest.mark.parametrize(
    ("name", "found"),
    [("moter", "Motor"), ("MOTOR", "Motor"), ("vlave", "Valve"), ("x", None), ("pump", None), ("", None)],
)
def test_suggest(name: str, found: str | None) -> None:
    assert suggest(name, ["Motor", "Valve", "level"]) == found
