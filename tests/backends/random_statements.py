"""Random programs with statements of every kind, and a small interpreter that says what they must do.

An expression or statement is its text with a function that does what the text means, on a memory of plain dicts and
lists. What operations mean is taken from `semantics.arithmetic`. A program runs for some scans; a fault ends it.
"""

from __future__ import annotations

import copy
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from hypothesis import strategies as st

from iec2mpy.semantics import arithmetic
from iec2mpy.semantics import types as ty
from iec2mpy.semantics.arithmetic import ArithmeticFault
from iec2mpy.semantics.types import ElementaryType, Kind
from tests.backends.random_programs import literal, values

Memory = dict[str, Any]
"""By variable: a number, a list for an array, a memory for an instance."""
SCANS = 3
_TYPES = (ty.SINT, ty.INT, ty.DINT, ty.UINT, ty.UDINT, ty.BOOL, ty.WORD, ty.REAL)
_NUMBERS = (ty.SINT, ty.INT, ty.DINT, ty.UINT, ty.UDINT)
_DEPTH = 2


class _Exit(Exception):
    pass


class _Continue(Exception):
    pass


@dataclass(frozen=True)
class _Expr:
    """`constant`: the checker works it out, and would tell that it faults."""

    text: str
    value: Callable[[Memory], Any]
    constant: bool = False


@dataclass(frozen=True)
class _Place:
    """`locate` gives the list or memory and the index or name in it, and may fault."""

    text: str
    locate: Callable[[Memory], tuple[Any, Any]]


@dataclass(frozen=True)
class _Statement:
    lines: tuple[str, ...]
    run: Callable[[Memory], None]


@dataclass(frozen=True)
class _Array:
    name: str
    low: int
    high: int
    element: ElementaryType


@dataclass(frozen=True)
class _Scope:
    """What a body can name. `read` and `written`: variables by type; `counters`: unused variables for loops."""

    read: Mapping[str, tuple[str, ...]]
    written: Mapping[str, tuple[str, ...]]
    arrays: tuple[_Array, ...] = ()
    counters: tuple[str, ...] = ()
    function: Callable[[int, float], int] | None = None
    meter: _Statement | None = None
    in_loop: bool = False


# ------------------------------------------------------------------------------------------- expressions


@st.composite
def _reals(draw: st.DrawFn) -> float:
    edges = [0.0, 1.0, -1.0, 0.1, 2.5, 3.5, -0.5, 1e-30, 3e38, 16777217.0, 2147483648.0, -32768.5]
    number = draw(st.one_of(st.sampled_from(edges), st.floats(-1000, 1000, width=32)))
    return arithmetic.to_single(number)


def _number_of(of: ElementaryType) -> st.SearchStrategy[Any]:
    return _reals() if of is ty.REAL else values(of)


def _literal_of(of: ElementaryType, value: Any) -> str:
    if of is not ty.REAL:
        return literal(of, value)
    text = f"{value:.9g}".upper()
    mantissa, e, exponent = text.partition("E")
    return "REAL#" + (mantissa if "." in mantissa else mantissa + ".0") + e + exponent


@st.composite
def _constant(draw: st.DrawFn, of: ElementaryType, strategy: st.SearchStrategy[Any] | None = None) -> _Expr:
    value = draw(_number_of(of) if strategy is None else strategy)
    return _fixed(of, value)


def _fixed(of: ElementaryType, value: Any) -> _Expr:
    return _Expr(_literal_of(of, value), lambda _: value, constant=True)


@st.composite
def _leaf(draw: st.DrawFn, scope: _Scope, of: ElementaryType) -> _Expr:
    kinds = ["constant"] + ["variable"] * 3 * bool(scope.read.get(of.name))
    arrays = [array for array in scope.arrays if array.element is of]
    kind = draw(st.sampled_from(kinds + ["element"] * 3 * bool(arrays)))
    if kind == "constant":
        return draw(_constant(of))
    if kind == "variable":
        name = draw(st.sampled_from(scope.read[of.name]))
        return _Expr(name, lambda memory: memory[name])
    return _loaded(draw(_element(scope, draw(st.sampled_from(arrays)))))


