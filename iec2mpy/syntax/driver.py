"""Runs the LALR tables over tokens, and goes on after errors.

Lark's own loop stops at the first error, and its states cannot be searched for a way on; this one keeps the same
two stacks and recovers as yacc does: it throws away tokens up to one that ends something (`;`, THEN, END_IF, …), pops
states up to one where that token can follow (after an ERROR token in place of what was thrown away, or after a word
that is missing), and goes on from there without a further message.
"""

from __future__ import annotations

from typing import Any

from iec2mpy.source.diagnostics import Diagnostics
from iec2mpy.syntax import messages, prune, tables
from iec2mpy.syntax.actions import ACTIONS
from iec2mpy.syntax.keywords import BLOCK_ENDS, STATEMENT_WORDS
from iec2mpy.syntax.situation import Situation
from iec2mpy.syntax.tokens import Token

_MOST_ERRORS = 100
"""After so many errors in one part of a file the rest of it is not read: they tell nothing new."""

_SYNCHRONIZING = frozenset({
    "SEMICOLON", "COMMA", "RPAR", "RSQB", "THEN", "DO", "OF", "TO", "BY", "ELSE", "ELSIF", "UNTIL", "COLON",
    *STATEMENT_WORDS, *BLOCK_ENDS.values(), "STRUCT", "END_STRUCT", "END_VAR", "END_TYPE", "VAR", "VAR_GLOBAL",
    "RESOURCE", "END_RESOURCE", "TASK", "PROGRAM", "END_CONFIGURATION", "$END",
})  # fmt: skip
"""Tokens at which reading can start again."""

_BRIDGES: tuple[tuple[str, ...], ...] = (
    (), ("ERROR",), ("ASSIGN", "ERROR"), ("SEMICOLON",), ("ERROR", "SEMICOLON"),
    ("THEN",), ("ERROR", "THEN"), ("DO",), ("ERROR", "DO"), ("OF",), ("ERROR", "OF"),
    ("UNTIL", "ERROR"), ("RANGE", "ERROR"), ("TO", "ERROR"), ("TO", "ERROR", "DO"),
    ("ASSIGN", "ERROR", "TO", "ERROR", "DO"), ("ERROR", "TO", "ERROR", "DO"),
    ("COLON", "ERROR"), ("COLON", "ERROR", "SEMICOLON"), ("ON", "NAME"),
)  # fmt: skip
"""What can be put between what was read and the token at which reading goes on, the likeliest first."""


def run(tokens: list[Token], start: str, diagnostics: Diagnostics) -> Any:
    """The value of rule `start` for tokens that end with `$END`; None where nothing could be made of them.

    Errors go to `diagnostics`; each has the right place, and none follows from another.
    """
    driver = _Driver(tokens, start, diagnostics)
    value = driver.run()
    at = sorted(prune.holes(driver.tokens) + driver.gaps) if diagnostics.has_errors else []
    return prune.prune(value, at) if at else value


