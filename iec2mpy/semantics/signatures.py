"""The standard functions as `stdlib/functions.toml` lists them, and what it says about the standard blocks."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache

from iec2mpy.semantics.conversions import type_named
from iec2mpy.semantics.typed import Pou
from iec2mpy.semantics.types import ElementaryType, StringType
from iec2mpy.source.resources import resource_dir


@dataclass(frozen=True, slots=True)
class Parameter:
    """`type` is the name of an elementary or of a generic type."""

    name: str
    type: str


@dataclass(frozen=True, slots=True)
class Signature:
    """A standard function. `fixed` is the type that a typed name gives to the generic type `generic` (`ADD_INT`).

    `operator` is the operator that the function is another name of, or None; `name` is without the type. `separate`:
    each generic input has a type of its own. A function with `outputs` has no result.
    """

    name: str
    inputs: tuple[Parameter, ...]
    result: str
    operator: str | None = None
    extensible: bool = False
    optional: bool = False
    fixed: ElementaryType | StringType | None = None
    separate: bool = False
    outputs: tuple[Parameter, ...] = ()

    @property
    def generic(self) -> str | None:
        """The generic type that a typed name replaces: that of the result, else that of the inputs."""
        return next((t for t in (self.result, *(p.type for p in self.inputs)) if t.startswith("ANY")), None)

    def parameter(self, number: int) -> Parameter | None:
        """The input at a position from 0; those of an extensible function go on without end."""
        if number < len(self.inputs):
            return self.inputs[number]
        if not self.extensible:
            return None
        last = self.inputs[-1]
        stem, start = _numbered(last.name)
        return Parameter(f"{stem}{start + number - len(self.inputs) + 1}", last.type)

    def position(self, name: str) -> int | None:
        """The position from 0 of the input of that name, in any letter case; None where there is none."""
        name = name.upper()
        for number, parameter in enumerate(self.inputs):
            if parameter.name == name:
                return number
        if self.extensible and re.fullmatch(r"[A-Z]+\d{1,3}", name):
            stem, start = _numbered(self.inputs[-1].name)
            if name.startswith(stem) and name[len(stem) :].isdigit():
                number = int(name[len(stem) :]) - start + len(self.inputs) - 1
                return number if number >= len(self.inputs) else None
        return None


def _numbered(name: str) -> tuple[str, int]:
    stem = name.rstrip("0123456789")
    return stem, int(name[len(stem) :])


@cache
def _data() -> Mapping[str, dict]:
    return tomllib.loads((resource_dir("stdlib") / "functions.toml").read_text(encoding="utf-8"))


@cache
def _functions() -> Mapping[str, Signature]:
    return {
        name: Signature(
            name,
            _parameters(row["inputs"]),
            row.get("result", ""),
            row.get("operator"),
            row.get("extensible", False),
            row.get("optional", False),
            separate=row.get("separate", False),
            outputs=_parameters(row.get("outputs", [])),
        )
        for name, row in _data()["functions"].items()
    }


def _parameters(texts: Sequence[str]) -> tuple[Parameter, ...]:
    return tuple(Parameter(*text.split(": ")) for text in texts)


def generic_members(generic: str) -> list[str]:
    """The names of the elementary types that a generic type stands for (figure 5)."""
    return _data()["generic"][generic]


@cache
def standard_function(name: str) -> Signature | None:
    """The standard function of that name in any letter case, typed names (`ADD_INT`) included, or None."""
    name = name.upper()
    found = _functions().get(name) or _bcd(name)
    if found is not None:
        return found
    stem, _, suffix = name.rpartition("_")
    generic = _functions().get(stem) or _with_selector(stem)
    if generic is None or generic.separate or generic.generic is None or suffix not in generic_members(generic.generic):
        return None
    return replace(generic, fixed=type_named(suffix))


def _bcd(name: str) -> Signature | None:
    """BCD_TO_UINT, WORD_BCD_TO_UINT, TO_BCD_WORD, UINT_TO_BCD_WORD (table 22, 3 and 4): a name for each pair."""
    for direction, source, target in (("BCD_TO", "ANY_BCD", "ANY_INT"), ("TO_BCD", "ANY_INT", "ANY_BCD")):
        match = re.fullmatch(rf"(?:([A-Z]+)_)?{direction}_([A-Z]+)", name)
        if match is None or match[2] not in generic_members(target):
            continue
        if match[1] is None or match[1] in generic_members(source):
            return Signature(direction, (Parameter("IN", match[1] or source),), match[2])
    return None


def _with_selector(name: str) -> Signature | None:
    """MUX with the type of its selector K: `MUX_INT` of MUX_INT_REAL (table 32, 6)."""
    stem, _, suffix = name.rpartition("_")
    generic = _functions().get(stem)
    if generic is None or not generic.inputs or generic.inputs[0].type == generic.generic:
        return None
    selector = generic.inputs[0]
    if not selector.type.startswith("ANY") or suffix not in generic_members(selector.type):
        return None
    return replace(generic, inputs=(Parameter(selector.name, suffix), *generic.inputs[1:]))


def function_names() -> list[str]:
    """The names of the standard functions that users may call, without typed ones."""
    return [name for name in _functions() if not name.startswith("__")]


def is_planned_block(name: str) -> bool:
    """Whether it is a standard block that this compiler does not have yet."""
    return name.upper() in _data()["not_yet"]["blocks"]


def typed_block_names() -> Mapping[str, str]:
    """The standard blocks with a type in their name, and the blocks that they are."""
    return _data()["blocks"]["other_names"]


@cache
def _parameter_aliases() -> Mapping[str, Mapping[str, str]]:
    table = _data()["blocks"]["parameters"]
    return {
        block.casefold(): {long.casefold(): short.casefold() for long, short in names.items()}
        for block, names in table.items()
    }


def parameter_key(block: Pou, key: str) -> str:
    """The key that a parameter of a block is declared by: some standard blocks have long names, too (table 43)."""
    if not block.span.file.is_stdlib:
        return key
    return _parameter_aliases().get(block.name.casefold(), {}).get(key, key)
