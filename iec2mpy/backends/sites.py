"""The places that may raise a fault, numbered: generated code notes the number, the map says what it means."""

from __future__ import annotations

from dataclasses import dataclass, field

from iec2mpy.backends.memory_map import Site
from iec2mpy.ir import nodes as n


@dataclass(slots=True)
class Sites:
    """Gives each source line of a POU one number, from 1."""

    _numbers: dict[tuple[str, int, str], int] = field(default_factory=dict)

    def number(self, site: n.Site) -> int:
        key = (site.span.file.name, site.span.line, site.pou.name)
        return self._numbers.setdefault(key, len(self._numbers) + 1)

    def all(self) -> list[Site]:
        return [Site(number, *key) for key, number in self._numbers.items()]
