"""Structures whose fields have places of their own: relative addresses and OVERLAP (6.4.4.7, table 11)."""

from __future__ import annotations

from iec2mpy.semantics.packing import bit_size, field_offsets, packed_fields, starts_at_bit
from iec2mpy.semantics.scope import UNKNOWN, Scope
from iec2mpy.semantics.typed import Variable
from iec2mpy.semantics.types import BYTE, ArrayType, StructType
from iec2mpy.source.diagnostics import Related
from iec2mpy.syntax import tree

_BYTE = 8


def relative_offset(scope: Scope, field: tree.StructField) -> int | None:
    """The bit of a structure where a field begins, by its address; None where it has none, or a wrong one, which is
    reported."""
    location = field.location
    if isinstance(location, tree.DirectVariable):
        hint = "Write a place in the structure, such as %B2 or %X2.7."
        scope.diagnostics.add("E0704", f"A member has no address such as {location.text}.", location.span, hint)
        return None
    if location is None:
        return None
    if location.bit >= _BYTE:
        message = f"There is no bit {location.bit} in a byte: its bits are 0 to 7."
        scope.diagnostics.add("E0514", message, location.span)
        return None
    if len(field.names) > 1:
        message = f"`{field.names[1].text}` would be in the same place as `{field.names[0].text}`."
        scope.diagnostics.add("E0719", message, field.names[1].span, "Give each member an address of its own.")
        return None
    return location.byte * _BYTE + location.bit


def lay_out(scope: Scope, t: StructType, spec: tree.StructSpec) -> None:
    """Checks the places of a structure's fields, and gives one with OVERLAP the bytes that its fields share."""
    if any(field.type is UNKNOWN for field in t.fields.values()):
        return
    if not spec.overlap and all(field.relative is None for field in t.fields.values()):
        return
    if not _have_places(scope, t):
        return
    if not spec.overlap:
        _report_overlap(scope, t)
        return
    for declared in spec.fields:
        if declared.initial is not None:
            # 6.4.4.7.2
            message = "A structure with OVERLAP has no initial values: its members share their storage."
            scope.diagnostics.add("E0701", message, declared.initial.span)
    count = -(-(bit_size(t) or 0) // _BYTE)
    initial = packed_fields(t, {key: field.initial for key, field in t.fields.items()})
    bytes_of = ArrayType(BYTE, ((0, max(count, 1) - 1),))
    name = next(iter(t.fields.values()))
    t.storage = Variable("__bytes", bytes_of, None, name.span, tuple(initial.to_bytes(max(count, 1), "little")))


def _have_places(scope: Scope, t: StructType) -> bool:
    """Whether each field can be where it is; the first that cannot is reported."""
    for field in t.fields.values():
        if bit_size(field.type) is None:
            # 6.4.4.7.1 leaves out strings
            problem, hint = "has no place among bytes", "Take it out of the structure."
        elif (field.relative or 0) % _BYTE and not starts_at_bit(field.type):
            problem, hint = "must begin at a byte", "Give it an address such as %B2."
        else:
            continue
        scope.diagnostics.add("E0711", f"`{field.name}` is {field.type}, which {problem}.", field.span, hint)
        return False
    return True


def _report_overlap(scope: Scope, t: StructType) -> None:
    ordered = sorted(field_offsets(t).items(), key=lambda entry: entry[1])
    end, last = 0, None
    for field, offset in ordered:
        if last is not None and offset < end:
            first, second = sorted((last, field), key=lambda f: f.span.start)
            scope.diagnostics.add(
                "E0719",
                f"`{second.name}` and `{first.name}` are in the same place.",
                second.span,
                "Write STRUCT OVERLAP if they shall be.",
                [Related(first.span, f"`{first.name}` is here.")],
            )
            return
        end, last = offset + (bit_size(field.type) or 0), field