class _Driver:
    def __init__(self, tokens: list[Token], start: str, diagnostics: Diagnostics) -> None:
        loaded = tables.load()
        self._rows = loaded.states
        self._rules = loaded.rules
        self._end_state = loaded.ends[start]
        self._states = [loaded.starts[start]]
        self._values: list[Any] = []
        self.tokens = tokens
        self._at = 0
        self._diagnostics = diagnostics
        self._errors = 0
        self.gaps: list[int] = []  # where tokens were skipped with nothing in their place
        self._lost_end = False  # an END_ word was skipped: that its block is open at the end is no further mistake

    def run(self) -> Any:
        rows, rules, states, values, tokens = self._rows, self._rules, self._states, self._values, self.tokens
        diagnostics, actions = self._diagnostics, ACTIONS
        while True:
            token = tokens[self._at]
            token_type = token.type
            while (step := rows[states[-1]].get(token_type)) is not None:
                if step >= 0:
                    states.append(step)
                    values.append(token)
                    self._at += 1
                    break
                rule = rules[-1 - step]
                length = rule.length
                if rule.action is not None:
                    if length:
                        taken = values[-length:]
                        del values[-length:], states[-length:]
                    else:
                        taken = []
                    values.append(actions[rule.action](taken, diagnostics))
                else:
                    del states[-1]
                states.append(rows[states[-1]][rule.origin])
                if states[-1] == self._end_state and token_type == "$END":
                    return values[-1]
            else:
                if not self._recover(token):
                    return None

    # --------------------------------------------------------------------------------------------- errors

    def _recover(self, token: Token) -> bool:
        """Report what is wrong at `token` and find a way on; False where there is none."""
        self._errors += 1
        if self._errors > _MOST_ERRORS:
            return False
        start = Token("$START", "", token.start, token.start, token.file)
        previous = self.tokens[self._at - 1] if self._at else start
        silent = token.bad or previous.bad or (self._lost_end and token.type == "$END")
        following = self.tokens[min(self._at + 1, len(self.tokens) - 1)]
        situation = Situation(previous, token, following, tuple(self._values), self.accepts, self._expected())
        finding = messages.explain(situation)
        if not silent:
            self._diagnostics.add(finding.code, finding.message, finding.span, finding.hint)
        if finding.insert is not None:
            self.tokens.insert(self._at, previous.inserted_after(finding.insert, messages.shown_type(finding.insert)))
            return True
        if finding.replace is not None:
            self.tokens[self._at] = token.as_type(finding.replace)
            return True
        if finding.drop:
            del self.tokens[self._at : self._at + finding.drop]
            return True
        return self._panic()

    def accepts(self, *types: str, pop: int = 0) -> bool:
        """Whether tokens of these types could follow now, or with some of the states popped."""
        states = self._states[: len(self._states) - pop]
        for token_type in types:
            while True:
                step = self._rows[states[-1]].get(token_type)
                if step is None:
                    return False
                if step >= 0:
                    states.append(step)
                    break
                rule = self._rules[-1 - step]
                if rule.length:
                    del states[-rule.length :]
                states.append(self._rows[states[-1]][rule.origin])
                if token_type == "$END" and states[-1] == self._end_state:
                    return True
        return True

    def _expected(self) -> list[str]:
        return [
            name for name in self._rows[self._states[-1]] if name.isupper() and name != "ERROR" and self.accepts(name)
        ]

    def _panic(self) -> bool:
        """Skip tokens, pop states, and put in what is missing, until a token can follow again."""
        first = self._at
        while True:
            token = self.tokens[self._at]
            if token.type in _SYNCHRONIZING:
                for pop in range(len(self._states)):
                    if pop and self._opens_block(self._values[-pop]) and token.type != "$END":
                        break
                    for bridge in _BRIDGES:
                        if (pop == 0 or bridge[:1] == ("ERROR",)) and self.accepts(*bridge, token.type, pop=pop):
                            self._build_bridge(bridge, pop, first)
                            return True
            if token.type == "$END":
                return False
            self._lost_end = self._lost_end or token.type.startswith("END_")
            self._at += 1

    @staticmethod
    def _opens_block(value: Any) -> bool:
        """Whether this value is the word of a block, which must stay open until its END_ word."""
        return isinstance(value, Token) and value.type in ("IF", "CASE", "FOR", "WHILE", "REPEAT", "STRUCT", "RESOURCE")

    def _build_bridge(self, bridge: tuple[str, ...], pop: int, first: int) -> None:
        if pop:
            del self._states[-pop:], self._values[-pop:]
        start = self.tokens[first]
        before = self.tokens[max(self._at - 1, 0)]
        inserted = [
            Token(name, "", start.start, max(start.start, before.end), start.file, None, True)
            if name == "ERROR"
            else before.inserted_after(name, messages.shown_type(name))
            for name in bridge
        ]
        if first < self._at and "ERROR" not in bridge and first:
            self.gaps.append(self.tokens[first - 1].end)
        # What was skipped is cut out: the token before the next error is then one that was read.
        self.tokens[first : self._at] = inserted
        self._at = first
