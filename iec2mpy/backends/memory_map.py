"""The map of the memory image: which slot holds which variable, and how values look from outside.

Written as `program.map.json` beside the program. A variable is a leaf: one value, or all the elements of arrays that
are alike, with subscripts left open (`main.a[].x`). What is asked for may be more than a leaf: `main.a` gives a list.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from typing import Any


@dataclass(frozen=True, slots=True)
class Dimension:
    """`stride`: slots from one element to the next."""

    low: int
    high: int
    stride: int


@dataclass(frozen=True, slots=True)
class MappedVariable:
    """A leaf. `path` as declared, with `[]`, `[,]`, … for subscripts; `kind` how its value is coded (see `_CODERS`);
    `low`, `high` the values it may have, for what is stored in V; `unsigned` whether its slot is read without a sign."""

    path: str
    type: str
    kind: str
    array: str
    slot: int
    low: int = 0
    high: int = 0
    dimensions: tuple[Dimension, ...] = ()
    address: str | None = None
    retain: bool = False
    constant: bool = False
    file: str = ""
    line: int = 0


@dataclass(frozen=True, slots=True)
class Site:
    """A place that may raise a fault."""

    number: int
    file: str
    line: int
    pou: str
