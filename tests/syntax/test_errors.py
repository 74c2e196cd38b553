"""Syntax errors: one cause gives one diagnostic, at the line that a user looks at, and the rest is still read."""

from __future__ import annotations

import pytest

from iec2mpy.source.diagnostics import Diagnostic, Diagnostics
from iec2mpy.source.spans import SourceFile
from iec2mpy.syntax import parse, tree
from tests.syntax.trees import errors, show

# A body, with the code and line of each error; the first line of the body is 2.
BODIES: list[tuple[str, list[tuple[str, int]]]] = [
    ("x := x ? 2;", [("E0101", 2)]),
    ("x := “abc”;", [("E0101", 2)]),
    ("für := 1;", [("E0105", 2)]),
    ("x := 10 000;", [("E0106", 2)]),
    ("x := 1(* *)2;", [("E0106", 2)]),
    ("x := INT;", [("E0112", 2)]),
    ("if := 5;", [("E0112", 2)]),
    ("x := 1\ny := 2;", [("E0113", 2)]),
    ("a := 2 b := 3;", [("E0113", 2)]),
    ("EXIT", [("E0113", 2)]),
    ("x := y\n  + z\n  w := 5;", [("E0113", 3)]),
    ("IF x THEN y := 1 ELSE y := 2; END_IF;", [("E0113", 2)]),
    ("IF x THEN\n  y := 1;", [("E0114", 4)]),
    ("WHILE TRUE DO\n  IF x THEN EXIT;\nEND_WHILE;", [("E0114", 4)]),
    ("IF x THEN y := 1; END_WHILE;\nz := 1;", [("E0115", 2)]),
    ("WHILE x DO y := 1; END_IF; END_WHILE;", [("E0115", 2)]),
    ("END_IF;\nx := 1;", [("E0115", 2)]),
    ("x := (1 + 2;\ny := 3;", [("E0116", 2)]),
    ("x := 1 + 2);\ny := 3;", [("E0116", 2)]),
    ("x := a[1);", [("E0116", 2)]),
    ("IF (x > 1 THEN y := 1; END_IF;", [("E0116", 2)]),
    ("f(x := 1; y := 2);", [("E0116", 2)]),
    ("x = 1;", [("E0117", 2)]),
    ("x => y;", [("E0117", 2)]),
    ("x : = 1;", [("E0117", 2)]),
    ("IF x := 1 THEN y := 2; END_IF;", [("E0117", 2)]),
    ("FOR i = 1 TO 10 DO x := 1; END_FOR;", [("E0117", 2)]),
    ("CASE x OF\n1: y = 2;\n2: y := 3\n3, 4: y := 5;\nEND_CASE;", [("E0117", 3), ("E0113", 4)]),
    ("IF x == 1 && y != 2 || !z THEN y := 2; END_IF;", [("E0118", 2)] * 5),
    ("x == 3;", [("E0118", 2)]),
    ("x += 1;\ny++;", [("E0118", 2), ("E0118", 3)]),
    ("x := y % 2;", [("E0118", 2)]),
    ("IF x = 1\n  y := 2;\nEND_IF;", [("E0119", 2)]),
    ("FOR i := 1 TO 10\n  x := x + 1;\nEND_FOR;", [("E0119", 2)]),
    ("WHILE x < 10 THEN x := x + 1; END_WHILE;", [("E0119", 2)]),
    ("CASE x\n  1: y := 2;\nEND_CASE;", [("E0119", 2)]),
    ("x := y +;\nz := 3;", [("E0119", 2)]),
    ("x := ;", [("E0119", 2)]),
    ("x := * 5;", [("E0119", 2)]),
    ("x := a AND OR b;", [("E0119", 2)]),
    ("x := a b c;", [("E0119", 2)]),
    ("f(x y);", [("E0119", 2)]),
    ("f(x := 1 y := 2);", [("E0119", 2)]),
    ("f(1,,2);", [("E0119", 2)]),
    ("a[1, ] := 5;", [("E0119", 2)]),
    ("IF THEN x := 1; END_IF;", [("E0119", 2)]),
    ("IF x > THEN x := 1; END_IF;", [("E0119", 2)]),
    ("FOR TO 10 DO x := 1; END_FOR;", [("E0119", 2)]),
    ("FOR i := 1 TO DO x := 1; END_FOR;", [("E0119", 2)]),
    ("REPEAT x := 1; END_REPEAT;", [("E0119", 2)]),
    ("CASE x OF 1..: y := 1; ..5: y := 2; END_CASE;", [("E0119", 2), ("E0119", 2)]),
    ("CASE x OF 1 y := 2; END_CASE;", [("E0119", 2)]),
    ("CASE x OF ELSE y := 2; END_CASE;", [("E0119", 2)]),
    ("x := NOT NOT y;", [("E0119", 2)]),
    ("x;", [("E0120", 2)]),
    ("5 := x;", [("E0120", 2)]),
    ("CASE x OF\n  y := 1;\n  1: y := 2;\nEND_CASE;", [("E0120", 3)]),
    ("IF x THEN y := 1; ELSE y := 2; ELSE y := 3; END_IF;", [("E0120", 2)]),
    ("REPEAT x := 1; UNTIL x > 5; END_REPEAT;", [("E0121", 2)]),
    ("RETURN 5;", [("E0121", 2)]),
    ("x := 1;\nVAR y : INT; END_VAR\ny := ;", [("E0122", 3), ("E0119", 4)]),
    ("f(y => a + b);", [("E0124", 2)]),
    ("x := NOT(a, b);", [("E0126", 2)]),
    ("IF x THEN\nELSEIF y THEN\nENDIF;", [("E0127", 3), ("E0127", 4)]),
    ("IF x THEN\nEND IF;\nIF x THEN\nEND _IF;", [("E0127", 3), ("E0127", 5)]),
    ("WHLE x < 10 DO x := 1; END_WHILE;", [("E0127", 2)]),
    ("x := (* never closed\ny := 1;", [("E0102", 2)]),
    ("x := 1; {VERSION 2.0", [("E0104", 2)]),
    ("x := TRUE AND;\nIF y THEN\n  z := * 5;\n  f(1,,2);\nEND_IF\nw := 1);",
     [("E0119", 2), ("E0119", 4), ("E0119", 5), ("E0113", 6), ("E0116", 7)]),
]  # fmt: skip

