"""Diagnostics for other programs."""

from __future__ import annotations

import json

from iec2mpy.source.diagnostics import Diagnostic, Related
from iec2mpy.source.formats import to_json, to_sarif
from iec2mpy.source.spans import SourceFile, Span

_FILE = SourceFile("src/a b.st", "x := 1;\ny := 'ä';\n")
_FOUND = [
    Diagnostic("E0202", "Twice.", Span(_FILE, 8, 9), "Rename it.", (Related(Span(_FILE, 0, 1), "first"),)),
    Diagnostic("W0831", "Careful."),
]


def test_json() -> None:
    first, second = json.loads(to_json(_FOUND))
    assert first == {
        "file": "src/a b.st",
        "line": 2,
        "column": 1,
        "end_line": 2,
        "end_column": 2,
        "code": "E0202",
        "severity": "error",
        "about": "name",
        "message": "Twice.",
        "hint": "Rename it.",
        "related": [
            {"file": "src/a b.st", "line": 1, "column": 1, "end_line": 1, "end_column": 2, "message": "first"}
        ],
    }
    assert (second["file"], second["line"], second["severity"], second["hint"]) == (None, None, "warning", None)


def test_sarif() -> None:
    log = json.loads(to_sarif(_FOUND))
    assert log["version"] == "2.1.0"
    (run,) = log["runs"]
    rules = run["tool"]["driver"]["rules"]
    first, second = run["results"]
    assert [rules[result["ruleIndex"]]["id"] for result in run["results"]] == ["E0202", "W0831"]
    assert (first["level"], first["message"]["text"]) == ("error", "Twice. Rename it.")
    place = first["locations"][0]["physicalLocation"]
    assert place["artifactLocation"]["uri"] == "src/a%20b.st"
    assert place["region"] == {"startLine": 2, "startColumn": 1, "endLine": 2, "endColumn": 2}
    assert first["relatedLocations"][0]["message"]["text"] == "first"
    assert (second["level"], second["locations"]) == ("warning", [])


def test_nothing_found() -> None:
    assert json.loads(to_json([])) == []
    assert json.loads(to_sarif([]))["runs"][0]["results"] == []
