"""What each rule of `st.lark` makes: one function a rule (or alias), from the values of its symbols to a tree node.

A value is a token, a node, a list, or None. An action gets `diagnostics` for what the grammar takes and the language,
or this compiler, does not.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from iec2mpy.source.diagnostics import Diagnostics
from iec2mpy.source.dialects import require
from iec2mpy.source.spans import Span
from iec2mpy.syntax import tree
from iec2mpy.syntax.tokens import Token

Action = Callable[[list[Any], Diagnostics], Any]

ACTIONS: dict[str, Action] = {}
"""Each action by the name that it has in the grammar."""


def action(function: Action) -> Action:
    """Enter a function into `ACTIONS`, by its name."""
    ACTIONS[function.__name__] = function
    return function


def over(first: Any, last: Any) -> Span:
    """The span from one value's start to another's end."""
    start = first.span
    return Span(start.file, start.start, last.span.end)


def name_of(token: Token) -> tree.Name:
    return tree.Name(token.text, token.span)


def not_supported(code: str, what: str, span: Span, diagnostics: Diagnostics) -> None:
    diagnostics.add(code, f"{what} not supported yet.", span)


# --------------------------------------------------------------------------------------------------- lists


@action
def empty_list(_values: list[Any], _diagnostics: Diagnostics) -> list[Any]:
    return []


@action
def one(values: list[Any], _diagnostics: Diagnostics) -> list[Any]:
    return [] if values[0] is None else values


@action
def more(values: list[Any], _diagnostics: Diagnostics) -> list[Any]:
    """A list and a further item; what could not be read is None and is left out."""
    items, item = values
    if item is not None:
        items.append(item)
    return items


@action
def separated(values: list[Any], _diagnostics: Diagnostics) -> list[Any]:
    """A list, a comma and a further item."""
    items, _, item = values
    if item is not None:
        items.append(item)
    return items


@action
def none(_values: list[Any], _diagnostics: Diagnostics) -> None:
    return None


@action
def nothing(_values: list[Any], _diagnostics: Diagnostics) -> None:
    return None


@action
def second(values: list[Any], _diagnostics: Diagnostics) -> Any:
    """What stands behind a word or sign: `BY step`, `:= value`."""
    return values[1]


# --------------------------------------------------------------------------------------------- expressions

_OPERATORS = {
    "OR": "OR", "XOR": "XOR", "AND": "AND", "EQ": "=", "NE": "<>", "LT": "<", "GT": ">", "LE": "<=", "GE": ">=",
    "PLUS": "+", "MINUS": "-", "TIMES": "*", "DIVIDE": "/", "MOD": "MOD", "POWER": "**", "NOT": "NOT",
}  # fmt: skip


@action
def binary(values: list[Any], _diagnostics: Diagnostics) -> tree.BinaryExpr:
    left, operator, right = values
    return tree.BinaryExpr(_OPERATORS[operator.type], left, right, operator.span, over(left, right))


@action
def short_circuit(values: list[Any], diagnostics: Diagnostics) -> tree.BinaryExpr:
    """AND_THEN, OR_ELSE: in the standard it is open whether both sides are evaluated (7.3.2)."""
    left, operator, right = values
    word = operator.text.upper()
    instead = f"Write {word.partition('_')[0]}: both sides are evaluated then."
    message = f"`{operator.text}` is not an operator of the standard."
    require("short-circuit", diagnostics, "E0129", message, operator.span, instead)
    return tree.BinaryExpr(word, left, right, operator.span, over(left, right))


@action
def unary_operation(values: list[Any], _diagnostics: Diagnostics) -> tree.UnaryExpr:
    operator, operand = values
    return tree.UnaryExpr(_OPERATORS[operator.type], operand, over(operator, operand))


@action
def negation(values: list[Any], diagnostics: Diagnostics) -> tree.Expr:
    """`NOT (a)` is the operator; `NOT(IN := a)` the function, which has one input (table 31)."""
    operator, opening, arguments, closing = values
    span = over(operator, closing)
    if len(arguments) != 1:
        diagnostics.add(
            "E0126",
            f"NOT takes one value, here it has {len(arguments)}.",
            span,
            "Write NOT before each value, such as `NOT a AND NOT b`.",
        )
        return tree.Literal("bool", False, None, span)
    if arguments[0].name is None:
        return tree.UnaryExpr("NOT", replace(arguments[0].value, span=over(opening, closing)), span)
    return tree.CallExpr(tree.NameExpr(operator.text, operator.span), tuple(arguments), span)


@action
def parenthesised(values: list[Any], _diagnostics: Diagnostics) -> tree.Expr:
    opening, expression, closing = values
    return replace(expression, span=over(opening, closing))


@action
def literal(values: list[Any], _diagnostics: Diagnostics) -> tree.Literal:
    return values[0].value


@action
def enumerated_value(values: list[Any], _diagnostics: Diagnostics) -> tree.TypedEnumValue:
    token = values[0]
    type_name, _, value = token.text.partition("#")
    middle = token.start + len(type_name)
    return tree.TypedEnumValue(
        tree.Name(type_name, Span(token.file, token.start, middle)),
        tree.Name(value, Span(token.file, middle + 1, token.end)),
        token.span,
    )


@action
def error_operand(values: list[Any], _diagnostics: Diagnostics) -> tree.Literal:
    """In place of an operand that could not be read; the error is reported, and no program is made of the tree."""
    return tree.Literal("int", 0, None, values[0].span)


@action
def null(values: list[Any], _diagnostics: Diagnostics) -> tree.Literal:
    return tree.Literal("null", 0, None, values[0].span)


@action
def name(values: list[Any], _diagnostics: Diagnostics) -> tree.NameExpr:
    token = values[0]
    return tree.NameExpr(token.text, token.span)


@action
def object_word(values: list[Any], diagnostics: Diagnostics) -> tree.NameExpr:
    token = values[0]
    not_supported("E0904", f"Classes and methods (`{token.text}`) are", token.span, diagnostics)
    return tree.NameExpr(token.text, token.span)


@action
def direct(values: list[Any], _diagnostics: Diagnostics) -> tree.DirectVariable:
    token = values[0]
    if token.bad:
        return tree.DirectVariable("M", "X", (0,), token.span)
    letters = token.text[1:3].upper()
    size = letters[1] if not letters[1].isdigit() else "X"
    numbers = token.text[1:].lstrip("IQMXBWDLiqmxbwdl")
    return tree.DirectVariable(letters[0], size, tuple(map(int, numbers.split("."))), token.span)


@action
def partial_direct(values: list[Any], diagnostics: Diagnostics) -> None:
    not_supported("E0908", f"Addresses that are given later (`{values[0].text}`) are", values[0].span, diagnostics)


@action
def relative_address(values: list[Any], diagnostics: Diagnostics) -> tree.RelativeAddress | None:
    """`%B0`, `%X3.7` (6.4.4.7.1): an offset in bytes, and for a bit its number in the byte."""
    token = values[0]
    byte, dot, bit = token.text[1:].upper().lstrip("XBWDL").partition(".")
    if bool(dot) != (not token.text[1].isalpha() or token.text[1] in "Xx"):
        message = f"`{token.text}` is no place in a structure."
        diagnostics.add("E0111", message, token.span, "Such as %B2 for a byte, %X2.7 for a bit of it.")
        return None
    return tree.RelativeAddress(int(byte), int(bit or 0), token.span)


@action
def member(values: list[Any], _diagnostics: Diagnostics) -> tree.MemberExpr:
    base, _, token = values
    return tree.MemberExpr(base, name_of(token), over(base, token))


@action
def part(values: list[Any], diagnostics: Diagnostics) -> tree.PartExpr:
    """`base.3`, `base.%X3`, `base.%W1` (6.5.5.3, table 17)."""
    base, _, token = values
    if "." in token.text:
        diagnostics.add(
            "E0111",
            f"`{token.text}` is no bit, byte or word of a variable.",
            token.span,
            "Such as `x.%X3`, `x.%B1`, `x.3`.",
        )
        return tree.PartExpr(base, "X", 0, over(base, token))
    if token.type == "INTEGER":
        return tree.PartExpr(base, "X", token.value.value, over(base, token))
    text = token.text[1:].upper()
    size = text[0] if text[0].isalpha() else "X"
    return tree.PartExpr(base, size, int(text.lstrip("XBWDL")), over(base, token))


@action
def index(values: list[Any], _diagnostics: Diagnostics) -> tree.IndexExpr:
    base, _, indices, closing = values
    return tree.IndexExpr(base, tuple(indices), over(base, closing))


@action
def call(values: list[Any], _diagnostics: Diagnostics) -> tree.CallExpr:
    callee, _, arguments, closing = values
    return tree.CallExpr(callee, tuple(arguments), over(callee, closing))


@action
def dereference(values: list[Any], _diagnostics: Diagnostics) -> tree.DerefExpr:
    base, caret = values
    return tree.DerefExpr(base, over(base, caret))


@action
def reference(values: list[Any], _diagnostics: Diagnostics) -> tree.RefExpr:
    word, _, operand, closing = values
    return tree.RefExpr(operand, over(word, closing))


@action
def positional_argument(values: list[Any], _diagnostics: Diagnostics) -> tree.Argument:
    return tree.Argument(None, values[0], False, False, values[0].span)


@action
def input_argument(values: list[Any], _diagnostics: Diagnostics) -> tree.Argument:
    """`name := value`, or `name :=` with nothing behind it (6.6.1.4.2: it is as if the parameter were not given)."""
    value = values[2] if len(values) == 3 else None
    return tree.Argument(name_of(values[0]), value, False, False, over(values[0], values[-1]))


@action
def output_argument(values: list[Any], _diagnostics: Diagnostics) -> tree.Argument:
    value = values[2] if len(values) == 3 else None
    return tree.Argument(name_of(values[0]), value, True, False, over(values[0], values[-1]))


@action
def negated_output(values: list[Any], _diagnostics: Diagnostics) -> tree.Argument:
    word, token, _, value = values
    return tree.Argument(name_of(token), value, True, True, over(word, value))
