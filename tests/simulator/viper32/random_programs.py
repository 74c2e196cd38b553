"""Random viper functions over arrays, each in two texts: for boards, and for the 64-bit registers of Linux.

The second one masks each result to 32 bits, and extends the sign after each load, so that both must compute the same.
"""

from __future__ import annotations

from dataclasses import dataclass

from hypothesis import strategies as st

_DECLARATIONS = """\
from array import array
import micropython
V = array("i", {values!r})
H = array("H", {values!r} and [n & 65535 for n in {values!r}])
B = bytearray([n & 255 for n in {values!r}])

def plain(x, y):
    return y if x < 100 else x

@micropython.viper
def native(x: int, y: int) -> int:
    return x ^ (y & 1023)

@micropython.viper
def f():
    v = ptr32(V)
    h = ptr16(H)
    q = ptr8(B)
{body}
f()
"""
RESULT = "(list(V), list(H), list(B))"
_DEPTH = 3
_FORMS = ["ring", "bits", "literal", "shift", "divide", "choose", "logic", "test", "cast", "call"]


@dataclass(frozen=True)
class Pair:
    """The two texts of an expression."""

    host: str
    board: str


@dataclass(frozen=True)
class Program:
    host: str
    board: str


def _same(text: str) -> Pair:
    return Pair(text, text)


def _signed(text: str) -> str:
    return f"((({text}) << 32) >> 32)"


def _unsigned(text: str) -> str:
    return f"(({text}) & 0xffffffff)"


def _literals() -> st.SearchStrategy[int]:
    edges = [0, 1, -1, 31, 255, 65535, 32768, -32768, 0x3FFFFFFF, -0x3FFFFFFF]
    return st.one_of(st.integers(-100, 100), st.sampled_from(edges))


@st.composite
def _number(draw: st.DrawFn, depth: int) -> Pair:
    """An `int`. A literal never stands alone, so that nothing is folded."""
    if depth == 0 or draw(st.integers(0, 4)) == 0:
        return draw(_leaf())
    kind = draw(st.sampled_from(_FORMS))
    a = draw(_number(depth - 1))
    if kind == "test":
        c = draw(_comparison(depth - 1))
        return Pair(f"int({c.host})", f"int({c.board})")
    if kind == "cast":
        u = draw(_unsigned_number(depth - 1))
        return Pair(_signed(f"int({u.host})"), f"int({u.board})")
    if kind == "shift":
        operator = draw(st.sampled_from(["<<", ">>"]))
        b = draw(_number(depth - 1))
        n = draw(st.one_of(st.integers(0, 31).map(lambda n: _same(str(n))), st.just(_masked(b, 31))))
        host = f"({a.host} {operator} {n.host})"
        return Pair(_signed(host) if operator == "<<" else host, f"({a.board} {operator} {n.board})")
    if kind == "divide":
        operator = draw(st.sampled_from(["//", "%"]))
        b = _masked(draw(_number(depth - 1)), 1023)
        literal = draw(st.integers(-1000, 1000).filter(bool))
        d = draw(st.sampled_from([_same(str(literal)), Pair(f"({b.host} + 1)", f"({b.board} + 1)")]))
        return Pair(f"(({a.host} >> 2) {operator} {d.host})", f"(({a.board} >> 2) {operator} {d.board})")
    if kind == "literal":
        operator = draw(st.sampled_from(["+", "-", "*", "&", "|", "^"]))
        literal = draw(_literals())
        host = f"({a.host} {operator} {literal})" if draw(st.booleans()) else f"({literal} {operator} {a.host})"
        return Pair(_signed(host), host.replace(a.host, a.board))
    b = draw(_number(depth - 1))
    if kind == "choose":
        c = draw(_condition(depth - 1))
        return Pair(f"({a.host} if {c.host} else {b.host})", f"({a.board} if {c.board} else {b.board})")
    if kind == "logic":
        operator = draw(st.sampled_from(["and", "or"]))
        return Pair(f"({a.host} {operator} {b.host})", f"({a.board} {operator} {b.board})")
    if kind == "call":
        function = draw(st.sampled_from(["plain", "native"]))
        return Pair(f"int({function}({a.host}, {b.host}))", f"int({function}({a.board}, {b.board}))")
    operator = draw(st.sampled_from(["+", "-", "*"] if kind == "ring" else ["&", "|", "^"]))
    if draw(st.integers(0, 5)) == 0:
        b = draw(_unsigned_number(depth - 1))
    return Pair(_signed(f"{a.host} {operator} {b.host}"), f"({a.board} {operator} {b.board})")


def _masked(number: Pair, mask: int) -> Pair:
    return Pair(f"({number.host} & {mask})", f"({number.board} & {mask})")


@st.composite
def _leaf(draw: st.DrawFn) -> Pair:
    kind = draw(st.sampled_from(["local", "v", "v", "h", "q"]))
    if kind == "local":
        return draw(st.integers(0, 3).map(lambda n: _same(f"t{n}")))
    slot = draw(st.sampled_from([*map(str, range(8)), "t0 & 7", "t1 & 7"]))
    load = f"{kind}[{slot}]"
    return Pair(_signed(load) if kind == "v" else load, load)


