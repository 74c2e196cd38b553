"""`iec2mpy test`: runs case files, and says what was not as expected."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from iec2mpy.cli.support import UserError, dialect_option, engine_option

if TYPE_CHECKING:
    from iec2mpy.simulator.case_runner import Outcome
    from iec2mpy.simulator.cases import BadCase, Case

_HELP = """Run case files: tests of a program, step by step, in virtual time.

FILES are case files, or projects, whose tests/*.toml are run; without them, the project in this folder.

\b
Examples:
  iec2mpy test                          the tests of the project in this folder
  iec2mpy test tests/main.toml -k alarm only cases with "alarm" in their id or title
  iec2mpy test --engine viper32         as a board computes, on 32 bits
  iec2mpy test --engine all --json results.json

A case passes if it does so on each engine that is named. The last line counts the cases that passed and failed; the
exit code is 1 if one failed. docs/case-files.md describes the files.
"""


@click.command("test", help=_HELP)
@click.argument("files", metavar="[FILES]...", nargs=-1, type=click.Path(path_type=Path))
@engine_option(several=True)
@click.option("-k", "pattern", metavar="PATTERN", default="", help="Only cases with this text in their id or title.")
@click.option("-v", "--verbose", is_flag=True, help="Name the cases that passed, too.")
@click.option("--json", "json_out", metavar="OUT", type=click.Path(path_type=Path), help="Write one record a case.")
@dialect_option
def command(
    files: Sequence[Path],
    engines: Sequence[str],
    pattern: str,
    verbose: bool,
    json_out: Path | None,
    dialect: str | None,
) -> None:
    from iec2mpy.project.config import dialect_of
    from iec2mpy.simulator.case_runner import PASSED, run_case

    cases = _chosen(_case_files(files), pattern)
    outcomes: list[Outcome] = []
    for case in cases:
        outcome = run_case(case, engines, dialect or dialect_of(case.file.resolve().parent.parent))
        outcomes.append(outcome)
        if outcome.outcome != PASSED or verbose:
            _show(outcome)
    if json_out is not None:
        json_out.write_text(json.dumps([_record(o) for o in outcomes], indent=1) + "\n", encoding="utf-8")
    passed = sum(o.outcome == PASSED for o in outcomes)
    click.echo(f"{passed} passed, {len(outcomes) - passed} failed")
    if passed < len(outcomes):
        raise click.exceptions.Exit(1)


def _case_files(arguments: Sequence[Path]) -> list[Path]:
    found: list[Path] = []
    for path in arguments or [Path()]:
        if not path.is_dir():
            found.append(path)
            continue
        tests = sorted(path.glob("tests/*.toml"))
        if not tests:
            raise UserError(f"there are no case files in {path / 'tests'}")
        found += tests
    return found


def _chosen(files: Sequence[Path], pattern: str) -> list[Case | BadCase]:
    from iec2mpy.simulator.cases import CaseFileError, load_case_file

    try:
        cases = [case for path in files for case in load_case_file(path)]
    except CaseFileError as error:
        raise UserError(str(error)) from None
    wanted = pattern.casefold()
    chosen = [case for case in cases if wanted in f"{case.id} {case.title}".casefold()]
    if not chosen:
        raise UserError(f'no case has "{pattern}" in its id or title' if cases else "the case files hold no case")
    return chosen


def _show(outcome: Outcome) -> None:
    case = outcome.case
    title = f" ({case.title})" if case.title else ""
    click.echo(f"{outcome.outcome:7}{case.file}: {case.id}{title}")
    if outcome.message:
        click.echo(f"       {outcome.message}")


def _record(outcome: Outcome) -> dict[str, object]:
    case = outcome.case
    return {
        "file": str(case.file),
        "id": case.id,
        "features": list(case.features),
        "outcome": outcome.outcome,
        "message": outcome.message,
    }
