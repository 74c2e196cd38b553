"""Which source line makes an object first, in a scan on a board."""

from __future__ import annotations

import pytest

from iec2mpy.backends.allocation import first_allocation
from iec2mpy.backends.target import PORTABLE_BOARD, VIPER32, Target
from tests.backends.compiling import lowered

_NEVER, _LINE = None, 4


@pytest.mark.parametrize(
    ("statement", "in_viper", "in_bytecode"),
    [
        ("i := i + 1;", _NEVER, _NEVER),
        ("x := i > 3 AND x;", _NEVER, _NEVER),
        ("t(IN := x, PT := T#1s);", _NEVER, 14),
        ("d := d + 1;", _NEVER, _LINE),
        ("d := i;", _NEVER, _NEVER),
        ("r := r + 1.0;", _LINE, _LINE),
        ("r := q;", _NEVER, _NEVER),
        ("x := r > q;", _NEVER, _NEVER),
        ("r := i;", _LINE, _LINE),
        ("i := REAL_TO_INT(r);", _NEVER, _NEVER),
        ("d := REAL_TO_DINT(r);", _LINE, _LINE),
        ("s := CONCAT(s, 'x');", _LINE, _LINE),
        ("s := 'x';", _NEVER, _NEVER),
        ("i := LEN(s);", _NEVER, _NEVER),
    ],
)
def test_statements(statement: str, in_viper: int | None, in_bytecode: int | None) -> None:
    text = (
        "PROGRAM main\nVAR i : INT; d : DINT; r, q : REAL; x : BOOL; s : STRING; t : TON; END_VAR\n"
        f"i := 1;\n{statement}\nr := 1.0;\nEND_PROGRAM\n"
    )
    module = lowered(text)

    def line(target: Target) -> int | None:
        span = first_allocation(module, target)
        return span and span.line

    assert line(VIPER32) == in_viper
    assert (line(PORTABLE_BOARD) is None) == (in_bytecode is None)
