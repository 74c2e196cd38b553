"""The intermediate representation: typed, structured, and the same for all five languages.

Expressions are pure: they read variables and locals, and may fault, but change nothing. Whatever has an effect is a
statement, so the order of evaluation is the order of statements, and it is decided in one place: the builder.

Integers are mathematical: `add`, `sub`, `mul` give the exact result, and `Wrap` brings it into its type. A value that
is neither a wrapped one nor inside its type's range stands only below another `add`, `sub`, `mul` or a `Wrap`.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from iec2mpy.semantics.typed import Pou, Scalar, Task, Variable
from iec2mpy.semantics.types import REFERENCE, ElementaryType, RefType, StringType, Type, unaliased
from iec2mpy.source.spans import Span

ValueType = ElementaryType | StringType
"""The type of an expression: what a single value is stored as."""

# ------------------------------------------------------------------------------------------------ places


@dataclass(frozen=True, slots=True)
class Global:
    """A variable of the configuration, or a located one."""

    variable: Variable


@dataclass(frozen=True, slots=True)
class Self:
    """The instance of the block or program whose body this is."""

    pou: Pou


@dataclass(frozen=True, slots=True)
class Frame:
    """What a POU holds only while it runs: all of a function, VAR_TEMP of the others. One for all instances."""

    pou: Pou


@dataclass(frozen=True, slots=True)
class Deref:
    """What an in-out stands for, or what a reference refers to: a variable of that declared type. `reference` is not
    NULL: for an in-out a Load of its own slot, else checked by a Guard."""

    reference: Expr
    type: Type


@dataclass(frozen=True, slots=True)
class Field:
    """A variable of an instance, a frame or a structure."""

    variable: Variable


@dataclass(frozen=True, slots=True)
class Element:
    """An element of an array, by its number from 0, whatever the dimensions."""

    index: Expr


Root = Global | Self | Frame | Deref
Step = Field | Element


@dataclass(frozen=True, slots=True)
class Place:
    """Where a value lives. `type` is the declared type of what is there, without aliases."""

    root: Root
    steps: tuple[Step, ...]
    type: Type


def storage_type(variable: Variable) -> Type:
    """The type of what a variable itself holds, without aliases: an in-out holds a reference, an ARRAY[*] too."""
    return RefType(variable.type) if variable.by_reference else unaliased(variable.type)


# ------------------------------------------------------------------------------------------- expressions


@dataclass(frozen=True, slots=True)
class Const:
    value: Scalar
    type: ValueType

    @property
    def number(self) -> int:
        """The value of a constant that is stored as an integer."""
        assert isinstance(self.value, int)
        return self.value


@dataclass(frozen=True, slots=True)
class Local:
    """A temporary of a body. `low` and `high` are proven bounds of an integer, or None."""

    number: int
    type: ValueType
    low: int | None = None
    high: int | None = None


@dataclass(frozen=True, slots=True)
class Load:
    place: Place
    type: ValueType


@dataclass(frozen=True, slots=True)
class Ref:
    """A reference to the place."""

    place: Place
    type: ValueType = REFERENCE


@dataclass(frozen=True, slots=True)
class Now:
    """The controller's time, fixed when its task started."""

    type: ValueType


@dataclass(frozen=True, slots=True)
class Op:
    """An operation of two operands, both of `operands`' type; `type` is the result's.

    add sub mul div mod (integers: div truncates, mod has the sign of the dividend, and the divisor is not 0; real
    numbers: add sub mul div); and or xor (BOOL, bit strings); shl shr (zeros come in), rol ror (the right operand of
    all four is a count in V, below the width, or of 64 bits any); eq ne lt gt le ge (give BOOL).
    """

    name: str
    left: Expr
    right: Expr
    type: ValueType


@dataclass(frozen=True, slots=True)
class Not:
    """The complement of a BOOL or bit string."""

    operand: Expr
    type: ValueType


@dataclass(frozen=True, slots=True)
class Wrap:
    """The operand modulo 2^n, in the range of `type` (an integer, bit string or duration), and where that type lives:
    it takes a number from V to O and back, too."""

    operand: Expr
    type: ValueType


@dataclass(frozen=True, slots=True)
class ToReal:
    """An integer, a REAL or an LREAL as a REAL or LREAL, which holds it."""

    operand: Expr
    type: ValueType


@dataclass(frozen=True, slots=True)
class Select:
    """`then` if the condition holds, else `otherwise`; both are of `type`."""

    condition: Expr
    then: Expr
    otherwise: Expr
    type: ValueType


