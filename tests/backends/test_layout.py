"""Where variables live: sizes, what is retained, the only instance of a block, references with two parts."""

from __future__ import annotations

from iec2mpy.backends import layout
from iec2mpy.backends.layout import Size
from iec2mpy.semantics.typed import Pou
from mcu_runtime import slots
from tests.backends.compiling import generated, laid_out

_PARTS = """
TYPE Part : STRUCT a : INT; r : REAL; row : ARRAY[0..2] OF BOOL; s : STRING; END_STRUCT; END_TYPE
FUNCTION_BLOCK Inner
VAR_INPUT x : INT; END_VAR
VAR_IN_OUT io : Part; END_VAR
VAR kept : INT; r : REAL; END_VAR
VAR_TEMP t : INT; END_VAR
kept := kept + x + io.a;
END_FUNCTION_BLOCK
"""


def test_slots_of_the_controller() -> None:
    assert (layout.NOW, layout.LOOP, layout.SITE, layout.FIRST) == (slots.NOW, slots.LOOP, slots.SITE, slots.FIRST)


def _pou(found: layout.Layout, name: str) -> Pou:
    return next(pou for pou in found.module.bodies if pou.name == name)


def test_sizes() -> None:
    found = laid_out(
        f"{_PARTS}PROGRAM main\nVAR p : ARRAY[1..2, 0..1] OF Part; i : Inner; q : Part; END_VAR\n"
        "i(x := 1, io := q);\nEND_PROGRAM\n"
    )
    main, inner = _pou(found, "main").variables, _pou(found, "Inner")
    assert found.size_of(main["q"].type) == Size(4, 2)
    assert found.size_of(main["p"].type) == Size(16, 8)
    # x, the reference, kept; and r. VAR_TEMP is in the frame
    assert found.size_of(main["i"].type) == Size(3, 1)
    assert found.frame_record(inner).size == Size(1, 0)


def test_everything_has_slots_of_its_own() -> None:
    found = laid_out(
        f"{_PARTS}VAR_GLOBAL g : INT; h AT %MW0 : INT; END_VAR\nPROGRAM main\nVAR_EXTERNAL g : INT; END_VAR\n"
        "VAR i : Inner; q : Part; END_VAR\ni(x := g, io := q);\n%QX0.0 := TRUE;\nEND_PROGRAM\n"
    )
    taken: set[tuple[str, int]] = set()
    for declared, _, at, _ in found.storages():
        size = found.size_of(declared)
        for array in ("V", "O"):
            for slot in range(at.of(array), at.of(array) + size.of(array)):
                assert (array, slot) not in taken
                taken.add((array, slot))
    assert min(slot for array, slot in taken if array == "V") == layout.FIRST
    assert min(slot for array, slot in taken if array == "O") == layout.FIRST_OBJECT


_ONE = "FUNCTION_BLOCK B VAR n : INT; END_VAR n := n + 1; END_FUNCTION_BLOCK\n"
_HOLDER = "FUNCTION_BLOCK H VAR b : B; END_VAR b(); END_FUNCTION_BLOCK\n"


def _single(text: str) -> bool:
    found = laid_out(_ONE + text)
    return found.single_base(_pou(found, "B")) is not None


def test_single_base() -> None:
    assert _single("PROGRAM main\nVAR b : B; END_VAR\nb();\nEND_PROGRAM\n")
    assert _single("PROGRAM main\nVAR b : ARRAY[3..3] OF B; END_VAR\nb[3]();\nEND_PROGRAM\n")
    assert _single(f"{_HOLDER}PROGRAM main\nVAR h : H; END_VAR\nh();\nEND_PROGRAM\n")
    assert not _single("PROGRAM main\nVAR b, c : B; END_VAR\nb();\nEND_PROGRAM\n")
    assert not _single("PROGRAM main\nVAR b : ARRAY[0..1] OF B; END_VAR\nb[0]();\nEND_PROGRAM\n")
    assert not _single(f"{_HOLDER}PROGRAM main\nVAR h : ARRAY[0..1] OF H; END_VAR\nh[0]();\nEND_PROGRAM\n")
    assert not _single(f"{_HOLDER}PROGRAM main\nVAR h : H; b : B; END_VAR\nh();\nEND_PROGRAM\n")
    assert not _single(
        "PROGRAM P\nVAR b : B; END_VAR\nb();\nEND_PROGRAM\nCONFIGURATION c RESOURCE r ON x\n"
        "PROGRAM p1 : P; PROGRAM p2 : P;\nEND_RESOURCE END_CONFIGURATION\n"
    )


def _retained(text: str) -> set[str]:
    """The names of the variables that are inside of the ranges of RETAIN."""
    program = generated(text)
    namespace: dict[str, object] = {}
    exec(program.text, namespace)
    ranges = namespace["RETAIN"]
    assert isinstance(ranges, tuple)
    return {
        v.path
        for v in program.map.variables
        for start, end in ranges["VO".index(v.array)]
        if start <= v.slot < end
    }


def test_what_says_nothing_does_as_its_instance() -> None:
    text = (
        "FUNCTION_BLOCK B\nVAR plain : INT; r : REAL; END_VAR\nVAR RETAIN always : INT; END_VAR\n"
        "VAR NON_RETAIN never : INT; END_VAR\nplain := plain + 1;\nEND_FUNCTION_BLOCK\n"
        "PROGRAM main\nVAR a : B; x : INT; END_VAR\nVAR RETAIN b : B; c : ARRAY[0..1] OF B; y : INT; END_VAR\n"
        "VAR NON_RETAIN d : B; END_VAR\na(); b(); c[0](); d();\nEND_PROGRAM\n"
    )
    assert _retained(text) == {
        *("main.a.always", "main.b.plain", "main.b.r", "main.b.always"),
        *("main.c[].plain", "main.c[].r", "main.c[].always", "main.y", "main.d.always"),
    }


def test_retained_globals_and_programs() -> None:
    text = (
        "VAR_GLOBAL RETAIN g : ARRAY[0..2] OF REAL; END_VAR\nVAR_GLOBAL h : INT; END_VAR\n"
        "PROGRAM P\nVAR a : INT; END_VAR\nVAR NON_RETAIN b : INT; END_VAR\na := a + 1;\nEND_PROGRAM\n"
        "CONFIGURATION c RESOURCE r ON x\nPROGRAM RETAIN p1 : P; PROGRAM p2 : P;\nEND_RESOURCE END_CONFIGURATION\n"
    )
    assert _retained(text) == {"g[]", "p1.a"}