def _loaded(place: _Place) -> _Expr:
    def value(memory: Memory) -> Any:
        where, index = place.locate(memory)
        return where[index]

    return _Expr(place.text, value)


@st.composite
def _element(draw: st.DrawFn, scope: _Scope, array: _Array) -> _Place:
    """An element; now and then one that the array does not have."""
    kind = draw(st.sampled_from(["constant"] * 8 + ["limited"] * 16 + ["variable"]))
    if kind == "constant":
        index = draw(_constant(ty.INT, st.integers(array.low, array.high)))
    else:
        name = draw(st.sampled_from(scope.read["INT"]))
        index = _Expr(name, lambda memory: memory[name])
        index = _limited(index, array.low, array.high) if kind == "limited" else index

    def locate(memory: Memory) -> tuple[list[Any], int]:
        number = index.value(memory)
        if not array.low <= number <= array.high:
            raise ArithmeticFault("index")
        return memory[array.name], number - array.low

    return _Place(f"{array.name}[{index.text}]", locate)


def _limited(number: _Expr, low: int, high: int) -> _Expr:
    return _applied("LIMIT", ty.INT, _fixed(ty.INT, low), number, _fixed(ty.INT, high))


def _applied(name: str, of: ElementaryType, *arguments: _Expr) -> _Expr:
    text = f"{name}({', '.join(a.text for a in arguments)})"
    constant = all(a.constant for a in arguments)
    return _Expr(text, lambda memory: arithmetic.builtin(name, [a.value(memory) for a in arguments], of), constant)


def _combined(name: str, of: ElementaryType, left: _Expr, right: _Expr) -> _Expr:
    return _Expr(
        f"({left.text} {name} {right.text})",
        lambda memory: arithmetic.binary(name, left.value(memory), right.value(memory), of, of),
        left.constant and right.constant,
    )


def _converted(operand: _Expr, source: ElementaryType, to: ElementaryType) -> _Expr:
    text = f"{source.name}_TO_{to.name}({operand.text})"
    return _Expr(text, lambda memory: arithmetic.convert(operand.value(memory), source, to), operand.constant)


@st.composite
def _expression(draw: st.DrawFn, scope: _Scope, of: ElementaryType, depth: int = _DEPTH) -> _Expr:
    """An expression that does not fault if it is constant."""
    found = draw(_any_expression(scope, of, depth))
    try:
        if found.constant:
            found.value({})
    except ArithmeticFault:
        return draw(_leaf(scope, of))
    return found


@st.composite
def _any_expression(draw: st.DrawFn, scope: _Scope, of: ElementaryType, depth: int) -> _Expr:
    if depth == 0 or not draw(st.integers(0, 3)):
        return draw(_leaf(scope, of))
    if scope.function is not None and of is ty.DINT and not draw(st.integers(0, 5)):
        return draw(_function_call(scope, scope.function, depth))
    if of is ty.BOOL and draw(st.booleans()):
        compared = draw(st.sampled_from(_TYPES))
        name = draw(st.sampled_from(["=", "<>", "<", ">", "<=", ">="]))
        return _combined(name, compared, *(draw(_expression(scope, compared, depth - 1)) for _ in range(2)))
    kind = draw(st.sampled_from(["binary", "binary", "unary", "convert", "call"]))
    if kind == "convert":
        return draw(_conversion(scope, of, depth))
    first = draw(_expression(scope, of, depth - 1))
    if kind == "unary":
        return _unary(first, of)
    if kind == "call":
        return draw(_standard_call(scope, of, first, depth))
    arithmetical = ["+", "-", "*", "/"] + ["MOD"] * (of is not ty.REAL)
    name = draw(st.sampled_from(["AND", "OR", "XOR"] if _is_bits(of) else arithmetical))
    if name in ("/", "MOD") and draw(st.integers(0, 7)):
        return _combined(name, of, first, draw(_constant(of, _number_of(of).filter(bool))))
    second = draw(_expression(scope, of, depth - 1))
    if name == "/" and second.constant and not second.value({}):
        return first
    return _combined(name, of, first, second)


