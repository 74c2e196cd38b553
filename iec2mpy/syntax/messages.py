"""What to say about a token that cannot follow, and what would mend it.

Each rule looks at one kind of mistake, and gives a finding where it is that mistake. The order counts: from the special
to the general.
"""

from __future__ import annotations

from collections.abc import Callable

from iec2mpy.source.dialects import with_dialects
from iec2mpy.source.spans import Span
from iec2mpy.syntax.keywords import BLOCK_ENDS, KEYWORDS, OPTIONAL_SEMICOLON, STATEMENT_WORDS
from iec2mpy.syntax.lexer import SYMBOLS
from iec2mpy.syntax.situation import Finding, Situation
from iec2mpy.syntax.tokens import Token
from iec2mpy.syntax.tree import BinaryExpr

_SHOWN = {terminal: text for text, terminal in SYMBOLS.items()} | {
    "AND": "AND", "NAME": "a name", "INTEGER": "a number", "LITERAL": "a value", "ENUM_VALUE": "a value",
    "DIRECT": "an address", "PARTIAL_DIRECT": "an address", "PART": "a bit number", "ELEMENTARY": "a type",
    "STRING": "a type", "$END": "the end",
}  # fmt: skip

_GLUE = ("COLON", "ASSIGN", "COMMA", "TO", "DO", "THEN", "OF", "RPAR", "RSQB", "RANGE", "LPAR", "ON", "UNTIL")
"""Signs and words that are found to be missing by trying whether they would fit."""

_OPERATORS = frozenset(
    {"PLUS", "MINUS", "TIMES", "DIVIDE", "MOD", "POWER", "AND", "OR", "XOR", "EQ", "NE", "LT", "GT", "LE", "GE"}
)
_OPERANDS = frozenset({"NAME", "INTEGER", "LITERAL", "ENUM_VALUE", "DIRECT", "LPAR", "NOT"})
_CONTINUES_NAME = frozenset({"ASSIGN", "LPAR", "DOT", "LSQB", "CARET", "EQ", "COLON"})
_ENDS_STATEMENT = frozenset({
    *STATEMENT_WORDS, *BLOCK_ENDS.values(), "ELSE", "ELSIF", "UNTIL", "END_VAR", "END_STRUCT", "END_TYPE",
    "END_RESOURCE", "END_CONFIGURATION", "TASK", "PROGRAM", "RESOURCE", "VAR", "VAR_GLOBAL", "$END",
})  # fmt: skip
_BEFORE_VALUE = frozenset({"LPAR", "ASSIGN", "COMMA", "LSQB", "SEMICOLON", "OF", "COLON", "$START"})
_HEAD_WORDS = {"THEN": "IF and ELSIF have THEN", "DO": "FOR and WHILE have DO", "OF": "CASE has OF"}


def shown_type(terminal: str) -> str:
    """A terminal as it is written."""
    return _SHOWN.get(terminal, terminal)


def explain(situation: Situation) -> Finding:
    """The finding of the first rule that has one."""
    for rule in _RULES:
        finding = rule(situation)
        if finding is not None:
            return finding
    return _general(situation)


def _text(token: Token) -> str:
    if token.text:
        return f"`{token.text}`"
    return "the beginning" if token.type == "$START" else "the end of the file"


def _missing_after(previous: Token) -> Span:
    """Where something is missing: the end of the token before, as it is that line which is unfinished."""
    return Span(previous.file, max(previous.end - 1, previous.start), previous.end)


# --------------------------------------------------------------------------------------------- the rules


def _split_number(s: Situation) -> Finding | None:
    if s.previous.type == s.token.type == "INTEGER" and not s.new_line and not s.accepts("INTEGER"):
        return Finding(
            "E0106",
            f"Two numbers follow one another: {_text(s.previous)} and {_text(s.token)}.",
            s.token.span,
            f"A number has no spaces inside: `{s.previous.text}_{s.token.text}`.",
            drop=1,
        )
    if s.token.type == "DOT" and s.previous.type == "INTEGER":
        return Finding(
            "E0106",
            f"Digits are missing behind the point of `{s.previous.text}.`.",
            s.token.span,
            f"Write `{s.previous.text}.0`.",
            drop=1,
        )
    if s.token.type == "DOT" and s.following.type == "INTEGER" and s.accepts("LITERAL"):
        return Finding(
            "E0106",
            f"Digits are missing before the point of `.{s.following.text}`.",
            s.token.span,
            f"Write `0.{s.following.text}`.",
            drop=1,
        )
    return None


