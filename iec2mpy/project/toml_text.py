"""TOML with the place of every key, so that messages can point at it. `tomllib` reads the values, and no places."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from iec2mpy.source.diagnostics import CompileError, Diagnostic
from iec2mpy.source.spans import SourceFile, Span

KeyPath = tuple[str, ...]

_KEY = r"""(?:"(?:[^"\\]|\\.)*"|'[^']*'|[A-Za-z0-9_-]+)"""
_DOTTED = rf"{_KEY}(?:[ \t]*\.[ \t]*{_KEY})*"
_TABLE_LINE = re.compile(rf"[ \t]*\[\[?[ \t]*(?P<keys>{_DOTTED})[ \t]*\]")
_KEY_LINE = re.compile(rf"[ \t]*(?P<keys>{_DOTTED})[ \t]*=[ \t]*")
_ONE_KEY = re.compile(_KEY)
_VALUE_TOKEN = re.compile(
    r'(?P<text>"""(?:[^\\]|\\.)*?"""|'
    r"'''.*?'''|"
    r'"(?:[^"\\\n]|\\.)*"|'
    r"'[^'\n]*')|(?P<comment>\#[^\n]*)|(?P<open>[\[{])|(?P<close>[\]}])|(?P<end>\n)|(?P<other>.)",
    re.DOTALL,
)
_ERROR_PLACE = re.compile(r" \(at line (\d+), column (\d+)\)$")
_DECLARED_TWICE = re.compile(r"Cannot (?:declare|overwrite|mutate)")


@dataclass(frozen=True, slots=True)
class TomlText:
    """A TOML file: its values, and where each key stands. A key inside of an inline table has its table's place."""

    file: SourceFile
    data: dict[str, Any]
    _keys: Mapping[KeyPath, Span] = field(repr=False)
    _values: Mapping[KeyPath, Span] = field(repr=False)

    def key_span(self, *path: str) -> Span:
        """Where a key or the head of a table stands; of the nearest table around it where it has no line of its own."""
        return _nearest(self._keys, path) or Span(self.file, 0, 0)

    def value_span(self, *path: str) -> Span:
        """Where the value of a key stands; where the key stands if it is a table."""
        return self._values.get(path) or self.key_span(*path)


def _nearest(places: Mapping[KeyPath, Span], path: KeyPath) -> Span | None:
    while path:
        if path in places:
            return places[path]
        path = path[:-1]
    return None


def parse_toml(file: SourceFile) -> TomlText:
    """Reads a TOML file; raises CompileError with E0831 where it is not TOML."""
    try:
        data = tomllib.loads(file.text)
    except tomllib.TOMLDecodeError as error:
        raise CompileError([_syntax_error(file, str(error))]) from None
    keys, values = _scan(file)
    return TomlText(file, data, keys, values)


def _syntax_error(file: SourceFile, text: str) -> Diagnostic:
    span = Span(file, max(len(file.text.rstrip()) - 1, 0), len(file.text.rstrip()))
    place = _ERROR_PLACE.search(text)
    if place:
        text = text[: place.start()]
        start = file.line_starts[int(place[1]) - 1] + int(place[2]) - 1
        span = Span(file, start, start + 1)
    if _DECLARED_TWICE.match(text):
        line_start = file.line_starts[span.line - 1]
        line = file.line_text(span.line)
        span = Span(file, line_start, line_start + len(line))
        return Diagnostic("E0831", f"`{line.strip()}` says something a second time.", span, "Keep one of the two.")
    message = f"This is not TOML: {text[0].lower()}{text[1:]}."
    return Diagnostic("E0831", message, span, 'A line is `key = value`; text stands in quotes: `board = "pico"`.')


def _scan(file: SourceFile) -> tuple[dict[KeyPath, Span], dict[KeyPath, Span]]:
    """The places of all keys and of all values, of a text that is known to be TOML."""
    text = file.text
    keys: dict[KeyPath, Span] = {}
    values: dict[KeyPath, Span] = {}
    table: KeyPath = ()
    at = 0
    while at < len(text):
        head = _TABLE_LINE.match(text, at)
        line = None if head else _KEY_LINE.match(text, at)
        if head:
            table = _split(head["keys"])
            keys.setdefault(table, Span(file, head.start("keys"), head.end("keys")))
        elif line:
            path = table + _split(line["keys"])
            keys[path] = Span(file, line.start("keys"), line.end("keys"))
            end = _value_end(text, line.end())
            values[path] = Span(file, line.end(), end)
            at = end
        newline = text.find("\n", at)
        at = newline + 1 if newline >= 0 else len(text)
    return keys, values


def _value_end(text: str, start: int) -> int:
    """The end of the value that starts here: where its line ends, outside of brackets and texts."""
    depth = 0
    end = at = start
    while token := _VALUE_TOKEN.match(text, at):
        at = token.end()
        if depth == 0 and (token["end"] or token["comment"]):
            break
        depth += bool(token["open"]) - bool(token["close"])
        if not token.group().isspace():
            end = at
    return end


def _split(dotted: str) -> KeyPath:
    """The parts of a key as written: `channels."%IX0.0"` has two."""
    return tuple(tomllib.loads(f"{key} = 0").popitem()[0] for key in _ONE_KEY.findall(dotted))