def _is_bits(of: ElementaryType) -> bool:
    return of.kind in (Kind.BOOL, Kind.BITS)


def _unary(operand: _Expr, of: ElementaryType) -> _Expr:
    if of.kind is Kind.UNSIGNED:
        return operand
    name = "NOT" if _is_bits(of) else "-"
    text = f"({name} {operand.text})"
    return _Expr(text, lambda memory: arithmetic.unary(name, operand.value(memory), of), operand.constant)


@st.composite
def _conversion(draw: st.DrawFn, scope: _Scope, of: ElementaryType, depth: int) -> _Expr:
    """Of a number that fits, most often."""
    source = draw(st.sampled_from([t for t in _TYPES if t is not of and not {t, of} <= {ty.REAL, ty.WORD, ty.BOOL}]))
    operand = draw(_expression(scope, source, depth - 1))
    if not _is_bits(source) and of in _NUMBERS and draw(st.integers(0, 7)):
        low, high = max(of.low, -1000), min(of.high, 1000)
        if source is ty.REAL:
            low, high = float(low), float(high)
        else:
            low, high = max(source.low, low), min(source.high, high)
        operand = _applied("LIMIT", source, _fixed(source, low), operand, _fixed(source, high))
    return _converted(operand, source, of)


@st.composite
def _standard_call(draw: st.DrawFn, scope: _Scope, of: ElementaryType, first: _Expr, depth: int) -> _Expr:
    second = draw(_expression(scope, of, depth - 1))
    if of.kind is Kind.BITS:
        name = draw(st.sampled_from(["SHL", "SHR", "ROL", "ROR"]))
        return _applied(name, of, first, draw(_constant(ty.INT, st.integers(0, of.bits + 1))))
    if _is_bits(of) or draw(st.booleans()):
        return _applied("SEL", of, draw(_expression(scope, ty.BOOL, depth - 1)), first, second)
    name = draw(st.sampled_from(["MIN", "MAX", "ABS"] + ["SQRT"] * (of is ty.REAL)))
    if name == "SQRT":
        first = _applied("ABS", of, first)
    return _applied(name, of, *([first, second] if name in ("MIN", "MAX") else [first]))


@st.composite
def _function_call(draw: st.DrawFn, scope: _Scope, function: Callable[[int, float], int], depth: int) -> _Expr:
    a, x = draw(_expression(scope, ty.DINT, depth - 1)), draw(_expression(scope, ty.REAL, depth - 1))
    return _Expr(f"weigh({a.text}, {x.text})", lambda memory: function(a.value(memory), x.value(memory)))


# -------------------------------------------------------------------------------------------- statements


def _indented(block: _Statement) -> tuple[str, ...]:
    return tuple(f"  {line}" for line in block.lines)


@st.composite
def _block(draw: st.DrawFn, scope: _Scope, depth: int, least: int = 1) -> _Statement:
    statements = draw(st.lists(_statement(scope, depth), min_size=least, max_size=least + 2))

    def run(memory: Memory) -> None:
        for statement in statements:
            statement.run(memory)

    return _Statement(tuple(line for s in statements for line in s.lines), run)


@st.composite
def _statement(draw: st.DrawFn, scope: _Scope, depth: int) -> _Statement:
    kinds = ["assign"] * 3 + ["call"] * (scope.meter is not None)
    if depth > 0:
        kinds += ["if", "case"] + ["for", "while", "repeat"] * bool(scope.counters) + ["leave"] * scope.in_loop
    return draw(_STATEMENTS[draw(st.sampled_from(kinds))](scope, depth))


