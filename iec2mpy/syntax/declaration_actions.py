"""Actions of the rules for types, variables and configurations (6.4 to 6.8)."""

from __future__ import annotations

from typing import Any

from iec2mpy.source.diagnostics import Diagnostics
from iec2mpy.source.dialects import accepts, require
from iec2mpy.syntax import tree
from iec2mpy.syntax.actions import action, name_of, not_supported, over
from iec2mpy.syntax.tokens import Token

# --------------------------------------------------------------------------------------------------- types


@action
def identifier(values: list[Any], _diagnostics: Diagnostics) -> tree.Name:
    return name_of(values[0])


@action
def qualified(values: list[Any], _diagnostics: Diagnostics) -> tree.Name:
    base, _, token = values
    return tree.Name(f"{base.text}.{token.text}", over(base, token))


@action
def named_type(values: list[Any], _diagnostics: Diagnostics) -> tree.NamedTypeSpec:
    return tree.NamedTypeSpec(values[0], values[0].span)


def _is_wide(token: Token) -> bool:
    return token.text.upper() == "WSTRING"


@action
def string(values: list[Any], _diagnostics: Diagnostics) -> tree.StringSpec:
    return tree.StringSpec(_is_wide(values[0]), None, values[0].span)


@action
def sized_string(values: list[Any], diagnostics: Diagnostics) -> tree.StringSpec:
    word, opening, length, closing = values
    if opening.type == "LPAR":
        message = f"The length of a {word.text.upper()} stands in square brackets."
        instead = f"Such as `{word.text}[{length.span.text}]`."
        require("string-in-parentheses", diagnostics, "E0121", message, opening.span, instead)
    return tree.StringSpec(_is_wide(word), length, over(word, closing))


@action
def subrange(values: list[Any], _diagnostics: Diagnostics) -> tree.SubrangeSpec:
    base, _, low, _, high, closing = values
    return tree.SubrangeSpec(base, low, high, over(base, closing))


@action
def based_enum(values: list[Any], _diagnostics: Diagnostics) -> tree.EnumSpec:
    base, _, items, closing = values
    return tree.EnumSpec(base, tuple(items), over(base, closing))


@action
def enum(values: list[Any], _diagnostics: Diagnostics) -> tree.EnumSpec:
    opening, items, closing = values
    return tree.EnumSpec(None, tuple(items), over(opening, closing))


@action
def plain_item(values: list[Any], _diagnostics: Diagnostics) -> tree.EnumItem:
    return tree.EnumItem(name_of(values[0]), None, values[0].span)


@action
def enum_item(values: list[Any], _diagnostics: Diagnostics) -> tree.EnumItem:
    token, _, value = values
    return tree.EnumItem(name_of(token), value, over(token, value))


@action
def array(values: list[Any], _diagnostics: Diagnostics) -> tree.ArraySpec:
    word, _, bounds, _, _, element = values
    return tree.ArraySpec(tuple(bounds), element, over(word, element))


@action
def bound(values: list[Any], _diagnostics: Diagnostics) -> tree.ArrayBound:
    low, _, high = values
    return tree.ArrayBound(low, high, over(low, high))


@action
def open_bound(values: list[Any], _diagnostics: Diagnostics) -> tree.ArrayBound:
    return tree.ArrayBound(None, None, values[0].span)


@action
def struct(values: list[Any], _diagnostics: Diagnostics) -> tree.StructSpec:
    word, fields, end = values
    return tree.StructSpec(tuple(fields), False, over(word, end))


@action
def overlapping_struct(values: list[Any], _diagnostics: Diagnostics) -> tree.StructSpec:
    word, _, fields, end = values
    return tree.StructSpec(tuple(fields), True, over(word, end))


@action
def field(values: list[Any], _diagnostics: Diagnostics) -> tree.StructField:
    names, _, type_spec, initial, end = values
    return tree.StructField(tuple(names), None, type_spec, initial, over(names[0], initial or type_spec or end))


@action
def located_field(values: list[Any], _diagnostics: Diagnostics) -> tree.StructField:
    names, _, location, _, type_spec, initial, _ = values
    return tree.StructField(tuple(names), location, type_spec, initial, over(names[0], initial or type_spec))


@action
def reference_type(values: list[Any], _diagnostics: Diagnostics) -> tree.TypeSpec:
    word, target = values
    return tree.RefSpec(target, over(word, target))


