"""The checked program: every expression has its type, every name its variable. What the IR is built from.

Implicit conversions stand in it as `Convert`, constants are folded to `Constant`, arguments are matched to their
parameters. It holds no errors: it is only built from a program that has none.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from iec2mpy.semantics.types import ElementaryType, Type
from iec2mpy.source.spans import Span
from iec2mpy.syntax.tree import Edge, PouKind, Section

Scalar = int | float | str
"""A value as it is stored: BOOL 0 or 1, integers, bit strings and enumerations their (mathematical) number, TIME
milliseconds, LTIME nanoseconds, dates and times of day what `types.py` says, CHAR and WCHAR their code, REAL and LREAL
float, STRING and WSTRING str, NULL 0."""


@dataclass(frozen=True, slots=True)
class Address:
    """REF(variable) as an initial value: the variable, and the way to the part of it that is meant, by fields and by
    the numbers of elements from 0. `type` is that of the part."""

    variable: Variable
    steps: tuple[Variable | int, ...]
    type: Type


Value = Scalar | Address | Sequence["Value"] | Mapping[str, "Value"]
"""Also a reference that is no NULL, and whole: arrays as (nested) sequences, structures and instances as mappings by
case-folded name. Complete for arrays and structures; for an instance it holds only what is given, the rest follows from
its declaration."""

# ------------------------------------------------------------------------------------ variables and POUs


@dataclass(frozen=True, slots=True)
class SharedPlace:
    """A place among bytes that several variables share. `storage`: these bytes, an array; `bit`: from its first bit."""

    storage: Variable
    bit: int


@dataclass(eq=False, slots=True)
class Variable:
    """A declared variable, a field of a structure, or a parameter.

    `section` is None for a field, and RESULT_SECTION does not exist: a function's result is `Pou.result`.
    `initial` is complete: the declared value, or that of the type. `address` is the normal form of its location.
    For EXTERNAL, `target` is the global variable meant. `retain`: True for RETAIN, False for NON_RETAIN, and None where
    nothing is written: such a variable of an instance does as the instance does (6.5.6.2), others are not retained.
    `limits`: of an ARRAY[*], the variables of the same POU that hold its limits, (low, high) of each dimension.
    `shared` is where a located variable lies that overlaps others. `relative`: the bit of its structure where a field
    begins that has an address.
    `referred`: where there is a REF of it, so that it can be written under another name at any time.
    """

    name: str
    type: Type
    section: Section | None
    span: Span
    initial: Value
    constant: bool = False
    retain: bool | None = None
    address: str | None = None
    target: Variable | None = None
    owner: Pou | None = None
    shared: SharedPlace | None = None
    referred: Span | None = None
    limits: tuple[tuple[Variable, Variable], ...] = ()
    relative: int | None = None

    @property
    def key(self) -> str:
        return self.name.casefold()

    @property
    def by_reference(self) -> bool:
        """Whether it stands for a variable of the caller: an in-out does, and any ARRAY[*]."""
        return self.section is Section.IN_OUT or bool(self.limits)

    @property
    def hidden(self) -> bool:
        """Whether the compiler made it, and no program can name it."""
        return self.section is None and self.owner is not None


@dataclass(frozen=True, slots=True)
class EdgeInput:
    """An input that the body sees TRUE only in the execution of an edge. `memory` is the variable that keeps what it
    was: TRUE where the edge was already there."""

    input: Variable
    edge: Edge
    memory: Variable


@dataclass(eq=False, slots=True)
class Pou:
    """A program organization unit. `variables` in order of declaration, by case-folded name.

    `result` is the variable that a function's result is assigned to, and has the function's name.
    """

    kind: PouKind
    name: str
    span: Span
    variables: dict[str, Variable] = field(default_factory=dict)
    result: Variable | None = None
    edges: list[EdgeInput] = field(default_factory=list)
    body: tuple[Stmt, ...] = ()

    @property
    def inputs(self) -> list[Variable]:
        return [v for v in self.variables.values() if v.section is Section.INPUT]

    @property
    def en(self) -> Variable | None:
        """The input EN, where the POU declares it itself (6.6.1.5)."""
        found = self.variables.get("en")
        return found if found is not None and found.section is Section.INPUT else None

    @property
    def eno(self) -> Variable | None:
        """The output ENO, where the POU declares it itself (6.6.1.5)."""
        found = self.variables.get("eno")
        return found if found is not None and found.section is Section.OUTPUT else None

    @property
    def parameters(self) -> list[Variable]:
        """Inputs, outputs and in-outs, in order of declaration: what a call may name."""
        return [v for v in self.variables.values() if v.section in (Section.INPUT, Section.OUTPUT, Section.IN_OUT)]


@dataclass(eq=False, slots=True)
class Task:
    """`interval` in microseconds."""

    name: str
    interval: int
    priority: int
    span: Span


@dataclass(eq=False, slots=True)
class ProgramInstance:
    """A program as it runs. `task` is None where it has none: it runs once a scan."""

    name: str
    pou: Pou
    task: Task | None
    span: Span
    retain: bool | None = None


@dataclass(eq=False, slots=True)
class Application:
    """All that runs on one controller.

    Without a CONFIGURATION there is one task of the default interval, named "main", over all programs.
    `direct` holds, by address, the located variables without another name: those of `AT %QW5 : INT`, and those that
    stand as addresses in bodies. All variables with one `address` are one place; they have the same type, unless they
    lie among shared bytes: `storages` are these.
    """

    globals: dict[str, Variable]
    direct: dict[str, Variable]
    storages: list[Variable]
    pous: list[Pou]
    tasks: list[Task]
    programs: list[ProgramInstance]


# ------------------------------------------------------------------------------------------ expressions


@dataclass(frozen=True, slots=True)
class Constant:
    """A value known at compile time, as it is stored."""

    value: Scalar
    type: Type
    span: Span


@dataclass(frozen=True, slots=True)
class VariableRef:
    """A variable of this POU or a global one (an EXTERNAL is replaced by its global)."""

    variable: Variable
    type: Type
    span: Span


@dataclass(frozen=True, slots=True)
class DirectRef:
    """`%IX0.0` in an expression: a variable that has no other name; `variable.address` is its address."""

    variable: Variable
    type: Type
    span: Span


@dataclass(frozen=True, slots=True)
class FieldRef:
    """A field of a structure, or a variable of an instance."""

    base: Expr
    field: Variable
    type: Type
    span: Span


@dataclass(frozen=True, slots=True)
class ElementRef:
    """An element of an array; as many indices as dimensions, each of an integer type."""

    base: Expr
    indices: tuple[Expr, ...]
    type: Type
    span: Span


@dataclass(frozen=True, slots=True)
class PartRef:
    """A part of a bit string (table 17): as many bits as `type` has, from bit `low` of the variable `base` on."""

    base: Expr
    low: int
    type: ElementaryType
    span: Span


@dataclass(frozen=True, slots=True)
class CharacterRef:
    """A character of a string, by its position from 1 (6.4.2.2); `type` is CHAR or WCHAR."""

    base: Expr
    index: Expr
    type: Type
    span: Span


@dataclass(frozen=True, slots=True)
class Dereference:
    """`base^`: what a reference refers to; NULL faults at run time."""

    base: Expr
    type: Type
    span: Span


@dataclass(frozen=True, slots=True)
class ReferenceTo:
    """`REF(target)`: a reference to a variable, an instance, or a part of one."""

    target: Expr
    type: Type
    span: Span


@dataclass(frozen=True, slots=True)
class Convert:
    """From the operand's type to `type`; implicit ones (figure 12) and X_TO_Y alike. `truncate` is TRUNC."""

    operand: Expr
    type: Type
    span: Span
    truncate: bool = False


