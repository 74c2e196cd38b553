"""Where parsing stands when a token cannot follow, and what a rule finds out about it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from iec2mpy.source.spans import Span
from iec2mpy.syntax.tokens import Token


@dataclass(frozen=True, slots=True)
class Situation:
    """Where parsing stands: the token that cannot follow, its neighbours, and the values on the stack.

    `accepts(*types)` tells whether tokens of these types could follow; `expected` holds each one that could.
    """

    previous: Token
    token: Token
    following: Token
    values: tuple[Any, ...]
    accepts: Callable[..., bool]
    expected: list[str]

    @property
    def new_line(self) -> bool:
        return self.token.line > self.previous.line


@dataclass(frozen=True, slots=True)
class Finding:
    """What is wrong; and a token to insert or to read instead, or how many to leave out, where that mends it."""

    code: str
    message: str
    span: Span
    hint: str | None = None
    insert: str | None = None
    replace: str | None = None
    drop: int = 0
