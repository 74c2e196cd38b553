"""The IR as text, for people: a line a statement, inner blocks indented. Golden tests compare it."""

from __future__ import annotations

from collections.abc import Iterator

from iec2mpy.ir import nodes as n

_SYMBOLS = {
    **{"add": "+", "sub": "-", "mul": "*", "div": "/", "mod": "MOD", "and": "AND", "or": "OR", "xor": "XOR"},
    **{"shl": "SHL", "shr": "SHR", "rol": "ROL", "ror": "ROR", "ne": "<>", "eq": "="},
    **{"lt": "<", "gt": ">", "le": "<=", "ge": ">="},
}


def print_body(body: n.Body) -> str:
    """A POU's body."""
    return "\n".join([f"{body.pou.name}:", *_block(body.block, "  ")]) + "\n"


def _block(block: n.Block, indent: str) -> Iterator[str]:
    for statement in block:
        yield from _statement(statement, indent)


def _statement(statement: n.Stmt, indent: str) -> Iterator[str]:
    match statement:
        case n.Line(span):
            yield f"{indent}# {span.line}"
        case n.Store(place, value):
            yield f"{indent}{_place(place)} := {_expr(value)}"
        case n.SetLocal(local, value):
            yield f"{indent}{_expr(local)} := {_expr(value)}"
        case n.Copy(target, source):
            yield f"{indent}copy {_place(target)} := {_place(source)}"
        case n.Compare(local, left, right):
            yield f"{indent}{_expr(local)} := compare {_place(left)} = {_place(right)}"
        case n.Bind(reference, target):
            yield f"{indent}bind {_place(reference)} => {_place(target)}"
        case n.Reset(place):
            yield f"{indent}reset {_place(place)}"
        case n.Call(pou, instance):
            yield f"{indent}call {pou.name}" + (f" on {_place(instance)}" if instance else "")
        case n.Part(number):
            yield f"{indent}part {number}"
        case n.Guard(condition, fault, site):
            yield f"{indent}fault {fault} if {_expr(condition)}  # {site.span.line}"
        case n.Mark(site):
            yield f"{indent}mark  # {site.span.line}"
        case n.Tick():
            yield f"{indent}tick"
        case n.If(condition, then, otherwise):
            yield f"{indent}if {_expr(condition)}"
            yield from _block(then, indent + "  ")
            if otherwise:
                yield f"{indent}else"
                yield from _block(otherwise, indent + "  ")
        case n.Try(body):
            yield f"{indent}try"
            yield from _block(body, indent + "  ")
        case n.While(condition, body):
            yield f"{indent}while {_expr(condition)}"
            yield from _block(body, indent + "  ")
        case n.Break():
            yield f"{indent}break"
        case n.Next():
            yield f"{indent}next"
        case n.Return():
            yield f"{indent}return"


def _expr(expr: n.Expr) -> str:
    match expr:
        case n.Const(value):
            return repr(value)
        case n.Local(number, _, low, high):
            return f"%{number}" + (f"[{low}..{high}]" if low is not None else "")
        case n.Load(place):
            return _place(place)
        case n.Ref(place):
            return f"REF({_place(place)})"
        case n.Now():
            return "now"
        case n.Op(name, left, right):
            return f"({_expr(left)} {_SYMBOLS[name]} {_expr(right)})"
        case n.Not(operand):
            return f"NOT {_expr(operand)}"
        case n.Wrap(operand, to):
            return f"{to}({_expr(operand)})"
        case n.ToReal(operand):
            return f"REAL({_expr(operand)})"
        case n.Select(condition, then, otherwise):
            return f"({_expr(then)} if {_expr(condition)} else {_expr(otherwise)})"
        case n.Intrinsic(name, arguments):
            return f"{name}({', '.join(map(_expr, arguments))})"


def _place(place: n.Place) -> str:
    match place.root:
        case n.Global(variable):
            text = variable.name
        case n.Self():
            text = "self"
        case n.Frame(pou):
            text = f"{pou.name}'"
        case n.Deref(reference):
            text = f"{_expr(reference)}^"
    for step in place.steps:
        text += f".{step.variable.name}" if isinstance(step, n.Field) else f"[{_expr(step.index)}]"
    return text
