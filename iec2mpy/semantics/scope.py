"""The names that a program can use: of the whole program (`GlobalScope`), and inside of one POU (`Scope`)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from iec2mpy.semantics.typed import Pou, Variable
from iec2mpy.semantics.types import BlockType, ElementaryType, EnumType, Kind, Type
from iec2mpy.source.diagnostics import Diagnostics
from iec2mpy.source.spans import Span
from iec2mpy.syntax import tree

UNKNOWN = ElementaryType("?", Kind.BOOL, 0, 0, 0)
"""The type of what was declared wrongly. Whoever meets it says nothing: the declaration has been reported."""


@dataclass(frozen=True, slots=True)
class GlobalDeclaration:
    """A name of a VAR_GLOBAL section, before its type is known. `shared` is False inside of a CONFIGURATION."""

    section: tree.VarSection
    declaration: tree.VarDecl
    name: tree.Name
    shared: bool


@dataclass(slots=True)
class GlobalScope:
    """All that stands outside of POUs. Everything is found by its case-folded name.

    `types`, `globals` and the variables of `pous` are worked out when they are first asked for, as declarations may
    stand in any order; `active` holds what is being worked out, and shows a declaration that needs itself.
    """

    diagnostics: Diagnostics
    type_declarations: dict[str, tree.TypeDecl] = field(default_factory=dict)
    pou_declarations: dict[str, tree.PouDecl] = field(default_factory=dict)
    global_declarations: dict[str, GlobalDeclaration] = field(default_factory=dict)
    configurations: list[tree.ConfigurationDecl] = field(default_factory=list)
    types: dict[str, Type] = field(default_factory=dict)
    globals: dict[str, Variable] = field(default_factory=dict)
    pous: dict[str, Pou] = field(default_factory=dict)
    block_types: dict[str, BlockType] = field(default_factory=dict)
    scopes: dict[str, Scope] = field(default_factory=dict)
    enumerators: dict[str, list[EnumType]] = field(default_factory=dict)
    located: list[Variable] = field(default_factory=list)
    direct: dict[str, Variable] = field(default_factory=dict)
    active: set[str] = field(default_factory=set)


@dataclass(slots=True)
class Scope:
    """The names of one POU, or, with `pou` None, of what stands outside of POUs.

    `locals` holds its variables and, for a function, the result, under the function's name. `loops` counts the loops
    around the statement being checked, `controls` holds the control variables of the FORs among them, with the place
    of each. `calls` are the POUs that the body calls, with the place of the first call.
    """

    world: GlobalScope
    pou: Pou | None = None
    is_stdlib: bool = False
    locals: dict[str, Variable] = field(default_factory=dict)
    enumerators: dict[str, list[EnumType]] = field(default_factory=dict)
    loops: int = 0
    controls: dict[Variable, Span] = field(default_factory=dict)
    calls: dict[Pou, Span] = field(default_factory=dict)
    result_assigned: bool = False

    @property
    def diagnostics(self) -> Diagnostics:
        return self.world.diagnostics

    def enumerations_with(self, key: str) -> list[EnumType]:
        """The enumerations that have a value of that name; those of the POU itself come first, and hide the others."""
        return self.enumerators.get(key) or self.world.enumerators.get(key, [])

    def visible_names(self) -> Iterator[str]:
        """What may be named in an expression, as declared, for suggestions."""
        for variable in self.locals.values():
            yield variable.name
        for enumerators in (self.enumerators, self.world.enumerators):
            for key, types in enumerators.items():
                yield next(name for name in types[0].values if name.casefold() == key)
