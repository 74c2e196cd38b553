"""A simulation of a program: its variables by their paths, scans and restarts, on one of the engines."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import TracebackType

from iec2mpy.backends import GeneratedProgram
from iec2mpy.backends.memory_map import Leaf
from iec2mpy.simulator import engines

_MEANINGS: Mapping[str, str] = {
    "zero": "zero: a division by zero",
    "index": "index: an array has no element with this subscript",
    "range": "range: a value is outside of the range that is allowed here",
    "NULL": "NULL: a reference refers to nothing",
    "loop": "loop: a loop does not come to its end",
    "recursion": "recursion: a call came back to a block or function that was still running",
    "memory": "memory: there is no memory left",
}
"""What each kind of fault means."""


@dataclass(frozen=True, slots=True)
class Fault:
    """What stopped the controller. `line` is 0, and `file` and `pou` are "", where the place is not known."""

    kind: str
    file: str
    line: int
    pou: str

    @property
    def text(self) -> str:
        """What happened, without the place: `zero: a division by zero`. Case files look for a part of it."""
        return _MEANINGS.get(self.kind, self.kind)

    @property
    def message(self) -> str:
        """What happened and where, such as `zero: a division by zero (main.st, line 4, in main)`."""
        place = f" ({self.file}, line {self.line}, in {self.pou})" if self.line else ""
        return f"{self.text}{place}"


class Simulation:
    """A program in virtual time: the first scan is at 0, the next one `period` later, and nothing waits.

    Paths and values are those of `MemoryMap`, whose UnknownPath and BadValue the methods raise; and EngineError where
    the engine fails, which is not the fault of the program's author.
    """

    def __init__(self, program: GeneratedProgram, engine: str) -> None:
        self._map = program.map
        self._engine = engines.start(engine, program.text)

    @property
    def period(self) -> int:
        """Microseconds from scan to scan: the interval of the fastest task."""
        return self._engine.period

    def set(self, path: str, value: object) -> None:
        """Write a variable, or all of an array or structure. An input keeps its value until it is set again."""
        written = self._map.write(self._map.resolve(path), value, self._read)
        self._engine.write([(array, slot, _stored(raw)) for array, slot, raw in written])

    def get(self, path: str) -> object:
        """The value of a variable, or of all of an array or structure."""
        return self._map.read(self._map.resolve(path), self._read)

    def get_leaves(self, leaves: Sequence[Leaf]) -> list[object]:
        """Many single values, in one request to the engine."""
        return self._map.read_leaves(leaves, self._read)

    def restart(self, cold: bool) -> None:
        """Initial values, at time 0; warm: RETAIN variables keep theirs, and the clock goes on."""
        self._engine.restart(cold)

    def scan(self, n: int = 1) -> Fault | None:
        """Run n scans, fewer where a fault stops the controller: the fault is what is returned."""
        fault = self._engine.scan(n)
        if fault is None:
            return None
        kind, number = fault
        site = self._map.site(number)
        return Fault(kind, site.file, site.line, site.pou) if site else Fault(kind, "", 0, "")

    def run(self, microseconds: int) -> Fault | None:
        """Run as many scans as fit into the span."""
        return self.scan(microseconds // self.period)

    def close(self) -> None:
        """End it. A `with` statement does so too."""
        self._engine.close()

    def __enter__(self) -> Simulation:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def _read(self, places: Sequence[engines.Place]) -> Sequence[object]:
        return self._engine.read(places)


def _stored(raw: object) -> engines.Stored:
    assert isinstance(raw, (int, float, str))
    return raw