@st.composite
def _assign(draw: st.DrawFn, scope: _Scope, _depth: int) -> _Statement:
    of = draw(st.sampled_from([t for t in _TYPES if scope.written.get(t.name)]))
    arrays = [array for array in scope.arrays if array.element is of]
    if arrays and draw(st.booleans()):
        place = draw(_element(scope, draw(st.sampled_from(arrays))))
    else:
        name = draw(st.sampled_from(scope.written[of.name]))
        place = _Place(name, lambda memory: (memory, name))
    value = draw(_expression(scope, of))

    def run(memory: Memory) -> None:
        where, index = place.locate(memory)
        where[index] = value.value(memory)

    return _Statement((f"{place.text} := {value.text};",), run)


@st.composite
def _if(draw: st.DrawFn, scope: _Scope, depth: int) -> _Statement:
    conditions = [draw(_expression(scope, ty.BOOL)) for _ in range(draw(st.integers(1, 2)))]
    bodies = [draw(_block(scope, depth - 1)) for _ in conditions]
    otherwise = draw(_block(scope, depth - 1))

    def run(memory: Memory) -> None:
        for condition, body in zip(conditions, bodies, strict=True):
            if condition.value(memory):
                body.run(memory)
                return
        otherwise.run(memory)

    lines: list[str] = []
    for word, condition, body in zip(["IF", "ELSIF"], conditions, bodies, strict=False):
        lines += [f"{word} {condition.text} THEN", *_indented(body)]
    return _Statement((*lines, "ELSE", *_indented(otherwise), "END_IF;"), run)


@st.composite
def _case(draw: st.DrawFn, scope: _Scope, depth: int) -> _Statement:
    of = draw(st.sampled_from(_NUMBERS))
    selector = draw(_expression(scope, of, 1))
    limits = sorted(draw(st.sets(values(of), min_size=2, max_size=6)))
    groups = [(low, high) for low, high in zip(limits[::2], limits[1::2], strict=False)]
    bodies = [draw(_block(scope, depth - 1)) for _ in groups]
    otherwise = draw(_block(scope, depth - 1))

    def run(memory: Memory) -> None:
        number = selector.value(memory)
        for (low, high), body in zip(groups, bodies, strict=True):
            if low <= number <= high:
                body.run(memory)
                return
        otherwise.run(memory)

    lines = [f"CASE {selector.text} OF"]
    for (low, high), body in zip(groups, bodies, strict=True):
        lines += [f"{low}..{high}:", *_indented(body)]
    return _Statement((*lines, "ELSE", *_indented(otherwise), "END_CASE;"), run)


def _repeated(body: _Statement, memory: Memory) -> bool:
    """Runs a loop's body once; False where it leaves the loop."""
    try:
        body.run(memory)
    except _Continue:
        pass
    except _Exit:
        return False
    return True


def _inside_loop(scope: _Scope) -> _Scope:
    counter, *rest = scope.counters
    read = {**scope.read, "INT": (*scope.read.get("INT", ()), counter)}
    return replace(scope, read=read, counters=tuple(rest), in_loop=True)


@st.composite
def _for(draw: st.DrawFn, scope: _Scope, depth: int) -> _Statement:
    """At most some 8 passes, also around the limits of the type."""
    counter = scope.counters[0]
    near = draw(st.sampled_from([-3, 0, 2, ty.INT.high - 3, ty.INT.low + 3]))
    ends = max(near - 4, ty.INT.low), min(near + 4, ty.INT.high)
    start, end = draw(_bound(scope, *ends)), draw(_bound(scope, *ends))
    step = draw(st.sampled_from([1, 1, 2, 3, -1, -2]))
    body = draw(_block(_inside_loop(scope), depth - 1))

    def run(memory: Memory) -> None:
        value, last = start.value(memory), end.value(memory)
        while True:
            memory[counter] = arithmetic.wrap(value, ty.INT)
            if (value > last if step > 0 else value < last) or not _repeated(body, memory):
                return
            value += step

    head = f"FOR {counter} := {start.text} TO {end.text} BY {step} DO"
    return _Statement((head, *_indented(body), "END_FOR;"), run)


@st.composite
def _bound(draw: st.DrawFn, scope: _Scope, low: int, high: int) -> _Expr:
    if draw(st.booleans()):
        return draw(_constant(ty.INT, st.integers(low, high)))
    return _limited(draw(_expression(scope, ty.INT, 1)), low, high)


