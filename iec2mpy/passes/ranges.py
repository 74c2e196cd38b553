"""Value ranges: takes away checks and wrap-arounds that are never needed.

What is used as a proof: declared types; what this body stored in the same scan, and has tested on the way. What a slot
held before the scan is worth its declared type and no more: it may be written or restored from outside.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace

from iec2mpy.ir import nodes as n
from iec2mpy.ir.bounds import Bounds, bounds
from iec2mpy.ir.walk import map_statement_exprs, may_fault, statements
from iec2mpy.semantics import types as ty
from iec2mpy.semantics.typed import Pou

_MIRRORED = {"lt": "gt", "gt": "lt", "le": "ge", "ge": "le", "eq": "eq", "ne": "ne"}
_NEGATED = {"lt": "ge", "ge": "lt", "le": "gt", "gt": "le", "eq": "ne", "ne": "eq"}


@dataclass(slots=True)
class _Facts:
    """What is known at a point of a body: bounds of locals, and of plain variables by their place."""

    pou: Pou
    locals: dict[int, Bounds] = field(default_factory=dict)
    variables: dict[int, Bounds] = field(default_factory=dict)
    numbers: dict[n.Place, int] = field(default_factory=dict)
    """Of the places in `variables`: to hash a place takes time, and facts are copied and compared at each branch."""
    references: set[int] = field(default_factory=set)
    """The numbers of those that hold a reference."""

    def copy(self) -> _Facts:
        return _Facts(self.pou, dict(self.locals), dict(self.variables), self.numbers, self.references)

    def of(self, expr: n.Expr) -> Bounds | None:
        if isinstance(expr, n.Local):
            return self.locals.get(expr.number)
        return self.variables.get(self.numbers.get(expr.place, -1)) if isinstance(expr, n.Load) else None

    def number(self, place: n.Place) -> int:
        number = self.numbers.setdefault(place, len(self.numbers))
        if isinstance(place.type, ty.RefType):
            self.references.add(number)
        return number

    def learn(self, expr: n.Expr, low: int, high: int) -> None:
        """The expression, a local or a plain variable, is inside of bounds."""
        known_low, known_high = bounds(expr, self.of)
        found = max(low, known_low), min(high, known_high)
        if found[0] > found[1]:
            return  # this point is never reached
        if isinstance(expr, n.Local):
            self.locals[expr.number] = found
        elif isinstance(expr, n.Load) and _is_plain(expr.place, self.pou):
            self.variables[self.number(expr.place)] = found

    def meet(self, other: _Facts) -> None:
        """Keeps what holds on both ways to here."""
        self.locals = _met(self.locals, other.locals)
        self.variables = _met(self.variables, other.variables)


def _met(first: dict[int, Bounds], second: dict[int, Bounds]) -> dict[int, Bounds]:
    return {
        key: one if one == other else (min(one[0], other[0]), max(one[1], other[1]))
        for key, one in first.items()
        if (other := second.get(key)) is not None
    }


def narrow(body: n.Body) -> n.Body:
    """The body without checks and wrap-arounds that its value ranges make needless."""
    return replace(body, block=_block(body.block, _Facts(body.pou)))


def _block(block: n.Block, facts: _Facts) -> n.Block:
    result: list[n.Stmt] = []
    for statement in block:
        result.append(_statement(statement, facts))
    return tuple(result)


def _statement(statement: n.Stmt, facts: _Facts) -> n.Stmt:
    if isinstance(statement, n.While):
        _forget_what_changes(statement.body, facts)
    statement = map_statement_exprs(statement, _simplifier(facts))
    match statement:
        case n.SetLocal(local, value):
            if _is_integer(value):
                facts.locals[local.number] = bounds(value, facts.of)
        case n.Compare(local):
            facts.locals.pop(local.number, None)
        case n.Store(place, value):
            _forget(place, facts)
            if _is_integer(value) and _is_plain(place, facts.pou):
                facts.variables[facts.number(place)] = bounds(value, facts.of)
        case n.Copy(place) | n.Reset(place):
            _forget(place, facts)
        case n.Call():
            facts.variables.clear()
        case n.Guard(condition):
            _assume(condition, False, facts)
        case n.If(condition, then, otherwise):
            return _branches(condition, then, otherwise, facts)
        case n.Try(body):
            new_body = _block(body, facts.copy())
            # how far it comes is unknown
            _forget_what_changes(body, facts)
            return n.Try(new_body)
        case n.While(condition, body):
            inside = facts.copy()
            _assume(condition, True, inside)
            return n.While(condition, _block(body, inside))
        case _:
            pass
    return statement


def _branches(condition: n.Expr, then: n.Block, otherwise: n.Block, facts: _Facts) -> n.Stmt:
    other = facts.copy()
    _assume(condition, True, facts)
    _assume(condition, False, other)
    new_then, new_otherwise = _block(then, facts), _block(otherwise, other)
    if _leaves(new_then):
        facts.locals, facts.variables = other.locals, other.variables
    elif not _leaves(new_otherwise):
        facts.meet(other)
    return n.If(condition, new_then, new_otherwise)


def _leaves(block: n.Block) -> bool:
    return bool(block) and isinstance(block[-1], (n.Return, n.Break, n.Next))


def _forget_what_changes(body: n.Block, facts: _Facts) -> None:
    """What a loop changes is unknown at the start of a pass, and after the loop; and after what may have been broken
    off."""
    for statement in statements(body):
        match statement:
            case n.SetLocal(local) | n.Compare(local):
                facts.locals.pop(local.number, None)
            case n.Store(place) | n.Copy(place) | n.Reset(place):
                _forget(place, facts)
            case n.Call():
                facts.variables.clear()
            case _:
                pass


def _forget(place: n.Place, facts: _Facts) -> None:
    """A store through an in-out or a reference may change anything that has its type; a whole array or structure, what
    is in it."""
    if isinstance(place.root, n.Deref) or _may_be_own(place, facts.pou) or ty.value_type(place.type) is None:
        # a reference is only ever written as one: so it is tested for NULL once, and not at each use
        kept = facts.references if ty.value_type(place.type) not in (None, ty.REFERENCE) else ()
        facts.variables = {number: facts.variables[number] for number in kept if number in facts.variables}
    else:
        facts.variables.pop(facts.number(place), None)


def _is_plain(place: n.Place, pou: Pou) -> bool:
    """A variable or field that no other place can be: its own storage, found without a subscript. Located variables
    share theirs with others at the same address."""
    if isinstance(place.root, n.Deref) or _may_be_own(place, pou):
        return False
    if isinstance(place.root, n.Global) and place.root.variable.address is not None:
        return False
    return all(isinstance(step, n.Field) for step in place.steps)


def _may_be_own(place: n.Place, pou: Pou) -> bool:
    """Whether this is a variable of a global instance of the block whose body this is: perhaps the one that runs."""
    return isinstance(place.root, n.Global) and any(
        isinstance(step, n.Field) and step.variable.owner is pou for step in place.steps
    )


def _is_integer(value: n.Expr) -> bool:
    return isinstance(value.type, ty.ElementaryType) and not value.type.in_objects


# --------------------------------------------------------------------------------------------- conditions


def _assume(condition: n.Expr, holds: bool, facts: _Facts) -> None:
    """Adds what a condition says, which is known to hold or not to hold."""
    match condition:
        case n.Not(operand, ty.BOOL):
            _assume(operand, not holds, facts)
        case n.Op("and", left, right) if holds:
            _assume(left, True, facts)
            _assume(right, True, facts)
        case n.Op("or", left, right) if not holds:
            _assume(left, False, facts)
            _assume(right, False, facts)
        case n.Op(name, left, right) if name in _MIRRORED and _is_integer(left):
            if not holds:
                name = _NEGATED[name]
            _compare(name, left, right, facts)
            _compare(_MIRRORED[name], right, left, facts)
        case n.Local() | n.Load() if _is_integer(condition):
            facts.learn(condition, *((1, 1) if holds else (0, 0)))
        case _:
            pass


def _compare(name: str, left: n.Expr, right: n.Expr, facts: _Facts) -> None:
    """`left name right` holds: bounds for the left side."""
    if not isinstance(left, (n.Local, n.Load)):
        return
    low, high = bounds(left, facts.of)
    right_low, right_high = bounds(right, facts.of)
    learn: dict[str, Callable[[], Bounds]] = {
        "lt": lambda: (low, right_high - 1),
        "le": lambda: (low, right_high),
        "gt": lambda: (right_low + 1, high),
        "ge": lambda: (right_low, high),
        "eq": lambda: (right_low, right_high),
        "ne": lambda: _without((low, high), right_low) if right_low == right_high else (low, high),
    }
    facts.learn(left, *learn[name]())


def _without(found: Bounds, value: int) -> Bounds:
    """Bounds that a value, which is not meant, may make narrower."""
    return found[0] + (found[0] == value), found[1] - (found[1] == value)


# -------------------------------------------------------------------------------------------- expressions


def _simplifier(facts: _Facts) -> Callable[[n.Expr], n.Expr]:
    def simplify(expr: n.Expr) -> n.Expr:
        match expr:
            case n.Wrap(operand, ty.ElementaryType() as to) if operand.type.in_objects or to.in_objects:
                return n.Wrap(_unwrapped(operand, to.bits), to)
            case n.Wrap(operand, ty.ElementaryType() as to):
                return _wrap(operand, to, facts)
            case n.Op(name, left, right) if name in _MIRRORED and _is_integer(left):
                decided = _decided(expr, name, bounds(left, facts.of), bounds(right, facts.of))
                return expr if decided is not expr and may_fault(expr) else decided
            case n.Op("div" | "mod", left, n.Const() as divisor) if _is_integer(left):
                return _by_power_of_two(expr, left, divisor) if bounds(left, facts.of)[0] >= 0 else expr
            case n.Local(number, value_type, None, None) if number in facts.locals:
                # later stages see the bounds without the way that led to them
                low, high = facts.locals[number]
                if isinstance(value_type, ty.ElementaryType) and (low, high) != (value_type.low, value_type.high):
                    return n.Local(number, value_type, low, high)
                return expr
            case _:
                return expr

    return simplify


def _wrap(operand: n.Expr, to: ty.ElementaryType, facts: _Facts) -> n.Expr:
    """Without the wrap-around where the value is in range; otherwise without those below it that it makes needless."""
    low, high = bounds(operand, facts.of)
    if to.low <= low and high <= to.high:
        return _retyped(operand, to)
    return n.Wrap(_unwrapped(operand, to.bits), to)


def _by_power_of_two(expr: n.Op, left: n.Expr, divisor: n.Const) -> n.Expr:
    """Of a number that is not negative, a division by 2^n is a shift, and its rest are the low bits."""
    value = divisor.number
    if value <= 0 or value & (value - 1):
        return expr
    if expr.name == "mod":
        return n.Op("and", left, n.Const(value - 1, divisor.type), expr.type)
    return n.Op("shr", left, n.Const(value.bit_length() - 1, divisor.type), expr.type)


def _retyped(expr: n.Expr, to: ty.ElementaryType) -> n.Expr:
    """The same value as one of another type, which has it too: the sum of two DINT may be a UDINT's."""
    if isinstance(expr, n.Const) or (isinstance(expr, n.Op) and expr.name in n.ARITHMETIC):
        return replace(expr, type=to)
    return expr


