"""Where the keys of a TOML file stand."""

from __future__ import annotations

import pytest

from iec2mpy.project.toml_text import TomlText, parse_toml
from iec2mpy.source.diagnostics import CompileError
from iec2mpy.source.spans import SourceFile

TEXT = '''# a comment with a = 1 and [brackets]
title = "x = [1]"   # and another
list = [
  "a]", # "b"
  'c = 2',
]
[table."with.dot"]
key.inner = { a = 1, b = "}" }
  indented = 5
long = """
[not.a.table]
no = "key"
"""
[channels]
"%IX0.0" = 1
'''


def parsed(text: str) -> TomlText:
    return parse_toml(SourceFile("test.toml", text))


@pytest.mark.parametrize(
    ("path", "line", "key", "value"),
    [
        (("title",), 2, "title", '"x = [1]"'),
        (("table", "with.dot"), 7, 'table."with.dot"', 'table."with.dot"'),
        (("table", "with.dot", "key", "inner"), 8, "key.inner", '{ a = 1, b = "}" }'),
        (("table", "with.dot", "key", "inner", "b"), 8, "key.inner", "key.inner"),
        (("table", "with.dot", "indented"), 9, "indented", "5"),
        (("channels", "%IX0.0"), 15, '"%IX0.0"', "1"),
    ],
)
def test_places(path: tuple[str, ...], line: int, key: str, value: str) -> None:
    toml = parsed(TEXT)
    assert toml.key_span(*path).line == line
    assert toml.key_span(*path).text == key
    assert toml.value_span(*path).text == value


def test_value_of_several_lines() -> None:
    assert parsed(TEXT).value_span("list").text.endswith("'c = 2',\n]")


def test_what_stands_in_a_text_is_no_key() -> None:
    toml = parsed(TEXT)
    assert toml.key_span("not", "a", "table").start == 0
    assert toml.key_span("table", "with.dot", "no").text == 'table."with.dot"'


def test_values_are_those_of_tomllib() -> None:
    assert parsed(TEXT).data["table"]["with.dot"]["long"].startswith("[not.a.table]")


@pytest.mark.parametrize(
    ("text", "line", "column", "says"),
    [
        ("a = 1\nb = pico\n", 2, 5, "not TOML"),
        ('a = "pico\nb = 1\n', 1, 10, "not TOML"),
        ("a = 1\na = 2\n", 2, 1, "`a = 2` says something a second time"),
        ("[t]\na = 1\n\n[t]\n", 4, 1, "`[t]` says something a second time"),
        ("[t\n", 1, 3, "not TOML"),
        ("a = [1,\n", 1, 7, "not TOML"),
    ],
)
def test_what_is_not_toml(text: str, line: int, column: int, says: str) -> None:
    with pytest.raises(CompileError) as caught:
        parsed(text)
    (error,) = caught.value.diagnostics
    assert error.code == "E0831"
    assert error.span is not None
    assert (error.span.line, error.span.column) == (line, column)
    assert says in error.message