@dataclass(frozen=True, slots=True)
class Unary:
    """`operator`: "-", "NOT"."""

    operator: str
    operand: Expr
    type: Type
    span: Span


@dataclass(frozen=True, slots=True)
class Binary:
    """Both operands have the same base type, except for a duration * or / a number, and a date or time of day + or - a
    duration: there it is `left`.

    `operator`: + - * / MOD ** AND OR XOR = <> < > <= >=; `type` is BOOL for comparisons. Strings may differ in length.
    """

    operator: str
    left: Expr
    right: Expr
    type: Type
    span: Span


@dataclass(frozen=True, slots=True)
class BuiltinCall:
    """A standard function that is no operator, by its name in `stdlib/functions.toml` (ABS, SHL, LIMIT, LEFT, …)."""

    name: str
    arguments: tuple[Expr, ...]
    type: Type
    span: Span


@dataclass(frozen=True, slots=True)
class InputArgument:
    """A value for an input, already of the input's type."""

    parameter: Variable
    value: Expr


@dataclass(frozen=True, slots=True)
class InOutArgument:
    """The variable that an in-out, or an ARRAY[*], stands for."""

    parameter: Variable
    target: Expr


@dataclass(frozen=True, slots=True)
class OutputArgument:
    """Where an output goes after the call. `value` is what is assigned: a reference to the output (for a block a
    FieldRef of the instance, for a function a VariableRef of the parameter), negated or converted as need be."""

    parameter: Variable
    target: Expr
    value: Expr


