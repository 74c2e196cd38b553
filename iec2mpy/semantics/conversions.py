"""Which types go where: sameness, implicit conversions (figures 11 and 12), common types, explicit conversions."""

from __future__ import annotations

from collections.abc import Mapping

from iec2mpy.semantics.types import (
    BOOL,
    BYTE,
    DINT,
    DWORD,
    ELEMENTARY,
    INT,
    LINT,
    LREAL,
    LTIME,
    LTOD,
    LWORD,
    MOMENTS,
    NULL_TYPE,
    OTHER_NAMES,
    REAL,
    SINT,
    TIME,
    TOD,
    UDINT,
    UINT,
    ULINT,
    USINT,
    WORD,
    ArrayType,
    ElementaryType,
    Kind,
    OpenArrayType,
    RefType,
    StringType,
    SubrangeType,
    Type,
    base_type,
    unaliased,
)

UNTYPED_INT = ElementaryType("integer literal", Kind.SIGNED, 0, 0, 0)
UNTYPED_REAL = ElementaryType("real literal", Kind.REAL, 0, 0, 0)
"""The types of literals without a prefix until their context gives them one (6.6.1.6, rule 8). They stand in constants
only, and never in a checked program."""

_WIDER: Mapping[ElementaryType, tuple[ElementaryType, ...]] = {
    SINT: (INT, DINT, LINT, REAL, LREAL),
    INT: (DINT, LINT, REAL, LREAL),
    DINT: (LINT, LREAL),
    USINT: (UINT, INT, UDINT, DINT, ULINT, LINT, REAL, LREAL),
    UINT: (UDINT, DINT, ULINT, LINT, REAL, LREAL),
    UDINT: (ULINT, LINT, LREAL),
    REAL: (LREAL,),
    BOOL: (BYTE, WORD, DWORD, LWORD),
    BYTE: (WORD, DWORD, LWORD),
    WORD: (DWORD, LWORD),
    DWORD: (LWORD,),
    TIME: (LTIME,),
    TOD: (LTOD,),
}
"""Figure 12: the conversions that keep every value; the nearest types first."""

INTEGER_KINDS = frozenset((Kind.SIGNED, Kind.UNSIGNED))
BIT_KINDS = frozenset((Kind.BOOL, Kind.BITS))
NUMBER_KINDS = frozenset((Kind.SIGNED, Kind.UNSIGNED, Kind.REAL))


def is_untyped(t: Type) -> bool:
    return t is UNTYPED_INT or t is UNTYPED_REAL


def is_integer(t: Type) -> bool:
    """Whether a value of the type is an integer number (ANY_INT), subranges and named values included."""
    t = base_type(t)
    return isinstance(t, ElementaryType) and t.kind in INTEGER_KINDS


def is_real(t: Type) -> bool:
    """Whether a value of the type is a real number (ANY_REAL), an untyped one included."""
    t = base_type(t)
    return isinstance(t, ElementaryType) and t.kind is Kind.REAL


def same_type(a: Type, b: Type) -> bool:
    """Whether a variable of one type is one of the other: aliases do not count, array bounds and ranges do."""
    a, b = unaliased(a), unaliased(b)
    if isinstance(a, SubrangeType) and isinstance(b, SubrangeType):
        return (a.base, a.low, a.high) == (b.base, b.low, b.high)
    if isinstance(a, ArrayType) and isinstance(b, ArrayType):
        return a.bounds == b.bounds and same_type(a.element, b.element)
    if isinstance(a, OpenArrayType):
        return False  # two of them may have different limits
    if isinstance(a, RefType) and isinstance(b, RefType):
        return same_type(a.target, b.target)  # a directly derived type is the same (6.4.4.10.1)
    return a == b


def can_stand_for(given: Type, parameter: Type) -> bool:
    """Whether a variable of type `given` can be what an in-out of type `parameter` stands for (6.6.1.6, 6.5.3)."""
    given, parameter = unaliased(given), unaliased(parameter)
    if not isinstance(parameter, OpenArrayType):
        return same_type(given, parameter)
    is_array = isinstance(given, (ArrayType, OpenArrayType))
    return is_array and given.dimensions == parameter.dimensions and same_type(given.element, parameter.element)


