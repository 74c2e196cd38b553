"""The command line as a whole: help, exit codes, and how errors are told."""

from __future__ import annotations

import importlib
import os
import pty
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from iec2mpy.cli import COMMANDS, cli, main


def test_help_names_every_command_and_shows_an_example(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--help"]) == 0
    out = capsys.readouterr().out
    assert "iec2mpy new hello --board pico" in out
    for name, line in COMMANDS.items():
        assert name in out
        assert line in out


@pytest.mark.parametrize("name", COMMANDS)
def test_help_of_a_command_has_examples(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([name, "--help"]) == 0
    out = capsys.readouterr().out
    assert f"Usage: iec2mpy {name}" in out
    assert "Example" in out
    assert f"  iec2mpy {name}" in out


def test_version(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--version"]) == 0
    assert capsys.readouterr().out.startswith("iec2mpy")


@pytest.mark.parametrize("arguments", [[], ["nothing"], ["run", "--nothing"], ["run", "--scans", "0"]])
def test_wrong_usage(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(arguments) == 2
    captured = capsys.readouterr()
    assert "Usage: iec2mpy" in captured.err
    assert captured.out == ""


def _raising(error: BaseException) -> object:
    def command(*_: object, **__: object) -> None:
        raise error

    return command


@pytest.fixture
def failing_check(monkeypatch: pytest.MonkeyPatch) -> Iterator[object]:
    """Makes `iec2mpy check` raise what it is given."""
    check = importlib.import_module("iec2mpy.cli.check")
    yield lambda error: monkeypatch.setattr(check, "_check", _raising(error))


def test_os_error_is_a_sentence(failing_check, capsys: pytest.CaptureFixture[str]) -> None:
    failing_check(OSError(28, "No space left on device", "build/program.py"))
    assert main(["check"]) == 2
    assert capsys.readouterr().err == "iec2mpy: build/program.py: No space left on device\n"


def test_ctrl_c_is_quiet(failing_check, capsys: pytest.CaptureFixture[str]) -> None:
    failing_check(KeyboardInterrupt())
    assert main(["check"]) == 130
    captured = capsys.readouterr()
    assert (captured.out, captured.err.strip()) == ("", "")


def test_own_fault_asks_for_a_report(failing_check, capsys, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("IEC2MPY_DEBUG", raising=False)
    failing_check(AssertionError("oops"))
    assert main(["check"]) == 70
    err = capsys.readouterr().err
    assert len(err.splitlines()) == 1
    assert "a fault of iec2mpy itself (AssertionError in test_main.py:" in err
    assert "report it" in err


def test_debug_shows_the_traceback(failing_check, capsys, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("IEC2MPY_DEBUG", "1")
    failing_check(AssertionError("oops"))
    assert main(["check"]) == 70
    assert "Traceback (most recent call last)" in capsys.readouterr().err


def test_help_imports_no_command() -> None:
    code = "import sys; from iec2mpy.cli import main; main(['--help']); print(*sys.modules, file=sys.stderr)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    modules = done.stderr.split()
    assert "iec2mpy.cli" in modules
    assert not {"iec2mpy.cli.run", "lark", "rich", "serial", "matplotlib"} & set(modules)


def test_reader_that_goes_away() -> None:
    command = f"{sys.executable} -m iec2mpy boards | true"
    done = subprocess.run(["bash", "-c", command], capture_output=True, text=True, check=True)
    assert "Traceback" not in done.stderr
    assert "Exception" not in done.stderr


def test_live_table_until_ctrl_c(tmp_path: Path) -> None:
    """On a terminal: the table changes as the program runs, and Ctrl-C ends it."""
    assert main(["new", str(tmp_path / "hello"), "--board", "pico"]) == 0
    ours, theirs = pty.openpty()
    process = subprocess.Popen(
        [sys.executable, "-m", "iec2mpy", "run", str(tmp_path / "hello")],
        stdin=theirs,
        stdout=theirs,
        stderr=theirs,
        env={**os.environ, "TERM": "xterm", "COLUMNS": "80", "LINES": "24"},
    )
    os.close(theirs)
    try:
        shown = b""
        deadline = time.monotonic() + 30
        while b"true" not in shown and time.monotonic() < deadline:
            shown += os.read(ours, 4096)
        process.send_signal(signal.SIGINT)
        assert process.wait(10) == 130
    finally:
        process.kill()
        os.close(ours)
    text = shown.decode()
    assert "main.lamp" in text
    assert "false" in text
    assert "true" in text
    assert "Ctrl-C ends it" in text
    assert "Traceback" not in text


def test_commands_are_those_that_exist() -> None:
    with cli.make_context("iec2mpy", ["check"]) as context:
        assert [cli.get_command(context, name) is not None for name in COMMANDS] == [True] * len(COMMANDS)