FILES: list[tuple[str, list[tuple[str, int]]]] = [
    ("", [("E0003", 1)]),
    ("  (* nothing *)\n// here\n", [("E0003", 1)]),
    ("PROGRAM p\n;\nEND_PROGRAM", []),
    ("PROGRAM p; x := 1; END_PROGRAM", []),
    ("PROGRAM\nEND_PROGRAM", [("E0119", 1)]),
    ("PROGRAM if\nEND_PROGRAM", [("E0112", 1)]),
    ("PROGRAM 2nd\nEND_PROGRAM", [("E0106", 1)]),
    ("PROGRAM p;\nVAR x : INT; END_VAR;\nVAR y : INT; END_VAR\nEND_PROGRAM;",
     [("E0121", 1), ("E0121", 2), ("E0121", 4)]),
    ("PROGRAM p\nVAR\n  x : INT\n  y : BOOL;\nEND_VAR\nEND_PROGRAM", [("E0113", 3)]),
    ("PROGRAM p\nVAR x : INT; y : INT END_VAR\nEND_PROGRAM", [("E0113", 2)]),
    ("PROGRAM p\nVAR\n  x : INT;\nx := 1;\nEND_PROGRAM", [("E0114", 4)]),
    ("PROGRAM p\nVAR x : INT;\nIF x THEN y := 1; END_IF;\nEND_PROGRAM", [("E0114", 3)]),
    ("PROGRAM p\nVAR\n  x : INT;\n  for : INT;\n  2nd : INT;\nEND_VAR\nEND_PROGRAM", [("E0112", 4), ("E0106", 5)]),
    ("PROGRAM p\nVAR x INT; y : ; z := 5; END_VAR\nEND_PROGRAM", [("E0119", 2)] * 3),
    ("PROGRAM p\nVAR\nx := INT;\ny : INT = 5;\nz : ARRAY 1..5] OF INT;\nEND_VAR\nEND_PROGRAM",
     [("E0117", 3), ("E0117", 4), ("E0116", 5)]),
    ("PROGRAM p\nVAR\na : ARRAY[5] OF INT;\nb : STRING(20);\nc : ARRAY[1..2] INT;\nd AT : INT;\nEND_VAR\nEND_PROGRAM",
     [("E0119", 3), ("E0121", 4), ("E0119", 5), ("E0119", 6)]),
    ("TYPE\n  A : INT;\nPROGRAM p\nEND_PROGRAM", [("E0114", 3)]),
    ("TYPE\n  A : STRUCT\n    x : INT;\nEND_TYPE", [("E0114", 4)]),
    ("TYPE\n  A : (a, A#b, c);\n  B : (a; b);\nEND_TYPE", [("E0121", 2), ("E0116", 3)]),
    ("TYPE END_TYPE", [("E0119", 1)]),
    ("FUNCTION f : INT\nf := 1;\nEND_PROGRAM\nPROGRAM p\nx := ;\nEND_PROGRAM", [("E0115", 3), ("E0119", 5)]),
    ("FUNCTION f INT\nf := 1;\nEND_FUNCTION", [("E0119", 1)]),
    ("FUNCTION f :\nf := 1;\nEND_FUNCTION", [("E0119", 1)]),
    ("PROGRAM p : INT\nEND_PROGRAM", [("E0121", 1)]),
    ("FUNCTION_BLOCK b\nx := 1;\nFUNCTION_BLOCK c\nEND_FUNCTION_BLOCK", [("E0114", 3)]),
    ("PROGRAM p\nx := 1;", [("E0114", 2)]),
    ("x := 1;", [("E0128", 1)]),
    ("int main() { return 0; }\nPROGRAM p\nx := ;\nEND_PROGRAM", [("E0128", 1), ("E0119", 3)]),
    ("VAR x : INT; END_VAR\nPROGRAM p\nEND_PROGRAM", [("E0128", 1)]),
    ("END_VAR\nPROGRAM p\nEND_PROGRAM", [("E0115", 1)]),
    ("CONFIGURATION c\nRESOURCE r ON PLC\nTASK t();\nPROGRAM p WITH t main;\nEND_RESOURCE\nEND_CONFIGURATION",
     [("E0123", 3), ("E0119", 4)]),
    ("CONFIGURATION c\nRESOURCE r\nTASK t(INTERVAL := T#10ms PRIORITY := 1);\nPROGRAM p : m;\nEND_CONFIGURATION",
     [("E0119", 2), ("E0119", 3), ("E0114", 5)]),
    ("CONFIGURATION c\nPROGRAM p : m;\nPROGRAM m\nVAR x : INT; END_VAR\nEND_PROGRAM", [("E0114", 3)]),
]  # fmt: skip