@action
def error_type(values: list[Any], _diagnostics: Diagnostics) -> tree.TypeSpec:
    """In place of a type that could not be read."""
    return tree.NamedTypeSpec(tree.Name("INT", values[0].span), values[0].span)


@action
def one_name(values: list[Any], _diagnostics: Diagnostics) -> list[tree.Name]:
    return [name_of(values[0])]


@action
def further_name(values: list[Any], _diagnostics: Diagnostics) -> list[tree.Name]:
    names, _, token = values
    names.append(name_of(token))
    return names


# ------------------------------------------------------------------------------------------- initial values


@action
def initial_items(values: list[Any], diagnostics: Diagnostics) -> tree.Initial | None:
    """What stands behind `:=`. Several values, or `3(0)`, are an array whose brackets are left out."""
    sign, items = values
    if not items or (len(items) == 1 and not isinstance(items[0], tree.Repeat)):
        return items[0] if items else None
    message = "The initial values of an array stand in square brackets."
    span = over(items[0], items[-1])
    require("bare-array", diagnostics, "E0129", message, sign.span, "Such as `[1, 2, 3]`.")
    return tree.ArrayInitial(tuple(items), span)


@action
def array_initial(values: list[Any], _diagnostics: Diagnostics) -> tree.ArrayInitial:
    opening, items, closing = values
    return tree.ArrayInitial(tuple(items), over(opening, closing))


@action
def repeat(values: list[Any], _diagnostics: Diagnostics) -> tree.Repeat:
    """`3(0)`, `3()` (6.4.4.5.2)."""
    count, closing = values[0], values[-1]
    repeated = values[2] if len(values) == 4 else []
    return tree.Repeat(count.value, tuple(repeated), over(count, closing))


@action
def repeated_struct(values: list[Any], _diagnostics: Diagnostics) -> tree.Repeat:
    """`50(PT := T#1s)`: the brackets are those of the repetition and of the structure at once (6.6.3.4)."""
    count, opening, fields, closing = values
    return tree.Repeat(count.value, (tree.StructInitial(tuple(fields), over(opening, closing)),), over(count, closing))


@action
def struct_initial(values: list[Any], _diagnostics: Diagnostics) -> tree.StructInitial:
    opening, fields, closing = values
    return tree.StructInitial(tuple(fields), over(opening, closing))


@action
def field_value(values: list[Any], _diagnostics: Diagnostics) -> tree.FieldInitial:
    token, _, value = values
    return tree.FieldInitial(name_of(token), value, over(token, value))


@action
def type_block(values: list[Any], diagnostics: Diagnostics) -> list[tree.TypeDecl]:
    word, declarations, end = values
    if not declarations and not diagnostics.has_errors:
        diagnostics.add("E0119", "This TYPE declares nothing.", over(word, end), "Such as `Speed : INT;`.")
    return declarations


@action
def type_declaration(values: list[Any], _diagnostics: Diagnostics) -> tree.TypeDecl:
    token, _, type_spec, initial, _ = values
    return tree.TypeDecl(name_of(token), type_spec, initial, over(token, initial or type_spec))


# ----------------------------------------------------------------------------------------------- variables


@action
def section(values: list[Any], diagnostics: Diagnostics) -> tree.VarSection:
    word, qualifiers, variables, end = values
    kind = tree.Section(word.type)
    retention: tree.Retention | None = None
    if kind is tree.Section.STATIC:
        message = f"`{word.text}` is no section of the standard."
        require("static-variables", diagnostics, "E0129", message, word.span, "Write VAR, in a block or a program.")
    for token in qualifiers:
        if token.type == "ACCESS":
            not_supported("E0904", f"Access specifiers (`{token.text}`) are", token.span, diagnostics)
        elif token.type != "CONSTANT":
            retention = tree.Retention(token.type)
    constant = any(token.type == "CONSTANT" for token in qualifiers)
    if kind is tree.Section.INPUT and accepts(word.file, "constant-input"):
        constant = False  # a constant only for whoever calls it in a drawing: its value comes from outside
    return tree.VarSection(kind, constant, retention, tuple(variables), over(word, end))


@action
def variable(values: list[Any], _diagnostics: Diagnostics) -> tree.VarDecl:
    names, _, type_spec, initial, _ = values
    return tree.VarDecl(tuple(names), None, type_spec, initial, over(names[0], initial or type_spec))


@action
def edge_variable(values: list[Any], _diagnostics: Diagnostics) -> tree.VarDecl:
    names, _, type_spec, edge, _ = values
    return tree.VarDecl(tuple(names), None, type_spec, None, over(names[0], edge), tree.Edge(edge.type))


