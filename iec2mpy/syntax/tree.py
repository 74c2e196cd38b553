"""The syntax tree, as the parsers leave it: names are text, nothing has a type yet.

Every node has the span of its text. Names are kept as written; whoever compares them uses `str.casefold`
(identifiers are not case-sensitive: 6.1.2).
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from iec2mpy.source.spans import Span

# --------------------------------------------------------------------------------------------------- names


@dataclass(frozen=True, slots=True)
class Name:
    """An identifier, or a qualified one (`a.b`), at its place."""

    text: str
    span: Span

    @property
    def key(self) -> str:
        return self.text.casefold()


# --------------------------------------------------------------------------------------------- expressions


@dataclass(frozen=True, slots=True)
class Literal:
    """A literal. `prefix` is the type name before `#` as written, if any (`INT#5`, `T#1s` has the prefix `T`).

    `value`: bool; int (also based literals); float; str (decoded characters); for durations an int of
    nanoseconds; for dates, times of day and date-and-times an int of nanoseconds since midnight or 1970.
    `kind`: "bool", "int", "real", "string", "wstring", "duration", "date", "tod", "dt", "null".
    """

    kind: str
    value: bool | int | float | str
    prefix: str | None
    span: Span


@dataclass(frozen=True, slots=True)
class NameExpr:
    """A name alone: a variable, an enumerated value, or the name of a POU where it is called."""

    name: str
    span: Span


@dataclass(frozen=True, slots=True)
class TypedEnumValue:
    """`Colour#red` (table 11)."""

    type_name: Name
    value: Name
    span: Span


@dataclass(frozen=True, slots=True)
class DirectVariable:
    """`%IX0.0`. `area` is I, Q or M; `size` X, B, W, D, L (X where none is written); `path` the numbers."""

    area: str
    size: str
    path: tuple[int, ...]
    span: Span

    @property
    def text(self) -> str:
        """The address in its one normal form: `%IX0.0`."""
        return f"%{self.area}{self.size}{'.'.join(map(str, self.path))}"


@dataclass(frozen=True, slots=True)
class MemberExpr:
    """`base.name`."""

    base: Expr
    name: Name
    span: Span


@dataclass(frozen=True, slots=True)
class PartExpr:
    """Partial access of a bit string: `base.%X3`, `base.%B1`; `base.3` has the size X (table 17)."""

    base: Expr
    size: str
    index: int
    span: Span


@dataclass(frozen=True, slots=True)
class IndexExpr:
    """`base[i, j]`."""

    base: Expr
    indices: tuple[Expr, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class DerefExpr:
    """`base^`."""

    base: Expr
    span: Span


@dataclass(frozen=True, slots=True)
class RefExpr:
    """`REF(operand)`."""

    operand: Expr
    span: Span


@dataclass(frozen=True, slots=True)
class Argument:
    """One actual parameter: `value` alone, `name := value`, or `name => target` (`NOT name => target`).

    `value` is None where nothing is written after `:=` or `=>`.
    """

    name: Name | None
    value: Expr | None
    is_output: bool
    negated: bool
    span: Span


@dataclass(frozen=True, slots=True)
class CallExpr:
    """`callee(arguments)`: a function, a block instance, a method. `AND(a, b)` and its like have a NameExpr too."""

    callee: Expr
    arguments: tuple[Argument, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class UnaryExpr:
    """`operator`: "-", "+", "NOT"."""

    operator: str
    operand: Expr
    span: Span


@dataclass(frozen=True, slots=True)
class BinaryExpr:
    """`operator`: + - * / ** MOD AND OR XOR = <> < > <= >= (`&` is AND). `operator_span` is its own place."""

    operator: str
    left: Expr
    right: Expr
    operator_span: Span
    span: Span


Expr = (
    Literal
    | NameExpr
    | TypedEnumValue
    | DirectVariable
    | MemberExpr
    | PartExpr
    | IndexExpr
    | DerefExpr
    | RefExpr
    | CallExpr
    | UnaryExpr
    | BinaryExpr
)

# ---------------------------------------------------------------------------------------------- statements


@dataclass(frozen=True, slots=True)
class AssignStmt:
    """`target := value;`"""

    target: Expr
    value: Expr
    span: Span


@dataclass(frozen=True, slots=True)
class AttemptStmt:
    """`target ?= value;` (6.6.6.7)"""

    target: Expr
    value: Expr
    span: Span


@dataclass(frozen=True, slots=True)
class CallStmt:
    """A call that stands alone."""

    call: CallExpr
    span: Span


@dataclass(frozen=True, slots=True)
class Branch:
    """A condition with what runs under it."""

    condition: Expr
    body: tuple[Stmt, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class IfStmt:
    """IF and its ELSIFs in order; `otherwise` is None where there is no ELSE."""

    branches: tuple[Branch, ...]
    otherwise: tuple[Stmt, ...] | None
    span: Span


@dataclass(frozen=True, slots=True)
class LabelRange:
    """`low..high` as a CASE label."""

    low: Expr
    high: Expr
    span: Span


@dataclass(frozen=True, slots=True)
class CaseGroup:
    """Labels with the statements that they select."""

    labels: tuple[Expr | LabelRange, ...]
    body: tuple[Stmt, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class CaseStmt:
    selector: Expr
    groups: tuple[CaseGroup, ...]
    otherwise: tuple[Stmt, ...] | None
    span: Span


@dataclass(frozen=True, slots=True)
class ForStmt:
    """`step` is None where no BY is written (then it is 1)."""

    control: Expr
    start: Expr
    end: Expr
    step: Expr | None
    body: tuple[Stmt, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class WhileStmt:
    condition: Expr
    body: tuple[Stmt, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class RepeatStmt:
    body: tuple[Stmt, ...]
    until: Expr
    span: Span


@dataclass(frozen=True, slots=True)
class ExitStmt:
    span: Span


@dataclass(frozen=True, slots=True)
class ContinueStmt:
    span: Span


@dataclass(frozen=True, slots=True)
class ReturnStmt:
    span: Span


Stmt = (
    AssignStmt
    | AttemptStmt
    | CallStmt
    | IfStmt
    | CaseStmt
    | ForStmt
    | WhileStmt
    | RepeatStmt
    | ExitStmt
    | ContinueStmt
    | ReturnStmt
)

# ---------------------------------------------------------------------------------- types and initial values


@dataclass(frozen=True, slots=True)
class NamedTypeSpec:
    """A type by its name."""

    name: Name
    span: Span


@dataclass(frozen=True, slots=True)
class StringSpec:
    """`STRING`, `STRING[n]`, `WSTRING[n]`."""

    wide: bool
    length: Expr | None
    span: Span


@dataclass(frozen=True, slots=True)
class SubrangeSpec:
    """`INT (low..high)`."""

    base: Name
    low: Expr
    high: Expr
    span: Span


@dataclass(frozen=True, slots=True)
class EnumItem:
    """`name` or `name := value`."""

    name: Name
    value: Expr | None
    span: Span


@dataclass(frozen=True, slots=True)
class EnumSpec:
    """`(a, b := 3)`, with a base type where one is written (`INT (a := 1, b)`)."""

    base: Name | None
    items: tuple[EnumItem, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class ArrayBound:
    """`low..high`; both None for `*`."""

    low: Expr | None
    high: Expr | None
    span: Span


@dataclass(frozen=True, slots=True)
class ArraySpec:
    bounds: tuple[ArrayBound, ...]
    element: TypeSpec
    span: Span


@dataclass(frozen=True, slots=True)
class RefSpec:
    """`REF_TO target`."""

    target: TypeSpec
    span: Span


@dataclass(frozen=True, slots=True)
class RelativeAddress:
    """`%B2`, `%X3.7`: a place from the start of a structure, `byte` bytes on and in it `bit` bits (6.4.4.7.1)."""

    byte: int
    bit: int
    span: Span


@dataclass(frozen=True, slots=True)
class StructField:
    """`names AT location : type := initial`."""

    names: tuple[Name, ...]
    location: DirectVariable | RelativeAddress | None
    type: TypeSpec
    initial: Initial | None
    span: Span


@dataclass(frozen=True, slots=True)
class StructSpec:
    """`overlap`: the fields may share storage."""

    fields: tuple[StructField, ...]
    overlap: bool
    span: Span


TypeSpec = NamedTypeSpec | StringSpec | SubrangeSpec | EnumSpec | ArraySpec | StructSpec | RefSpec


@dataclass(frozen=True, slots=True)
class Repeat:
    """`count(value, …)` inside an array's initial value; an empty `values` means the default value."""

    count: Expr
    values: tuple[Initial | Repeat, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class ArrayInitial:
    """`[1, 2, 3(0)]`."""

    items: tuple[Initial | Repeat, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class FieldInitial:
    name: Name
    value: Initial
    span: Span


@dataclass(frozen=True, slots=True)
class StructInitial:
    """`(a := 1, b := 2)`, for structures and for instances."""

    fields: tuple[FieldInitial, ...]
    span: Span


Initial = Expr | ArrayInitial | StructInitial

# -------------------------------------------------------------------------------------------- declarations


class Section(Enum):
    """The keyword that starts a section of variables."""

    VAR = "VAR"
    INPUT = "VAR_INPUT"
    OUTPUT = "VAR_OUTPUT"
    IN_OUT = "VAR_IN_OUT"
    TEMP = "VAR_TEMP"
    STATIC = "VAR_STAT"
    GLOBAL = "VAR_GLOBAL"
    EXTERNAL = "VAR_EXTERNAL"


class Retention(Enum):
    RETAIN = "RETAIN"
    NON_RETAIN = "NON_RETAIN"


class Edge(Enum):
    """Which change of an input its block sees (6.6.3.5.3)."""

    RISING = "R_EDGE"
    FALLING = "F_EDGE"


@dataclass(frozen=True, slots=True)
class VarDecl:
    """`a, b AT %IX0.0 : TYPE := initial`, or `a, b : BOOL R_EDGE`. `names` is empty for `AT %IX0.0 : BOOL` without a
    name."""

    names: tuple[Name, ...]
    location: DirectVariable | None
    type: TypeSpec
    initial: Initial | None
    span: Span
    edge: Edge | None = None


@dataclass(frozen=True, slots=True)
class VarSection:
    section: Section
    constant: bool
    retention: Retention | None
    declarations: tuple[VarDecl, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class TypeDecl:
    """One type of a TYPE … END_TYPE."""

    name: Name
    type: TypeSpec
    initial: Initial | None
    span: Span


class PouKind(Enum):
    FUNCTION = "FUNCTION"
    FUNCTION_BLOCK = "FUNCTION_BLOCK"
    PROGRAM = "PROGRAM"


@dataclass(frozen=True, slots=True)
class PouDecl:
    """A program organization unit. `result` is the type of a function's result."""

    kind: PouKind
    name: Name
    result: TypeSpec | None
    sections: tuple[VarSection, ...]
    body: tuple[Stmt, ...]
    span: Span
    """From the first keyword to the end of END_…; `end` is the place of the END_ keyword itself."""
    end: Span


@dataclass(frozen=True, slots=True)
class TaskDecl:
    """`TASK name (INTERVAL := …, PRIORITY := …)`; arguments in the order written."""

    name: Name
    arguments: tuple[Argument, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class ProgramDecl:
    """`PROGRAM [RETAIN] name WITH task : type;` `connections` are what stands in brackets behind the type."""

    name: Name
    retention: Retention | None
    task: Name | None
    type: Name
    connections: tuple[Argument, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class ResourceDecl:
    """RESOURCE … END_RESOURCE; name and type are None where a configuration has no RESOURCE of its own."""

    name: Name | None
    type: Name | None
    sections: tuple[VarSection, ...]
    tasks: tuple[TaskDecl, ...]
    programs: tuple[ProgramDecl, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class ConfigurationDecl:
    name: Name
    sections: tuple[VarSection, ...]
    resources: tuple[ResourceDecl, ...]
    span: Span


Declaration = TypeDecl | PouDecl | ConfigurationDecl | VarSection
"""What stands in a file. A VarSection here is a VAR_GLOBAL outside of any CONFIGURATION."""


@dataclass(frozen=True, slots=True)
class CompilationUnit:
    """All of one file, in its order."""

    declarations: tuple[Declaration, ...]
