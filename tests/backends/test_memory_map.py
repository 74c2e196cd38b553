"""The map: paths to slots, values in and out, what is refused, and the same as files for the host and the board."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

import pytest

from iec2mpy.backends.memory_map import BadValue, Group, Leaf, MemoryMap, UnknownPath
from mcu_runtime.names import Names
from tests.backends.compiling import generated

_TEXT = """
TYPE
  Colour : (red, green, blue);
  Part : STRUCT a : INT; r : REAL; row : ARRAY[1..2] OF Colour; s : STRING[4]; END_STRUCT;
END_TYPE
VAR_GLOBAL CONSTANT limit : INT := 5; END_VAR
PROGRAM main
VAR
  parts : ARRAY[0..1, -1..1] OF Part;
  button AT %IX0.0 : BOOL;
  words AT %MW10 : ARRAY[0..1] OF WORD;
  t : TIME; u : UDINT; small : INT (-3..3); timer : TON;
END_VAR
timer(IN := button, PT := t);
parts[1, 0].a := INT#5 / small;
END_PROGRAM
"""
_PROGRAM = generated(_TEXT)
_MAP = _PROGRAM.map


def _nothing(places: Sequence[tuple[str, int]]) -> Sequence[object]:
    """Nothing here shares its slot with others, so nothing needs to be read before it is written."""
    assert not places
    return []


def _slots(path: str) -> list[tuple[str, int]]:
    return [(leaf.variable.array, leaf.slot) for leaf in _MAP.leaves(_MAP.resolve(path))]


def test_elements_of_nested_arrays_and_structures() -> None:
    first = _slots("main.parts[0,-1]")
    assert [array for array, _ in first] == ["V", "O", "V", "V", "O"]
    a, r = _slots("main.parts[0,-1].a")[0][1], _slots("main.parts[0,-1].r")[0][1]
    # a Part has 3 slots of V and 2 of O; the last subscript runs fastest
    assert _slots("MAIN.Parts[0,0].A") == [("V", a + 3)]
    assert _slots("main.parts[1,-1].row[2]") == [("V", a + 9 + 2)]
    assert _slots("main.parts[1, 1].s") == [("O", r + 5 * 2 + 1)]
    assert len(set(_slots("main.parts"))) == 6 * 5


def test_addresses() -> None:
    assert _slots("%ix0.0") == _slots("main.button")
    assert _slots("%MW10") == _slots("main.words[0]")


@pytest.mark.parametrize(
    ("path", "message"),
    [
        ("main.color", "main has no color"),
        ("main.buton", "main has no buton; did you mean button?"),
        ("nothing", "there is no nothing"),
        ("main.t.x", "main.t has no parts, in main.t.x"),
        ("main.t[1]", "main.t has no parts, in main.t[1]"),
        ("main.timer[1]", "main.timer is no array, in main.timer[1]"),
        ("main.parts[0]", "main.parts has 2 dimensions, not 1"),
        ("main.parts[0,x]", "main.parts[0,x]: a subscript here is a number"),
        ("main.parts[0,2]", "main.parts[0,2]: 2 is not in -1..1"),
        ("%QX9.9", "the program has nothing at %QX9.9"),
    ],
)
def test_unknown_paths(path: str, message: str) -> None:
    with pytest.raises(UnknownPath) as raised:
        _MAP.resolve(path)
    assert str(raised.value) == message


def test_read_and_write() -> None:
    memory: dict[tuple[str, int], object] = dict.fromkeys(_slots("main.parts"), 0)
    memory |= {(a, s): "" for a, s in _slots("main.parts") if (a, s) in _strings()}
    part = _MAP.resolve("main.parts[1,0]")
    for array, slot, raw in _MAP.write(part, {"A": -5, "row": ["blue", "Colour#green"], "s": "ab"}, _nothing):
        memory[array, slot] = raw
    read = _MAP.read(part, lambda places: [memory[place] for place in places])
    assert read == {"a": -5, "r": 0, "row": ["blue", "green"], "s": "ab"}
    others = _MAP.read(_MAP.resolve("main.parts[0,0]"), lambda places: [memory[place] for place in places])
    assert others == {"a": 0, "r": 0, "row": ["red", "red"], "s": ""}


def _strings() -> set[tuple[str, int]]:
    return {place for i in (0, 1) for k in (-1, 0, 1) for place in _slots(f"main.parts[{i},{k}].s")}


@pytest.mark.parametrize(
    ("path", "value", "message"),
    [
        ("main.small", 4, "main.small is INT (-3..3): 4 is not in -3..3"),
        ("main.button", 2, "main.button is BOOL: 2 is neither true nor false"),
        ("main.u", -1, "main.u is UDINT: -1 is not in 0..4294967295"),
        ("main.u", 1.5, "main.u is UDINT: 1.5 is no integer"),
        ("main.t", 5, "main.t is TIME: 5 is no duration such as T#1s500ms"),
        ("main.parts[0,0].s", "abcde", "main.parts[0,0].s is STRING[4]: 5 characters are more than 4"),
        ("main.parts[0,0].row[1]", "pink", "main.parts[0,0].row[1] is Colour: 'pink' is none of red, green, blue"),
        ("main.words", [1], "main.words is an array of 2: its value is a list of as many"),
        ("main.parts[0,0]", 3, "main.parts[0,0] is a structure: its value is a table of its fields"),
        ("main.parts[0,0]", {"z": 3}, "main.parts[0,0] has no field z"),
    ],
)
def test_refused_values(path: str, value: object, message: str) -> None:
    with pytest.raises(BadValue) as raised:
        _MAP.write(_MAP.resolve(path), value, _nothing)
    assert str(raised.value) == message


def test_json() -> None:
    content = json.loads(_MAP.to_json())
    rows = {row["path"]: row for row in content["variables"]}
    assert content["version"] == 1 and content["program"] == _PROGRAM.hash
    assert rows["main.parts[,].row[]"]["dimensions"] == [
        {"low": 0, "high": 1, "stride": 9},
        {"low": -1, "high": 1, "stride": 3},
        {"low": 1, "high": 2, "stride": 1},
    ]
    assert rows["main.button"]["address"] == "%IX0.0"
    assert rows["limit"]["constant"] is True
    assert (rows["main.u"]["file"], rows["main.u"]["line"]) == ("main.st", 12)
    assert content["enums"] == {"Colour": {"red": 0, "green": 1, "blue": 2}}
    assert [(site["file"], site["line"], site["pou"]) for site in content["sites"]] == [("main.st", 15, "main")]


def test_the_board_finds_the_same_slots(tmp_path: Path) -> None:
    path = tmp_path / "program.names"
    path.write_text(_PROGRAM.names, encoding="utf-8")
    names = Names(str(path))
    asked = ["main.parts[1,-1].row[2]", "main.parts[0,1].s", "main.u", "MAIN.Button", "main.timer.et", "main.small"]
    for wanted in asked:
        leaf = _MAP.resolve(wanted)
        assert isinstance(leaf, Leaf)
        place = names.resolve(wanted)
        assert (place.array, place.slot) == (leaf.variable.array, leaf.slot), wanted
    assert names.resolve("main.parts[0,0].row[1]").encode("BLUE") == 2
    assert names.resolve("main.u").decode(-1) == 0xFFFFFFFF
    assert names.place(1) == "main.st:15 (main)"
    with pytest.raises(KeyError):
        names.resolve("main.parts[0,2].s")


def test_an_empty_map() -> None:
    empty = MemoryMap([], {}, [], "")
    with pytest.raises(UnknownPath):
        empty.resolve("x")
    assert isinstance(_MAP.resolve("main"), Group)
