"""The command line. One module a command, imported when the command is used: `--help` and `--version` start at once."""

from __future__ import annotations

import importlib
import os
import sys
import traceback
from collections.abc import Sequence

import click

from iec2mpy.cli.support import UserError, exit_code, show_diagnostics
from iec2mpy.source.diagnostics import CompileError

COMMANDS = {
    "new": "Make a new project.",
    "check": "Look for errors, and build nothing.",
    "build": "Build the files that a board runs.",
    "run": "Simulate a program on this computer.",
    "test": "Run case files: tests of a program.",
    "boards": "List the boards, or show one with its channels.",
    "deploy": "Put a project on a board, and start it.",
}
"""The commands in the order in which a newcomer needs them, each with the line that `iec2mpy --help` shows."""

_DEBUG = "IEC2MPY_DEBUG"
_HELP = """Programs for small PLCs: from IEC 61131-3 Structured Text to a MicroPython board.

\b
A first project, from nothing to a board:
  iec2mpy new hello --board pico        make a project
  iec2mpy run hello                     see it run on this computer
  iec2mpy test hello                    run its tests
  iec2mpy deploy hello --port /dev/ttyACM0

`iec2mpy COMMAND --help` explains a command, with examples.
"""


class _LazyGroup(click.Group):
    """A group whose commands are the attribute `command` of the module with their name."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        if cmd_name not in COMMANDS:
            return None
        return importlib.import_module(f"iec2mpy.cli.{cmd_name}").command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """From the table, so that no command has to be imported."""
        with formatter.section("Commands"):
            formatter.write_dl(list(COMMANDS.items()))


def _set_debug(_context: click.Context, _option: click.Parameter, debug: bool) -> None:
    if debug:
        os.environ[_DEBUG] = "1"


def _show_version(context: click.Context, _option: click.Parameter, wanted: bool) -> None:
    if wanted:
        from importlib.metadata import PackageNotFoundError, version

        try:
            click.echo(f"iec2mpy {version('iec2mpy')}")
        except PackageNotFoundError:
            click.echo("iec2mpy, from a checkout that is not installed")
        context.exit()


@click.group(cls=_LazyGroup, help=_HELP, context_settings={"help_option_names": ["-h", "--help"]})
@click.option(
    "--version", is_flag=True, is_eager=True, expose_value=False, callback=_show_version, help="Show the version."
)
@click.option(
    "--debug",
    is_flag=True,
    is_eager=True,  # before the command's module is imported, which may fail, too
    expose_value=False,
    callback=_set_debug,
    help="Show the traceback of a fault of iec2mpy itself; so does IEC2MPY_DEBUG=1.",
)
def cli() -> None:
    """What `main` runs."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command line, and return its exit code: 0, 1 for errors in the user's program, 2 for wrong usage or an
    environment in which the command cannot work, 130 after Ctrl-C."""
    try:
        given = None if arguments is None else list(arguments)
        result = cli.main(args=given, prog_name="iec2mpy", standalone_mode=False)
    except UserError as error:
        return _say(str(error), error.exit_code)
    except CompileError as error:
        show_diagnostics(error.diagnostics)
        return exit_code(error.diagnostics)
    except click.exceptions.NoArgsIsHelpError as error:
        click.echo(error.format_message(), err=True)
        return 2
    except click.ClickException as error:
        error.show()
        return 2
    except (click.Abort, KeyboardInterrupt):
        return 130
    except BrokenPipeError:
        # The reader of a pipe, such as `head`, has gone. Nothing more can be said, not even at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 141
    except OSError as error:
        return _say(_os_error_text(error), 2)
    except Exception as error:
        return _say_what_failed(error)
    return result if isinstance(result, int) else 0


def _say(message: str, exit_code: int) -> int:
    click.echo(f"iec2mpy: {message}", err=True)
    return exit_code


def _os_error_text(error: OSError) -> str:
    reason = error.strerror or str(error)
    return f"{error.filename}: {reason}" if error.filename else reason


def _say_what_failed(error: Exception) -> int:
    from iec2mpy.simulator.engines import EngineUnavailable

    if isinstance(error, EngineUnavailable):
        return _say(str(error), 2)
    if os.environ.get(_DEBUG):
        traceback.print_exc()
    place = traceback.extract_tb(error.__traceback__)[-1]
    return _say(
        f"a fault of iec2mpy itself ({type(error).__name__} in {os.path.basename(place.filename)}:{place.lineno}). "
        "Please report it, with the program and the output of the same command after `iec2mpy --debug`.",
        70,
    )
