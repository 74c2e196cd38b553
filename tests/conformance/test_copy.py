"""The copy of the conformance cases is that of the common directory beside the checkout, where there is one."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.conformance.suite import HERE, PARTS

COMMON = HERE.parents[2] / "shared" / "conformance"


def _behind(common: Path, copy: Path) -> list[str]:
    """The files of the common directory that the copy lacks, or has otherwise."""
    names = [f"{part}/{name}" for part in PARTS for name in ("visible.toml", "features.toml")]
    there = [name for name in names if (common / name).exists()]
    return [n for n in there if not (copy / n).exists() or (copy / n).read_bytes() != (common / n).read_bytes()]


def test_copy_is_not_behind() -> None:
    behind = _behind(COMMON, HERE)
    assert not behind, f"tests/conformance is behind {COMMON} in: {', '.join(behind)}. Copy these files."


@pytest.mark.parametrize(
    ("copied", "expected"), [("same", []), ("older", ["part1/visible.toml"]), (None, ["part1/visible.toml"])]
)
def test_what_is_behind(tmp_path: Path, copied: str | None, expected: list[str]) -> None:
    common, copy = tmp_path / "common", tmp_path / "copy"
    for folder, content in ((common, "same"), (copy, copied)):
        (folder / "part1").mkdir(parents=True)
        if content is not None:
            (folder / "part1" / "visible.toml").write_text(content, encoding="utf-8")
    assert _behind(common, copy) == expected
