"""Case files: tests of a PLC program, as TOML. Reading and checking; `case_runner` runs them.

The format is described in docs/case-files.md. A case that is not as it describes becomes a `BadCase`, and the other
cases of its file still run: one misspelt key hides no other result.
"""

from __future__ import annotations

import difflib
import tomllib
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from iec2mpy.project.durations import parse_duration

DEFAULT_INTERVAL_US = 10_000
ABOUT = ("syntax", "type", "name", "range", "access", "const", "call", "decl", "flow", "config")
RESTARTS = ("warm", "cold")


class CaseFileError(Exception):
    """A case file that cannot be read at all. The text is a sentence for the user."""


class _Malformed(Exception):
    """What is wrong with one case, without its file and id."""


@dataclass(frozen=True, slots=True)
class Step:
    """A restart if one is named, then `set`, then the scans, then `expect` or `fault`. `number` counts from 1.

    One of `scans` and `run_us` (a span in microseconds) is None.
    """

    number: int
    set: Mapping[str, Any] = field(default_factory=dict)
    restart: str | None = None
    scans: int | None = 1
    run_us: int | None = None
    expect: Mapping[str, Any] = field(default_factory=dict)
    fault: str | None = None


@dataclass(frozen=True, slots=True)
class ExpectedError:
    """An error that the compiler must report on `line` of the source, or of `file` where the case has several."""

    line: int
    about: str
    file: str | None = None


@dataclass(frozen=True, slots=True)
class Case:
    """One test. It has `source` or `files`, and `steps` or `error`. `file` is the case file's path as it was given."""

    file: Path
    id: str
    features: tuple[str, ...]
    title: str
    source: str | None
    files: tuple[str, ...]
    interval_us: int
    steps: tuple[Step, ...]
    error: ExpectedError | None


@dataclass(frozen=True, slots=True)
class BadCase:
    """A case that is not as the format says. `message` is a sentence; `id` is what could be found out."""

    file: Path
    id: str
    title: str
    features: tuple[str, ...]
    message: str


def load_case_file(path: Path) -> list[Case | BadCase]:
    """All cases of a file, in its order. Raises CaseFileError where the file cannot be read as TOML."""
    return cases_of(path, read_tables(path))


def cases_of(path: Path, tables: Iterable[Mapping[str, Any]]) -> list[Case | BadCase]:
    """The cases that the tables of a file hold."""
    cases: list[Case | BadCase] = []
    seen: dict[str, int] = {}
    for position, table in enumerate(tables, start=1):
        name = table.get("id")
        name = name if isinstance(name, str) and name else f"case {position}"
        try:
            if name in seen:
                raise _Malformed(f'the id "{name}" is used twice; it is also that of case {seen[name]} of the file')
            seen[name] = position
            cases.append(_case(path, table))
        except _Malformed as error:
            cases.append(_bad_case(path, name, table, f"the case is not well formed: {error}"))
    return cases


def _bad_case(path: Path, name: str, table: Mapping[str, Any], message: str) -> BadCase:
    """With its title and features, if these are as they should be."""
    title, features = table.get("title"), table.get("features")
    return BadCase(
        file=path,
        id=name,
        title=title if isinstance(title, str) else "",
        features=tuple(f for f in features if isinstance(f, str)) if isinstance(features, list) else (),
        message=message,
    )


def read_tables(path: Path) -> list[dict[str, Any]]:
    """The tables `[[case]]` of a file, unchecked. Raises CaseFileError where the file cannot be read as TOML."""
    try:
        with path.open("rb") as file:
            data = tomllib.load(file)
    except tomllib.TOMLDecodeError as error:
        raise CaseFileError(f"{path} is not TOML: {error}") from None
    except UnicodeDecodeError:
        raise CaseFileError(f"{path} is not UTF-8 text") from None
    except OSError as error:
        raise CaseFileError(f"{path} cannot be read: {error.strerror}") from None
    unknown = [key for key in data if key != "case"]
    if unknown:
        raise CaseFileError(f"{path}: `{unknown[0]}` is no key of a case file, where each case starts with [[case]]")
    tables = data.get("case", [])
    if not isinstance(tables, list) or not all(isinstance(t, dict) for t in tables):
        raise CaseFileError(f"{path}: a case starts with [[case]], in double brackets")
    return tables


# ------------------------------------------------------------------------------------------ one case

_CASE_KEYS = ("id", "features", "title", "source", "files", "interval", "steps", "error", "tolerance", "note")
_STEP_KEYS = ("set", "scans", "run", "restart", "expect", "fault")
_ERROR_KEYS = ("line", "about", "file")


