"""The lexer: text to tokens, by one regular expression (6.1, 6.3).

Comments, pragmas and white space yield no tokens. What cannot be read is reported here, once, and its token is marked
`bad`, so that no parser complains about it again.
"""

from __future__ import annotations

import re

from iec2mpy.source.diagnostics import Diagnostics
from iec2mpy.source.dialects import accepts, require
from iec2mpy.source.spans import SourceFile, Span
from iec2mpy.syntax import literals
from iec2mpy.syntax.keywords import DIALECT_WORDS, KEYWORDS
from iec2mpy.syntax.tokens import Token
from iec2mpy.syntax.tree import Literal

_TOKEN = re.compile(
    r"""[ \t\r\n\f\v\u00a0\ufeff]*(?:
    (?P<typed>[A-Za-z_]\w*\#)
  | (?P<name>[^\W\d]\w*)
  | (?P<comment>//|\(\*|/\*)
  | (?P<symbol>:=|:[ \t]+=|=>|\?=|<>|<=|>=|\*\*|\.\.\.|\.\.|==|!=|&&|\|\||\+=|-=|\*=|/=
      |\+\+(?=[ \t]*;)|--(?=[ \t]*;)|[;:,()\[\].=<>+\-*/&^?!|])
  | (?P<based>\d+\#[+-]?\w*)
  | (?P<number>\d\w*(?:\.\d\w*)?(?:(?<=\d[eE])[+-]\d\w*)?)
  | (?P<string>['"])
  | (?P<percent>%(?:[IQMiqm][XBWDLxbwdl]?\*(?!\))|(?:[A-Za-z]\w*|\d+)?(?:\.\d+)*))
  | (?P<pragma>\{)
  | (?P<other>.)
  | (?P<end>\Z)
    )""",
    re.VERBOSE,
)

SYMBOLS = {
    ":=": "ASSIGN", "=>": "ARROW", "?=": "TRY_ASSIGN", "<>": "NE", "<=": "LE", ">=": "GE", "**": "POWER", "..": "RANGE",
    ";": "SEMICOLON", ":": "COLON", ",": "COMMA", "(": "LPAR", ")": "RPAR", "[": "LSQB", "]": "RSQB", ".": "DOT",
    "=": "EQ", "<": "LT", ">": "GT", "+": "PLUS", "-": "MINUS", "*": "TIMES", "/": "DIVIDE", "&": "AND", "^": "CARET",
    "?": "QUESTION",
}  # fmt: skip

_FOREIGN_SYMBOLS = {
    "==": ("EQ", "`=`"), "!=": ("NE", "`<>`"), "&&": ("AND", "`AND`"), "||": ("OR", "`OR`"), "!": ("NOT", "`NOT`"),
    "|": ("OR", "`OR`"), "%": ("MOD", "`MOD`"), "...": ("RANGE", "`..`"),
}  # fmt: skip
"""Operators of C and its like: what they are read as, and what to write instead."""

_COMPOUND_ASSIGNMENTS = {"+=": "+ …", "-=": "- …", "*=": "* …", "/=": "/ …", "++": "+ 1", "--": "- 1"}
_TYPOGRAPHIC_QUOTES = {"“": "”", "„": "“", "”": "”", "‘": "’", "’": "’", "‚": "‘"}

_COMMENT_MARKS = {"(*": ("*)", re.compile(r"\(\*|\*\)")), "/*": ("*/", re.compile(r"/\*|\*/"))}
_DRAWN = re.compile(r"\{\s*(LD|FBD)\s*\}", re.IGNORECASE)
_C_CODE = re.compile(r"\{\{|\{[^}]*;[^}]*")
_DRAWN_END = re.compile(r"^[ \t]*END_(?:PROGRAM|FUNCTION|FUNCTION_BLOCK|METHOD|ACTION|TRANSITION)\b", re.I | re.M)
_DIRECT = re.compile(r"%([IQM])([XBWDL]?)(\d+(?:\.\d+)*)\Z", re.IGNORECASE)
_PART = re.compile(r"%(?:[XBWDL]?\d+|[XBWDL]\d+\.\d+)\Z", re.IGNORECASE)
_PARTIAL_DIRECT = re.compile(r"%[IQM][XBWDL]?\*\Z", re.IGNORECASE)


