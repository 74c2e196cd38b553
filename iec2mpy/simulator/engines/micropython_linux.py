"""The engines `micropython` (portable form) and `viper` (viper form, 64 bits): MicroPython for Linux executes the
program. Which of the two it is, is a matter of the program's text only."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import cast

from iec2mpy.simulator.engines import child, wire
from iec2mpy.simulator.engines.base import Place, Stored

_SCANS_AT_ONCE = 1000
"""So that the child answers well within its time."""


class MicroPythonEngine:
    """`base.Engine` for a program in a child process."""

    def __init__(self, text: str) -> None:
        self._child = child.borrow()
        try:
            self._period = self._child.load(text)
        except BaseException:
            self.close()
            raise

    @property
    def period(self) -> int:
        return self._period

    def restart(self, cold: bool) -> None:
        self._child.ask(f"restart {int(cold)}")

    def scan(self, n: int) -> tuple[str, int] | None:
        while n > 0:
            answer = self._child.ask(f"scan {min(n, _SCANS_AT_ONCE)}")
            if answer:
                _, kind, site = answer.split(" ")
                return kind, int(site)
            n -= _SCANS_AT_ONCE
        return None

    def read(self, places: Sequence[Place]) -> list[Stored]:
        if not places:
            return []
        answer = self._child.ask(" ".join(["read", *(f"{array}{slot}" for array, slot in places)]))
        return [cast(Stored, wire.value(word)) for word in answer.split(" ")]

    def write(self, items: Iterable[tuple[str, int, Stored]]) -> None:
        words = [f"{array}{slot}={wire.word(value)}" for array, slot, value in items]
        if words:
            self._child.ask(" ".join(["write", *words]))

    def close(self) -> None:
        child.give_back(self._child)
