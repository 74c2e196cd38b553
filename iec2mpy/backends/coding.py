"""How a value looks in its slot, and outside of it: one pair of functions a kind of variable."""

from __future__ import annotations

import struct
from collections.abc import Callable, Mapping

from iec2mpy.backends.forms import pattern
from iec2mpy.semantics import calendar
from iec2mpy.semantics.arithmetic import NANOSECONDS
from iec2mpy.semantics.types import CHAR, ELEMENTARY, MOMENTS, WCHAR, ElementaryType
from iec2mpy.syntax.time_literals import UNITS, value_of

Enum = Mapping[str, int]


def format_duration(prefix: str, nanoseconds: int, smallest: str) -> str:
    """`T#1h30m`, `T#-500ms`, `T#0ms`, `LT#1us5ns`; `smallest`: the unit of 0."""
    left, text = abs(nanoseconds), ""
    for unit, size in UNITS.items():
        count, left = divmod(left, size)
        text += f"{count}{unit}" if count else ""
    return f"{prefix}#{'-' if nanoseconds < 0 else ''}{text or f'0{smallest}'}"


def parse_duration(text: str) -> int:
    """Nanoseconds of a duration such as `T#1s500ms`; raises ValueError."""
    match value_of(text):
        case ("duration", nanoseconds):
            return nanoseconds
        case _:
            raise ValueError(f"{text!r} is no duration such as T#1s500ms")


def _in_range(value: int, low: int, high: int) -> int:
    if not low <= value <= high:
        raise ValueError(f"{value} is not in {low}..{high}")
    return value


def _encode_bool(value: object, _low: int, _high: int, _enum: Enum) -> object:
    if isinstance(value, bool) or (isinstance(value, int) and value in (0, 1)):
        return int(value)
    raise ValueError(f"{value!r} is neither true nor false")


def _encode_wide(value: object, low: int, high: int, _enum: Enum) -> int:
    if isinstance(value, bool) or not isinstance(value, int):
        raise ValueError(f"{value!r} is no integer")
    return _in_range(value, low, high)


def _encode_integer(value: object, low: int, high: int, enum: Enum) -> object:
    return pattern(_encode_wide(value, low, high, enum))


def _encode_real(value: object, low: int, high: int, enum: Enum) -> object:
    try:
        return struct.unpack("<f", struct.pack("<f", _encode_lreal(value, low, high, enum)))[0]
    except OverflowError:
        raise ValueError(f"{value!r} is too large for REAL") from None


def _encode_lreal(value: object, _low: int, _high: int, _enum: Enum) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise ValueError(f"{value!r} is no number")
    try:
        return float(value)
    except OverflowError:
        raise ValueError(f"{value!r} is too large for LREAL") from None


def _encode_ltime(value: object, low: int, high: int, _enum: Enum) -> object:
    if not isinstance(value, str):
        raise ValueError(f"{value!r} is no duration such as T#1s500ms")
    return _in_range(parse_duration(value), low, high)


def _encode_duration(value: object, low: int, high: int, _enum: Enum) -> object:
    if not isinstance(value, str):
        raise ValueError(f"{value!r} is no duration such as T#1s500ms")
    return _in_range(parse_duration(value) // NANOSECONDS, low, high)


def _encode_text(value: object, capacity: int, highest: int) -> str:
    """`highest`: the greatest code that a character may have."""
    if not isinstance(value, str):
        raise ValueError(f"{value!r} is no string")
    if len(value) > capacity:
        raise ValueError(f"{len(value)} characters are more than {capacity}")
    wrong = next((c for c in value if ord(c) > highest), None)
    if wrong is not None:
        raise ValueError(f"its characters go up to {highest:#X}, and {wrong!r} is {ord(wrong):#X}")
    return value


def _encode_string(value: object, _low: int, high: int, _enum: Enum) -> object:
    return _encode_text(value, high, CHAR.high)


def _encode_wstring(value: object, _low: int, high: int, _enum: Enum) -> object:
    return _encode_text(value, high, WCHAR.high)


def _encode_character(value: object, _low: int, high: int, _enum: Enum) -> object:
    text = _encode_text(value, 1, high)
    if not text:
        raise ValueError("it is one character, and here is none")
    return ord(text)


def _encode_enum(value: object, _low: int, _high: int, enum: Enum) -> object:
    names = {name.casefold(): number for name, number in enum.items()}
    if isinstance(value, str) and value.rpartition("#")[2].casefold() in names:
        return names[value.rpartition("#")[2].casefold()]
    raise ValueError(f"{value!r} is none of {', '.join(enum)}")


def _encode_reference(value: object, _low: int, _high: int, _enum: Enum) -> object:
    if isinstance(value, str) and value.upper() == "NULL":
        return 0
    raise ValueError(f"{value!r} is not NULL, and nothing else can be given to a reference from outside")


def _decode_enum(raw: object, enum: Enum) -> object:
    return next((name for name, number in enum.items() if number == raw), raw)


def _encode_moment(of: ElementaryType, value: object, low: int, high: int) -> object:
    example = calendar.text(0, of)
    if not isinstance(value, str):
        raise ValueError(f"{value!r} is no literal such as {example}")
    try:
        return _in_range(calendar.parse(value, of), low, high)
    except ValueError:
        raise ValueError(f"{value!r} is no literal such as {example}, or not one of its values") from None


def _moment_coders(
    of: ElementaryType,
) -> tuple[Callable[[object, Enum], object], Callable[[object, int, int, Enum], object]]:
    return (
        lambda raw, _: calendar.text(_as_int(raw), of),
        lambda value, low, high, _: _encode_moment(of, value, low, high),
    )


_CODERS: Mapping[str, tuple[Callable[[object, Enum], object], Callable[[object, int, int, Enum], object]]] = {
    "bool": (lambda raw, _: bool(raw), _encode_bool),
    "integer": (lambda raw, _: raw, _encode_integer),
    "unsigned32": (lambda raw, _: _as_int(raw) & 0xFFFFFFFF, _encode_integer),
    "integer64": (lambda raw, _: raw, _encode_wide),
    "real": (lambda raw, _: raw, _encode_real),
    "lreal": (lambda raw, _: raw, _encode_lreal),
    "duration": (lambda raw, _: format_duration("T", _as_int(raw) * NANOSECONDS, "ms"), _encode_duration),
    "ltime": (lambda raw, _: format_duration("LT", _as_int(raw), "ns"), _encode_ltime),
    "string": (lambda raw, _: raw, _encode_string),
    "wstring": (lambda raw, _: raw, _encode_wstring),
    "character": (lambda raw, _: chr(_as_int(raw)), _encode_character),
    "enum": (_decode_enum, _encode_enum),
    "reference": (lambda raw, _: "not NULL" if raw else "NULL", _encode_reference),
    **{t.name.lower(): _moment_coders(t) for t in ELEMENTARY.values() if t.kind in MOMENTS},
}


def _as_int(raw: object) -> int:
    assert isinstance(raw, int)
    return raw


def decode(kind: str, raw: object, enum: Enum) -> object:
    """The value of a slot as it is shown: bool, int, float, str; a duration, a date and a time of day as their
    literals, an enumeration as its name."""
    return _CODERS[kind][0](raw, enum)


def encode(kind: str, value: object, low: int, high: int, enum: Enum) -> object:
    """The raw form of a value that is shown so; raises ValueError where the variable cannot have it."""
    return _CODERS[kind][1](value, low, high, enum)