@action
def located_variable(values: list[Any], diagnostics: Diagnostics) -> tree.VarDecl:
    names, _, location, _, type_spec, initial, _ = values
    location = _absolute(location, diagnostics)
    return tree.VarDecl(tuple(names), location, type_spec, initial, over(names[0], initial or type_spec))


def _absolute(
    location: tree.DirectVariable | tree.RelativeAddress | None, diagnostics: Diagnostics
) -> tree.DirectVariable | None:
    """The address of a variable; one relative to a structure is reported, and stands for any."""
    if not isinstance(location, tree.RelativeAddress):
        return location
    message = f"`{location.span.text}` is a place in a structure, and no address of a variable."
    diagnostics.add("E0111", message, location.span, "Such as %IX0.0, %QW3, %MD48.")
    return tree.DirectVariable("M", "X", (0,), location.span)


@action
def nameless_variable(values: list[Any], diagnostics: Diagnostics) -> tree.VarDecl:
    word, location, _, type_spec, initial, _ = values
    location = _absolute(location, diagnostics)
    return tree.VarDecl((), location, type_spec, initial, over(word, initial or type_spec))


# ------------------------------------------------------------------------------------------ configurations


@action
def configuration(values: list[Any], _diagnostics: Diagnostics) -> tree.ConfigurationDecl:
    word, token, items, end = values
    resources = tuple(item for item in items if isinstance(item, tree.ResourceDecl))
    own = _members([item for item in items if not isinstance(item, tree.ResourceDecl)])
    sections, tasks, programs = own
    if tasks or programs:  # 6.8.1: the name of the only resource can be left out
        everything = (*tasks, *programs)
        first = min(everything, key=lambda item: item.span.start)
        last = max(everything, key=lambda item: item.span.end)
        resources = (tree.ResourceDecl(None, None, (), tasks, programs, over(first, last)), *resources)
    return tree.ConfigurationDecl(name_of(token), sections, resources, over(word, end))


def _members(
    items: list[Any],
) -> tuple[tuple[tree.VarSection, ...], tuple[tree.TaskDecl, ...], tuple[tree.ProgramDecl, ...]]:
    return (
        tuple(item for item in items if isinstance(item, tree.VarSection)),
        tuple(item for item in items if isinstance(item, tree.TaskDecl)),
        tuple(item for item in items if isinstance(item, tree.ProgramDecl)),
    )


@action
def resource(values: list[Any], _diagnostics: Diagnostics) -> tree.ResourceDecl:
    word, token, _, type_token, items, end = values
    sections, tasks, programs = _members(items)
    return tree.ResourceDecl(name_of(token), name_of(type_token), sections, tasks, programs, over(word, end))


@action
def task(values: list[Any], diagnostics: Diagnostics) -> tree.TaskDecl:
    word, token, _, arguments, closing, _ = values
    span = over(word, closing)
    if not any(argument.name is not None and argument.name.key == "priority" for argument in arguments):
        # the grammar of table 63 has SINGLE and INTERVAL as optional, and PRIORITY not
        diagnostics.add(
            "E0123", f"The task `{token.text}` has no PRIORITY.", span, "Write `PRIORITY := 1`; 0 is the most urgent."
        )
    return tree.TaskDecl(name_of(token), tuple(arguments), span)


@action
def program(values: list[Any], _diagnostics: Diagnostics) -> tree.ProgramDecl:
    word, retention, token, task_name, _, type_name, *rest = values
    connections = rest[1] if len(rest) == 4 else []
    return tree.ProgramDecl(
        name_of(token),
        tree.Retention(retention.type) if retention else None,
        name_of(task_name) if task_name else None,
        type_name,
        tuple(connections),
        over(word, rest[-2] if len(rest) == 4 else type_name),
    )


@action
def connection_input(values: list[Any], _diagnostics: Diagnostics) -> tree.Argument:
    target, _, value = values
    return tree.Argument(target, value, False, False, over(target, value))


@action
def connection_output(values: list[Any], _diagnostics: Diagnostics) -> tree.Argument:
    target, _, value = values
    return tree.Argument(target, value, True, False, over(target, value))


@action
def block_task(values: list[Any], diagnostics: Diagnostics) -> None:
    block, _, token = values
    not_supported(
        "E0913", f"A task for a single block (`{block.text} WITH {token.text}`) is", over(block, token), diagnostics
    )
