"""What every engine can do, and what may go wrong with one."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Protocol

Stored = int | float | str
"""A value as it stands in a slot: V has integers of 32 bits with sign, O floats and texts."""
Place = tuple[str, int]
"""An array, `"V"` or `"O"`, and a slot of it."""


class EngineError(Exception):
    """An engine could not load or execute a program. The text is a sentence for the user."""


class EngineUnavailable(EngineError):
    """An engine is not installed. The text says how to install it."""


class Engine(Protocol):
    """Executes one program in virtual time. Every method may raise EngineError."""

    @property
    def period(self) -> int:
        """Microseconds from scan to scan."""
        ...

    def restart(self, cold: bool) -> None:
        """Initial values, at time 0; warm: RETAIN variables keep theirs, and the clock goes on."""
        ...

    def scan(self, n: int) -> tuple[str, int] | None:
        """n scans. Gives the fault at which they ended, as (kind, site), or None. Only `restart` ends a fault."""
        ...

    def read(self, places: Sequence[Place]) -> list[Stored]:
        """The values in these slots, in this order."""
        ...

    def write(self, items: Iterable[tuple[str, int, Stored]]) -> None:
        """Store values: (array, slot, value). An input keeps its value, over restarts too, until the next."""
        ...

    def close(self) -> None:
        """End it; nothing else may be called then."""
        ...