@pytest.mark.parametrize(("text", "found"), BODIES, ids=[text for text, _ in BODIES])
def test_body(text: str, found: list[tuple[str, int]]) -> None:
    assert errors(f"PROGRAM p\n{text}\nEND_PROGRAM") == found


@pytest.mark.parametrize(("text", "found"), FILES, ids=[text for text, _ in FILES])
def test_file(text: str, found: list[tuple[str, int]]) -> None:
    assert errors(text) == found


def _diagnose(text: str) -> list[Diagnostic]:
    diagnostics = Diagnostics()
    parse(SourceFile("test.st", text), diagnostics)
    return diagnostics.items


def _only(text: str) -> Diagnostic:
    (diagnostic,) = _diagnose(text)
    return diagnostic


def test_missing_semicolon_is_at_the_end_of_the_unfinished_line() -> None:
    found = _only("PROGRAM p\n  x := 10\n  y := 2;\nEND_PROGRAM")
    assert found.span and (found.span.line, found.span.column) == (2, 9)
    assert found.message == "`;` is missing after `10`."


def test_missing_end_names_what_is_open() -> None:
    found = _only("PROGRAM p\nIF x THEN\n  y := 1;\nEND_PROGRAM")
    assert found.message == "`END_IF` is missing: this `IF` of line 2 is never closed."
    assert [related.span.line for related in found.related] == [2]