def _assignment_sign(s: Situation) -> Finding | None:
    token = s.token
    if s.accepts("ASSIGN"):
        if token.type == "EQ":
            return Finding("E0117", "`=` compares; `:=` assigns.", token.span, "Write `:=`.", replace="ASSIGN")
        if token.type == "ARROW":
            return Finding(
                "E0117",
                "`=>` hands over an output inside of a call; `:=` assigns.",
                token.span,
                "Write `:=`.",
                replace="ASSIGN",
            )
    if token.type == "ASSIGN":
        if s.accepts("COLON", s.following.type) and not s.accepts("EQ"):
            return Finding(
                "E0117",
                f"Between a name and its type stands `:`, as in `{s.previous.text} : INT;`.",
                token.span,
                replace="COLON",
            )
        if s.previous.type in ("INTEGER", "LITERAL"):
            return Finding(
                "E0117",
                f"Nothing can be assigned to {_text(s.previous)}: on the left of `:=` stands a variable.",
                s.previous.span,
            )
        if s.accepts("EQ"):
            return Finding("E0117", "`:=` assigns; `=` compares.", token.span, "Write `=`.", replace="EQ")
    return None


def _comparison_as_statement(s: Situation) -> Finding | None:
    """Between the labels of a CASE, `x = 1;` reads as a label up to its `;`."""
    if s.token.type != "SEMICOLON" or not s.accepts("COLON", "EXIT", "SEMICOLON"):
        return None
    last = s.values[-1]
    if isinstance(last, BinaryExpr) and last.operator == "=":
        return Finding("E0117", "`=` compares; `:=` assigns.", last.operator_span, "Write `:=`.")
    return Finding(
        "E0120", "This is neither a label of the CASE nor a statement.", s.previous.span, "A label ends with `:`."
    )


def _keyword_as_name(s: Situation) -> Finding | None:
    word = s.token.text.upper()
    if word not in KEYWORDS or word.startswith("END_") or not s.accepts("NAME", s.following.type):
        return None
    if word in ("THEN", "DO", "OF", "ELSE", "ELSIF", "UNTIL", *STATEMENT_WORDS) and s.following.type not in (
        "COLON",
        "COMMA",
        "ASSIGN",
        "AT",
    ):
        return None
    return Finding("E0112", f"`{s.token.text}` is a keyword and cannot be a name.", s.token.span, replace="NAME")


def _operator_without_left_side(s: Situation) -> Finding | None:
    if s.previous.type in ("AND", "OR", "XOR", "MOD") and s.accepts("LPAR") and not s.accepts("NAME"):
        return Finding("E0119", f"A value is missing before {_text(s.previous)}.", s.previous.span)
    return None


def _output_expression(s: Situation) -> Finding | None:
    if s.token.type in _OPERATORS and any(
        isinstance(value, Token) and value.type == "ARROW" for value in s.values[-2:]
    ):
        return Finding(
            "E0124",
            "An output (`=>`) goes to a variable, not to an expression.",
            s.token.span,
            "Take the output first, then calculate.",
        )
    return None


def _head_word(s: Situation) -> Finding | None:
    """THEN, DO, OF: missing, or one in place of another."""
    for word, rule in _HEAD_WORDS.items():
        if s.accepts(word) and word != "OF":
            if s.token.type in _HEAD_WORDS:
                return Finding(
                    "E0119", f"Here stands `{word}`, not {_text(s.token)}: {rule}.", s.token.span, replace=word
                )
            if s.accepts(word, s.token.type) and (
                s.new_line or s.token.type in _ENDS_STATEMENT or s.token.type == "SEMICOLON"
            ):
                return Finding(
                    "E0119", f"`{word}` is missing after {_text(s.previous)}.", _missing_after(s.previous), insert=word
                )
    return None


