"""Whatever the text, parsing ends with a tree and diagnostics, never with an exception, and in linear time."""

from __future__ import annotations

import time

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from iec2mpy.source.diagnostics import Diagnostics
from iec2mpy.source.render import render_text
from iec2mpy.source.spans import SourceFile
from iec2mpy.syntax import parse
from iec2mpy.syntax.keywords import KEYWORDS
from iec2mpy.syntax.lexer import SYMBOLS

PROGRAM = """\
TYPE
  Mode : (idle, heating := 2);
  Point : STRUCT x, y : INT := 1; END_STRUCT;
  Few : INT (0..5) := 1;
END_TYPE
FUNCTION twice : INT
VAR_INPUT a : INT; END_VAR
  twice := a * 2;
END_FUNCTION
FUNCTION_BLOCK blink
VAR RETAIN t1 : TON; list : ARRAY[1..3] OF Point := [(x := 1), 2((y := 2))]; END_VAR
VAR_OUTPUT q AT %QX0.0 : BOOL; s : STRING[10] := 'a$'b'; END_VAR
  (* toggles *)
  t1(IN := NOT t1.Q, PT := T#1s500ms, ET => rest);
  IF t1.Q AND (a > 1 OR NOT b) THEN q := NOT q; ELSIF c THEN ; ELSE RETURN; END_IF;
  CASE n OF 1, 3..5: list[n].x := twice(a := n); Mode#idle: EXIT; ELSE w.%X3 := 2#101 = 5; END_CASE;
  FOR i := 1 TO 10 BY 2 DO x := -2 ** 2 + 1.5E3; END_FOR;
  WHILE a < 5 DO a := a MOD 3; END_WHILE;
  REPEAT a := a - 1; UNTIL a <= 0 END_REPEAT;
END_FUNCTION_BLOCK
CONFIGURATION plant
  VAR_GLOBAL CONSTANT g : DINT := 5; END_VAR
  RESOURCE cpu ON PLC
    TASK fast(INTERVAL := T#10ms, PRIORITY := 1);
    PROGRAM p1 WITH fast : main(a := 5);
  END_RESOURCE
END_CONFIGURATION
"""

PIECES = [
    *KEYWORDS, *SYMBOLS, "a", "b", "TASK", "ON", "WITH", "STEP", "1", "2.5", "T#1s", "'x'", "%IX0.0", "%X1", "(*", "*)",
    "//", "{", "}", "{LD}", "$", "'", '"', "\n", "Mode#idle", "INT#", "OVERLAP", "PUBLIC", "END _IF",
]  # fmt: skip


def check(text: str) -> Diagnostics:
    diagnostics = Diagnostics()
    parse(SourceFile("test.st", text), diagnostics)
    for diagnostic in diagnostics.items:
        assert diagnostic.span is not None
        assert 0 <= diagnostic.span.start <= diagnostic.span.end <= len(text)
    render_text(diagnostics.items)
    return diagnostics


def test_the_program_itself_has_no_errors() -> None:
    assert check(PROGRAM).items == []


@given(st.text(alphabet=st.one_of(st.characters(), st.sampled_from("();:=.,'\"$%#{}[]*/<>+-&^?|\n"))))
@settings(max_examples=300, deadline=None)
def test_any_text(text: str) -> None:
    check(text)


@given(st.lists(st.sampled_from(PIECES), max_size=60))
@settings(max_examples=500, deadline=None)
def test_any_words_in_any_order(words: list[str]) -> None:
    check(" ".join(words))
    check(f"PROGRAM p\n{' '.join(words)}\nEND_PROGRAM")
    check(f"PROGRAM p VAR {' '.join(words)} END_VAR\nEND_PROGRAM")
    check(f"CONFIGURATION c\n{' '.join(words)}\nEND_CONFIGURATION")


@given(st.data())
@settings(max_examples=400, deadline=None, suppress_health_check=[HealthCheck.too_slow])
def test_mutations_of_a_program(data: st.DataObject) -> None:
    text = PROGRAM
    for _ in range(data.draw(st.integers(1, 4))):
        start = data.draw(st.integers(0, len(text)))
        length = data.draw(st.integers(0, 12))
        text = text[:start] + data.draw(st.sampled_from(["", " ", *PIECES])) + text[start + length :]
    check(text)


@pytest.mark.parametrize("end", range(0, len(PROGRAM), 7))
def test_a_program_that_is_cut_off(end: int) -> None:
    check(PROGRAM[:end])


@pytest.mark.parametrize(
    "unit",
    [
        "x := a + b * (c - 1);\n",
        "x := ;\n",
        "END_IF;\n",
        "f(a; b);\n",
        "(* comment *)\n",
        "IF a THEN\n",
        "x := 'abc\n",
        ") ] (\n",
    ],
)
def test_time_is_linear(unit: str) -> None:
    """Ten times the text takes at most some thirty times as long: the rest is noise of the machine."""

    def duration(count: int) -> float:
        text = "PROGRAM p\n" + unit * count + "END_PROGRAM"
        best = 1e9
        for _ in range(3):
            started = time.process_time()
            parse(SourceFile("test.st", text), Diagnostics())
            best = min(best, time.process_time() - started)
        return best

    assert duration(3000) < 30 * max(duration(300), 0.002)
