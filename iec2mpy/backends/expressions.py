"""Expressions of the IR as text of Python, in either form."""

from __future__ import annotations

from dataclasses import dataclass, field

from iec2mpy.backends import forms
from iec2mpy.backends.addresses import Addresses
from iec2mpy.backends.forms import Binding, Text, call, infix, number
from iec2mpy.backends.layout import NOW, Layout
from iec2mpy.backends.names import SlotNames
from iec2mpy.backends.reals import real_text
from iec2mpy.backends.target import Target
from iec2mpy.ir import nodes as n
from iec2mpy.ir.bounds import bounds
from iec2mpy.ir.intrinsics import INTRINSICS
from iec2mpy.ir.walk import may_fault
from iec2mpy.semantics import types as ty
from iec2mpy.semantics.typed import Pou

_WIDE_HELPERS = {
    **{"div": "quotient", "mod": "remainder"},
    **{"shl": "shl64", "shr": "shr64", "rol": "rol64", "ror": "ror64"},
}
HELPERS = {"f32", "boxed", "wrap64", "mask64", "now_ns", *_WIDE_HELPERS.values()}
"""Functions of the runtime that stand for no intrinsic."""
_SYMBOLS = {"add": "+", "sub": "-", "mul": "*", "and": "&", "or": "|", "xor": "^"}
_HIGHEST = (1 << 31) - 1
"""Of a machine word of 32 bits; of its lowest number there is no negative."""
_VIPER_LITERAL = 1 << 30
"""A literal of this size and beyond is an object to a 32-bit viper. -2^30 would fit, but is read as the negative of one
that does not."""


