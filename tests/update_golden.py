"""Writes anew what the golden cases expect: `python -m tests.update_golden`. Look at what changes."""

from __future__ import annotations

from tests.golden import rewrite
from tests.renderers import RENDERERS

if __name__ == "__main__":
    for folder, render in RENDERERS.items():
        for path in sorted(folder.glob("*.test")):
            rewrite(path, render)
