"""What the standard leaves to the implementer. Limits come from the compiler itself, choices from docs/language.md."""

from __future__ import annotations

import re

from iec2mpy.backends.layout import FIRST, MAX_OBJECTS, MAX_SLOTS
from iec2mpy.project.compile import DEFAULT_INTERVAL_US
from iec2mpy.semantics.configuration import MAX_PRIORITY
from iec2mpy.semantics.type_specs import MAX_ELEMENTS
from iec2mpy.semantics.types import DEFAULT_STRING_LENGTH
from iec2mpy.syntax.balance import DEEPEST_BLOCK, DEEPEST_EXPRESSION
from tests.conformance.suite import HERE

_GUIDE = HERE.parents[1] / "docs" / "language.md"
_CHOICES = re.compile(r"^## Where the standard leaves a choice\n\n(\|.*?)\n\n", re.MULTILINE | re.DOTALL)

LIMITS: tuple[tuple[str, str, str], ...] = (
    ("6.1.2", "significant characters of a name", "all; its length has no limit"),
    ("6.1.5", "nested comments", "of both kinds, to any depth"),
    ("6.2", "pragmas", "skipped"),
    ("6.4.2", "length of a STRING that is declared without one", f"{DEFAULT_STRING_LENGTH} characters"),
    ("6.4.4.5", "elements of an ARRAY", f"{MAX_ELEMENTS:,}"),
    ("6.5", "values of all variables of 32 bits or less together", f"{MAX_SLOTS - FIRST:,}"),
    ("6.5", "values of all other variables together", f"{MAX_OBJECTS - 1:,}"),
    ("6.8.2", "PRIORITY of a task", f"0, the most urgent, to {MAX_PRIORITY:,}"),
    (
        "6.8.2",
        "interval of programs without a CONFIGURATION",
        f"{DEFAULT_INTERVAL_US // 1000} ms, or as the project says",
    ),
    ("7.3.2", "operators, brackets and members nested in one expression", f"{DEEPEST_EXPRESSION}"),
    ("7.3.3", "statements nested in one another", f"{DEEPEST_BLOCK}"),
)
"""Rows of (clause, what, value)."""


def choices() -> list[str]:
    """The rows of the user guide's table of choices, as they stand there."""
    table = _CHOICES.search(_GUIDE.read_text(encoding="utf-8"))
    if table is None:
        raise ValueError(f"{_GUIDE} has no table of choices")
    return table[1].splitlines()