_OPERAND_ENDS = frozenset({
    "NAME", "RSQB", "RPAR", "CARET", "LITERAL", "INTEGER", "ENUM_VALUE", "DIRECT", "PART", "NULL",
})  # fmt: skip
_NO_ARGUMENTS = re.compile(r"\s*\(\s*\)")
_DECLARES = re.compile(r"\s+[A-Za-z_]")


def tokenize(file: SourceFile, diagnostics: Diagnostics) -> list[Token]:
    """All tokens of a file; the last one has the type `$END`."""
    tokens: list[Token] = []
    append = tokens.append
    text = file.text
    match = _TOKEN.match
    keyword = KEYWORDS.get
    symbol_type = SYMBOLS.get
    at = 0
    cut_off = False  # by a comment that is never closed: what is missing at the end is not the program's fault
    while True:
        found = match(text, at)
        assert found is not None  # `other` takes any character, `end` the end
        kind = found.lastgroup
        assert kind is not None
        start, at = found.span(kind)
        piece = text[start:at]
        if kind == "name":
            token_type = keyword(piece.upper(), "NAME")
            if token_type in DIALECT_WORDS and not _is_keyword(file, at, token_type, tokens):
                token_type = "NAME"
            if token_type == "NAME":
                if at < len(text) and text[at] == "=" and piece in "SRsr" and _ends_operand(tokens):
                    at += 1
                    append(Token("LATCH", text[start:at], start, at, file))
                    continue
                bad = ("_" in piece or not piece.isascii()) and _check_name(piece, Span(file, start, at), diagnostics)
                append(Token("NAME", piece, start, at, file, None, bad))
            elif token_type == "ELEMENTARY" and (called := _clock(file, piece, start, at, diagnostics)) is not None:
                append(called)
            elif token_type == "LITERAL":
                value = Literal("bool", piece.upper() == "TRUE", None, Span(file, start, at))
                append(Token(token_type, piece, start, at, file, value))
            else:
                append(Token(token_type, piece, start, at, file))
        elif kind == "symbol":
            token_type = symbol_type(piece)
            if token_type is None:
                append(_foreign_symbol(file, start, at, diagnostics))
            else:
                append(Token(token_type, piece, start, at, file))
        elif kind == "end":
            append(Token("$END", "", len(text), len(text), file, None, cut_off))
            return tokens
        elif kind == "comment":
            at, closed = _skip_comment(file, start, piece, diagnostics)
            cut_off = cut_off or not closed
        else:
            token, at = _OTHERS[kind](file, start, at, diagnostics)
            if token is not None:
                append(token)
            elif at == len(text):
                cut_off = text[at - 1] != "}"


def _ends_operand(tokens: list[Token]) -> bool:
    """Whether a value may end with the last token: then no name can follow."""
    return bool(tokens) and tokens[-1].type in _OPERAND_ENDS


def _is_keyword(file: SourceFile, end: int, word: str, tokens: list[Token]) -> bool:
    """Whether a word of `DIALECT_WORDS` is one here: where the dialect has it, and where it can be no name."""
    if accepts(file, DIALECT_WORDS[word]):
        return True
    return _DECLARES.match(file.text, end) is not None if word == "VAR_STAT" else _ends_operand(tokens)


def _clock(file: SourceFile, word: str, start: int, end: int, diagnostics: Diagnostics) -> Token | None:
    """`TIME` of `TIME()`: the name of a function, where the dialect has it."""
    if word.upper() != "TIME" or not (brackets := _NO_ARGUMENTS.match(file.text, end)):
        return None
    span = Span(file, start, brackets.end())
    instead = "A TON measures spans of time."
    known = require("time-call", diagnostics, "E0129", "`TIME()` is no function of the standard.", span, instead)
    return Token("NAME", word, start, end, file, None, not known)