@st.composite
def _while(draw: st.DrawFn, scope: _Scope, depth: int) -> _Statement:
    counter, condition = scope.counters[0], draw(_expression(scope, ty.BOOL))
    body = draw(_block(_inside_loop(scope), depth - 1))

    def run(memory: Memory) -> None:
        memory[counter] = 0
        # AND evaluates both sides
        while condition.value(memory) & (memory[counter] < 4):
            memory[counter] += 1
            if not _repeated(body, memory):
                return

    head = (f"{counter} := 0;", f"WHILE {condition.text} AND {counter} < 4 DO", f"  {counter} := {counter} + 1;")
    return _Statement((*head, *_indented(body), "END_WHILE;"), run)


@st.composite
def _repeat(draw: st.DrawFn, scope: _Scope, depth: int) -> _Statement:
    counter, condition = scope.counters[0], draw(_expression(scope, ty.BOOL))
    body = draw(_block(_inside_loop(scope), depth - 1))

    def run(memory: Memory) -> None:
        memory[counter] = 0
        while True:
            memory[counter] += 1
            if not _repeated(body, memory) or condition.value(memory) | (memory[counter] >= 3):
                return

    head = (f"{counter} := 0;", "REPEAT", f"  {counter} := {counter} + 1;")
    return _Statement((*head, *_indented(body), f"UNTIL {condition.text} OR {counter} >= 3 END_REPEAT;"), run)


@st.composite
def _leave(draw: st.DrawFn, scope: _Scope, _depth: int) -> _Statement:
    condition = draw(_expression(scope, ty.BOOL))
    word, how = draw(st.sampled_from([("EXIT", _Exit), ("CONTINUE", _Continue)]))

    def run(memory: Memory) -> None:
        if condition.value(memory):
            raise how

    return _Statement((f"IF {condition.text} THEN {word}; END_IF;",), run)


@st.composite
def _call(draw: st.DrawFn, scope: _Scope, _depth: int) -> _Statement:
    """Of an instance, or of one in an array of two."""
    meter = scope.meter
    assert meter is not None
    name = draw(st.sampled_from(["m0", "m1", "m"]))
    index = draw(_bound(scope, 0, 1))
    a, x = draw(_expression(scope, ty.INT)), draw(_expression(scope, ty.REAL))
    target = draw(st.sampled_from(scope.written["DINT"]))

    def run(memory: Memory) -> None:
        instance = memory["m"][index.value(memory)] if name == "m" else memory[name]
        instance["a"], instance["x"] = a.value(memory), x.value(memory)
        meter.run(instance)
        memory[target] = instance["d"]

    shown = f"m[{index.text}]" if name == "m" else name
    return _Statement((f"{shown}(a := {a.text}, x := {x.text}, d => {target});",), run)


_STATEMENTS: dict[str, Callable[[_Scope, int], st.SearchStrategy[_Statement]]] = {
    "assign": _assign,
    "call": _call,
    "if": _if,
    "case": _case,
    "for": _for,
    "while": _while,
    "repeat": _repeat,
    "leave": _leave,
}


# ---------------------------------------------------------------------------------------------- programs


@dataclass(frozen=True)
class RandomScans:
    """A program, and what is to be seen after each of its scans: the kind of the fault, or the values by path."""

    text: str
    scans: tuple[str | Mapping[str, Any], ...]


_COUNTERS = ("k0", "k1")


@st.composite
def _declared(draw: st.DrawFn, names: Mapping[str, tuple[str, ...]]) -> tuple[list[str], Memory]:
    """Declarations with initial values, and the memory that they make."""
    lines: list[str] = []
    memory: Memory = {}
    for of in _TYPES:
        for name in names.get(of.name, ()):
            memory[name] = draw(_number_of(of))
            lines.append(f"  {name} : {of.name} := {_literal_of(of, memory[name])};")
    return lines, memory


