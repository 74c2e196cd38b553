"""What the golden cases show: IR as it is built, IR after one pass, text of MicroPython."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path

from iec2mpy import backends, ir, passes
from iec2mpy.backends.target import PORTABLE, VIPER32, VIPER64, Target
from iec2mpy.ir import nodes as n
from iec2mpy.ir.printer import print_body
from iec2mpy.ir.verifier import verify
from iec2mpy.passes.dead import remove_dead
from iec2mpy.passes.fold import fold
from iec2mpy.passes.inline import inline
from iec2mpy.passes.ranges import narrow
from iec2mpy.project.compile import check_files
from iec2mpy.source.spans import SourceFile
from tests.golden import GoldenCase, Render

_HERE = Path(__file__).parent
_TARGETS: Mapping[str, Target] = {"portable": PORTABLE, "viper64": VIPER64, "viper32": VIPER32}


def built(source: str) -> n.Module:
    """The IR of a program, as it is built."""
    module = ir.build(check_files([SourceFile("main.st", source)]).application)
    verify(module)
    return module


def shown(module: n.Module, names: str) -> str:
    """The bodies of the POUs with these names, separated by blanks."""
    bodies = {pou.name: body for pou, body in module.bodies.items()}
    return "\n".join(print_body(bodies[name]) for name in names.split())


def _each_body(rewrite: Callable[[n.Body], n.Body]) -> Callable[[n.Module], n.Module]:
    return lambda module: replace(module, bodies={pou: rewrite(body) for pou, body in module.bodies.items()})


_PASSES: Mapping[str, Callable[[n.Module], n.Module]] = {
    "fold": _each_body(fold),
    "narrow": _each_body(narrow),
    "dead": _each_body(remove_dead),
    "inline": inline,
    "all": passes.run,
}


def _ir(case: GoldenCase, heading: str) -> str:
    return shown(built(case.source), heading.removeprefix("out "))


def _one_pass(case: GoldenCase, heading: str) -> str:
    """`[before main]` and `[out main]`; the file's name is that of the pass."""
    word, names = heading.split(" ", 1)
    module = built(case.source)
    if word == "out":
        module = _PASSES[case.file.stem](module)
        verify(module)
    return shown(module, names)


def _text(case: GoldenCase, heading: str) -> str:
    """`[out portable]`, `[out viper64]`, `[out viper32]`: all of the module."""
    module = passes.run(built(case.source))
    return backends.generate(module, _TARGETS[heading.removeprefix("out ")]).text


RENDERERS: Mapping[Path, Render] = {
    _HERE / "ir" / "golden": _ir,
    _HERE / "passes" / "golden": _one_pass,
    _HERE / "backends" / "golden": _text,
}
"""By the folder of the cases."""