def _unwrapped(expr: n.Expr, bits: int) -> n.Expr:
    """The expression without inner wrap-arounds of at least as many bits: modulo 2^bits that is the same."""
    match expr:
        case n.Wrap(operand, ty.ElementaryType() as inner) if inner.bits >= bits and _lives_with(operand, inner):
            return _unwrapped(operand, bits)
        case n.Op(name, left, right) if name in n.ARITHMETIC:
            return n.Op(name, _unwrapped(left, bits), _unwrapped(right, bits), expr.type)
        case _:
            return expr


def _lives_with(operand: n.Expr, t: ty.ElementaryType) -> bool:
    """Whether the operand, an integer, lives in the same array as values of the type."""
    return operand.type.in_objects == t.in_objects


def _decided(expr: n.Op, name: str, left: Bounds, right: Bounds) -> n.Expr:
    """The comparison, or its result where the bounds decide it."""
    always = {
        "lt": left[1] < right[0],
        "le": left[1] <= right[0],
        "gt": left[0] > right[1],
        "ge": left[0] >= right[1],
        "eq": left == right and left[0] == left[1],
        "ne": left[1] < right[0] or left[0] > right[1],
    }
    never = {
        "lt": left[0] >= right[1],
        "le": left[0] > right[1],
        "gt": left[1] <= right[0],
        "ge": left[1] < right[0],
        "eq": left[1] < right[0] or left[0] > right[1],
        "ne": left == right and left[0] == left[1],
    }
    if always[name]:
        return n.Const(1, ty.BOOL)
    return n.Const(0, ty.BOOL) if never[name] else expr
