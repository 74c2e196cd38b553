"""Configurations: tasks and programs."""

from __future__ import annotations

import pytest

from iec2mpy.semantics.typed import Application
from tests.semantics.checking import check_text, checked, codes

_TASK = "TASK t(INTERVAL := T#5ms, PRIORITY := 1);"
MAIN = "PROGRAM main\nVAR n : INT; END_VAR\nn := n + 1;\nEND_PROGRAM\n"


def configured(inner: str) -> str:
    return f"{MAIN}CONFIGURATION plant\nRESOURCE cpu ON PLC\n{inner}\nEND_RESOURCE\nEND_CONFIGURATION\n"


def test_without_a_configuration_one_task_runs_all_programs() -> None:
    application = checked(MAIN + MAIN.replace("main", "second"))
    assert [(t.name, t.interval) for t in application.tasks] == [("main", 10_000)]
    assert [(p.name, p.task) for p in application.programs] == [
        ("main", application.tasks[0]),
        ("second", application.tasks[0]),
    ]


def test_tasks_and_programs() -> None:
    application = checked(
        configured(
            "TASK fast(INTERVAL := T#5ms, PRIORITY := 1); TASK slow(INTERVAL := T#1s, PRIORITY := 2);\n"
            "PROGRAM a WITH fast : main; PROGRAM RETAIN b WITH slow : main; PROGRAM c : main;"
        )
    )
    assert [(t.name, t.interval, t.priority) for t in application.tasks] == [("fast", 5000, 1), ("slow", 1_000_000, 2)]
    programs = [(p.name, p.task.name if p.task else None, p.retain) for p in application.programs]
    assert programs == [("a", "fast", None), ("b", "slow", True), ("c", None, None)]


@pytest.mark.parametrize(
    ("inner", "found"),
    [
        (_TASK + "\nPROGRAM a WITH u : main;", [("E0201", 8)]),
        (_TASK + "\nPROGRAM a WITH t : man;", [("E0203", 8)]),
        ("TASK t(INTERVAL := 10, PRIORITY := 1);\nPROGRAM a WITH t : main;", [("E0301", 7)]),
        ("TASK t(PRIORITY := 1);\nPROGRAM a WITH t : main;", [("E0801", 7)]),
        ("TASK t(INTERVAL := T#5ms, PRIORITY := 99999);\nPROGRAM a WITH t : main;", [("E0802", 7)]),
        (
            f"{_TASK}\n{_TASK.upper()}\nPROGRAM a WITH t : main;",
            [("E0202", 8)],
        ),
        (
            _TASK + "\nPROGRAM a WITH t : main;\nPROGRAM A WITH t : main;",
            [("E0202", 9)],
        ),
        ("TASK t(SINGLE := %IX0.0, PRIORITY := 1);\nPROGRAM a WITH t : main;", [("E0918", 7)]),
    ],
)
def test_wrong_configurations(inner: str, found: list[tuple[str, int]]) -> None:
    assert codes(configured(inner)) == found


def test_globals_of_a_configuration() -> None:
    text = """PROGRAM main
VAR_EXTERNAL g : INT; END_VAR
g := g + 1;
END_PROGRAM
CONFIGURATION plant
VAR_GLOBAL g : INT := 3; END_VAR
RESOURCE cpu ON PLC
VAR_GLOBAL RETAIN h AT %MW4 : INT; END_VAR
TASK t(INTERVAL := T#10ms, PRIORITY := 1);
PROGRAM p WITH t : main;
END_RESOURCE
END_CONFIGURATION
"""
    application = checked(text)
    assert [(v.name, v.initial, v.retain, v.address) for v in application.globals.values()] == [
        ("g", 3, None, None),
        ("h", 0, True, "%MW4"),
    ]


def test_a_second_resource_is_not_there_yet() -> None:
    text = configured(_TASK + "\nPROGRAM a WITH t : main;").replace(
        "END_CONFIGURATION",
        f"RESOURCE cpu2 ON PLC\n{_TASK}\nPROGRAM b WITH t : main;\nEND_RESOURCE\nEND_CONFIGURATION",
    )
    assert [code for code, _ in codes(text)] == ["E0918"]


def test_a_library_without_programs_is_no_error() -> None:
    application, diagnostics = check_text("FUNCTION_BLOCK B\nVAR n : INT; END_VAR\nn := n + 1;\nEND_FUNCTION_BLOCK\n")
    assert isinstance(application, Application)
    assert diagnostics.items == []
    assert application.programs == []
