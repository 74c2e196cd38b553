"""The body under construction: where statements are added, and where temporaries come from."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager

from iec2mpy.ir import nodes as n
from iec2mpy.semantics import typed as t
from iec2mpy.semantics import types as ty
from iec2mpy.semantics.defaults import default_value
from iec2mpy.source.spans import Span
from iec2mpy.syntax.tree import Section

FALSE = n.Const(0, ty.BOOL)
TRUE = n.Const(1, ty.BOOL)


class Context:
    """Collects the statements of one POU. The block that is open receives what is emitted.

    `depth`: how many expressions stand around the one that is being lowered. `values`: variables whose value is at
    hand: control variables of the loops around, EN and ENO, arguments of a standard function. `edges`: what the body
    reads in place of an input with an edge. `instance`: one that was called, with its place (`called`)."""

    def __init__(self, pou: t.Pou) -> None:
        self.pou = pou
        self.hidden: list[t.Variable] = []
        self.locals = 0
        self.depth = 0
        self.values: dict[t.Variable, n.Expr] = {}
        self.edges: dict[t.Variable, n.Place] = {}
        self.instance: tuple[t.Expr, n.Place] | None = None
        self._block: list[n.Stmt] = []
        self._span = pou.span

    # ------------------------------------------------------------------------------- statements

    def emit(self, statement: n.Stmt) -> None:
        self._block.append(statement)

    def emit_all(self, statements: Iterable[n.Stmt]) -> None:
        self._block += statements

    def line(self, span: Span) -> None:
        """A new source statement begins."""
        self._span = span
        self.emit(n.Line(span))

    @property
    def site(self) -> n.Site:
        """The place of the current source statement, for faults."""
        return n.Site(self._span, self.pou)

    @contextmanager
    def block(self) -> Iterator[list[n.Stmt]]:
        """Opens an inner block; what is emitted meanwhile goes there."""
        outer, self._block = self._block, []
        try:
            yield self._block
        finally:
            self._block = outer

    @property
    def statements(self) -> n.Block:
        return tuple(self._block)

    # ------------------------------------------------------------------------------ temporaries

    def new_local(self, value_type: n.ValueType, low: int | None = None, high: int | None = None) -> n.Local:
        local = n.Local(self.locals, value_type, low, high)
        self.locals += 1
        return local

    def spill(self, value: n.Expr) -> n.Local:
        """The value, computed here and now."""
        local = self.new_local(value.type)
        self.emit(n.SetLocal(local, value))
        return local

    def atom(self, value: n.Expr) -> n.Expr:
        """The value in a form that may be written several times: a constant, a local, a plain variable."""
        return value if is_atom(value) else self.spill(value)

    def kept(self, value: n.Expr) -> n.Expr:
        """The value in a form that means the same after any statement: a constant or a local."""
        return value if isinstance(value, (n.Const, n.Local)) else self.spill(value)

    def new_hidden(self, value_type: ty.Type) -> n.Place:
        """A nameless variable of the frame: for a whole array or structure, and for what large code shares."""
        initial = default_value(value_type)
        variable = t.Variable(f"__{len(self.hidden)}", value_type, None, self._span, initial, owner=self.pou)
        self.hidden.append(variable)
        return n.Place(n.Frame(self.pou), (n.Field(variable),), value_type)

    @contextmanager
    def bound(self, control: t.Expr, current: n.Local) -> Iterator[None]:
        """Inside a FOR, its control variable has the value of a local, whose bounds are known.

        Nothing in the body may write it. One that others can reach (a global or located one, or what an in-out stands
        for) is read from its slot."""
        assert isinstance(control, t.VariableRef), "the checker lets only plain variables count"
        variable = control.variable
        reached = variable.referred is not None or variable.address is not None or variable.section is Section.IN_OUT
        if reached or variable.owner is None:
            yield
            return
        with self.known({variable: current}):
            yield

    @contextmanager
    def known(self, values: Mapping[t.Variable, n.Expr]) -> Iterator[None]:
        """Inside, these values stand for their variables."""
        self.values |= values
        yield
        for variable in values:
            del self.values[variable]

    @contextmanager
    def called(self, instance: t.Expr, place: n.Place) -> Iterator[None]:
        """Inside, the expression of an instance that was called means the place that it had before the call."""
        outer, self.instance = self.instance, (instance, place)
        yield
        self.instance = outer

    # ---------------------------------------------------------------------- order of evaluation

    def mark(self) -> int:
        """A point in the open block, for `settle`."""
        return len(self._block)

    def settle(self, mark: int, values: list[n.Expr]) -> list[n.Expr]:
        """Keeps the order of evaluation from left to right: where something with an effect was emitted since `mark`,
        values that were worked out before it are stored in locals at the mark."""
        if not self._has_effect_since(mark):
            return values
        settled = []
        for value in values:
            if isinstance(value, (n.Const, n.Local)):
                settled.append(value)
                continue
            local = self.new_local(value.type)
            self._block.insert(mark, n.SetLocal(local, value))
            mark += 1
            settled.append(local)
        return settled

    def settle_wholes(self, mark: int, places: list[n.Place]) -> list[n.Place]:
        """`settle`, for whole arrays and structures: they are copied."""
        if not self._has_effect_since(mark):
            return places
        settled = []
        for place in places:
            kept = self.new_hidden(place.type)
            self._block.insert(mark, n.Copy(kept, place))
            mark += 1
            settled.append(kept)
        return settled

    def _has_effect_since(self, mark: int) -> bool:
        return any(isinstance(s, (n.Call, n.Store, n.Copy, n.If, n.Try, n.While)) for s in self._block[mark:])

    def settle_place(self, mark: int, place: n.Place) -> n.Place:
        """`settle`, for the subscripts of a place, and for the reference that leads to it."""
        indices = [step.index for step in place.steps if isinstance(step, n.Element)]
        root = place.root
        if isinstance(root, n.Deref) and not is_in_out(root.reference):
            (reference,) = self.settle(mark, [root.reference])
            root = n.Deref(reference, root.type)
        settled = iter(self.settle(mark, indices))
        steps = tuple(n.Element(next(settled)) if isinstance(step, n.Element) else step for step in place.steps)
        return n.Place(root, steps, place.type)


def is_in_out(reference: n.Expr) -> bool:
    """Whether it is the own slot of an in-out: that changes only when its POU is called."""
    if not isinstance(reference, n.Load) or not reference.place.steps:
        return False
    last = reference.place.steps[-1]
    return isinstance(last, n.Field) and last.variable.by_reference


def is_atom(value: n.Expr) -> bool:
    """Whether writing the value twice costs little, and means the same."""
    if isinstance(value, n.Load):
        root = value.place.root
        return not isinstance(root, n.Deref) and all(isinstance(step, n.Field) for step in value.place.steps)
    if isinstance(value, n.Now):
        return not value.type.in_objects
    return isinstance(value, (n.Const, n.Local))