def test_indentation_tells_which_block_is_open() -> None:
    text = "PROGRAM p\nIF a THEN\n  IF b THEN\n    x := 1;\n  y := 2;\nEND_IF;\nEND_PROGRAM"
    assert "`IF` of line 3" in _only(text).message


def test_else_if_is_explained() -> None:
    found = _only("PROGRAM p\nIF a THEN\n  x := 1;\nELSE IF b THEN\n  x := 2;\nEND_IF;\nEND_PROGRAM")
    assert found.code == "E0114" and found.hint is not None and "ELSIF" in found.hint


def test_unclosed_comment_is_reported_where_it_starts_and_hides_no_end() -> None:
    found = _only("PROGRAM p\nx := 1;\n(* forgotten (* nested *)\nEND_PROGRAM")
    assert found.code == "E0102" and found.span and found.span.line == 3


def test_statements_around_an_error_are_kept() -> None:
    diagnostics = Diagnostics()
    text = "PROGRAM p\na := 1;\nb := ;\nIF c THEN\n  d := ) + ;\n  e := 5;\nEND_IF;\nf := 6;\nEND_PROGRAM"
    unit = parse(SourceFile("test.st", text), diagnostics)
    program = unit.declarations[0]
    assert isinstance(program, tree.PouDecl)
    shown = "\n".join(show(statement) for statement in program.body)
    assert shown.startswith("a := 1\n") and "e := 5" in shown and shown.endswith("f := 6")


def test_no_message_speaks_of_the_parser() -> None:
    texts = [f"PROGRAM p\n{text}\nEND_PROGRAM" for text, _ in BODIES] + [text for text, _ in FILES]
    for diagnostic in (item for text in texts for item in _diagnose(text)):
        said = f"{diagnostic.message} {diagnostic.hint}".casefold()
        assert not any(word in said for word in ("token", "unexpected", "lpar", "semicolon", "$end", "error"))
        assert (diagnostic.message.endswith(".") and diagnostic.message[0] in "`T") or diagnostic.message[0].isupper()


def test_many_errors_end() -> None:
    text = "PROGRAM p\n" + "x := := ;\n" * 5000 + "END_PROGRAM"
    assert 50 <= len(_diagnose(text)) <= 200


@pytest.mark.parametrize(
    "text",
    [
        "x := " + "(" * 5000 + "1" + ")" * 5000 + ";",
        "x := " + "1 + " * 5000 + "1;",
        "x := a" + ".b" * 5000 + ";",
        "x := a" + "[1]" * 5000 + ";",
        "IF a THEN " * 5000 + "END_IF; " * 5000,
    ],
    ids=["brackets", "sum", "members", "subscripts", "blocks"],
)
def test_what_nests_too_deeply_is_refused(text: str) -> None:
    assert errors(f"PROGRAM p\n{text}\nEND_PROGRAM") == [("E0125", 2)]


def test_types_that_nest_too_deeply_are_refused() -> None:
    text = "TYPE A : " + "ARRAY[1..2] OF " * 5000 + "INT; END_TYPE"
    assert errors(text) == [("E0125", 1)]
