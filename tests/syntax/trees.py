"""Shows trees as text, for tests: `(+ a (* b 2))`, without the spans."""

from __future__ import annotations

from iec2mpy.source.diagnostics import Diagnostics
from iec2mpy.source.spans import SourceFile
from iec2mpy.syntax import parse, tree


def parse_text(text: str) -> tuple[tree.CompilationUnit, list[tuple[str, int]]]:
    """The tree, and the code and line of each diagnostic."""
    diagnostics = Diagnostics()
    unit = parse(SourceFile("test.st", text), diagnostics)
    return unit, [(item.code, item.span.line) for item in diagnostics.items if item.span]


def errors(text: str) -> list[tuple[str, int]]:
    return parse_text(text)[1]


def first(text: str) -> tree.Declaration:
    """The first declaration of a text without errors."""
    unit, found = parse_text(text)
    assert found == []
    return unit.declarations[0]


def pou(text: str) -> tree.PouDecl:
    declaration = first(text)
    assert isinstance(declaration, tree.PouDecl)
    return declaration


def body(statements: str) -> str:
    """Statements, in a program of their own, shown one a line."""
    return "\n".join(show(statement) for statement in pou(f"PROGRAM p\n{statements}\nEND_PROGRAM").body)


def expression(text: str) -> str:
    statement = pou(f"PROGRAM p\nx := {text};\nEND_PROGRAM").body[0]
    assert isinstance(statement, tree.AssignStmt)
    return show(statement.value)


def _list(items: object) -> str:
    assert isinstance(items, tuple)
    return " ".join(show(item) for item in items)


def show(node: object) -> str:
    match node:
        case None:
            return "-"
        case tree.Name(text):
            return text
        case tree.Literal(kind, value, prefix):
            shown = repr(value) if kind in ("string", "wstring") else str(value)
            return f"{prefix}#{shown}" if prefix else shown
        case tree.NameExpr(name):
            return name
        case tree.TypedEnumValue(type_name, value):
            return f"{type_name.text}#{value.text}"
        case tree.DirectVariable():
            return node.text
        case tree.MemberExpr(base, name):
            return f"{show(base)}.{name.text}"
        case tree.PartExpr(base, size, index):
            return f"{show(base)}.%{size}{index}"
        case tree.IndexExpr(base, indices):
            return f"{show(base)}[{_list(indices)}]"
        case tree.Argument(name, value, is_output, negated):
            sign = "=>" if is_output else ":="
            return f"{'NOT ' if negated else ''}{show(name) + sign if name else ''}{show(value) if value else ''}"
        case tree.CallExpr(callee, arguments):
            return f"{show(callee)}({_list(arguments)})"
        case tree.UnaryExpr(operator, operand):
            return f"({operator} {show(operand)})"
        case tree.BinaryExpr(operator, left, right):
            return f"({operator} {show(left)} {show(right)})"
        case tree.AssignStmt(target, value):
            return f"{show(target)} := {show(value)}"
        case tree.CallStmt(call):
            return show(call)
        case tree.IfStmt(branches, otherwise):
            shown = " ".join(f"[{show(branch.condition)}: {_list(branch.body)}]" for branch in branches)
            return f"(if {shown}{_otherwise(otherwise)})"
        case tree.CaseStmt(selector, groups, otherwise):
            shown = " ".join(f"[{_list(group.labels)}: {_list(group.body)}]" for group in groups)
            return f"(case {show(selector)} {shown}{_otherwise(otherwise)})"
        case tree.LabelRange(low, high) | tree.ArrayBound(low, high):
            return f"{show(low)}..{show(high)}"
        case tree.ForStmt(control, start, end, step, statements):
            return f"(for {show(control)} {show(start)} {show(end)} {show(step)}: {_list(statements)})"
        case tree.WhileStmt(condition, statements):
            return f"(while {show(condition)}: {_list(statements)})"
        case tree.RepeatStmt(statements, until):
            return f"(repeat {_list(statements)} until {show(until)})"
        case tree.ExitStmt():
            return "exit"
        case tree.ContinueStmt():
            return "continue"
        case tree.ReturnStmt():
            return "return"
        case tree.NamedTypeSpec(name):
            return name.text
        case tree.StringSpec(wide, length):
            return ("WSTRING" if wide else "STRING") + (f"[{show(length)}]" if length else "")
        case tree.SubrangeSpec(base, low, high):
            return f"{base.text}({show(low)}..{show(high)})"
        case tree.EnumSpec(base, items):
            shown = " ".join(f"{item.name.text}{'=' + show(item.value) if item.value else ''}" for item in items)
            return f"{base.text if base else ''}({shown})"
        case tree.ArraySpec(bounds, element):
            return f"array[{_list(bounds)}] {show(element)}"
        case tree.StructSpec(fields, _):
            return f"struct({_list(fields)})"
        case tree.StructField(names, _, type_spec, initial):
            return f"[{_list(names)} {show(type_spec)}{_initial(initial)}]"
        case tree.VarDecl(names, location, type_spec, initial):
            place = f" at {location.text}" if location else ""
            return f"[{_list(names)}{place}: {show(type_spec)}{_initial(initial)}]"
        case tree.TypeDecl(name, type_spec, initial):
            return f"{name.text}: {show(type_spec)}{_initial(initial)}"
        case tree.VarSection(section, constant, retention, declarations):
            words = [section.value, *(["CONSTANT"] if constant else []), *([retention.value] if retention else [])]
            return f"{' '.join(words)} {_list(declarations)}".rstrip()
        case tree.ArrayInitial(items):
            return f"[{_list(items)}]"
        case tree.Repeat(count, values):
            return f"{show(count)}({_list(values)})"
        case tree.StructInitial(fields):
            return f"({' '.join(f'{field.name.text}={show(field.value)}' for field in fields)})"
    raise AssertionError(node)


def _otherwise(statements: tuple[tree.Stmt, ...] | None) -> str:
    return "" if statements is None else f" [else: {_list(statements)}]"


def _initial(initial: tree.Initial | None) -> str:
    return "" if initial is None else f" = {show(initial)}"
