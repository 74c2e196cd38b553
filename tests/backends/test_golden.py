"""The text of generated modules, in each form."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.golden import GoldenCase, all_cases, check
from tests.renderers import RENDERERS

_FOLDER = Path(__file__).parent / "golden"


@pytest.mark.parametrize("case", all_cases(_FOLDER))
def test_golden(case: GoldenCase) -> None:
    check(case, RENDERERS[_FOLDER])