@dataclass(frozen=True, slots=True)
class Intrinsic:
    """A call of a function of the runtime (`ir/intrinsics.py`)."""

    name: str
    arguments: tuple[Expr, ...]
    type: ValueType


Expr = Const | Local | Load | Ref | Now | Op | Not | Wrap | ToReal | Select | Intrinsic

ARITHMETIC = frozenset({"add", "sub", "mul"})
SHIFTS = frozenset({"shl", "shr", "rol", "ror"})
COMPARISONS = {"eq": "==", "ne": "!=", "lt": "<", "gt": ">", "le": "<=", "ge": ">="}

# -------------------------------------------------------------------------------------------- statements


@dataclass(frozen=True, slots=True)
class Site:
    """A source line that may raise a fault."""

    span: Span
    pou: Pou


@dataclass(frozen=True, slots=True)
class Line:
    """Says that what follows comes from this source line: for the reader, and for the map."""

    span: Span


@dataclass(frozen=True, slots=True)
class Store:
    place: Place
    value: Expr


@dataclass(frozen=True, slots=True)
class SetLocal:
    local: Local
    value: Expr


@dataclass(frozen=True, slots=True)
class Copy:
    """All of an array or structure. The two have the same type."""

    target: Place
    source: Place


@dataclass(frozen=True, slots=True)
class Compare:
    """Sets a BOOL local: whether two whole arrays or structures of one type are equal."""

    local: Local
    left: Place
    right: Place


@dataclass(frozen=True, slots=True)
class Bind:
    """Makes an in-out stand for a place."""

    reference: Place
    target: Place


@dataclass(frozen=True, slots=True)
class Reset:
    """Gives a variable of a frame its initial value."""

    place: Place
    value: object


@dataclass(frozen=True, slots=True)
class Call:
    """Runs a body. `instance` is None for a function."""

    pou: Pou
    instance: Place | None


@dataclass(frozen=True, slots=True)
class Part:
    """Runs statements of this body that stand in a function of their own. Only the backends make parts, from 1."""

    number: int


@dataclass(frozen=True, slots=True)
class Guard:
    """Raises a fault where the condition holds. `fault`: zero, index, range, NULL."""

    condition: Expr
    fault: str
    site: Site


@dataclass(frozen=True, slots=True)
class Mark:
    """Notes the place before a statement whose expressions may fault by themselves (intrinsics)."""

    site: Site


@dataclass(frozen=True, slots=True)
class Tick:
    """Counts a pass of a loop that has no proven bound; faults `loop` where there are too many."""

    site: Site


@dataclass(frozen=True, slots=True)
class If:
    condition: Expr
    then: Block
    otherwise: Block


@dataclass(frozen=True, slots=True)
class Try:
    """Runs the body as far as the first fault in it, however deep that is raised; then what follows. `loop` is not
    caught. No jump leads out of the body."""

    body: Block


@dataclass(frozen=True, slots=True)
class While:
    """Runs the body as long as the condition holds; `Const` TRUE for a loop that ends by `Break`."""

    condition: Expr
    body: Block


@dataclass(frozen=True, slots=True)
class Break:
    pass


@dataclass(frozen=True, slots=True)
class Next:
    """On with the next pass of the loop."""


@dataclass(frozen=True, slots=True)
class Return:
    pass


Stmt = (
    Line
    | Store
    | SetLocal
    | Copy
    | Compare
    | Bind
    | Reset
    | Call
    | Part
    | Guard
    | Mark
    | Tick
    | If
    | Try
    | While
    | Break
    | Next
    | Return
)
Block = tuple[Stmt, ...]

# ------------------------------------------------------------------------------------------------ bodies


@dataclass(frozen=True, slots=True)
class Body:
    """The code of a POU. `locals`: the next free number of a temporary. `hidden`: further variables of its frame, for
    whole arrays and structures on their way."""

    pou: Pou
    block: Block
    locals: int
    hidden: tuple[Variable, ...] = ()


@dataclass(frozen=True, slots=True)
class ProgramRun:
    """A program instance with the task that runs it (None: once a scan)."""

    name: str
    pou: Pou
    task: Task | None
    retain: bool


@dataclass(frozen=True, slots=True)
class Module:
    """All of an application. `globals` with the located variables that no POU declares; `storages`: the bytes that
    located variables share; `bodies` by POU, callees before callers."""

    globals: tuple[Variable, ...]
    storages: tuple[Variable, ...]
    tasks: tuple[Task, ...]
    programs: tuple[ProgramRun, ...]
    bodies: dict[Pou, Body] = field(default_factory=dict)
