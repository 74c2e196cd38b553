"""Large bodies in parts: a viper function of some 600 statements has hung an RP2350."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field

from iec2mpy.ir import nodes as n
from iec2mpy.ir.walk import expressions, set_local, statements

MAX_STATEMENTS = 250
_LINES: dict[type, int] = {n.Line: 0, n.Guard: 3, n.Tick: 4, n.Copy: 6, n.Compare: 8, n.Try: 3}
"""Statements of Python for one of the IR, where that is not 1."""


def split(body: n.Body) -> tuple[n.Block, ...]:
    """The body's block, or the blocks of several functions: the last is the body's own, and `Part` statements say where
    it, and the parts themselves, run the others.

    A part shares no local with the rest, and nothing in it leaves it by a jump.
    """
    if _count(body.block) <= MAX_STATEMENTS:
        return (body.block,)
    splitter = _Splitter(_locals(body.block))
    own = splitter.fitted(body.block)
    return (*splitter.parts, own)


@dataclass(slots=True)
class _Splitter:
    """`uses`: how often each local stands in the body. What has become a part needs no more room."""

    uses: Counter[int]
    parts: list[n.Block] = field(default_factory=list)

    def fitted(self, block: n.Block) -> n.Block:
        """The block with at most MAX_STATEMENTS, if that can be done."""
        if _count(block) <= MAX_STATEMENTS:
            return block
        block = tuple(self._smaller(statement) for statement in block)
        while (count := _count(block)) > MAX_STATEMENTS:
            block = self._in_parts(block)
            if _count(block) >= count:
                break
        return block

    def _smaller(self, statement: n.Stmt) -> n.Stmt:
        """A statement with large blocks inside: these first in themselves, then as parts."""
        if _count((statement,)) <= MAX_STATEMENTS:
            return statement
        match statement:
            case n.If(condition, then, otherwise):
                then, otherwise = self.fitted(then), self.fitted(otherwise)
                # the larger one is more worth a call
                if _count(then) + _count(otherwise) >= MAX_STATEMENTS and _count(then) >= _count(otherwise):
                    then = self._outlined(then)
                if _count(then) + _count(otherwise) >= MAX_STATEMENTS:
                    otherwise = self._outlined(otherwise)
                return n.If(condition, then, otherwise)
            case n.Try(inner):
                return n.Try(self.fitted(inner))
            case n.While(condition, inner):
                return n.While(condition, self.fitted(inner))
            case _:
                return statement

    def _in_parts(self, block: n.Block) -> n.Block:
        """The block with parts in place of runs of statements, each run as long as a function may be."""
        result: list[n.Stmt] = []
        run: list[n.Stmt] = []
        size = 0
        for piece in _pieces(block):
            closed, count = self._is_closed(piece), _count(piece)
            if not closed or size + count > MAX_STATEMENTS:
                result += self._outlined(tuple(run))
                run, size = [], 0
            if closed:
                run += piece
                size += count
            else:
                result += piece
        return (*result, *self._outlined(tuple(run)))

    def _is_closed(self, block: n.Block) -> bool:
        """Whether the block shares no local with the rest of the body, and no jump leaves it."""
        return not _leaves(block, in_loop=False) and all(
            count == self.uses[local] for local, count in _locals(block).items()
        )

    def _outlined(self, block: n.Block) -> n.Block:
        """A part in place of the block, where the block can be one."""
        if _count(block) <= 1 or not self._is_closed(block):
            return block
        self.parts.append(block)
        return (n.Part(len(self.parts)),)


def _pieces(block: n.Block) -> list[n.Block]:
    """The block cut where a source statement begins, and where no local is in use."""
    last_use = {local: position for position, statement in enumerate(block) for local in _locals((statement,))}
    pieces: list[n.Block] = []
    start, live_until = 0, -1
    for position, statement in enumerate(block):
        after_line = position > start and isinstance(block[position - 1], n.Line)
        if position > start and (isinstance(statement, n.Line) or (live_until < position and not after_line)):
            pieces.append(block[start:position])
            start = position
        live_until = max([live_until, *(last_use[local] for local in _locals((statement,)))])
    return [*pieces, block[start:]]


def _count(block: n.Block) -> int:
    """About how many statements of Python the block becomes."""
    return sum(_LINES.get(type(s), 1) for s in statements(block))


def _locals(block: n.Block) -> Counter[int]:
    """How often each local is set or read in the block."""
    found: Counter[int] = Counter()
    for statement in statements(block):
        if (local := set_local(statement)) is not None:
            found[local.number] += 1
        found.update(e.number for e in expressions(statement) if isinstance(e, n.Local))
    return found


def _leaves(block: n.Block, in_loop: bool) -> bool:
    """Whether a jump leads out of the block: a RETURN, or the end of a pass of a loop around it."""
    for statement in block:
        match statement:
            case n.Return():
                return True
            case n.Break() | n.Next() if not in_loop:
                return True
            case n.If(_, then, otherwise) if _leaves(then, in_loop) or _leaves(otherwise, in_loop):
                return True
            case n.Try(inner) if _leaves(inner, in_loop):
                return True
            case n.While(_, inner) if _leaves(inner, in_loop=True):
                return True
            case _:
                pass
    return False
