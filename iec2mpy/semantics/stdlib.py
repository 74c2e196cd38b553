"""The standard function blocks, which are written in ST themselves."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from functools import cache

from iec2mpy.semantics.signatures import typed_block_names
from iec2mpy.source.resources import resource_dir
from iec2mpy.source.spans import SourceFile

_BLOCK = re.compile(r"^FUNCTION_BLOCK\s+(\w+)", re.MULTILINE)
_WORD = re.compile(r"\w+")


@cache
def _library() -> Mapping[str, SourceFile]:
    """The file of each standard block, by the block's name in capitals, typed names included."""
    blocks: dict[str, SourceFile] = {}
    for path in sorted(resource_dir("stdlib").glob("*.st")):
        file = SourceFile(f"stdlib/{path.name}", path.read_text(encoding="utf-8"), is_stdlib=True)
        for name in _BLOCK.findall(file.text):
            blocks[name.upper()] = file
    for typed, plain in typed_block_names().items():
        blocks[typed] = blocks[plain]
    return blocks


def stdlib_files(texts: Iterable[str]) -> list[SourceFile]:
    """The files of the standard blocks that program texts name: only these need to be parsed."""
    library = _library()
    used: dict[str, SourceFile] = {}
    for text in texts:
        for name in library.keys() & {word.upper() for word in _WORD.findall(text)}:
            used[library[name].path] = library[name]
    return [used[path] for path in sorted(used)]


def block_names() -> list[str]:
    """The names of all standard blocks."""
    return list(_library())
