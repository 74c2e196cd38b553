"""The codes of all diagnostics. Each has a page in `docs/errors/`.

E00 files, E01 syntax, E02 names, E03 types, E04 calls, E05 constants and ranges, E06 control flow and
statements, E07 declarations, E08 configuration, project and boards, E09 what is not supported yet, E10 devices;
W for warnings, numbered likewise.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Code:
    """`about` is the word of the case files' format: syntax, type, name, range, access, const, call, decl, flow, config."""

    title: str
    about: str


CODES: dict[str, Code] = {
    "E0001": Code("file cannot be read", "config"),
    "E0002": Code("file is not UTF-8 text", "syntax"),
    "E0003": Code("file holds no program", "syntax"),
    "E0201": Code("name is not declared", "name"),
    "E0202": Code("name is declared twice", "name"),
    "E0203": Code("type is not declared", "name"),
    "E0204": Code("no such member", "name"),
    "E0205": Code("enumerated value of several types", "name"),
    "E0206": Code("no such enumerated value", "name"),
    "E0207": Code("function is not declared", "name"),
    "E0208": Code("name means something else here", "name"),
    "E0209": Code("no global variable of that name", "name"),
    "E0210": Code("parameter of a block is not declared", "name"),
    "E0301": Code("value has the wrong type", "type"),
    "E0302": Code("operator does not go with this type", "type"),
    "E0303": Code("operands have different types", "type"),
    "E0304": Code("condition is not BOOL", "type"),
    "E0305": Code("subscript is not an integer", "type"),
    "E0306": Code("wrong number of subscripts", "type"),
    "E0307": Code("no members or elements here", "type"),
    "E0308": Code("CASE of the wrong type", "type"),
    "E0309": Code("FOR of the wrong type", "type"),
    "E0310": Code("no subrange or enumeration of this type", "type"),
    "E0311": Code("VAR_EXTERNAL has another type", "type"),
    "E0312": Code("argument of the wrong type", "type"),
    "E0313": Code("literal needs a type", "type"),
    "E0314": Code("in-out of another type", "type"),
    "E0315": Code("address of another size", "type"),
    "E0401": Code("no such parameter", "call"),
    "E0402": Code("parameter is given twice", "call"),
    "E0403": Code("too many arguments", "call"),
    "E0404": Code("argument is missing", "call"),
    "E0405": Code("in-out is missing", "call"),
    "E0406": Code("in-out needs a variable", "call"),
    "E0407": Code("output is taken with =>", "call"),
    "E0408": Code("input is given with :=", "call"),
    "E0409": Code("no result", "call"),
    "E0410": Code("POU calls itself", "call"),
    "E0411": Code("cannot be called", "call"),
    "E0412": Code("named and unnamed arguments mixed", "call"),
    "E0413": Code("output needs a variable", "call"),
    "E0501": Code("value does not fit the type", "range"),
    "E0502": Code("subscript is out of bounds", "range"),
    "E0503": Code("division by zero", "range"),
    "E0504": Code("value is outside of the subrange", "range"),
    "E0505": Code("value is not constant", "const"),
    "E0506": Code("limits in the wrong order", "range"),
    "E0507": Code("constant cannot be written", "const"),
    "E0508": Code("constant expression has no value", "range"),
    "E0509": Code("string length is out of range", "range"),
    "E0510": Code("FOR with a step of 0", "range"),
    "E0511": Code("global constant needs CONSTANT", "const"),
    "E0601": Code("EXIT or CONTINUE outside of a loop", "flow"),
    "E0602": Code("control variable is written in its loop", "access"),
    "E0603": Code("not a variable", "access"),
    "E0604": Code("cannot be written here", "access"),
    "E0605": Code("cannot be read here", "access"),
    "E0606": Code("cannot be an in-out", "access"),
    "E0701": Code("no initial value here", "decl"),
    "E0702": Code("qualifier does not go with this section", "decl"),
    "E0703": Code("no instance here", "decl"),
    "E0704": Code("no address here", "decl"),
    "E0705": Code("type or block contains itself", "decl"),
    "E0706": Code("instance is named like a function", "decl"),
    "E0707": Code("program is not a type", "decl"),
    "E0708": Code("section does not belong here", "decl"),
    "E0709": Code("initial value has another shape", "type"),
}