@st.composite
def scans(draw: st.DrawFn) -> RandomScans:
    """A program with a function, four instances of a block, arrays, and statements of every kind."""
    function_text, function = draw(_weigh())
    meter_text, meter, instance = draw(_meter())
    arrays = (_Array("ints", -2, 4, ty.INT), _Array("dints", 1, 3, ty.DINT), _Array("reals", 0, 2, ty.REAL))
    names = {of.name: (f"{of.name.lower()}0", f"{of.name.lower()}1") for of in _TYPES}
    declarations, memory = draw(_declared(names))
    for array in arrays:
        memory[array.name] = [draw(_number_of(array.element)) for _ in range(array.low, array.high + 1)]
        shown = ", ".join(_literal_of(array.element, value) for value in memory[array.name])
        declarations.append(f"  {array.name} : ARRAY[{array.low}..{array.high}] OF {array.element.name} := [{shown}];")
    memory |= {name: copy.deepcopy(instance) for name in ("m0", "m1")}
    memory["m"] = [copy.deepcopy(instance) for _ in range(2)]
    memory |= dict.fromkeys(_COUNTERS, 0)
    declarations += ["  m0, m1 : Meter;", "  m : ARRAY[0..1] OF Meter;", f"  {', '.join(_COUNTERS)} : INT;"]
    body = draw(_block(_Scope(names, names, arrays, _COUNTERS, function, meter), 3, least=4))
    lines = [*function_text, *meter_text, "PROGRAM main", "VAR", *declarations, "END_VAR", *body.lines, "END_PROGRAM"]
    return RandomScans("\n".join([*lines, ""]), _expected(body, memory))


def _expected(body: _Statement, memory: Memory) -> tuple[str | Mapping[str, Any], ...]:
    found: list[str | Mapping[str, Any]] = []
    for _ in range(SCANS):
        try:
            body.run(memory)
        except ArithmeticFault as fault:
            return (*found, fault.kind)
        found.append(copy.deepcopy(memory))
    return tuple(found)


@st.composite
def _weigh(draw: st.DrawFn) -> tuple[list[str], Callable[[int, float], int]]:
    """A function of a DINT and a REAL, whose variables are new at each call."""
    names = {"DINT": ("d", "weigh"), "REAL": ("y",), "INT": ("i",), "BOOL": ("b",)}
    read = {**names, "DINT": ("a", "d", "weigh"), "REAL": ("x", "y")}
    declarations, start = draw(_declared({**names, "DINT": ("d",)}))
    body = draw(_block(_Scope(read, names), 1))

    def function(a: int, x: float) -> int:
        memory = {**start, "a": a, "x": x, "weigh": 0}
        body.run(memory)
        return memory["weigh"]

    head = ["FUNCTION weigh : DINT", "VAR_INPUT a : DINT; x : REAL; END_VAR", "VAR"]
    return [*head, *declarations, "END_VAR", *body.lines, "END_FUNCTION"], function


@st.composite
def _meter(draw: st.DrawFn) -> tuple[list[str], _Statement, Memory]:
    """A block that keeps its variables from call to call."""
    names = {"DINT": ("d",), "REAL": ("y",), "INT": ("i",), "BOOL": ("b",), "UDINT": ("u",)}
    read = {**names, "INT": ("i", "a"), "REAL": ("y", "x")}
    declarations, memory = draw(_declared({**names, "DINT": ()}))
    arrays = (_Array("last", 0, 2, ty.INT),)
    body = draw(_block(_Scope(read, names, arrays, counters=("k",)), 2))
    head = ["FUNCTION_BLOCK Meter", "VAR_INPUT a : INT; x : REAL; END_VAR", "VAR_OUTPUT d : DINT; END_VAR", "VAR"]
    held = ["  last : ARRAY[0..2] OF INT;", "  k : INT;", "END_VAR"]
    memory |= {"a": 0, "x": 0.0, "d": 0, "last": [0, 0, 0], "k": 0}
    return [*head, *declarations, *held, *body.lines, "END_FUNCTION_BLOCK"], body, memory