def _check_name(name: str, span: Span, diagnostics: Diagnostics) -> bool:
    """Whether something is wrong with the form of a name (6.1.2, table 2)."""
    if not name.isascii():
        foreign = next(character for character in name if not character.isascii())
        diagnostics.add(
            "E0105",
            f"`{foreign}` cannot stand in a name: names have the letters A to Z, digits and `_`.",
            span,
            "Accents and other alphabets can be used in comments and strings.",
        )
    elif ("__" in name and not span.file.is_stdlib) or name == "_":
        diagnostics.add(
            "E0105", f"The name `{name}` has two `_` in a row, or nothing else; one between letters is allowed.", span
        )
    elif name.endswith("_"):
        diagnostics.add("E0105", f"The name `{name}` ends with `_`.", span, f"Write `{name.rstrip('_')}`.")
    else:
        return False
    return True


def _foreign_symbol(file: SourceFile, start: int, end: int, diagnostics: Diagnostics) -> Token:
    text = file.text[start:end]
    span = Span(file, start, end)
    if text in _COMPOUND_ASSIGNMENTS:
        hint = f"Write `x := x {_COMPOUND_ASSIGNMENTS[text]}`, with the name twice."
        diagnostics.add("E0118", f"`{text}` is not an operator of this language.", span, hint)
        return Token("ASSIGN", text, start, end, file, None, True)
    if text.startswith(":"):
        diagnostics.add("E0117", "`:=` is written without a space.", span)
        return Token("ASSIGN", text, start, end, file)
    token_type, instead = _FOREIGN_SYMBOLS[text]
    diagnostics.add("E0118", f"`{text}` is not an operator of this language.", span, f"Write {instead}.")
    return Token(token_type, text, start, end, file, None, True)


def _skip_comment(file: SourceFile, start: int, mark: str, diagnostics: Diagnostics) -> tuple[int, bool]:
    """The offset behind a comment, and whether it is closed. Both bracket forms nest (6.1.5, table 3)."""
    text = file.text
    if mark == "//":
        end = text.find("\n", start)
        return (len(text) if end < 0 else end), True
    closing, marks = _COMMENT_MARKS[mark]
    depth = 0
    for found in marks.finditer(text, start):
        depth += 1 if found.group() == mark else -1
        if depth == 0:
            return found.end(), True
    diagnostics.add(
        "E0102",
        f"This comment is never closed: `{closing}` is missing.",
        Span(file, start, start + 2),
        "Comments can be nested: each one needs its own end." if depth > 1 or text.find(closing, start) >= 0 else None,
    )
    return len(text), False


def _typed(file: SourceFile, start: int, end: int, diagnostics: Diagnostics) -> tuple[Token | None, int]:
    """A literal with a prefix (`INT#5`, `T#1s`), or a qualified enumerated value (`Colour#red`)."""
    return literals.read_prefixed(file, start, end, diagnostics)


def _based(file: SourceFile, start: int, end: int, diagnostics: Diagnostics) -> tuple[Token | None, int]:
    return literals.read_based(file, start, end, diagnostics), end


def _number(file: SourceFile, start: int, end: int, diagnostics: Diagnostics) -> tuple[Token | None, int]:
    return literals.read_number(file, start, end, diagnostics), end


def _string(file: SourceFile, start: int, end: int, diagnostics: Diagnostics) -> tuple[Token | None, int]:
    token = literals.read_string(file, start, start, None, diagnostics)
    return token, token.end


