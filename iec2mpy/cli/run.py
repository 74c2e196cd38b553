"""`iec2mpy run`: simulates a program on this computer."""

from __future__ import annotations

import dataclasses
import json
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

import click

from iec2mpy.cli.support import UserError, dialect_option, engine_option, load_program, show_diagnostics, show_fault

if TYPE_CHECKING:
    from iec2mpy.backends import GeneratedProgram
    from iec2mpy.simulator.session import Fault, Simulation
    from iec2mpy.simulator.watching import Watched

_REFRESH_S = 0.1
"""How often the live table is drawn."""

_HELP = """Simulate a program on this computer.

PATH is a project's folder, or source files that make one program; without it, the project in this folder.

Without --scans and --for, the program runs in real time, with a live table of its inputs, outputs and watched
variables, until Ctrl-C. With one of them it runs in virtual time, as fast as it goes, and the table shows the last
values.

\b
Examples:
  iec2mpy run
  iec2mpy run --set %IX0.0=true --watch main.timer
  iec2mpy run examples/tank --for T#60s --set main.simulated=true
  iec2mpy run main.st --for T#10s --trace out.csv --plot out.svg
"""


@click.command("run", help=_HELP)
@click.argument("paths", metavar="[PATH]...", nargs=-1, type=click.Path(path_type=Path))
@click.option("--scans", type=click.IntRange(min=1), metavar="N", help="Run N scans in virtual time.")
@click.option("--for", "duration", metavar="T#5s", help="Run for this span of virtual time.")
@engine_option(several=False)
@click.option("--set", "settings", metavar="PATH=VALUE", multiple=True, help="Set a variable or an input at the start.")
@click.option("--watch", "watches", metavar="PATH", multiple=True, help="Show this variable, too.")
@click.option("--trace", metavar="OUT.csv", type=click.Path(path_type=Path), help="Write the values after each scan.")
@click.option("--plot", metavar="OUT.svg", type=click.Path(path_type=Path), help="Draw the values over the time.")
@click.option("--json", "as_json", is_flag=True, help="Print the last values as JSON, and no table.")
@dialect_option
def command(
    paths: Sequence[Path],
    scans: int | None,
    duration: str | None,
    engine: str,
    settings: Sequence[str],
    watches: Sequence[str],
    trace: Path | None,
    plot: Path | None,
    as_json: bool,
    dialect: str | None,
) -> None:
    span_us = _span(scans, duration)
    if scans is None and span_us is None and (trace or plot or as_json):
        raise click.UsageError("--trace, --plot and --json need an end: say --scans or --for.")
    if plot is not None and find_spec("matplotlib") is None:
        raise UserError("--plot needs matplotlib: pip install 'iec2mpy[plot]'")
    from iec2mpy.backends.target import ENGINE_TARGETS
    from iec2mpy.project.compile import check_files, generate, lower
    from iec2mpy.simulator.session import Simulation
    from iec2mpy.simulator.watching import watch

    source = load_program(paths, dialect)
    checked = check_files(source.files, source.interval_us)
    show_diagnostics(checked.warnings)
    program = generate(lower(checked), ENGINE_TARGETS[engine])
    with _said_of("--watch"):
        watched = watch(program.map, watches)
    with Simulation(program, engine) as simulation:
        for setting in settings:
            _set(simulation, program, setting)
        count = scans if scans is not None else span_us and span_us // simulation.period
        if count is None:
            fault = _run_live(simulation, watched, source.name)
        elif trace or plot:
            fault = _record(simulation, watched, count, trace, plot, source.name)
        else:
            fault = simulation.scan(count)
        if count is not None:
            _show_last(simulation, watched, source.name, count, fault, as_json)
    for path in (trace, plot):
        if path is not None and not as_json:
            click.echo(f"Written: {path}")
    if fault is not None:
        show_fault(fault, source.files)
        raise click.exceptions.Exit(1)


def _span(scans: int | None, duration: str | None) -> int | None:
    """The span of --for in microseconds."""
    from iec2mpy.project.durations import parse_duration

    if duration is None:
        return None
    if scans is not None:
        raise click.UsageError("--scans and --for both say when to end: take one of them.")
    span = parse_duration(duration)
    if not span:
        raise click.UsageError(f"`{duration}` is no span of time; write for example --for T#1m30s.")
    return span


@contextmanager
def _said_of(option: str) -> Iterator[None]:
    """Variables that the program does not have, and values that they cannot have, are mistakes of the command line."""
    from iec2mpy.backends.memory_map import BadValue, UnknownPath

    try:
        yield
    except (UnknownPath, BadValue) as error:
        raise UserError(f"{option}: {error.args[0]}") from None


def _set(simulation: Simulation, program: GeneratedProgram, setting: str) -> None:
    from iec2mpy.simulator.values import parse_value

    path, equals, text = setting.partition("=")
    if not equals:
        raise click.UsageError(f"`--set {setting}` has no value; write for example --set main.speed=5.")
    with _said_of(f"--set {setting}"):
        simulation.set(path.strip(), parse_value(program.map.resolve(path.strip()), text))


def _record(
    simulation: Simulation, watched: Sequence[Watched], count: int, csv: Path | None, svg: Path | None, name: str
) -> Fault | None:
    """Scans one by one, with a row for each."""
    from iec2mpy.simulator.trace import Trace, draw_svg, write_csv
    from iec2mpy.simulator.watching import numbers, values

    recorded = Trace([w.column for w in watched])
    fault = None
    for scan in range(count):
        fault = simulation.scan()
        if fault is not None:
            break
        recorded.add(scan * simulation.period / 1000, numbers(watched, values(simulation, watched)))
    if csv is not None:
        write_csv(recorded, csv)
    if svg is not None:
        draw_svg(recorded, svg, name)
    return fault


def _show_last(
    simulation: Simulation, watched: Sequence[Watched], name: str, count: int, fault: Fault | None, as_json: bool
) -> None:
    from iec2mpy.simulator.watching import values

    last = values(simulation, watched)
    if as_json:
        groups: dict[str, dict[str, object]] = {"inputs": {}, "outputs": {}, "watched": {}}
        for variable, value in zip(watched, last, strict=True):
            groups[variable.group][variable.path] = value
        done: dict[str, object] = {"scans": count, "fault": None}
        if fault is not None:
            done = {"scans": None, "fault": dataclasses.asdict(fault)}
        click.echo(json.dumps({"name": name, **groups, **done}, indent=1))
        return
    from rich.console import Console

    from iec2mpy.backends.coding import format_duration
    from iec2mpy.cli.tables import values_table

    span = format_duration("T", count * simulation.period * 1000, "ms")
    when = "stopped by a fault" if fault is not None else f"after {span} ({count} scans)"
    Console(highlight=False).print(values_table(watched, last, f"{name}, {when}"))


def _run_live(simulation: Simulation, watched: Sequence[Watched], name: str) -> Fault | None:
    """Scans in real time and shows the values, until a fault or Ctrl-C."""
    from rich.live import Live

    from iec2mpy.cli.tables import values_table
    from iec2mpy.simulator.watching import values

    start = time.monotonic()
    done = 0
    fault = None
    with Live(auto_refresh=False) as live:
        while fault is None:
            seconds = time.monotonic() - start
            due = int(seconds * 1_000_000) // simulation.period + 1
            fault = simulation.scan(due - done)
            done = due
            title = f"{name}, {seconds:.1f} s (Ctrl-C ends it)"
            live.update(values_table(watched, values(simulation, watched), title), refresh=True)
            time.sleep(max(_REFRESH_S, simulation.period / 1_000_000))
    return fault
