"""What the tests of the checker share: text in, program and diagnostics out."""

from __future__ import annotations

from iec2mpy.semantics import check
from iec2mpy.semantics.stdlib import stdlib_files
from iec2mpy.semantics.typed import Application, Expr, Stmt
from iec2mpy.source.diagnostics import Diagnostics
from iec2mpy.source.spans import SourceFile
from iec2mpy.syntax import parse


def check_text(text: str) -> tuple[Application | None, Diagnostics]:
    diagnostics = Diagnostics()
    files = [SourceFile("test.st", text), *stdlib_files([text])]
    units = [parse(file, diagnostics) for file in files]
    return check(units, diagnostics), diagnostics


def checked(text: str) -> Application:
    """The program; there must be neither errors nor warnings."""
    application, diagnostics = check_text(text)
    assert [d.message for d in diagnostics.items] == []
    assert application is not None
    return application


def program(variables: str, body: str) -> str:
    return f"PROGRAM main\nVAR {variables} END_VAR\n{body}\nEND_PROGRAM\n"


def body_of(variables: str, body: str) -> tuple[Stmt, ...]:
    """The statements of a program with these variables."""
    return next(pou.body for pou in checked(program(variables, body)).pous if pou.name == "main")


def value_of(variables: str, expression: str, target: str) -> Expr:
    """The right side of an assignment to a variable of type `target`."""
    return body_of(f"{variables} target : {target};", f"target := {expression};")[0].value  # type: ignore[union-attr]


def codes(text: str) -> list[tuple[str, int]]:
    """The code and the line of each diagnostic."""
    return [(d.code, d.span.line if d.span else 0) for d in check_text(text)[1].items]


def codes_of(variables: str, body: str) -> list[str]:
    return [code for code, _ in codes(program(variables, body))]