def _percent(file: SourceFile, start: int, end: int, diagnostics: Diagnostics) -> tuple[Token | None, int]:
    """`%IX0.0` (table 16), `%X3` behind a dot (table 17), `%I*` (table 16), `%X3.0` in a structure, or a C operator."""
    text = file.text[start:end]
    if _DIRECT.match(text):
        return Token("DIRECT", text, start, end, file), end
    if _PART.match(text):
        return Token("PART", text, start, end, file), end
    if _PARTIAL_DIRECT.match(text):
        return Token("PARTIAL_DIRECT", text, start, end, file), end
    if text == "%":
        return _foreign_symbol(file, start, end, diagnostics), end
    span = Span(file, start, end)
    hint = "An address is written `%IX0.0`, `%QW3`, `%MD8`: I, Q or M; X, B, W, D or L; then numbers."
    if text[1:2].upper() not in ("I", "Q", "M", *"XBWDL"):
        message = f"`{text}` is no address: the letter behind `%` is I (input), Q (output) or M (memory)."
    elif not any(character.isdigit() for character in text):
        message = f"The number is missing in the address `{text}`."
    else:
        message = f"`{text}` is no address of the form `%IX0.0`."
    diagnostics.add("E0111", message, span, hint)
    return Token("DIRECT", text, start, end, file, None, True), end


def _pragma(file: SourceFile, start: int, _end: int, diagnostics: Diagnostics) -> tuple[Token | None, int]:
    """Pragmas are skipped (6.2), but not C, which MATIEC and OpenPLC write so; `{LD}` and `{FBD}` make one token with
    all of the drawing."""
    drawn = _DRAWN.match(file.text, start)
    if drawn:
        stop = _DRAWN_END.search(file.text, drawn.end())
        end = stop.start() if stop else len(file.text)
        return Token("DRAWING", drawn.group(1).upper(), start, end, file), end
    end = file.text.find("}", start)
    if end < 0:
        diagnostics.add("E0104", "This pragma is never closed: `}` is missing.", Span(file, start, start + 1))
        return None, len(file.text)
    if _C_CODE.match(file.text, start, end) and not _is_behind_bracket(file.text, start):
        message = "This is Inline C: it cannot run here, as a board runs MicroPython, and no C compiler takes part."
        diagnostics.add("E0130", message, Span(file, start, start + 1), "Write what it does in Structured Text.")
        end = file.text.find("}}", start) + 1 if file.text.startswith("{{", start) else end
    return None, max(end, start) + 1


def _is_behind_bracket(text: str, at: int) -> bool:
    """Whether `)` stands before: then this is a function in C, and that nothing of it is ST is told elsewhere."""
    at -= 1
    while at >= 0 and text[at].isspace():
        at -= 1
    return at >= 0 and text[at] == ")" and text[at - 1 : at] != "*"


def _other(file: SourceFile, start: int, end: int, diagnostics: Diagnostics) -> tuple[Token | None, int]:
    character = file.text[start]
    if character in _TYPOGRAPHIC_QUOTES:
        return _typographic_string(file, start, diagnostics)
    shown = f"`{character}`" if character.isprintable() else f"The character U+{ord(character):04X}"
    diagnostics.add("E0101", f"{shown} has no meaning in a program.", Span(file, start, end))
    return Token("UNKNOWN", character, start, end, file, None, True), end


def _typographic_string(file: SourceFile, start: int, diagnostics: Diagnostics) -> tuple[Token, int]:
    """Text between quotes as word processors set them: read as a string, so that it costs one message."""
    opening = file.text[start]
    line_end = file.text.find("\n", start)
    line_end = len(file.text) if line_end < 0 else line_end
    closing = file.text.find(_TYPOGRAPHIC_QUOTES[opening], start + 1, line_end)
    end = closing + 1 if closing >= 0 else start + 1
    span = Span(file, start, end)
    right = '"' if opening in "“„”" else "'"
    diagnostics.add(
        "E0101", f"`{opening}` has no meaning in a program.", span, f"Strings stand between `{right}` and `{right}`."
    )
    kind = "wstring" if right == '"' else "string"
    return Token("LITERAL", span.text, start, end, file, Literal(kind, "", None, span), True), end


_OTHERS = {
    "typed": _typed,
    "based": _based,
    "number": _number,
    "string": _string,
    "percent": _percent,
    "pragma": _pragma,
    "other": _other,
}