@dataclass(slots=True)
class ExpressionWriter:
    """Writes the expressions of one body; notes which functions of the runtime they need."""

    target: Target
    layout: Layout
    names: SlotNames
    pou: Pou
    runtime: dict[str, set[str]]
    """Functions used so far, by module of `mcu_runtime`."""
    addresses: Addresses = field(init=False)
    uses_objects: bool = False

    def __post_init__(self) -> None:
        self.addresses = Addresses(self.layout, self.names, self.pou, self.value)

    @property
    def viper(self) -> bool:
        return self.target.form == "viper"

    def need(self, module: str, function: str) -> str:
        """Notes that a function of the runtime is used; gives its name."""
        self.runtime.setdefault(module, set()).add(function)
        return function

    # ---------------------------------------------------------------------------------- conditions

    def condition(self, expr: n.Expr, negate: bool = False) -> Text:
        """A BOOL where only its truth counts. `and` and `or` may leave out the right side: not where that may fault."""
        match expr:
            case n.Not(operand, ty.BOOL):
                return self.condition(operand, not negate)
            case n.Const():
                # viper takes no True in `while`, and MicroPython optimises `while 1`
                return number(int(bool(expr.value) != negate))
            case n.Op(name, left, right) if name in n.COMPARISONS and not (negate and _is_real(left)):
                return self._comparison(_NEGATED[name] if negate else name, left, right)
            case n.Op(name, left, right) if name in n.COMPARISONS:
                # with a NaN, neither a < b nor a >= b holds
                return Text(f"not {self._comparison(name, left, right).at(Binding.COMPARE)}", Binding.NOT)
            case n.Op("and" | "or" as name, left, right) if expr.type is ty.BOOL and not may_fault(right):
                operator = name if not negate else {"and": "or", "or": "and"}[name]
                return infix(self.condition(left, negate), operator, self.condition(right, negate))
            case _:
                text = self.value(expr)
                return Text(f"not {text.at(Binding.NOT)}", Binding.NOT) if negate else text

    # -------------------------------------------------------------------------------------- values

    def value(self, expr: n.Expr) -> Text:
        """The value: a machine word for what lives in V, an object for what lives in O."""
        match expr:
            case n.Const(value):
                return self._constant(value, expr.type)
            case n.Local(local, value_type):
                return Text(f"{'x' if value_type.in_objects else 't'}{local}")
            case n.Load(place, value_type):
                return self._load(place, value_type)
            case n.Ref(place):
                return self.addresses.reference(place)
            case n.Now(value_type):
                return self._now(value_type)
            case n.Op(name, left, right, value_type):
                return self._operation(name, left, right, value_type)
            case n.Not(operand, value_type):
                return self._complement(operand, value_type)
            case n.Wrap(operand, value_type):
                assert isinstance(value_type, ty.ElementaryType)
                return self._wrapped(operand, value_type)
            case n.ToReal(operand, value_type):
                return self._to_real(operand, value_type)
            case n.Select(condition, then, otherwise):
                chosen = f"{self.value(then).at(Binding.OR)} if {self.condition(condition).at(Binding.OR)}"
                return Text(f"{chosen} else {self.value(otherwise).at(Binding.SELECT)}", Binding.SELECT)
            case n.Intrinsic(name, arguments, value_type):
                return self._intrinsic(name, arguments, value_type)

    def _constant(self, value: object, value_type: n.ValueType) -> Text:
        if isinstance(value_type, ty.StringType):
            return Text(quoted(str(value)))
        if isinstance(value_type, ty.ElementaryType) and value_type.is_real:
            assert isinstance(value, (int, float))
            return real_text(float(value), self.target, self.names)
        assert isinstance(value, int) and isinstance(value_type, ty.ElementaryType)
        if value_type.in_objects and self.viper:
            self.uses_objects = True
            slot, digits = self.layout.object_constant(value), f"{value & 0xFFFFFFFFFFFFFFFF:016X}"
            return Text(f"o[{self.names.name(('const', digits), slot, str(value))}]")
        if forms.held_as_pattern(self.target, value_type):
            value = forms.pattern(value)
        if self.target.word == 32 and not -_VIPER_LITERAL < value < _VIPER_LITERAL:
            slot = self.layout.constant(value)
            return Text(f"v[{self.names.name(('const', f'{value & 0xFFFFFFFF:08X}'), slot, str(value))}]")
        return number(value)

    def _now(self, value_type: n.ValueType) -> Text:
        assert isinstance(value_type, ty.ElementaryType)
        if value_type.in_objects:
            return call(self.need("slots", "now_ns"), Text("V"))
        return forms.load(self.target, Text(f"v[{self.names.name(('now',), NOW)}]"), value_type, value_type.low)

    def _load(self, place: n.Place, value_type: n.ValueType) -> Text:
        if value_type.in_objects:
            self.uses_objects = True
            return Text(f"o[{self.addresses.subscript(place, 'O').code}]")
        assert isinstance(value_type, ty.ElementaryType)
        low, _ = ty.value_range(place.type) or (value_type.low, value_type.high)
        return forms.load(self.target, Text(f"v[{self.addresses.subscript(place, 'V').code}]"), value_type, low)

    def _comparison(self, name: str, left: n.Expr, right: n.Expr) -> Text:
        texts = [self.value(left), self.value(right)]
        if name not in ("eq", "ne") and any(self._may_be_pattern(operand) for operand in (left, right)):
            texts = [call("uint", text) for text in texts]
        return infix(texts[0], n.COMPARISONS[name], texts[1])

    def _may_be_pattern(self, operand: n.Expr) -> bool:
        """Whether the value may be held as a negative number that means one from 2^31 on."""
        return (
            isinstance(operand.type, ty.ElementaryType)
            and forms.held_as_pattern(self.target, operand.type)
            and bounds(operand)[1] >= 1 << 31
        )

    def _operation(self, name: str, left: n.Expr, right: n.Expr, value_type: n.ValueType) -> Text:
        if name in n.COMPARISONS:
            compared = self._comparison(name, left, right)
            # to viper a comparison is a bool, which takes part in no operation
            return call("int", compared) if self.viper else compared
        assert isinstance(value_type, ty.ElementaryType)
        if value_type.is_real:
            result = infix(self.value(left), "/" if name == "div" else _SYMBOLS[name], self.value(right))
            return self._rounded(result, value_type)
        match name:
            case _ if value_type.in_objects and name in _WIDE_HELPERS:
                helper = self.need("arithmetic", _WIDE_HELPERS[name])
                return call(helper, self.boxing(left), self.boxing(right))
            case "div" | "mod":
                return self._division(name, left, right)
            case "shl":
                return infix(self.value(left), "<<", self.value(right))
            case "shr":
                return self._shifted_right(self.value(left), self.value(right), value_type)
            case "rol" | "ror":
                return self._rotated(name, left, right, value_type)
            case _:
                return infix(self.value(left), _SYMBOLS[name], self.value(right))

    def _shifted_right(self, value: Text, count: Text, value_type: ty.ElementaryType) -> Text:
        shifted = infix(forms.unsigned(self.target, value, value_type), ">>", count)
        return call("int", shifted) if forms.held_as_pattern(self.target, value_type) else shifted

    def _rotated(self, name: str, left: n.Expr, right: n.Expr, value_type: ty.ElementaryType) -> Text:
        """The count is from 1 to the width less 1."""
        value, count = self.value(left), self.value(right)
        rest = infix(number(value_type.bits), "-", count)
        up, down = (count, rest) if name == "rol" else (rest, count)
        high = forms.wrap(self.target, infix(value, "<<", up), value_type)
        return infix(high, "|", self._shifted_right(value, down, value_type))

    def _division(self, name: str, left: n.Expr, right: n.Expr) -> Text:
        """Python's `//` and `%` round down, the standard's `/` and MOD towards zero (table 29); the divisor is not 0.

        Before it is divided, a dividend of the other sign is moved towards the next multiple: (a + b - 1) // b for a
        negative a and a positive b. No intermediate value leaves the machine word. The one quotient that does, of the
        lowest number by -1, is not left to the processor: it wraps on some, and ends the program on others.
        """
        (low, _), (divisor_low, divisor_high) = bounds(left), bounds(right)
        a, b = self.value(left), self.value(right)
        if low >= 0 and divisor_low >= 0:
            return infix(a, "//" if name == "div" else "%", b)
        negated = infix(number(0), "-", a)
        if divisor_low == divisor_high and abs(divisor_low) == 1:
            return number(0) if name == "mod" else a if divisor_low == 1 else negated
        if divisor_low >= 0:
            moved = self._below(a, right)
        elif divisor_high <= 0:
            moved = self._above(a, right)
        else:
            moved = _choice(self._below(a, right), infix(b, ">", number(0)), self._above(a, right))
        quotient = infix(infix(a, "+", moved), "//", b)
        if self.target.word == 32 and low < -_HIGHEST and divisor_low <= -1 <= divisor_high:
            quotient = _choice(negated, infix(b, "==", number(-1)), quotient)
        return quotient if name == "div" else infix(a, "-", infix(quotient, "*", b))

    def _below(self, dividend: Text, divisor: n.Expr) -> Text:
        """What is added to a dividend for a positive divisor."""
        return _choice(self._next_to(divisor, -1), infix(dividend, "<", number(0)), number(0))

    def _above(self, dividend: Text, divisor: n.Expr) -> Text:
        """What is added to a dividend for a negative divisor."""
        return _choice(self._next_to(divisor, 1), infix(dividend, ">", number(0)), number(0))

    def _next_to(self, value: n.Expr, by: int) -> Text:
        if isinstance(value, n.Const):
            return self._constant(value.number + by, value.type)
        return infix(self.value(value), "+", number(by))

    def _complement(self, operand: n.Expr, value_type: n.ValueType) -> Text:
        assert isinstance(value_type, ty.ElementaryType)
        if value_type is ty.BOOL:
            if isinstance(operand, n.Op) and operand.name in n.COMPARISONS and not _is_real(operand.left):
                return self._operation(_NEGATED[operand.name], operand.left, operand.right, ty.BOOL)
            return infix(self.value(operand), "^", number(1))
        if value_type.in_objects:
            return infix(self.value(operand), "^", self._constant(value_type.high, value_type))
        ones = -1 if forms.held_as_pattern(self.target, value_type) else value_type.high
        return infix(self.value(operand), "^", number(ones))

    def _wrapped(self, operand: n.Expr, to: ty.ElementaryType) -> Text:
        """The operand modulo 2^bits, as a machine word or an object, whatever it is itself."""
        if not to.in_objects:
            text = self.value(operand)
            if operand.type.in_objects and self.viper:
                text = call("int", text)  # the low bits of any integer
            return forms.wrap(self.target, text, to)
        if self._is_widened(operand, to):
            text = self.boxing(operand)
            return call(self.need("arithmetic", "boxed"), text) if self.viper else text
        return call(self.need("arithmetic", "wrap64" if to.low else "mask64"), self.boxing(operand))

    def _is_widened(self, operand: n.Expr, to: n.ValueType) -> bool:
        """Whether a value of V, which the type in O has, only becomes an object."""
        if not to.in_objects or operand.type.in_objects:
            return False
        assert isinstance(to, ty.ElementaryType)
        low, high = bounds(operand)
        return to.low <= low and high <= to.high

    def boxing(self, expr: n.Expr) -> Text:
        """The value, for what makes an object of it anyway: an argument of a function of Python, an element of O."""
        match expr:
            case n.Const(int() as constant) if self.target.word != 32 or constant != -_VIPER_LITERAL:
                return number(constant)
            case n.Wrap(operand) if self._is_widened(operand, expr.type):
                return self.boxing(operand)
        text = self.value(expr)
        if expr.type is ty.BOOL and not self.viper:
            return call("int", text)  # Python's True is no number in a list or in a text
        if isinstance(expr.type, ty.ElementaryType) and not expr.type.in_objects:
            return forms.unsigned(self.target, text, expr.type)
        return text

    def _to_real(self, operand: n.Expr, to: n.ValueType) -> Text:
        assert isinstance(operand.type, ty.ElementaryType)
        if operand.type.is_real:
            return self.value(operand)  # a REAL: each is an LREAL, too
        value = call("float", self.boxing(operand))
        if not operand.type.in_objects:
            low, high = bounds(operand)
            if low >= -(1 << 24) and high <= 1 << 24:
                return value  # integers of up to 24 bits are exact in single precision
        return self._rounded(value, to)

    def _intrinsic(self, name: str, arguments: tuple[n.Expr, ...], value_type: n.ValueType) -> Text:
        runtime = INTRINSICS[name]
        if runtime.module is not None:
            self.need(runtime.module, runtime.function)
        result = call(runtime.function, *(self.boxing(argument) for argument in arguments))
        if runtime.rounds:
            return self._rounded(result, value_type)
        return call("int", result) if self.viper and not value_type.in_objects else result

    def _rounded(self, value: Text, of: n.ValueType) -> Text:
        """A REAL result in single precision, where the host computes in double; an LREAL as it is."""
        return value if self.target.single or of is ty.LREAL else call(self.need("arithmetic", "f32"), value)


_NEGATED = {"eq": "ne", "ne": "eq", "lt": "ge", "ge": "lt", "gt": "le", "le": "gt"}


def _is_real(expr: n.Expr) -> bool:
    return isinstance(expr.type, ty.ElementaryType) and expr.type.is_real


def _choice(then: Text, condition: Text, otherwise: Text) -> Text:
    return Text(f"{then.at(Binding.OR)} if {condition.code} else {otherwise.code}", Binding.SELECT)


def quoted(text: str) -> str:
    """A string literal that Python and MicroPython read alike."""
    characters = []
    for character in text:
        if character in '"\\':
            characters.append("\\" + character)
        elif " " <= character <= "~":
            characters.append(character)
        else:
            code = ord(character)
            characters.append(
                f"\\x{code:02x}" if code < 0x100 else f"\\u{code:04x}" if code < 0x10000 else f"\\U{code:08x}"
            )
    return '"' + "".join(characters) + '"'
