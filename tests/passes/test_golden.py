"""What each pass does to the IR by itself, and what it must leave alone."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.golden import GoldenCase, all_cases, check
from tests.renderers import RENDERERS

_FOLDER = Path(__file__).parent / "golden"


@pytest.mark.parametrize("case", all_cases(_FOLDER))
def test_golden(case: GoldenCase) -> None:
    check(case, RENDERERS[_FOLDER])
