"""docs/conformance.md says what the tests show, and the limits that it states are the compiler's."""

from __future__ import annotations

import pytest

from iec2mpy.project.compile import check_files
from iec2mpy.semantics.type_specs import MAX_ELEMENTS
from iec2mpy.source.diagnostics import CompileError
from iec2mpy.source.spans import SourceFile
from iec2mpy.syntax.balance import DEEPEST_BLOCK
from tests.conformance.statement import NO_CASE, NOT, PARTLY, STATEMENT, SUPPORTED, Feature, statement


def test_the_file_is_what_the_tests_show() -> None:
    written = STATEMENT.read_text(encoding="utf-8") if STATEMENT.exists() else ""
    same = written == statement()
    assert same, "docs/conformance.md is behind: write it anew with `python -m tests.conformance.statement`."


@pytest.mark.parametrize(
    ("passing", "others", "state"),
    [(["a"], [], SUPPORTED), (["a"], ["b"], PARTLY), ([], ["b"], NOT), ([], [], NO_CASE)],
)
def test_state(passing: list[str], others: list[str], state: str) -> None:
    assert Feature("1.1", "", "", passing, others).state == state


def _codes(source: str) -> set[str]:
    try:
        check_files([SourceFile("limit.st", source)])
    except CompileError as error:
        return {diagnostic.code for diagnostic in error.diagnostics}
    return set()


@pytest.mark.parametrize(("beyond", "codes"), [(0, set()), (1, {"E0512"})])
def test_limit_of_array_elements(beyond: int, codes: set[str]) -> None:
    source = f"PROGRAM main\nVAR a : ARRAY[1..{MAX_ELEMENTS + beyond}] OF BOOL; END_VAR\nEND_PROGRAM\n"
    assert _codes(source) == codes


@pytest.mark.parametrize(("beyond", "codes"), [(0, set()), (1, {"E0125"})])
def test_limit_of_nested_statements(beyond: int, codes: set[str]) -> None:
    depth = DEEPEST_BLOCK + beyond
    body = "IF x THEN\n" * depth + "x := FALSE;\n" + "END_IF;\n" * depth
    assert _codes(f"PROGRAM main\nVAR x : BOOL; END_VAR\n{body}END_PROGRAM\n") == codes