def _semicolon(s: Situation) -> Finding | None:
    if not s.accepts("SEMICOLON", s.token.type):
        return None
    starts = s.token.type in _ENDS_STATEMENT or (s.token.type == "NAME" and s.following.type in _CONTINUES_NAME)
    if s.new_line or starts:
        hint = with_dialects("end-without-semicolon") if s.previous.type in OPTIONAL_SEMICOLON else None
        message = f"`;` is missing after {_text(s.previous)}."
        return Finding("E0113", message, _missing_after(s.previous), hint, insert="SEMICOLON")
    return None


def _end_of_repeat(s: Situation) -> Finding | None:
    if s.token.type == "SEMICOLON" and s.accepts("END_REPEAT"):
        message = "No `;` stands between the condition of UNTIL and END_REPEAT."
        return Finding("E0121", message, s.token.span, "`UNTIL condition END_REPEAT;`", drop=1)
    if s.token.type == "END_REPEAT" and s.accepts("UNTIL"):
        message = "`UNTIL` and its condition are missing before `END_REPEAT`."
        return Finding("E0119", message, s.token.span, "`REPEAT … UNTIL condition END_REPEAT;`")
    return None


def _return_value(s: Situation) -> Finding | None:
    if s.previous.type == "RETURN" and s.token.type in _OPERANDS and not s.new_line:
        hint = "A function's result is assigned to its name before RETURN."
        return Finding("E0121", "RETURN has no value.", s.token.span, hint)
    return None


def _foreign_character(s: Situation) -> Finding | None:
    if s.token.type == "QUESTION":
        return Finding("E0101", "`?` has no meaning in a program.", s.token.span)
    return None


def _declaration(s: Situation) -> Finding | None:
    """Mistakes that are made between a variable's name and its `;`."""
    token, previous = s.token, s.previous
    if previous.type == "AT":
        return Finding("E0119", "An address is missing after `AT`.", previous.span, "Such as `AT %IX0.0`.")
    if token.type in ("SEMICOLON", "ASSIGN", "EQ") and s.accepts("COLON", "ELEMENTARY", "SEMICOLON"):
        return Finding(
            "E0119", f"The type of {_text(previous)} is missing.", previous.span, f"Such as `{previous.text} : INT;`."
        )
    if token.type in ("RSQB", "COMMA") and s.accepts("RANGE") and not s.accepts(token.type):
        return Finding(
            "E0119", "An array has a first and a last index.", previous.span, f"Such as `[1..{previous.text}]`."
        )
    return None


def _statement_start(s: Situation) -> Finding | None:
    if not s.accepts("EXIT") or (s.accepts("LITERAL") and s.token.type in _OPERATORS | {"RANGE"}):
        return None
    token = s.token
    if token.type in ("INTEGER", "LITERAL", "ENUM_VALUE"):
        message, hint = f"A statement cannot start with {_text(token)}.", "On the left of `:=` stands a variable."
    elif token.type in ("ELSE", "ELSIF"):
        message, hint = f"{_text(token)} belongs to no IF or CASE here.", None
    elif token.type in ("THEN", "DO", "OF", "UNTIL", "TO", "BY"):
        message, hint = (
            f"{_text(token)} has no beginning.",
            f"{_HEAD_WORDS[token.type]}." if token.type in _HEAD_WORDS else None,
        )
    elif token.text.upper() in KEYWORDS:
        message, hint = f"A statement cannot start with {_text(token)}.", None
    else:
        message, hint = (
            f"A statement cannot start with {_text(token)}.",
            "Statements are `x := 1;`, calls, IF, CASE, FOR, WHILE, REPEAT, EXIT, CONTINUE, RETURN.",
        )
    return Finding("E0120", message, token.span, hint)


def _value(s: Situation) -> Finding | None:
    if not (s.accepts("NAME") and s.accepts("LITERAL")):
        return None
    if s.token.type in ("MINUS", "PLUS", "NOT"):
        return Finding(
            "E0119",
            f"{_text(s.token)} cannot follow {_text(s.previous)} directly.",
            s.token.span,
            "Put the second sign and its value into brackets.",
        )
    if s.token.type in _OPERATORS | {"RANGE"} and s.previous.type in _BEFORE_VALUE:
        return Finding("E0119", f"A value is missing before {_text(s.token)}.", s.token.span)
    return Finding("E0119", f"A value is missing after {_text(s.previous)}.", _missing_after(s.previous))