ActualParameter = InputArgument | InOutArgument | OutputArgument


@dataclass(frozen=True, slots=True)
class Control:
    """EN and ENO of a call (6.6.1.5). `enable` is None where EN is not given. `eno` is None where ENO is not taken:
    then a fault goes on outward. The parameter of `eno` is a variable of this call only."""

    enable: Expr | None
    eno: OutputArgument | None


@dataclass(frozen=True, slots=True)
class FunctionCall:
    """A call of a user's function. `arguments` in the order written; inputs left out take their initial values.

    `type` is NO_RESULT for a function without a result: it stands only in a CallFunction.
    """

    function: Pou
    arguments: tuple[ActualParameter, ...]
    type: Type
    span: Span
    control: Control | None = None


@dataclass(frozen=True, slots=True)
class StandardCall:
    """A standard function that is called with EN or ENO. `call` is what it does (a Binary, a BuiltinCall, …), in which
    the variables of `arguments` stand for values that are worked out before it."""

    call: Expr
    arguments: tuple[tuple[Variable, Expr], ...]
    control: Control
    type: Type
    span: Span


Expr = (
    Constant
    | VariableRef
    | DirectRef
    | FieldRef
    | ElementRef
    | PartRef
    | CharacterRef
    | Dereference
    | ReferenceTo
    | Convert
    | Unary
    | Binary
    | BuiltinCall
    | FunctionCall
    | StandardCall
)

# ------------------------------------------------------------------------------------------- statements


@dataclass(frozen=True, slots=True)
class Assign:
    """The value has the target's type, except that a subrange takes its base type: the run time checks it."""

    target: Expr
    value: Expr
    span: Span


@dataclass(frozen=True, slots=True)
class CallFunction:
    """A function called for what it does."""

    call: FunctionCall | StandardCall
    span: Span


@dataclass(frozen=True, slots=True)
class Split:
    """SPLIT_DATE and its like: the parts of a date or time of day that the parameters of `outputs` name. These are
    variables of this call only."""

    operand: Expr
    outputs: tuple[OutputArgument, ...]
    control: Control | None
    span: Span


@dataclass(frozen=True, slots=True)
class CallBlock:
    """An instance invoked. `instance` is an Expr of a BlockType; inputs left out keep their values."""

    instance: Expr
    block: Pou
    arguments: tuple[ActualParameter, ...]
    span: Span
    control: Control | None = None


@dataclass(frozen=True, slots=True)
class If:
    branches: tuple[tuple[Expr, tuple[Stmt, ...]], ...]
    otherwise: tuple[Stmt, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class Case:
    """`groups`: the labels as ranges (low, high) of numbers, with what they select; the first match runs."""

    selector: Expr
    groups: tuple[tuple[tuple[tuple[int, int], ...], tuple[Stmt, ...]], ...]
    otherwise: tuple[Stmt, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class For:
    """All four expressions have the control variable's base type; `step` is often a Constant."""

    control: Expr
    start: Expr
    end: Expr
    step: Expr
    body: tuple[Stmt, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class While:
    condition: Expr
    body: tuple[Stmt, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class Repeat:
    body: tuple[Stmt, ...]
    until: Expr
    span: Span


@dataclass(frozen=True, slots=True)
class Exit:
    span: Span


@dataclass(frozen=True, slots=True)
class Continue:
    span: Span


@dataclass(frozen=True, slots=True)
class Return:
    span: Span


Stmt = Assign | CallFunction | Split | CallBlock | If | Case | For | While | Repeat | Exit | Continue | Return
