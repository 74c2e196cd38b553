"""Runs cases: compiles the program of each, does its steps on an engine, and says what was not as expected."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

from iec2mpy.backends import GeneratedProgram, Target
from iec2mpy.backends.memory_map import BadValue, MemoryMap, UnknownPath
from iec2mpy.backends.target import ENGINE_TARGETS
from iec2mpy.ir import Module
from iec2mpy.project.compile import check_files, generate, lower
from iec2mpy.simulator.cases import BadCase, Case, ExpectedError, Step
from iec2mpy.simulator.engines import EngineError, EngineUnavailable
from iec2mpy.simulator.session import Simulation
from iec2mpy.simulator.values import differences
from iec2mpy.source.diagnostics import CompileError, Diagnostic, Severity
from iec2mpy.source.files import read_sources
from iec2mpy.source.spans import STRICT, SourceFile

PASSED, FAILED, ERROR = "passed", "failed", "error"
_NOT_YET = "E09"


@dataclass(frozen=True, slots=True)
class Outcome:
    """What became of a case. `outcome` is "passed", "failed" (something was not as expected) or "error" (the case could
    not be run to its end: it is malformed, or its program does not compile). `message` says why, in sentences."""

    case: Case | BadCase
    outcome: str
    message: str = ""
    diagnostics: Sequence[Diagnostic] = ()


class Programs:
    """The program of a case, compiled once, and generated once for each target."""

    def __init__(self, case: Case, dialect: str = STRICT) -> None:
        self._case = case
        self._dialect = dialect
        self._generated: dict[Target, GeneratedProgram] = {}

    @cached_property
    def _module(self) -> Module:
        return lower(check_files(_files(self._case, self._dialect), self._case.interval_us))

    def for_engine(self, engine: str) -> GeneratedProgram:
        """The form of the program that an engine executes. Raises CompileError."""
        target = ENGINE_TARGETS[engine]
        if target not in self._generated:
            self._generated[target] = generate(self._module, target)
        return self._generated[target]


def _files(case: Case, dialect: str) -> list[SourceFile]:
    if case.source is not None:
        return [SourceFile(f"{case.file} ({case.id})", case.source, dialect=dialect)]
    return read_sources((case.file.parent / name for name in case.files), dialect=dialect)


def run_case(case: Case | BadCase, engines: Sequence[str], dialect: str = STRICT) -> Outcome:
    """Runs a case on each of the engines; the first one on which it does not pass decides. `dialect` is its program's.

    Raises EngineUnavailable where an engine is not installed.
    """
    if isinstance(case, BadCase):
        return Outcome(case, ERROR, case.message)
    try:
        return _run_on_all(case, engines, dialect)
    except EngineUnavailable:
        raise
    except Exception as error:
        # one fault of the compiler must not hide what became of all other cases
        return Outcome(case, ERROR, f"a fault of iec2mpy itself, please report it: {type(error).__name__}: {error}")


def _run_on_all(case: Case, engines: Sequence[str], dialect: str) -> Outcome:
    programs = Programs(case, dialect)
    if case.error is not None:
        return _expect_error(case, case.error, programs, engines[0])
    for engine in engines:
        outcome = run_steps(case, programs, engine)
        if outcome.outcome != PASSED:
            where = f"engine {engine}: " if len(engines) > 1 else ""
            return replace(outcome, message=where + outcome.message)
    return Outcome(case, PASSED)


def _expect_error(case: Case, expected: ExpectedError, programs: Programs, engine: str) -> Outcome:
    try:
        programs.for_engine(engine)
    except CompileError as error:
        errors = [d for d in error.diagnostics if d.severity is Severity.ERROR]
        # that a construct is not supported yet says nothing about whether it is used rightly
        proper = [d for d in errors if not d.code.startswith(_NOT_YET)]
        if any(_is_at(d, expected) for d in proper):
            return Outcome(case, PASSED)
        found = _list(errors)
    else:
        errors, found = [], "it compiles without an error"
    message = f"expected an error ({expected.about}) on line {expected.line}; found: {found}"
    return Outcome(case, FAILED, message, errors)


def _is_at(diagnostic: Diagnostic, expected: ExpectedError) -> bool:
    span = diagnostic.span
    right_file = span is not None and (expected.file is None or Path(span.file.path).match(expected.file))
    return span is not None and right_file and span.line == expected.line


def run_steps(case: Case, programs: Programs, engine: str) -> Outcome:
    """Runs the steps of a case on one engine. Raises EngineUnavailable where it is not installed."""
    try:
        program = programs.for_engine(engine)
    except CompileError as error:
        errors = [d for d in error.diagnostics if d.severity is Severity.ERROR]
        return Outcome(case, ERROR, f"the program does not compile: {_list(errors)}", errors)
    try:
        with Simulation(program, engine) as simulation:
            for step in case.steps:
                problem = _run_step(simulation, program.map, step)
                if problem:
                    return Outcome(case, FAILED, f"step {step.number}: {problem}")
    except EngineUnavailable:
        raise
    except (EngineError, UnknownPath, BadValue) as error:
        return Outcome(case, ERROR, str(error))
    return Outcome(case, PASSED)


def _run_step(simulation: Simulation, memory_map: MemoryMap, step: Step) -> str:
    """Does a step; gives what was not as expected, or ""."""
    if step.restart is not None:
        simulation.restart(cold=step.restart == "cold")
    for path, value in step.set.items():
        simulation.set(path, value)
    fault = simulation.run(step.run_us) if step.run_us is not None else simulation.scan(step.scans or 0)
    if step.fault is not None:
        if fault is None:
            return f"expected the fault `{step.fault}`, and nothing stopped the program"
        return "" if step.fault in fault.text else f"expected the fault `{step.fault}`, found {fault.message}"
    if fault is not None:
        return f"a fault stopped the program: {fault.message}"
    found = (
        difference
        for path, value in step.expect.items()
        for difference in differences(memory_map, memory_map.resolve(path), value, simulation.get(path))
    )
    return "; ".join(found)


def _list(errors: Sequence[Diagnostic]) -> str:
    """The first three errors, each with its place."""
    shown = [f"{_place(d)}{d.code}: {d.message}" for d in errors[:3]]
    more = [f"and {len(errors) - 3} more"] if len(errors) > 3 else []
    return "; ".join(shown + more)


def _place(diagnostic: Diagnostic) -> str:
    span = diagnostic.span
    return f"{Path(span.file.path).name}, line {span.line}: " if span is not None else ""
