"""Names in generated code: of functions, and of the constants that stand for slots."""

from __future__ import annotations

import keyword
import re

from iec2mpy.semantics.typed import Pou

_TAKEN = frozenset(
    {"V", "O", "TASKS", "UNTIMED", "RETAIN", "INPUTS", "OUTPUTS", "HASH", "reset", "v", "o", "b", "p", "const", "array"}
    | {
        "micropython",
        "abs",
        "len",
        "float",
        "int",
        "uint",
        "ptr",
        "ptr8",
        "ptr16",
        "ptr32",
        "bool",
        "object",
        "range",
        "fill",
        "put",
        "loop_check",
        "untimed",
        "Catchable",
        "forget_tracebacks",
    }
)
_OWN = re.compile(r"[txu]\d+|task_\w+|_.*")
"""Locals, the functions of tasks, and constants."""


class SlotNames:
    """The constants of a module: one name a slot number and use, shown with what it stands for."""

    def __init__(self) -> None:
        self._values: dict[str, int] = {}
        self._comments: dict[str, str] = {}
        self._reals: dict[int, str] = {}

    def name(self, path: tuple[str, ...], value: int, comment: str = "") -> str:
        """The name of the constant `value` for a path such as ("main", "delay", "IN")."""
        base = "_" + re.sub(r"\W", "_", "_".join(path)).upper().strip("_")
        name, suffix = base, 2
        while self._values.get(name, value) != value:
            name, suffix = f"{base}_{suffix}", suffix + 1
        self._values[name] = value
        if comment:
            self._comments.setdefault(name, comment)
        return name

    def real(self, bits: int, shown: str) -> str:
        """The name of a REAL constant that has these bits."""
        self._reals[bits] = shown
        # names of slots are in capitals
        return f"_real_{bits:08x}"

    def real_lines(self) -> list[str]:
        """The definitions of REAL constants; they call `bits_to_real`."""
        return [f"_real_{bits:08x} = bits_to_real(0x{bits:08X})  # {shown}" for bits, shown in self._reals.items()]

    def lines(self) -> list[str]:
        """The definitions of slots, by value."""
        rows = sorted(self._values.items(), key=lambda item: (item[1], item[0]))
        return [
            f"{name} = const({value})" + (f"  # {self._comments[name]}" if name in self._comments else "")
            for name, value in rows
        ]


def function_names(pous: list[Pou], runtime: set[str]) -> dict[Pou, str]:
    """A Python name for each body: the POU's own, unless Python, the runtime or generated code has it."""
    taken = _TAKEN | runtime
    names: dict[Pou, str] = {}
    for pou in pous:
        name = pou.name.replace(".", "_")
        if name in taken or keyword.iskeyword(name) or _OWN.fullmatch(name):
            name = f"pou_{name}"
        while name in taken:
            name += "_2"
        names[pou] = name
        taken |= {name}
    return names