@st.composite
def _unsigned_number(draw: st.DrawFn, depth: int) -> Pair:
    a = draw(_number(max(0, depth - 1)))
    u = Pair(_unsigned(f"uint({a.host})"), f"uint({a.board})")
    if depth <= 0:
        return u
    operator = draw(st.sampled_from(["+", "-", "*", "&", "|", "^", "<<", ">>"]))
    b = draw(_number(depth - 1))
    if operator in ("<<", ">>"):
        b = _masked(b, 31)
    return Pair(_unsigned(f"{u.host} {operator} {b.host}"), f"({u.board} {operator} {b.board})")


@st.composite
def _comparison(draw: st.DrawFn, depth: int) -> Pair:
    operator = st.sampled_from(["<", "<=", ">", ">=", "==", "!="])
    numbers = draw(st.sampled_from([_number, _unsigned_number]))
    a, b = draw(numbers(depth)), draw(numbers(depth))
    first = draw(operator)
    host, board = f"{a.host} {first} {b.host}", f"{a.board} {first} {b.board}"
    if draw(st.integers(0, 3)) == 0:
        c, second = draw(numbers(depth)), draw(operator)
        host, board = f"{host} {second} {c.host}", f"{board} {second} {c.board}"
    return Pair(f"({host})", f"({board})")


@st.composite
def _condition(draw: st.DrawFn, depth: int) -> Pair:
    kind = draw(st.sampled_from(["compare", "compare", "number", "not", "and", "or"]))
    if depth <= 0 or kind == "compare":
        return draw(_comparison(max(0, depth)))
    if kind == "number":
        return draw(_number(depth))
    a = draw(_condition(depth - 1))
    if kind == "not":
        return Pair(f"(not {a.host})", f"(not {a.board})")
    b = draw(_condition(depth - 1))
    return Pair(f"({a.host} {kind} {b.host})", f"({a.board} {kind} {b.board})")


@st.composite
def _store(draw: st.DrawFn) -> list[Pair]:
    e = draw(_number(_DEPTH))
    kind = draw(st.sampled_from(["local", "v", "v", "h", "q", "add", "local add"]))
    if kind == "local":
        n = draw(st.integers(0, 3))
        return [Pair(f"t{n} = {e.host}", f"t{n} = {e.board}")]
    operator = draw(st.sampled_from(["+", "-", "*", "&", "|", "^"]))
    if kind == "local add":
        n = draw(st.integers(0, 3))
        return [Pair(f"t{n} = {_signed(f't{n} {operator} {e.host}')}", f"t{n} {operator}= {e.board}")]
    i = _masked(draw(_number(1)), 7)
    if kind == "add":
        return [Pair(f"v[{i.host}] {operator}= {e.host}", f"v[{i.board}] {operator}= {e.board}")]
    return [Pair(f"{kind}[{i.host}] = {e.host}", f"{kind}[{i.board}] = {e.board}")]


def _indented(lines: list[Pair]) -> list[Pair]:
    return [Pair(f"    {line.host}", f"    {line.board}") for line in lines]


@st.composite
def _statement(draw: st.DrawFn, depth: int) -> list[Pair]:
    kind = draw(st.sampled_from(["store", "store", "store", "if", "for", "while"]))
    if depth == 0 or kind == "store":
        return draw(_store())
    body = _indented(draw(_block(depth - 1)))
    c = draw(_condition(2))
    if kind == "if":
        otherwise = _indented(draw(_block(depth - 1)))
        return [Pair(f"if {c.host}:", f"if {c.board}:"), *body, _same("else:"), *otherwise]
    leave = draw(st.sampled_from(["break", "continue", "pass"]))
    guard = _indented([Pair(f"if {c.host}:", f"if {c.board}:"), _same(f"    {leave}")])
    if kind == "for":
        header = draw(st.sampled_from(["range(3)", "range(t0 & 3, 5)", "range(6, t1 & 3, -2)", "range(0, h[2] & 3)"]))
        counter = f"i{depth}"
        return [_same(f"for {counter} in {header}:"), *guard, *body, _same(f"    v[{counter} & 7] = {counter}")]
    counter = f"w{depth}"
    d = draw(_condition(1))
    header = Pair(f"while {counter} < 4 and {d.host}:", f"while {counter} < 4 and {d.board}:")
    return [_same(f"{counter} = 0"), header, _same(f"    {counter} += 1"), *guard, *body]


@st.composite
def _block(draw: st.DrawFn, depth: int) -> list[Pair]:
    return [line for lines in draw(st.lists(_statement(depth), min_size=1, max_size=3)) for line in lines]


@st.composite
def programs(draw: st.DrawFn) -> Program:
    word = st.one_of(st.integers(-(2**31), 2**31 - 1), st.sampled_from([0, 1, -1, 2**31 - 1, -(2**31), 65536]))
    values = draw(st.lists(word, min_size=8, max_size=8))
    start = [Pair(f"t{n} = {_signed(f'v[{n}]')}", f"t{n} = v[{n}]") for n in range(4)]
    end = [_same(f"v[{n + 4}] ^= t{n}") for n in range(4)]
    lines = _indented([*start, *draw(_block(2)), *end])
    host = _DECLARATIONS.format(values=values, body="\n".join(line.host for line in lines))
    return Program(host, _DECLARATIONS.format(values=values, body="\n".join(line.board for line in lines)))
