"""The types: the one place that knows what each holds, how wide it is, and where it lives.

Elementary types are a table (table 10); derived types are nominal, and compare by identity, except for arrays and
strings, which compare by what they are made of.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from iec2mpy.semantics.typed import Pou, Value, Variable


class Kind(Enum):
    """The branches of the tree of generic types (figure 5) that behave alike."""

    BOOL = "bool"
    SIGNED = "signed integer"
    UNSIGNED = "unsigned integer"
    BITS = "bit string"
    REAL = "real"
    DURATION = "duration"
    DATE = "date"
    TIME_OF_DAY = "time of day"
    DATE_AND_TIME = "date and time"
    CHARACTER = "character"
    REFERENCE = "reference"


MOMENTS = frozenset((Kind.DATE, Kind.TIME_OF_DAY, Kind.DATE_AND_TIME))
"""Dates and times of day: ANY_DATE of figure 5."""


@dataclass(frozen=True, slots=True)
class ElementaryType:
    """A row of table 10. `low` and `high` bound the values of what is stored as an integer."""

    name: str
    kind: Kind
    bits: int
    low: int
    high: int

    @property
    def in_objects(self) -> bool:
        """Whether a value lives in `O` (a Python object) and not in `V` (a 32-bit slot)."""
        return self.kind is Kind.REAL or self.bits > 32

    @property
    def is_real(self) -> bool:
        """Whether a value is stored as a float."""
        return self.kind is Kind.REAL

    @property
    def is_whole(self) -> bool:
        """Whether a value is stored as an integer, in V or (a wide one) in O."""
        return self.kind is not Kind.REAL

    def __str__(self) -> str:
        return self.name


def _signed(name: str, bits: int, kind: Kind = Kind.SIGNED) -> ElementaryType:
    return ElementaryType(name, kind, bits, -(1 << bits - 1), (1 << bits - 1) - 1)


def _unsigned(name: str, bits: int, kind: Kind) -> ElementaryType:
    return ElementaryType(name, kind, bits, 0, (1 << bits) - 1)


BOOL = _unsigned("BOOL", 1, Kind.BOOL)
SINT = _signed("SINT", 8)
INT = _signed("INT", 16)
DINT = _signed("DINT", 32)
LINT = _signed("LINT", 64)
USINT = _unsigned("USINT", 8, Kind.UNSIGNED)
UINT = _unsigned("UINT", 16, Kind.UNSIGNED)
UDINT = _unsigned("UDINT", 32, Kind.UNSIGNED)
ULINT = _unsigned("ULINT", 64, Kind.UNSIGNED)
BYTE = _unsigned("BYTE", 8, Kind.BITS)
WORD = _unsigned("WORD", 16, Kind.BITS)
DWORD = _unsigned("DWORD", 32, Kind.BITS)
LWORD = _unsigned("LWORD", 64, Kind.BITS)
REAL = ElementaryType("REAL", Kind.REAL, 32, 0, 0)
LREAL = ElementaryType("LREAL", Kind.REAL, 64, 0, 0)
TIME = _signed("TIME", 32, Kind.DURATION)  # milliseconds
LTIME = _signed("LTIME", 64, Kind.DURATION)  # nanoseconds
DATE = ElementaryType("DATE", Kind.DATE, 32, -719_162, 2_932_896)  # days since 1970-01-01, of the years 1 to 9999
TOD = ElementaryType("TOD", Kind.TIME_OF_DAY, 32, 0, 86_400_000 - 1)  # milliseconds
DT = _signed("DT", 64, Kind.DATE_AND_TIME)  # milliseconds since 1970-01-01
LDATE = _signed("LDATE", 64, Kind.DATE)  # nanoseconds since 1970-01-01, whole days
LTOD = ElementaryType("LTOD", Kind.TIME_OF_DAY, 64, 0, 86_400_000_000_000 - 1)  # nanoseconds
LDT = _signed("LDT", 64, Kind.DATE_AND_TIME)  # nanoseconds since 1970-01-01
CHAR = _unsigned("CHAR", 8, Kind.CHARACTER)  # the character's code
WCHAR = _unsigned("WCHAR", 16, Kind.CHARACTER)

NO_RESULT = ElementaryType("no result", Kind.BOOL, 0, 0, 0)
"""What the call of a function without a result gives; such a call stands alone."""

REFERENCE = _unsigned("reference", 30, Kind.REFERENCE)
"""How a reference, or what an in-out stands for, is stored: the V slot in the low 16 bits, the O slot above; 0 is NULL.
No variable is declared so."""

ELEMENTARY: Mapping[str, ElementaryType] = {
    t.name: t
    for t in (
        *(BOOL, SINT, INT, DINT, LINT, USINT, UINT, UDINT, ULINT, BYTE, WORD, DWORD, LWORD),
        *(REAL, LREAL, TIME, LTIME, DATE, TOD, DT, LDATE, LTOD, LDT, CHAR, WCHAR),
    )
}
"""By name, in capitals. STRING and WSTRING have a length, and are `StringType`."""

OTHER_NAMES: Mapping[str, ElementaryType] = {
    "TIME_OF_DAY": TOD,
    "DATE_AND_TIME": DT,
    "LTIME_OF_DAY": LTOD,
    "LDATE_AND_TIME": LDT,
}
"""The long names of types that have a short one (table 10)."""

DEFAULT_STRING_LENGTH = 254


@dataclass(frozen=True, slots=True)
class StringType:
    """STRING, or WSTRING if it is `wide`, of up to `length` characters."""

    length: int = DEFAULT_STRING_LENGTH
    wide: bool = False

    @property
    def name(self) -> str:
        """STRING or WSTRING."""
        return "WSTRING" if self.wide else "STRING"

    @property
    def character(self) -> ElementaryType:
        """The type of each of its characters."""
        return WCHAR if self.wide else CHAR

    @property
    def in_objects(self) -> bool:
        """Whether a value lives in `O`: a string does."""
        return True

    def __str__(self) -> str:
        return self.name if self.length == DEFAULT_STRING_LENGTH else f"{self.name}[{self.length}]"


@dataclass(frozen=True, eq=False, slots=True)
class EnumType:
    """`values`: the number of each name (as declared), in order; `default` a number.

    `open` for a type with named values (`INT (a := 1, b := 2)`): it takes every value of its base, and is used like it
    (6.4.4.3.1). Others take only what is listed, and have no operations but = and <> (6.4.4.2.1).
    """

    name: str
    base: ElementaryType
    values: Mapping[str, int]
    default: int
    open: bool = False

    def __str__(self) -> str:
        return self.name


@dataclass(frozen=True, eq=False, slots=True)
class SubrangeType:
    """`name` is "INT (0..5)" where it has none of its own."""

    name: str
    base: ElementaryType
    low: int
    high: int
    default: int

    def __str__(self) -> str:
        return self.name


@dataclass(frozen=True, slots=True)
class ArrayType:
    """`bounds`: (low, high) of each dimension, both inclusive."""

    element: Type
    bounds: tuple[tuple[int, int], ...]

    @property
    def dimensions(self) -> int:
        return len(self.bounds)

    @property
    def lengths(self) -> tuple[int, ...]:
        return tuple(high - low + 1 for low, high in self.bounds)

    def __str__(self) -> str:
        return f"ARRAY[{', '.join(f'{low}..{high}' for low, high in self.bounds)}] OF {self.element}"


@dataclass(frozen=True, slots=True)
class OpenArrayType:
    """`ARRAY[*, *]`: a parameter that stands for an array with any limits (6.5.3)."""

    element: Type
    dimensions: int

    def __str__(self) -> str:
        return f"ARRAY[{', '.join('*' * self.dimensions)}] OF {self.element}"


@dataclass(eq=False, slots=True)
class StructType:
    """`fields` by their case-folded names, in order. Filled after it is made, as a structure may hold others.

    `storage`: the bytes that the fields share, in one with OVERLAP: it holds these, and nothing else."""

    name: str
    fields: dict[str, Variable] = field(default_factory=dict)
    storage: Variable | None = None

    def __str__(self) -> str:
        return self.name


@dataclass(eq=False, slots=True)
class BlockType:
    """The type of the instances of a function block."""

    name: str
    pou: Pou

    def __str__(self) -> str:
        return self.name


@dataclass(frozen=True, slots=True)
class RefType:
    """REF_TO target (6.4.4.10.1)."""

    target: Type

    def __str__(self) -> str:
        return "NULL" if self.target is NO_RESULT else f"REF_TO {self.target}"


NULL_TYPE = RefType(NO_RESULT)
"""The type of NULL, which every reference can be. It stands in constants only."""


@dataclass(frozen=True, eq=False, slots=True)
class AliasType:
    """`TYPE speed : INT := 5; END_TYPE`: another name, and another initial value, of a type (table 11)."""

    name: str
    target: Type
    default: Value

    def __str__(self) -> str:
        return self.name


Type = (
    ElementaryType
    | StringType
    | EnumType
    | SubrangeType
    | ArrayType
    | OpenArrayType
    | StructType
    | BlockType
    | RefType
    | AliasType
)


def base_type(t: Type) -> Type:
    """The type without aliases, subranges and named values: what operations are chosen by."""
    while isinstance(t, (AliasType, SubrangeType)) or (isinstance(t, EnumType) and t.open):
        t = t.target if isinstance(t, AliasType) else t.base
    return t


def unaliased(t: Type) -> Type:
    """The type without aliases; a subrange stays one."""
    while isinstance(t, AliasType):
        t = t.target
    return t


def value_type(t: Type) -> ElementaryType | StringType | None:
    """The elementary type that a single value is stored as, or None for what has several."""
    t = base_type(t)
    if isinstance(t, EnumType):
        return t.base
    if isinstance(t, RefType):
        return REFERENCE
    return t if isinstance(t, (ElementaryType, StringType)) else None


def value_range(t: Type) -> tuple[int, int] | None:
    """Lowest and highest value of what is stored as an integer, or None for everything else."""
    t = unaliased(t)
    if isinstance(t, SubrangeType):
        return t.low, t.high
    stored = value_type(t)
    if isinstance(stored, ElementaryType) and stored.is_whole:
        return stored.low, stored.high
    return None


def holds_instance(t: Type) -> bool:
    """Whether a variable of the type is, or contains, an instance of a function block."""
    return _holds(t, BlockType)


def holds_reference(t: Type) -> bool:
    """Whether a variable of the type is, or contains, a reference; what stands in an instance does not count."""
    return _holds(t, RefType)


def _holds(t: Type, kind: type) -> bool:
    t = unaliased(t)
    if isinstance(t, ArrayType):
        return _holds(t.element, kind)
    if isinstance(t, StructType):
        return any(_holds(field.type, kind) for field in t.fields.values())
    return isinstance(t, kind)
