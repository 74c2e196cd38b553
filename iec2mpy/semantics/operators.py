"""Operators: which types they take, what they give, and the folding of constants (tables 29 to 33, 35, 71)."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from iec2mpy.semantics import arithmetic, loose
from iec2mpy.semantics.arithmetic import COMPARISONS, ArithmeticFault
from iec2mpy.semantics.calendar import DURATION
from iec2mpy.semantics.coercion import coerce, convert, describe, fits_literal, is_number, typed_literal
from iec2mpy.semantics.conversions import (
    BIT_KINDS,
    INTEGER_KINDS,
    NUMBER_KINDS,
    UNTYPED_INT,
    UNTYPED_REAL,
    common_type,
    conversion_name,
    converts_implicitly,
    is_untyped,
    joined_type,
)
from iec2mpy.semantics.scope import Scope
from iec2mpy.semantics.typed import Binary, Constant, Convert, Expr, Scalar, Unary
from iec2mpy.semantics.types import (
    BOOL,
    LREAL,
    MOMENTS,
    REAL,
    BlockType,
    ElementaryType,
    EnumType,
    Kind,
    StringType,
    Type,
    base_type,
    value_type,
)
from iec2mpy.source.dialects import with_dialects
from iec2mpy.source.spans import Span

_ALL_KINDS = frozenset(Kind)
_DURATION = frozenset((Kind.DURATION,))
_TAKES: Mapping[str, frozenset[Kind]] = {
    "+": NUMBER_KINDS | {Kind.DURATION},
    "-": NUMBER_KINDS | {Kind.DURATION},
    "*": NUMBER_KINDS,
    "/": NUMBER_KINDS,
    "MOD": INTEGER_KINDS,
    "**": frozenset((Kind.REAL,)),
    "AND": BIT_KINDS,
    "OR": BIT_KINDS,
    "XOR": BIT_KINDS,
    **dict.fromkeys(COMPARISONS, _ALL_KINDS),
}
_NEEDS = {
    "+": "numbers or durations",
    "-": "numbers or durations",
    "*": "numbers",
    "/": "numbers",
    "MOD": "integers",
    "**": "REAL or LREAL numbers",
    "AND": "BOOL or bit strings",
    "OR": "BOOL or bit strings",
    "XOR": "BOOL or bit strings",
}


SHORT_CIRCUIT = ("AND_THEN", "OR_ELSE")
"""Operators that dialects have."""


def binary(scope: Scope, operator: str, left: Expr, right: Expr, operator_span: Span, span: Span) -> Expr | None:
    """`left operator right`, with both operands brought to their common type; None after a diagnostic."""
    if operator in SHORT_CIRCUIT:
        return _short_circuit(scope, operator, left, right, span)
    if isinstance(left, Constant) and isinstance(right, Constant) and is_untyped(left.type) and is_untyped(right.type):
        return _untyped(scope, operator, left, right, span)
    if operator in ("*", "/") and _is_kind(left.type, _DURATION) and is_number(right.type):
        number = typed_literal(scope, right)
        return number and _node(scope, operator, left, number, base_type(left.type), span)
    if operator == "**":
        return _power(scope, left, right, operator_span, span)
    if operator in ("+", "-") and _is_kind(left.type, MOMENTS):
        return _of_moment(scope, operator, left, right, operator_span, span)
    pair = _paired(scope, operator, _operand(operator, left), _operand(operator, right), operator_span, span)
    if pair is None:
        return None
    left, right = pair
    return _node(scope, operator, left, right, BOOL if operator in COMPARISONS else base_type(left.type), span)


def _short_circuit(scope: Scope, operator: str, left: Expr, right: Expr, span: Span) -> Expr | None:
    """The right side is evaluated only where the left one does not decide."""
    sides = [coerce(scope, side, BOOL, "E0302", f"`{operator}` needs BOOL") for side in (left, right)]
    first, second = sides
    if first is None or second is None:
        return None
    if isinstance(first, Constant):
        return second if bool(first.value) == (operator == "AND_THEN") else first
    return Binary(operator, first, second, BOOL, span)


def _node(scope: Scope, operator: str, left: Expr, right: Expr, t: Type, span: Span) -> Expr | None:
    left_type, right_type = value_type(left.type), value_type(right.type)
    if operator == "/" and isinstance(right, Constant) and right.value == 0:
        scope.diagnostics.add("E0503", "This divides by zero.", right.span)
        return None
    if isinstance(left, Constant) and isinstance(right, Constant) and left_type and right_type:
        return folded(
            scope, lambda: arithmetic.binary(operator, left.value, right.value, left_type, right_type), t, span
        )
    return Binary(operator, left, right, t, span)


def folded(scope: Scope, compute: Callable[[], Scalar], t: Type, span: Span) -> Expr | None:
    """The constant that `compute` gives; a diagnostic where it would stop the controller."""
    try:
        return Constant(compute(), t, span)
    except ArithmeticFault as fault:
        if fault.kind == "zero":
            scope.diagnostics.add("E0503", "This divides by zero.", span)
        else:
            scope.diagnostics.add("E0508", f"This has no value of type {t}: the operation would fail each time.", span)
        return None


# ---------------------------------------------------------------------------------------- pairs of operands


def _paired(
    scope: Scope, operator: str, left: Expr, right: Expr, operator_span: Span, span: Span
) -> tuple[Expr, Expr] | None:
    """Both operands in one type that the operator takes."""
    for operand in (left, right):
        if not _takes(operator, operand):
            _wrong_operand(scope, operator, operand)
            return None
    if is_untyped(left.type):
        return _with_literal(scope, operator, left, right, operator_span, literal_left=True)
    if is_untyped(right.type):
        return _with_literal(scope, operator, left, right, operator_span, literal_left=False)
    return _typed_pair(scope, operator, left, right, operator_span)


def _operand(operator: str, value: Expr) -> Expr:
    """Where the dialect makes no difference between them, a bit string as a number, or a number as a bit string."""
    return loose.as_bits(value) if operator in ("AND", "OR", "XOR") else loose.as_number(value)


def _takes(operator: str, operand: Expr) -> bool:
    t = base_type(operand.type)
    if isinstance(t, ElementaryType):
        # an untyped integer may turn out to be a bit string, when its partner is one
        return t.kind in _TAKES[operator] or (t is UNTYPED_INT and operator in ("AND", "OR", "XOR"))
    if operator not in COMPARISONS:
        return False
    # strings are compared in every way, all else only for equality (6.6.2.5.13, 7.3.3.2)
    return isinstance(t, StringType) or (operator in ("=", "<>") and not isinstance(t, BlockType))


def _with_literal(
    scope: Scope, operator: str, left: Expr, right: Expr, operator_span: Span, literal_left: bool
) -> tuple[Expr, Expr] | None:
    """One operand is an untyped literal: it takes the type of the other, or its own where it is too large for that."""
    literal, other = (left, right) if literal_left else (right, left)
    assert isinstance(literal, Constant)
    if fits_literal(literal, other.type):
        value = coerce(scope, literal, base_type(other.type))
    else:
        if _is_kind(other.type, BIT_KINDS) and literal.type is UNTYPED_INT:
            coerce_failed = f"{literal.value} is no {other.type}."
            scope.diagnostics.add("E0303", coerce_failed, literal.span)
            return None
        if not _is_kind(other.type, NUMBER_KINDS):
            _different(scope, operator, left, right, operator_span)
            return None
        value = typed_literal(scope, literal)
        if value is not None:
            pair = (value, other) if literal_left else (other, value)
            return _typed_pair(scope, operator, *pair, operator_span)
    if value is None:
        return None
    return (value, other) if literal_left else (other, value)


def _is_kind(t: Type, kinds: frozenset[Kind]) -> bool:
    t = base_type(t)
    return isinstance(t, ElementaryType) and t.kind in kinds


def _typed_pair(scope: Scope, operator: str, left: Expr, right: Expr, operator_span: Span) -> tuple[Expr, Expr] | None:
    a, b = base_type(left.type), base_type(right.type)
    if (pair := _characters(left, right)) is not None:
        return pair
    common = joined_type(a, b)
    if common is not None:
        return convert(left, common), convert(right, common)
    if (t := loose.joined(left, right)) is not None:
        return loose.loosely(left, t), loose.loosely(right, t)
    _different(scope, operator, left, right, operator_span)
    return None


def _characters(left: Expr, right: Expr) -> tuple[Expr, Expr] | None:
    """A character and a constant string of one: compared as characters, which gives the same and makes no string."""
    for one, other in ((left, right), (right, left)):
        t, character = base_type(one.type), base_type(other.type)
        if isinstance(one, Constant) and isinstance(t, StringType) and character is t.character:
            text = str(one.value)
            if len(text) == 1:
                code = Constant(ord(text), character, one.span)
                return (code, other) if one is left else (other, code)
    return None


def _wrong_operand(scope: Scope, operator: str, operand: Expr) -> None:
    if operator in COMPARISONS:
        message = f"{describe(operand.type)} has no `{operator}`."
        hint = (
            "Values of an enumeration are compared with = and <> only."
            if isinstance(base_type(operand.type), EnumType)
            else None
        )
    else:
        message = f"`{operator}` needs {_NEEDS[operator]}, but this is {describe(operand.type)}."
        hint = _operand_hint(operator, operand)
    scope.diagnostics.add("E0302", message, operand.span, hint)


def _operand_hint(operator: str, operand: Expr) -> str | None:
    t = base_type(operand.type)
    if isinstance(t, StringType) and operator == "+":
        return "CONCAT(a, b) joins strings."
    if isinstance(t, EnumType):
        return "Values of an enumeration cannot be calculated with."
    if _is_kind(t, frozenset((Kind.BITS,))) and operator in ("+", "-", "*", "/", "MOD"):
        number = loose.of_kind(t, Kind.UNSIGNED)
        return with_dialects("bits-are-numbers", f"Convert it with {t}_TO_{number}.")
    if _is_kind(t, MOMENTS) and operator in ("+", "-"):
        return "A date or time of day stands first: TOD#12:00:00 + T#1h."
    if operator == "**" and (name := conversion_name(t, REAL)):
        return f"Convert it with {name}."
    if t is BOOL and operator in ("+", "-", "*", "/"):
        return "BOOL values are combined with AND, OR and XOR."
    if _is_kind(t, NUMBER_KINDS) and operator in ("AND", "OR", "XOR"):
        return "Compare the number first, or convert it to a bit string such as WORD."
    return None


def _different(scope: Scope, operator: str, left: Expr, right: Expr, operator_span: Span) -> None:
    a, b = left.type, right.type
    hint = None
    if name := conversion_name(a, b) or conversion_name(b, a):
        hint = f"Convert one of them, for example with {name}."
    if _is_kind(a, _DURATION) or _is_kind(b, _DURATION):
        hint = "A duration goes with durations: write T#5s and its like. It can be multiplied and divided by a number."
    scope.diagnostics.add("E0303", f"`{operator}` cannot join {describe(a)} and {describe(b)}.", operator_span, hint)


# ------------------------------------------------------------------------------------------ special operators


def _of_moment(scope: Scope, operator: str, left: Expr, right: Expr, operator_span: Span, span: Span) -> Expr | None:
    """A date or time of day + or - a duration, or the difference of two (table 35, 2 to 9)."""
    moment, other = _elementary(left), base_type(right.type)
    difference = common_type(moment, other) if operator == "-" and isinstance(other, ElementaryType) else None
    if difference is not None:
        return _node(scope, operator, convert(left, difference), convert(right, difference), DURATION[difference], span)
    if moment.kind is not Kind.DATE and converts_implicitly(other, DURATION[moment]):
        return _node(scope, operator, left, convert(right, DURATION[moment]), moment, span)
    if moment.kind is Kind.DATE and _is_kind(other, _DURATION):
        hint = f"A {moment} is a whole day. Convert it with {moment}_TO_DT, and go on with that."
    elif is_number(other):
        hint = "Write a duration such as T#1h30m, or multiply T#1s by the number."
    else:
        added = "" if moment.kind is Kind.DATE else f"A {DURATION[moment]} can be added and subtracted. "
        hint = f"{added}The difference of two {moment} is a {DURATION[moment]}."
    scope.diagnostics.add("E0303", f"`{operator}` cannot join {moment} and {describe(other)}.", operator_span, hint)
    return None


def _power(scope: Scope, left: Expr, right: Expr, operator_span: Span, span: Span) -> Expr | None:
    """EXPT (table 29, 6): the base is a REAL or LREAL, the exponent any number; it is calculated with in that type."""
    base, exponent = typed_literal(scope, left), typed_literal(scope, right)
    if base is None or exponent is None:
        return None
    t = common_type(_elementary(base), REAL) if _is_kind(base.type, NUMBER_KINDS) else None
    if t is None:
        _wrong_operand(scope, "**", base)
        return None
    if not _is_kind(exponent.type, NUMBER_KINDS):
        scope.diagnostics.add(
            "E0302", f"An exponent must be a number, but this is {describe(exponent.type)}.", exponent.span
        )
        return None
    exponent_type = _elementary(exponent)
    if LREAL in (t, exponent_type):
        t = LREAL
    base = convert(base, t)
    if exponent_type is not t:
        exponent = _to_real(exponent, t)
    return _node(scope, "**", base, exponent, t, span)


def _elementary(value: Expr) -> ElementaryType:
    t = base_type(value.type)
    assert isinstance(t, ElementaryType)
    return t


def _to_real(value: Expr, t: ElementaryType) -> Expr:
    if isinstance(value, Constant):
        return Constant(arithmetic.to_precision(float(value.value), t), t, value.span)
    return Convert(value, t, value.span)


_EXACT: Mapping[str, Callable[..., int | float]] = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
}


def _untyped(scope: Scope, operator: str, left: Constant, right: Constant, span: Span) -> Expr | None:
    """Two untyped literals: calculated exactly, and still untyped, so that `60 * 1000` fits where 60000 does."""
    reals = UNTYPED_REAL in (left.type, right.type)
    a, b = left.value, right.value
    assert not isinstance(a, str) and not isinstance(b, str)
    if operator in COMPARISONS:
        return Constant(int(arithmetic.binary(operator, a, b, REAL, REAL)), BOOL, span)
    if operator == "**":
        return _power(scope, left, right, span, span)
    if operator in ("AND", "OR", "XOR") or (operator == "MOD" and reals):
        if reals:
            _wrong_operand(scope, operator, left if left.type is UNTYPED_REAL else right)
            return None
        value = int(arithmetic.bitwise(operator, int(a), int(b)))
        return Constant(value, UNTYPED_INT, span)
    if operator == "/" and b == 0:
        scope.diagnostics.add("E0503", "This divides by zero.", right.span)
        return None
    if operator in _EXACT:
        value = _EXACT[operator](a, b)
    elif operator == "/":
        value = a / b if reals else arithmetic.truncating_divide(int(a), int(b))
    else:
        value = arithmetic.modulo(int(a), int(b))
    return Constant(value, UNTYPED_REAL if reals else UNTYPED_INT, span)


def unary(scope: Scope, operator: str, operand: Expr, expected: Type | None, span: Span) -> Expr | None:
    """`-`, `+` and `NOT`. `expected` is the type that the place needs: it tells what `NOT 0` means."""
    if operator == "NOT":
        return _complement(scope, loose.as_bits(operand), expected, span)
    operand = loose.as_signed(operand)
    t = base_type(operand.type)
    if not isinstance(t, ElementaryType) or t.kind not in _TAKES["-"]:
        scope.diagnostics.add(
            "E0302",
            f"`{operator}` needs a number or a duration, but this is {describe(operand.type)}.",
            operand.span,
            "NOT negates a BOOL." if t is BOOL else None,
        )
        return None
    if operator == "+":
        return operand
    if isinstance(operand, Constant):
        if is_untyped(t):
            assert not isinstance(operand.value, str)
            return Constant(-operand.value, t, span)
        return folded(scope, lambda: arithmetic.unary("-", operand.value, t), t, span)
    return Unary("-", operand, t, span)


def _complement(scope: Scope, operand: Expr, expected: Type | None, span: Span) -> Expr | None:
    if isinstance(operand, Constant) and operand.type is UNTYPED_INT:
        # 6.6.1.6, example 5: what NOT(0) is depends on its width
        if expected is None or not _is_kind(expected, BIT_KINDS):
            scope.diagnostics.add(
                "E0313",
                "NOT of a number without a type has no clear meaning.",
                span,
                "Write the type: NOT WORD#0, or NOT FALSE.",
            )
            return None
        typed = coerce(scope, operand, expected)
        if typed is None:
            return None
        operand = typed
    t = base_type(operand.type)
    if not isinstance(t, ElementaryType) or t.kind not in BIT_KINDS:
        scope.diagnostics.add(
            "E0302",
            f"NOT needs BOOL or a bit string, but this is {describe(operand.type)}.",
            operand.span,
            "Compare the number first, for example NOT (x = 0)." if is_number(t) else None,
        )
        return None
    if isinstance(operand, Constant):
        return folded(scope, lambda: arithmetic.unary("NOT", operand.value, t), t, span)
    return Unary("NOT", operand, t, span)
