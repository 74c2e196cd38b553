"""Finds the name that was probably meant."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches


def suggest(name: str, candidates: Iterable[str]) -> str | None:
    """The candidate most like `name`, in its own spelling, or None where none is near. Letter case is ignored."""
    by_key: dict[str, str] = {}
    for candidate in candidates:
        by_key.setdefault(candidate.casefold(), candidate)
    found = get_close_matches(name.casefold(), by_key, n=1, cutoff=0.7)
    return by_key[found[0]] if found else None
