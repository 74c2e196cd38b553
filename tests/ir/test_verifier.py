"""The verifier finds each kind of IR that is not what `nodes.py` promises."""

from __future__ import annotations

from dataclasses import replace

import pytest

from iec2mpy.ir import nodes as n
from iec2mpy.ir.verifier import BrokenIR, verify
from iec2mpy.semantics import types as ty
from iec2mpy.semantics.typed import Pou
from tests.renderers import built

_SOURCE = """
FUNCTION_BLOCK Other
VAR_INPUT x : INT; END_VAR
;
END_FUNCTION_BLOCK
PROGRAM main
VAR a : INT; r : REAL; s : STRING; o : Other; END_VAR
a := 1;
r := 1.0;
s := 'x';
o(x := a);
END_PROGRAM
"""
_MODULE = built(_SOURCE)
_BODIES = {pou.name: body for pou, body in _MODULE.bodies.items()}
_MAIN, _OTHER = _BODIES["main"].pou, _BODIES["Other"].pou
_TRUE = n.Const(1, ty.BOOL)
_ZERO = n.Const(0, ty.INT)
_LOCAL = n.Local(0, ty.INT)


def _variable(name: str, pou: Pou = _MAIN) -> n.Place:
    variable = pou.variables[name]
    return n.Place(n.Self(pou), (n.Field(variable),), variable.type)


_BROKEN: dict[str, tuple[n.Block, str]] = {
    "a local that is never set": ((n.Store(_variable("a"), _LOCAL),), "local 0 is read before it is set"),
    "a local that is set in one branch": (
        (n.If(_TRUE, (n.SetLocal(_LOCAL, _ZERO),), ()), n.Store(_variable("a"), _LOCAL)),
        "local 0 is read before it is set",
    ),
    "a local that is set in a loop": (
        (n.While(_TRUE, (n.SetLocal(_LOCAL, _ZERO), n.Break())), n.Store(_variable("a"), _LOCAL)),
        "local 0 is read before it is set",
    ),
    "a local with a number that is not the body's": (
        (n.SetLocal(n.Local(5, ty.INT), _ZERO),),
        "local 5 is beyond the 1 of the body",
    ),
    "a break outside of loops": ((n.If(_TRUE, (n.Break(),), ()),), "a jump out of a loop stands in none"),
    "a next pass outside of loops": ((n.Next(),), "a jump out of a loop stands in none"),
    "an integer for a REAL": ((n.Store(_variable("r"), _ZERO),), "a INT is stored to a REAL"),
    "a string for an integer": (
        (n.Store(_variable("a"), n.Const("x", ty.StringType())),),
        "a STRING is stored to a INT",
    ),
    "a local of the other kind": (
        (n.SetLocal(_LOCAL, n.Const(1.0, ty.REAL)),),
        "a REAL in local 0, which is INT",
    ),
    "a condition that is no BOOL": ((n.If(_ZERO, (), ()),), "a condition is INT"),
    "operands of two kinds": (
        (n.Store(_variable("a"), n.Op("add", _ZERO, n.Load(_variable("r"), ty.REAL), ty.INT)),),
        "add of INT and REAL",
    ),
    "an instance of another POU": (
        (n.Store(_variable("x", _OTHER), _ZERO),),
        "an instance of Other is not this body's own",
    ),
    "an instance of another POU, in an expression": (
        (n.Store(_variable("a"), n.Load(_variable("x", _OTHER), ty.INT)),),
        "an instance of Other is not this body's own",
    ),
    "an instance of another POU, in a reference": (
        (n.Store(n.Place(n.Deref(n.Load(_variable("x", _OTHER), ty.REFERENCE), ty.INT), (), ty.INT), _ZERO),),
        "an instance of Other is not this body's own",
    ),
}


@pytest.mark.parametrize("name", _BROKEN)
def test_broken(name: str) -> None:
    block, problem = _BROKEN[name]
    module = replace(_MODULE, bodies={**_MODULE.bodies, _MAIN: n.Body(_MAIN, block, locals=1)})
    with pytest.raises(BrokenIR) as raised:
        verify(module)
    assert str(raised.value) == f"main: {problem}"


def test_a_callee_without_body() -> None:
    with pytest.raises(BrokenIR, match="main: Other has no body"):
        verify(replace(_MODULE, bodies={_MAIN: _MODULE.bodies[_MAIN]}))


def test_sound() -> None:
    block = (
        n.If(_TRUE, (n.SetLocal(_LOCAL, _ZERO),), (n.SetLocal(_LOCAL, _ZERO),)),
        n.While(_TRUE, (n.If(_TRUE, (n.Break(),), (n.Next(),)),)),
        n.Store(_variable("a"), _LOCAL),
    )
    verify(replace(_MODULE, bodies={**_MODULE.bodies, _MAIN: n.Body(_MAIN, block, locals=1)}))