def converts_implicitly(source: Type, target: Type) -> bool:
    """Whether a value of type `source` may stand where one of type `target` is needed."""
    source, target = base_type(source), base_type(target)
    if isinstance(target, StringType):
        # of any length: what is too long is cut (6.6.1.2.2); a character is a string of one
        return source is target.character or (isinstance(source, StringType) and source.wide == target.wide)
    if isinstance(source, ElementaryType):
        return source is target or target in _WIDER.get(source, ())
    if source is NULL_TYPE:
        return isinstance(target, RefType)
    return same_type(source, target)


def common_type(a: ElementaryType, b: ElementaryType) -> ElementaryType | None:
    """The least type that both convert to implicitly, or None (6.6.1.6, rule 7)."""
    if a is b:
        return a
    reached = (b, *_WIDER.get(b, ()))
    return next((t for t in (a, *_WIDER.get(a, ())) if t in reached), None)


def joined_type(a: Type, b: Type) -> Type | None:
    """The type that values of both types are brought to where one operation or function takes them."""
    if isinstance(a, ElementaryType) and isinstance(b, ElementaryType):
        return common_type(a, b)
    if isinstance(a, StringType) and converts_implicitly(b, a):
        return b if isinstance(b, StringType) and b.length > a.length else a
    if isinstance(b, StringType) and converts_implicitly(a, b):
        return b
    if converts_implicitly(b, a):
        return a
    return b if converts_implicitly(a, b) else None


def literal_type(value: int) -> ElementaryType | None:
    """The type of an integer literal that no context gives one, or None where no type holds it."""
    return next((t for t in (INT, DINT, UDINT, LINT, ULINT) if t.low <= value <= t.high), None)


_DIRECT_PATTERN = {(REAL, DWORD), (DWORD, REAL), (LREAL, LWORD), (LWORD, LREAL)}


def converts_explicitly(source: ElementaryType | StringType, target: ElementaryType | StringType) -> bool:
    """Whether there is a function SOURCE_TO_TARGET (tables 22 to 25, 27)."""
    if isinstance(source, StringType) or isinstance(target, StringType):
        string, other = (source, target) if isinstance(source, StringType) else (target, source)
        if isinstance(other, StringType) or other.kind in INTEGER_KINDS | MOMENTS or other is BOOL:
            return True
        return isinstance(string, StringType) and other is string.character
    if source is target or (source, target) in _DIRECT_PATTERN:
        return True
    if Kind.CHARACTER in (source.kind, target.kind):
        # a character counts as its code, which is a number or bits
        other = target if source.kind is Kind.CHARACTER else source
        return other.kind in INTEGER_KINDS | {Kind.BITS, Kind.CHARACTER}
    if source.kind in MOMENTS or target.kind in MOMENTS:
        return _converts_moment(source, target)
    # A REAL has no bits to cut or to fill: only DWORD has its width, as LWORD that of an LREAL. BOOL counts as 0 or 1.
    if Kind.REAL in (source.kind, target.kind):
        other = target if source.kind is Kind.REAL else source
        numbers = NUMBER_KINDS | {Kind.DURATION}
        return other.kind in numbers or (other is BOOL and target.kind is Kind.REAL)
    return True


def _converts_moment(source: ElementaryType, target: ElementaryType) -> bool:
    """Table 26, and numbers. What a type does not contain is not made up: a DATE has no time of day."""
    contained = {
        Kind.DATE: {Kind.DATE},
        Kind.TIME_OF_DAY: {Kind.TIME_OF_DAY, Kind.DURATION},
        Kind.DATE_AND_TIME: MOMENTS,
        Kind.DURATION: {Kind.TIME_OF_DAY},
    }
    if (source.kind, target.kind) == (Kind.DATE, Kind.DATE_AND_TIME):
        return True  # the start of the day
    numbers = INTEGER_KINDS | {Kind.BITS}
    return target.kind in contained.get(source.kind, ()) or numbers & {source.kind, target.kind} != set()


def conversion_name(source: Type, target: Type) -> str | None:
    """The name of the function that converts between two types, or None where there is none."""
    source, target = base_type(source), base_type(target)
    if not isinstance(source, (ElementaryType, StringType)) or not isinstance(target, (ElementaryType, StringType)):
        return None
    if is_untyped(source) or not converts_explicitly(source, target):
        return None
    return f"{source.name}_TO_{target.name}"


def type_named(name: str) -> ElementaryType | StringType | None:
    """The elementary type of that name, in any letter case; STRING and WSTRING with their usual length."""
    name = name.upper()
    if name in ("STRING", "WSTRING"):
        return StringType(wide=name == "WSTRING")
    return ELEMENTARY.get(name) or OTHER_NAMES.get(name)
