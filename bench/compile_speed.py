"""How fast the compiler is: lines of program text a second, stage by stage.

    python bench/compile_speed.py [lines]

The same tank is written again and again, until the program has so many lines (12,000): once as blocks of their own,
once in one large body. What a second is worth depends on the machine, so each time is also given as a multiple of what
CPython itself needs in the same run: `ast.parse` and `compile` of the generated text.
"""

from __future__ import annotations

import ast
import sys
import time
from collections.abc import Callable
from typing import TypeVar

from iec2mpy import backends, ir, passes, semantics, syntax
from iec2mpy.backends.target import ENGINE_TARGETS
from iec2mpy.semantics.stdlib import stdlib_files
from iec2mpy.source.diagnostics import Diagnostics
from iec2mpy.source.spans import SourceFile

_INPUTS = """
  flow{n} : REAL;
  start{n}, stop{n} : BOOL;
  highest{n} : INT (0..1000) := 800;
"""
_OUTPUTS = """
  level{n} : REAL;
  full{n}, running{n} : BOOL;
"""
_VARIABLES = """
  delay{n} : TON;
  history{n} : ARRAY[0..15] OF INT;
  next{n}, total{n}, i{n} : INT;
  mode{n} : (idle, filling, settling);
"""
_BODY = """
(* Starts on demand, and stops when it is full. *)
IF start{n} AND NOT stop{n} AND NOT full{n} THEN
  running{n} := TRUE;
ELSIF stop{n} OR full{n} THEN
  running{n} := FALSE;
END_IF;
delay{n}(IN := running{n}, PT := T#2s500ms);
CASE mode{n} OF
  idle:
    IF running{n} THEN mode{n} := filling; END_IF;
  filling:
    level{n} := level{n} + flow{n} * 0.01;
    IF delay{n}.Q AND REAL_TO_INT(level{n}) >= highest{n} THEN
      mode{n} := settling;
    END_IF;
ELSE
  IF NOT running{n} THEN mode{n} := idle; END_IF;
END_CASE;
next{n} := (next{n} + 1) MOD 16;
history{n}[next{n}] := LIMIT(0, REAL_TO_INT(level{n} * 10.0), 30000);
total{n} := 0;
FOR i{n} := 0 TO 15 DO
  total{n} := total{n} + history{n}[i{n}] / 16;
END_FOR;
full{n} := total{n} > highest{n} OR level{n} > 1000.0;
"""
_BLOCK = "".join(
    [
        "FUNCTION_BLOCK Tank{number}",
        f"\nVAR_INPUT{_INPUTS}END_VAR\nVAR_OUTPUT{_OUTPUTS}END_VAR\nVAR{_VARIABLES}END_VAR{_BODY}".format(n=""),
        "END_FUNCTION_BLOCK\n",
    ]
)
_CALL = """
tank{number}(flow := tank{number}.level / 7.0 + 1.5,
    start := ticks MOD 50 = {at},
    stop := tank{number}.full);
"""

T = TypeVar("T")


def in_blocks(lines: int) -> str:
    """A program of about so many lines, with a block for each tank."""
    numbers = range(max(1, lines // (_BLOCK + _CALL).count("\n")))
    blocks = "".join(_BLOCK.format(number=number) for number in numbers)
    variables = "".join(f"  tank{number} : Tank{number};\n" for number in numbers)
    calls = "".join(_CALL.format(number=number, at=number % 50) for number in numbers)
    return blocks + _main(variables, calls)


def in_one_body(lines: int) -> str:
    """A program of about so many lines, all of it in one body."""
    declared = _INPUTS + _OUTPUTS + _VARIABLES
    numbers = range(max(1, lines // (declared + _BODY).count("\n")))
    variables = "".join(declared.format(n=number) for number in numbers)
    return _main(variables, "".join(_BODY.format(n=number) for number in numbers))


def _main(variables: str, body: str) -> str:
    return f"\nPROGRAM main\nVAR\n  ticks : DINT;\n{variables}END_VAR\nticks := ticks + 1;\n{body}END_PROGRAM\n"


def measure(title: str, text: str) -> None:
    lines = text.count("\n")
    times: dict[str, float] = {}

    def timed(stage: str, work: Callable[[], T]) -> T:
        start = time.perf_counter()
        result = work()
        times[stage] = time.perf_counter() - start
        return result

    diagnostics = Diagnostics()
    source = SourceFile("bench.st", text)
    syntax.parse(SourceFile("warm.st", in_blocks(1)), diagnostics)  # the grammars' tables are loaded once
    units = [syntax.parse(file, diagnostics) for file in stdlib_files([text])]
    units.append(timed("parse", lambda: syntax.parse(source, diagnostics)))
    application = timed("check", lambda: semantics.check(units, diagnostics, 10_000))
    assert application is not None, diagnostics.items[0]
    module = timed("build", lambda: ir.build(application))
    module = timed("passes", lambda: passes.run(module))
    generated = timed("generate", lambda: backends.generate(module, ENGINE_TARGETS["viper32"]))
    portable = backends.generate(module, ENGINE_TARGETS["cpython"]).text
    total = sum(times.values())
    timed("CPython", lambda: compile(ast.parse(portable), "program.py", "exec"))

    print(f"\n{title}: {lines} lines, {generated.text.count(chr(10))} lines of MicroPython")
    for stage, seconds in [*times.items(), ("all but CPython", total)]:
        rate = f"{lines / seconds:10,.0f} lines a second" if stage != "CPython" else " " * 25
        print(f"{stage:16}{seconds:7.2f} s {rate} {seconds / times['CPython']:6.1f} times CPython")


if __name__ == "__main__":
    wanted = int(sys.argv[1]) if len(sys.argv) > 1 else 12_000
    measure("blocks", in_blocks(wanted))
    measure("one body", in_one_body(wanted))
