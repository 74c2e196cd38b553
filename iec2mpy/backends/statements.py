"""Statements of the IR as lines of Python."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from iec2mpy.backends import forms
from iec2mpy.backends.expressions import ExpressionWriter, quoted
from iec2mpy.backends.forms import Binding, Text, call, infix, number
from iec2mpy.backends.layout import LOOP, NOWHERE, SITE, Layout
from iec2mpy.backends.names import SlotNames
from iec2mpy.backends.reals import real_text
from iec2mpy.backends.sites import Sites
from iec2mpy.backends.target import Target
from iec2mpy.backends.values import flat_values
from iec2mpy.ir import nodes as n
from iec2mpy.ir.bounds import bounds
from iec2mpy.semantics import types as ty
from iec2mpy.semantics.typed import Pou
from iec2mpy.syntax.tree import PouKind

_UNROLLED = 4
"""A copy of so many slots is written out."""


@dataclass(slots=True)
class StatementWriter:
    """Writes the body of one function. `functions` are the names of the bodies that it may call."""

    expressions: ExpressionWriter
    functions: dict[Pou, str]
    sites: Sites
    lines: list[str] = field(default_factory=list)
    _indent: int = 1
    _line: tuple[str, int] | None = None
    _temporaries: int = 0

    def block(self, block: n.Block) -> None:
        """The statements, or `pass`."""
        before = len(self.lines)
        for statement in block:
            self._statement(statement)
        if not any(not line.lstrip().startswith("#") for line in self.lines[before:]):
            self._write("pass")

    def _write(self, code: str) -> None:
        self.lines.append("    " * self._indent + code)

    def _inner(self, block: n.Block) -> None:
        self._indent += 1
        self.block(block)
        self._indent -= 1

    def _statement(self, statement: n.Stmt) -> None:
        match statement:
            case n.Line(span):
                place = (span.file.name, span.line)
                if place != self._line:
                    self._write(f"# {span.file.name}:{span.line}  {span.file.line_text(span.line).strip()}")
                self._line = place
            case n.Store(place, value):
                self._store(place, value)
            case n.SetLocal(local, value):
                self._set_local(local, value)
            case n.Copy(target, source):
                self._copy(target, source)
            case n.Compare(local, left, right):
                self._compare(local, left, right)
            case n.Bind(reference, target):
                addresses = self.expressions.addresses
                self._write(f"v[{addresses.subscript(reference, 'V').code}] = {addresses.reference(target).code}")
            case n.Reset(place, value):
                self._reset(place, value)
            case n.Call(pou, instance):
                self._write(f"{self.functions[pou]}({', '.join(self._bases(pou, instance))})")
            case n.Part(number):
                function = part_name(self.functions, self.expressions.pou, number)
                self._write(f"{function}({', '.join(self._own_bases())})")
            case n.Guard(condition, fault, site):
                self._write(f"if {self.expressions.condition(condition).code}:")
                self._write(f"    {self._note(site)}")
                self._write(f"    raise {self.expressions.need('faults', fault.upper())}")
            case n.Mark(site):
                self._write(self._note(site))
            case n.Tick(site):
                self._tick(site)
            case n.If():
                self._if(statement)
            case n.Try(body):
                self._try(body)
            case n.While(condition, body):
                self._write(f"while {self.expressions.condition(condition).code}:")
                self._inner(body)
            case n.Break():
                self._write("break")
            case n.Next():
                self._write("continue")
            case n.Return():
                self._write("return")

    # ------------------------------------------------------------------------------------- values

    def _store(self, place: n.Place, value: n.Expr) -> None:
        if not isinstance(value.type, ty.ElementaryType) or value.type.in_objects:
            self.expressions.uses_objects = True
            text = self.expressions.boxing(value)
            self._write(f"o[{self.expressions.addresses.subscript(place, 'O').code}] = {text.code}")
            return
        text = self.expressions.value(value)
        text = forms.stored(self.expressions.target, text, value.type, bounds(value)[1])
        self._write(f"v[{self.expressions.addresses.subscript(place, 'V').code}] = {text.code}")

    def _set_local(self, local: n.Local, value: n.Expr) -> None:
        name = self.expressions.value(local).code
        if isinstance(value, n.Op) and value.name in ("div", "mod") and self._needs_unsigned_division(value):
            self._unsigned_division(name, value)
        else:
            self._write(f"{name} = {self.expressions.value(value).code}")

    def _needs_unsigned_division(self, value: n.Op) -> bool:
        assert isinstance(value.type, ty.ElementaryType)
        return forms.held_as_pattern(self.expressions.target, value.type) and (
            bounds(value.left)[1] >= 1 << 31 or bounds(value.right)[1] >= 1 << 31
        )

    def _unsigned_division(self, name: str, value: n.Op) -> None:
        """32-bit unsigned division, of patterns, with signed machine words (viper has no `//` of `uint`).

        A divisor from 2^31 on goes into the dividend once or not at all. By a smaller one, half of the dividend is
        divided: twice that quotient is right or one too small.
        """
        a, b = (self.expressions.value(operand) for operand in (value.left, value.right))
        quotient, rest = self._temporary(), self._temporary()
        half = call("int", infix(call("uint", a), ">>", number(1)))
        doubled = infix(infix(half, "//", b), "<<", number(1)).code
        large = infix(b, "<", number(0))
        if bounds(value.right)[1] >= 1 << 31:
            doubled = f"0 if {large.code} else {doubled}"
        self._write(f"{quotient} = {doubled}")
        self._write(f"{rest} = {infix(a, '-', infix(Text(quotient), '*', b)).code}")
        self._write(f"if uint({rest}) >= uint({b.code}):")
        self._write(f"    {quotient} += 1")
        self._write(f"    {rest} -= {b.at(Binding.TERM)}")
        self._write(f"{name} = {quotient if value.name == 'div' else rest}")

    def _temporary(self) -> str:
        """A machine word that is no local of the IR."""
        self._temporaries += 1
        return f"u{self._temporaries}"

    # ------------------------------------------------------------------------------ arrays, structures

    def _copy(self, target: n.Place, source: n.Place) -> None:
        for name, to, from_, count in self._paired(target, source):
            if count <= _UNROLLED:
                for position in range(count):
                    to_slot, from_slot = (_moved(text, position).code for text in (to, from_))
                    self._write(f"{name}[{to_slot}] = {name}[{from_slot}]")
            else:
                first, second, left = self._countdown(to, from_, count)
                self._write(f"    {name}[{first} + {left}] = {name}[{second} + {left}]")

    def _compare(self, local: n.Local, left: n.Place, right: n.Place) -> None:
        result = self.expressions.value(local).code
        self._write(f"{result} = 1")
        for name, one, other, count in self._paired(left, right):
            first, second, remaining = self._countdown(one, other, count)
            self._write(f"    if {name}[{first} + {remaining}] != {name}[{second} + {remaining}]:")
            self._write(f"        {result} = 0")
            self._write("        break")

    def _paired(self, one: n.Place, other: n.Place) -> Iterator[tuple[str, Text, Text, int]]:
        """For each array that has a part of the two: its name in the function, where they begin, how many slots."""
        size = self.expressions.layout.size_of(one.type)
        for array, name in (("V", "v"), ("O", "o")):
            if size.of(array):
                self.expressions.uses_objects |= array == "O"
                first, second = (self.expressions.addresses.subscript(place, array) for place in (one, other))
                yield name, first, second, size.of(array)

    def _countdown(self, one: Text, other: Text, count: int) -> tuple[str, str, str]:
        """The head of a loop over pairs of slots, from the last one: names of the two bases and of what is added."""
        first, second, left = self._temporary(), self._temporary(), self._temporary()
        self._write(f"{first} = {one.code}")
        self._write(f"{second} = {other.code}")
        self._write(f"{left} = {count}")
        self._write(f"while {left} > 0:")
        self._write(f"    {left} -= 1")
        return first, second, left

    def _reset(self, place: n.Place, value: object) -> None:
        written_for = self.expressions.target, self.expressions.names
        for array in ("V", "O"):
            values = flat_values(self.expressions.layout, place.type, value, array, NOWHERE, {})
            if not values:
                continue
            start = self.expressions.addresses.subscript(place, array).code
            if len(set(map(repr, values))) == 1:
                fill = self.expressions.need("memory", "fill")
                self._write(f"{fill}({array}, {start}, {len(values)}, {literal(values[0], *written_for)})")
            else:
                put = self.expressions.need("memory", "put")
                self._write(f"{put}({array}, {start}, {literals(values, *written_for)})")

    # ----------------------------------------------------------------------------- calls and control

    def _bases(self, pou: Pou, instance: n.Place | None) -> list[str]:
        if instance is None:
            return []
        addresses = self.expressions.addresses
        return [addresses.subscript(instance, array).code for array in base_arrays(self.expressions.layout, pou)]

    def _own_bases(self) -> list[str]:
        return base_parameters(self.expressions.layout, self.expressions.pou)

    def _note(self, site: n.Site) -> str:
        return f"v[{self.expressions.names.name(('site',), SITE)}] = {self.sites.number(site)}"

    def _tick(self, site: n.Site) -> None:
        loop = self.expressions.names.name(("loop",), LOOP)
        self._write(f"v[{loop}] -= 1")
        self._write(f"if v[{loop}] == 0:")
        self._write(f"    {self._note(site)}")
        self._write(f"    {self.expressions.need('faults', 'loop_check')}(V)")

    def _try(self, body: n.Block) -> None:
        """What a fault has passed through is forgotten: its object would grow at each of them."""
        self._write("try:")
        self._inner(body)
        self._write(f"except {self.expressions.need('faults', 'Catchable')}:")
        self._write(f"    {self.expressions.need('faults', 'forget_tracebacks')}()")

    def _if(self, statement: n.If) -> None:
        condition, then, otherwise = statement.condition, statement.then, statement.otherwise
        if not _has_code(then) and _has_code(otherwise):
            condition, then, otherwise = n.Not(condition, ty.BOOL), otherwise, ()
        self._write(f"if {self.expressions.condition(condition).code}:")
        self._inner(then)
        while len(chained := _code(otherwise)) == 1 and isinstance(chained[0], n.If) and _has_code(chained[0].then):
            for line in otherwise[: otherwise.index(chained[0])]:
                self._statement(line)
            self._write(f"elif {self.expressions.condition(chained[0].condition).code}:")
            self._inner(chained[0].then)
            otherwise = chained[0].otherwise
        if _has_code(otherwise):
            self._write("else:")
            self._inner(otherwise)


def base_arrays(layout: Layout, pou: Pou) -> list[str]:
    """The arrays in which a shared body takes a base: those in which an instance has a part. A function has no
    instance, and a body with only one instance knows where that is."""
    if pou.kind is PouKind.FUNCTION or layout.single_base(pou) is not None:
        return []
    size = layout.instance_record(pou).size
    return [array for array in ("V", "O") if size.of(array)]


def base_parameters(layout: Layout, pou: Pou) -> list[str]:
    """The names of the bases in the functions of a body."""
    return [{"V": "b", "O": "p"}[array] for array in base_arrays(layout, pou)]


def part_name(functions: dict[Pou, str], pou: Pou, number: int) -> str:
    """The function with a part of a large body."""
    return f"{functions[pou]}__{number}"


def literal(value: object, target: Target, names: SlotNames) -> str:
    """A stored value as Python text."""
    if isinstance(value, str):
        return quoted(value)
    if isinstance(value, float):
        return real_text(value, target, names).code
    return str(value)


def literals(values: list[object], target: Target, names: SlotNames) -> str:
    """Stored values as a tuple."""
    return f"({', '.join(literal(value, target, names) for value in values)},)"


def _moved(subscript: Text, by: int) -> Text:
    return infix(subscript, "+", number(by)) if by else subscript


def _code(block: n.Block) -> list[n.Stmt]:
    return [s for s in block if not isinstance(s, n.Line)]


def _has_code(block: n.Block) -> bool:
    return any(not isinstance(s, n.Line) for s in block)
