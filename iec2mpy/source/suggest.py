"""\"Did you mean …?\": the known name that is nearest to a misspelt one."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches


def suggest(name: str, candidates: Iterable[str]) -> str | None:
    """The candidate most like `name`, as it is spelt there, or None where none is near. Letter case does not count."""
    spelt = {candidate.casefold(): candidate for candidate in candidates}
    nearest = get_close_matches(name.casefold(), spelt, n=1, cutoff=0.7)
    return spelt[nearest[0]] if nearest else None