def _type(s: Situation) -> Finding | None:
    if not s.accepts("ELEMENTARY"):
        return None
    if s.token.type in ("SEMICOLON", "ASSIGN", "COMMA", "RPAR") or s.token.type.startswith("END") or s.new_line:
        return Finding(
            "E0119", f"A type is missing after {_text(s.previous)}.", _missing_after(s.previous), "Such as `x : INT;`."
        )
    return Finding("E0119", f"{_text(s.token)} is no type.", s.token.span, "Such as `x : INT;`.")


def _enumerated_in_list(s: Situation) -> Finding | None:
    if s.token.type == "ENUM_VALUE" and s.accepts("NAME"):
        name = s.token.text.partition("#")[2]
        return Finding(
            "E0121",
            f"In the list itself a value has no prefix: {_text(s.token)}.",
            s.token.span,
            f"Write `{name}`.",
            replace="NAME",
        )
    return None


def _glue(s: Situation) -> Finding | None:
    """A sign or word that would fit before this token; best one that fits with the token behind it, too."""
    fitting = [terminal for terminal in _GLUE if _may_be_missing(terminal, s) and s.accepts(terminal, s.token.type)]
    well = [terminal for terminal in fitting if s.accepts(terminal, s.token.type, s.following.type)]
    for terminal in well or fitting:
        between = f"after {_text(s.previous)}" if s.new_line else f"between {_text(s.previous)} and {_text(s.token)}"
        message = f"`{shown_type(terminal)}` is missing {between}."
        return Finding("E0119", message, _missing_after(s.previous), insert=terminal)
    return None


def _may_be_missing(terminal: str, s: Situation) -> bool:
    """Whether this is not only possible but likely."""
    if terminal in ("RPAR", "RSQB"):
        return s.token.type not in _OPERANDS
    if terminal == "LPAR":
        return len(s.expected) == 1
    if terminal == "ASSIGN" and s.token.type in ("NAME", "LPAR"):
        return s.accepts("ASSIGN", s.token.type, s.following.type)
    return True


def _operator(s: Situation) -> Finding | None:
    if s.token.type in _OPERANDS and s.accepts("PLUS"):
        return Finding(
            "E0119",
            f"Something is missing between {_text(s.previous)} and {_text(s.token)}: an operator, or `;`.",
            s.token.span,
        )
    return None


def _name(s: Situation) -> Finding | None:
    if s.accepts("NAME"):
        return Finding(
            "E0119",
            f"A name is missing {'before ' + _text(s.token) if not s.new_line else 'after ' + _text(s.previous)}.",
            s.token.span,
        )
    return None


def _general(s: Situation) -> Finding:
    names = [name for name in s.expected if name not in _OPERATORS]
    fitting = list(dict.fromkeys(shown_type(name) for name in names))[:5]
    if len(names) < len(s.expected):
        fitting.append("an operator")
    shown = [text if text.startswith(("a ", "an ", "the ")) else f"`{text}`" for text in fitting]
    if len(shown) == 1:
        missing = f"{shown[0][0].upper()}{shown[0][1:]} is missing after {_text(s.previous)}."
        return Finding("E0119", missing, _missing_after(s.previous))
    hint = f"What fits here: {', '.join(shown)}." if shown else None
    return Finding("E0121", f"{_text(s.token)} cannot stand after {_text(s.previous)}.", s.token.span, hint)


_RULES: tuple[Callable[[Situation], Finding | None], ...] = (
    _foreign_character,
    _split_number,
    _output_expression,
    _assignment_sign,
    _comparison_as_statement,
    _keyword_as_name,
    _return_value,
    _end_of_repeat,
    _operator_without_left_side,
    _head_word,
    _declaration,
    _semicolon,
    _enumerated_in_list,
    _statement_start,
    _value,
    _type,
    _glue,
    _operator,
    _name,
)
