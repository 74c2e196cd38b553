"""`iec2mpy deploy`: a project onto a board, over its serial line."""

from __future__ import annotations

from pathlib import Path

import click
from rich.console import Console
from rich.progress import BarColumn, DownloadColumn, Progress, TextColumn

from iec2mpy.cli.support import UserError, show_diagnostics
from iec2mpy.device.deploy import Deployed, Payload, deploy
from iec2mpy.device.errors import DeviceError, StartFailed
from iec2mpy.device.ports import usb_ports
from iec2mpy.device.runtime_files import payload
from iec2mpy.device.transport import connect
from iec2mpy.project.build import build_project
from iec2mpy.project.config import load_project

_HELP = """Put a project on a board, and start it.

DIR is the project's folder; without it, this one. The program that is on the board runs until the new one is there,
whole and checked; if the line breaks before, it stays.

\b
Examples:
  iec2mpy deploy --port /dev/ttyACM0       Linux
  iec2mpy deploy hello --port COM3         Windows
  iec2mpy deploy                           the only board that is plugged in

\b
Then the board's prompt is free, and knows the PLC:
  mpremote resume repl
  >>> import plc
  >>> plc.read("main.lamp")
"""


@click.command("deploy", help=_HELP)
@click.argument("directory", metavar="[DIR]", required=False, default=".", type=click.Path(path_type=Path))
@click.option("--port", metavar="P", help="The serial port of the board, such as /dev/ttyACM0 or COM3.")
@click.option("--board", "board_name", metavar="B", help="Build for this board instead of the project's.")
def command(directory: Path, port: str | None, board_name: str | None) -> int:
    project = load_project(directory, board_name)
    build = build_project(project)
    show_diagnostics(build.warnings)
    try:
        done = _deploy(port or _only_port(), payload(build.board_files))
    except DeviceError as error:
        show_diagnostics([error.diagnostic])
        return 1 if isinstance(error, StartFailed) else 2
    _report(Console(highlight=False), project.name, done)
    return 0


def _only_port() -> str:
    ports = usb_ports()
    if not ports:
        raise UserError("no board is plugged in, as far as this computer sees: name its port with `--port`")
    if len(ports) > 1:
        raise UserError(f"several boards are plugged in: choose one with `--port` ({', '.join(ports)})")
    return ports[0]


def _deploy(port: str, files: Payload) -> Deployed:
    columns = (TextColumn("uploading"), BarColumn(), DownloadColumn())
    console = Console(stderr=True)
    link = connect(port)
    try:
        with Progress(*columns, console=console, transient=True, disable=not console.is_terminal) as progress:
            line = progress.add_task("upload", total=None)
            return deploy(link, files, lambda done, total: progress.update(line, completed=done, total=total))
    finally:
        link.leave()


def _report(console: Console, name: str, done: Deployed) -> None:
    release = ".".join(map(str, done.release))
    sent = f"{done.uploaded:,} bytes sent" if done.uploaded else "it was there already, and has been started anew"
    console.print(f"{name} runs on {done.machine} with MicroPython {release} ({sent}).", soft_wrap=True)
    for task in done.status["tasks"]:
        console.print(f"  task {task['name']}: every {task['interval'] / 1000:g} ms")
