"""From a file's text to its syntax tree."""

from __future__ import annotations

from iec2mpy.source.diagnostics import Diagnostics
from iec2mpy.source.dialects import accepts
from iec2mpy.source.spans import SourceFile, Span
from iec2mpy.syntax import (
    declaration_actions,  # noqa: F401 - enters its functions into the table of actions
    driver,
    statement_actions,  # noqa: F401 - likewise
    tree,
)
from iec2mpy.syntax.balance import balance, join_split_words
from iec2mpy.syntax.keywords import IL_OPERATORS, OPTIONAL_SEMICOLON, SFC_WORDS
from iec2mpy.syntax.lexer import tokenize
from iec2mpy.syntax.splitter import Part, PouPart, split
from iec2mpy.syntax.tokens import Token


def parse(file: SourceFile, diagnostics: Diagnostics) -> tree.CompilationUnit:
    """The tree of all that could be read; errors go to `diagnostics`.

    Where there are errors the tree lacks things, or has something neutral in their place: no program can be made of it.
    """
    tokens = tokenize(file, diagnostics)
    if len(tokens) == 1:
        if not tokens[0].bad:
            diagnostics.add(
                "E0003",
                "This file holds no program.",
                Span(file, 0, 0),
                "Write `PROGRAM main`, statements, `END_PROGRAM`.",
            )
        return tree.CompilationUnit(())
    declarations: list[tree.Declaration] = []
    if accepts(file, "end-without-semicolon"):
        tokens = with_semicolons(tokens)
    for part in split(join_split_words(tokens, diagnostics), diagnostics):
        if isinstance(part, PouPart):
            declarations.append(_pou(part, diagnostics))
        else:
            declarations += _declarations(part, diagnostics)
    return tree.CompilationUnit(tuple(declarations))


def with_semicolons(tokens: list[Token]) -> list[Token]:
    """The tokens with a `;` behind each END_IF and its like that has none."""
    ended: list[Token] = []
    for token in tokens:
        if ended and ended[-1].type in OPTIONAL_SEMICOLON and token.type not in ("SEMICOLON", "ASSIGN"):
            before = ended[-1]
            ended.append(Token("SEMICOLON", ";", before.end, before.end, before.file))
        ended.append(token)
    return ended


def _declarations(part: Part, diagnostics: Diagnostics) -> list[tree.Declaration]:
    value = _read(part.tokens, part.rule, diagnostics)
    if value is None:
        return []
    return value if isinstance(value, list) else [value]


def _read(tokens: list[Token], rule: str, diagnostics: Diagnostics) -> tree.Declaration | list[tree.Declaration] | None:
    balanced = balance(tokens, diagnostics)
    return None if balanced is None else driver.run(balanced, rule, diagnostics)


def _pou(part: PouPart, diagnostics: Diagnostics) -> tree.PouDecl:
    sections = [_read(section, "section", diagnostics) for section in part.sections]
    result = _read(part.result, "result_type", diagnostics) if part.result else None
    return tree.PouDecl(
        tree.PouKind(part.word.type),
        tree.Name(part.name.text, part.name.span),
        result,  # type: ignore[arg-type]
        tuple(section for section in sections if isinstance(section, tree.VarSection)),
        tuple(_body(part.body, diagnostics)),
        part.word.span.to(part.end.span),
        part.end.span,
    )


def _body(tokens: list[Token], diagnostics: Diagnostics) -> list[tree.Stmt]:
    foreign = _foreign_language(tokens)
    if foreign is not None:
        code, what = foreign
        diagnostics.add(code, f"{what} not supported yet.", tokens[0].span, "Write this body in Structured Text.")
        return []
    balanced = balance(tokens, diagnostics, is_body=True)
    return driver.run(balanced, "body", diagnostics) or [] if balanced is not None else []


def _foreign_language(tokens: list[Token]) -> tuple[str, str] | None:
    """The code and name of what a body is written in, if that is not ST."""
    first = tokens[0]
    if first.type == "DRAWING":
        return "E0903", f"Drawn bodies (`{{{first.text}}}`) are"
    if first.type == "INITIAL_STEP" or (
        first.text.upper() in SFC_WORDS and tokens[1].type in ("NAME", "LPAR") and first.type == "NAME"
    ):
        return "E0902", "Sequential Function Charts are"
    if _is_instruction(tokens):
        return "E0901", "Instruction List is"
    return None


def _is_instruction(tokens: list[Token]) -> bool:
    """Whether the first line of a body is an instruction: an operator, perhaps behind a label, and an operand."""
    at = 2 if len(tokens) > 2 and tokens[0].type == "NAME" and tokens[1].type == "COLON" else 0
    operator, operand = tokens[at], tokens[min(at + 1, len(tokens) - 1)]
    if operator.text.upper() not in IL_OPERATORS:
        return False
    if operand.type in (
        "NAME",
        "LITERAL",
        "INTEGER",
        "ENUM_VALUE",
        "DIRECT",
        "MINUS",
        "QUESTION",
        "REF",
        "NULL",
        "THIS",
    ):
        return operand.line == operator.line
    return operator.text.upper().startswith("RET") and operand.type != "ASSIGN" and operand.line > operator.line
