"""Diagnostics: what the compiler has to say about a program, and the one place that collects it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from enum import Enum

from iec2mpy.source.codes import CODES
from iec2mpy.source.spans import Span


class Severity(Enum):
    ERROR = "error"
    WARNING = "warning"


@dataclass(frozen=True, slots=True)
class Related:
    """Another place that belongs to a diagnostic, such as the first declaration of a name."""

    span: Span
    message: str


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """One cause, told once. `span` is None where the fault is not in a text (an unreadable file, say)."""

    code: str
    message: str
    span: Span | None = None
    hint: str | None = None
    related: tuple[Related, ...] = ()

    @property
    def severity(self) -> Severity:
        return Severity.WARNING if self.code.startswith("W") else Severity.ERROR

    @property
    def about(self) -> str:
        """One word for the kind of error, as in case files: syntax, type, name, range, …"""
        return CODES[self.code].about


class Diagnostics:
    """Collects diagnostics; the same code at the same place is kept once."""

    def __init__(self) -> None:
        self._items: dict[tuple[str, object, int], Diagnostic] = {}

    def add(
        self,
        code: str,
        message: str,
        span: Span | None = None,
        hint: str | None = None,
        related: Iterable[Related] = (),
    ) -> None:
        """Record a diagnostic; whether it is an error or a warning is in the letter of its code."""
        assert code in CODES, code
        key = (code, span.file if span else message, span.start if span else 0)
        self._items.setdefault(key, Diagnostic(code, message, span, hint, tuple(related)))

    @property
    def items(self) -> list[Diagnostic]:
        """All of them, in the order of files and lines."""
        return sorted(self._items.values(), key=lambda d: (d.span.file.path, d.span.start) if d.span else ("", -1))

    @property
    def has_errors(self) -> bool:
        return any(d.severity is Severity.ERROR for d in self._items.values())


class CompileError(Exception):
    """Raised where a stage cannot go on; the diagnostics say why."""

    def __init__(self, diagnostics: list[Diagnostic]) -> None:
        super().__init__("; ".join(d.message for d in diagnostics if d.severity is Severity.ERROR))
        self.diagnostics = diagnostics
