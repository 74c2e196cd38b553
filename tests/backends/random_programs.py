"""Random expressions of every integer width, each with the value that the model of the meaning gives it."""

from __future__ import annotations

from dataclasses import dataclass

from hypothesis import strategies as st

from iec2mpy.semantics import arithmetic
from iec2mpy.semantics import types as ty
from iec2mpy.semantics.types import ElementaryType, Kind

INTEGERS = (ty.SINT, ty.INT, ty.DINT, ty.LINT, ty.USINT, ty.UINT, ty.UDINT, ty.ULINT)
BITS = (ty.BOOL, ty.BYTE, ty.WORD, ty.DWORD, ty.LWORD)
NUMBERED = (*INTEGERS, *BITS)
VARIABLES_A_TYPE = 2


@dataclass(frozen=True)
class Valued:
    """An expression as text of ST, and what it is worth."""

    text: str
    value: int


@st.composite
def values(draw: st.DrawFn, of: ElementaryType) -> int:
    """Numbers of a type; often those at its edges."""
    edges = [v for v in (of.low, of.low + 1, -1, 0, 1, 2, 7, of.high - 1, of.high) if of.low <= v <= of.high]
    return draw(st.one_of(st.sampled_from(edges), st.integers(of.low, of.high)))


@st.composite
def environments(draw: st.DrawFn) -> dict[str, int]:
    """Values for the variables: `int0`, `int1`, `byte0`, …"""
    return {f"{of.name.lower()}{number}": draw(values(of)) for of in NUMBERED for number in range(VARIABLES_A_TYPE)}


@st.composite
def expressions(draw: st.DrawFn, of: ElementaryType, environment: dict[str, int], depth: int = 3) -> Valued:
    """An expression of a type that does not fault."""
    shapes = ["variable", "literal"]
    if depth > 0:
        shapes += ["binary", "binary", "unary", "convert", "call"] + (["compare"] * 3 if of is ty.BOOL else [])
    shape = draw(st.sampled_from(shapes))
    try:
        return _SHAPES[shape](draw, of, environment, depth)
    except arithmetic.ArithmeticFault:
        return _literal(draw, of, environment, depth)


def literal(of: ElementaryType, value: int) -> str:
    if of is ty.BOOL:
        return "TRUE" if value else "FALSE"
    return f"{of.name}#{value}"


def _variable(draw: st.DrawFn, of: ElementaryType, environment: dict[str, int], _depth: int) -> Valued:
    name = f"{of.name.lower()}{draw(st.integers(0, VARIABLES_A_TYPE - 1))}"
    return Valued(name, environment[name])


def _literal(draw: st.DrawFn, of: ElementaryType, _environment: dict[str, int], _depth: int) -> Valued:
    value = draw(values(of))
    return Valued(literal(of, value), value)


def _binary(draw: st.DrawFn, of: ElementaryType, environment: dict[str, int], depth: int) -> Valued:
    names = ["AND", "OR", "XOR"] if of in BITS else ["+", "-", "*", "/", "MOD"]
    name = draw(st.sampled_from(names))
    left = draw(expressions(of, environment, depth - 1))
    right = draw(expressions(of, environment, depth - 1))
    value = arithmetic.binary(name, left.value, right.value, of, of)
    assert isinstance(value, int)
    return Valued(f"({left.text} {name} {right.text})", value)


def _unary(draw: st.DrawFn, of: ElementaryType, environment: dict[str, int], depth: int) -> Valued:
    operand = draw(expressions(of, environment, depth - 1))
    name = "NOT" if of in BITS else "-"
    if of.kind is Kind.UNSIGNED:
        return operand
    value = arithmetic.unary(name, operand.value, of)
    assert isinstance(value, int)
    return Valued(f"({name} {operand.text})", value)


def _convert(draw: st.DrawFn, of: ElementaryType, environment: dict[str, int], depth: int) -> Valued:
    source = draw(st.sampled_from([t for t in NUMBERED if t is not of]))
    operand = draw(expressions(source, environment, depth - 1))
    value = arithmetic.convert(operand.value, source, of)
    assert isinstance(value, int)
    return Valued(f"{source.name}_TO_{of.name}({operand.text})", value)


def _call(draw: st.DrawFn, of: ElementaryType, environment: dict[str, int], depth: int) -> Valued:
    if of in BITS:
        name = draw(st.sampled_from(["SHL", "SHR", "ROL", "ROR"]))
        value, count = draw(expressions(of, environment, depth - 1)), draw(st.integers(0, of.bits + 3))
        shown = draw(st.sampled_from([str(count), f"(int0 - int0 + {count})"]))
        result = arithmetic.builtin(name, [value.value, count], of)
        assert isinstance(result, int)
        return Valued(f"{name}({value.text}, {shown})", result)
    name, count = draw(st.sampled_from([("MAX", 2), ("MIN", 3), ("LIMIT", 3), ("SEL", 2), ("ABS", 1)]))
    arguments = [draw(expressions(of, environment, depth - 1)) for _ in range(count)]
    texts, numbers = [a.text for a in arguments], [a.value for a in arguments]
    if name == "SEL":
        selector = draw(expressions(ty.BOOL, environment, depth - 1))
        texts, numbers = [selector.text, *texts], [selector.value, *numbers]
    result = arithmetic.builtin(name, numbers, of)
    assert isinstance(result, int)
    return Valued(f"{name}({', '.join(texts)})", result)


def _compare(draw: st.DrawFn, _of: ElementaryType, environment: dict[str, int], depth: int) -> Valued:
    operands = draw(st.sampled_from(NUMBERED))
    name = draw(st.sampled_from(["=", "<>", "<", ">", "<=", ">="]))
    left = draw(expressions(operands, environment, depth - 1))
    right = draw(expressions(operands, environment, depth - 1))
    value = arithmetic.binary(name, left.value, right.value, operands, operands)
    assert isinstance(value, int)
    return Valued(f"({left.text} {name} {right.text})", value)


_SHAPES = {
    "variable": _variable,
    "literal": _literal,
    "binary": _binary,
    "unary": _unary,
    "convert": _convert,
    "call": _call,
    "compare": _compare,
}


@dataclass(frozen=True)
class RandomProgram:
    """A program whose variables `r0`, `r1`, … must have these values after a scan."""

    text: str
    results: tuple[int, ...]


@st.composite
def programs(draw: st.DrawFn, count: int = 8) -> RandomProgram:
    """A program that assigns some expressions."""
    environment = draw(environments())
    declarations = [
        f"  {of.name.lower()}{number} : {of.name} := {literal(of, environment[f'{of.name.lower()}{number}'])};"
        for of in NUMBERED
        for number in range(VARIABLES_A_TYPE)
    ]
    statements, results = [], []
    for number in range(count):
        of = draw(st.sampled_from(NUMBERED))
        expression = draw(expressions(of, environment))
        declarations.append(f"  r{number} : {of.name};")
        statements.append(f"r{number} := {expression.text};")
        results.append(expression.value)
    text = "\n".join(["PROGRAM main", "VAR", *declarations, "END_VAR", *statements, "END_PROGRAM", ""])
    return RandomProgram(text, tuple(results))