def _case(path: Path, table: Mapping[str, Any]) -> Case:
    _only(_CASE_KEYS, table, "a case")
    source = _text(table, "source")
    files = _texts(table, "files")
    _one_of(table, "source", "files")
    _one_of(table, "steps", "error")
    # `tolerance` matters only where time is real; here it must still be a duration
    _duration(table, "tolerance", "T#20ms")
    for key in ("title", "note"):
        _text(table, key)
    case = Case(
        file=path,
        id=_required(_text(table, "id"), "id"),
        features=_texts(table, "features"),
        title=_text(table, "title") or "",
        source=source,
        files=files,
        interval_us=_duration(table, "interval", "T#10ms") or DEFAULT_INTERVAL_US,
        steps=_steps(table["steps"]) if "steps" in table else (),
        error=_error(table["error"], files) if "error" in table else None,
    )
    if "files" in table and not files:
        raise _Malformed("`files` is empty")
    if "steps" in table and not case.steps:
        raise _Malformed("`steps` is empty: nothing would be tested")
    return case


def _steps(value: Any) -> tuple[Step, ...]:
    if not isinstance(value, list):
        raise _Malformed("`steps` must be a list of tables: steps = [ { expect = { ... } } ]")
    steps: list[Step] = []
    for number, table in enumerate(value, start=1):
        try:
            step = _step(number, table)
            if steps and steps[-1].fault is not None and step.restart is None:
                raise _Malformed("the step before it expects a fault, which stops the controller: it needs `restart`")
        except _Malformed as error:
            raise _Malformed(f"step {number}: {error}") from None
        steps.append(step)
    return tuple(steps)


def _step(number: int, table: Any) -> Step:
    if not isinstance(table, dict):
        raise _Malformed("a step must be a table: { expect = { ... } }")
    _only(_STEP_KEYS, table, "a step")
    for pair in (("scans", "run"), ("expect", "fault")):
        if all(key in table for key in pair):
            raise _Malformed(f"it has both `{pair[0]}` and `{pair[1]}`")
    scans = table.get("scans", 1)
    if not isinstance(scans, int) or isinstance(scans, bool) or scans < 0:
        raise _Malformed("`scans` must be a whole number, 0 or more")
    restart = _text(table, "restart")
    if restart is not None and restart not in RESTARTS:
        raise _Malformed(f'`restart` must be "warm" or "cold", not "{restart}"')
    run_us = _duration(table, "run", "T#200ms")
    return Step(
        number=number,
        set=_values(table, "set"),
        restart=restart,
        scans=scans if run_us is None else None,
        run_us=run_us,
        expect=_values(table, "expect"),
        fault=_text(table, "fault"),
    )


def _error(table: Any, files: Collection[str]) -> ExpectedError:
    if not isinstance(table, dict):
        raise _Malformed('`error` must be a table: error = { line = 3, about = "type" }')
    _only(_ERROR_KEYS, table, "`error`")
    line = table.get("line")
    if not isinstance(line, int) or isinstance(line, bool) or line < 1:
        raise _Malformed("`error` needs `line`, a whole number from 1")
    about = _required(_text(table, "about"), "error.about")
    if about not in ABOUT:
        raise _Malformed(f'`about` must be one of {", ".join(ABOUT)}, not "{about}"')
    file = _text(table, "file")
    if file is not None and file not in files:
        raise _Malformed(f'`error` names the file "{file}", which is not in `files`')
    if file is None and len(files) > 1:
        raise _Malformed("`error` must name its `file`, as `files` has several")
    return ExpectedError(line, about, file)


# ---------------------------------------------------------------------------------------- single keys


def _only(known: Collection[str], table: Mapping[str, Any], where: str) -> None:
    for key in table:
        if key not in known:
            close = difflib.get_close_matches(key, known, n=1)
            hint = f"did you mean `{close[0]}`?" if close else f"known are {', '.join(known)}"
            raise _Malformed(f"`{key}` is no key of {where} ({hint})")


def _one_of(table: Mapping[str, Any], first: str, second: str) -> None:
    if (first in table) == (second in table):
        what = f"both `{first}` and" if first in table else f"neither `{first}` nor"
        raise _Malformed(f"it has {what} `{second}`; exactly one is needed")


def _text(table: Mapping[str, Any], key: str) -> str | None:
    value = table.get(key)
    if value is not None and not isinstance(value, str):
        raise _Malformed(f"`{key}` must be a text")
    return value


def _required(text: str | None, key: str) -> str:
    if not text:
        raise _Malformed(f"`{key}` is missing")
    return text


def _texts(table: Mapping[str, Any], key: str) -> tuple[str, ...]:
    value = table.get(key, [])
    if not isinstance(value, list) or not all(isinstance(v, str) for v in value):
        raise _Malformed(f"`{key}` must be a list of texts")
    return tuple(value)


def _duration(table: Mapping[str, Any], key: str, example: str) -> int | None:
    """A duration in microseconds."""
    text = _text(table, key)
    if text is None:
        return None
    microseconds = parse_duration(text)
    if not microseconds:
        raise _Malformed(f'`{key}` must be a duration above 0, such as "{example}", not "{text}"')
    return microseconds


def _values(table: Mapping[str, Any], key: str) -> dict[str, Any]:
    value = table.get(key, {})
    if not isinstance(value, dict):
        raise _Malformed(f'`{key}` must be a table of paths and values: {key} = {{ "main.x" = 1 }}')
    return value
