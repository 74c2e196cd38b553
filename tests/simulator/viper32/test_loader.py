"""Loading: the namespace, imports, lines, what a module may not do."""

from __future__ import annotations

import sys
import traceback
from types import FrameType, ModuleType

import pytest

from iec2mpy.simulator.viper32 import ViperError, load

from .texts import PREAMBLE

GENERATED = '''\
from array import array
from micropython import const
import micropython
from mcu_runtime.viper32_test import ZERO, real_to_int
V = array("i", bytes(4 * 64))
O = [0.0, 4.0]
_MAIN_X = const(8)
@micropython.viper
def TON(b: int):
    v = ptr32(V)
    if v[b + 3] == 0:
        v[b + 3] = v[b] + 1
@micropython.viper
def main():
    v = ptr32(V)
    o = O
    t1 = v[_MAIN_X] + 1
    v[_MAIN_X] = ((t1 + 32768) & 65535) - 32768
    if v[9] == 0:
        v[3] = 17
        raise ZERO
    o[1] = o[0] * 2.0 + float(t1)
    v[10] = int(o[0] < o[1]) & v[11]
    v[12] = int(real_to_int(o[1], -32768, 32767))
    TON(20)
TASKS = (("main", 10000, 0, main),)
'''


class Fault(Exception):
    pass


@pytest.fixture(autouse=True)
def runtime(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    module = ModuleType("mcu_runtime.viper32_test")
    names: dict[str, object] = {"ZERO": Fault("zero"), "real_to_int": lambda x, low, high: round(x)}
    for name, value in names.items():
        setattr(module, name, value)
    monkeypatch.setitem(sys.modules, module.__name__, module)
    return module


def test_generated_code(runtime: ModuleType) -> None:
    names = load(GENERATED, "program.py")
    V, main = names["V"], names["TASKS"][0][3]
    V[8], V[9], V[11], V[20] = 32767, 1, 3, 41
    main()
    assert V[8] == -32768
    assert (V[10], V[12]) == (1, 32768)
    assert V[23] == 42
    assert "_MAIN_X" not in names
    V[9] = 0
    with pytest.raises(Fault) as caught:
        main()
    assert caught.value is runtime.ZERO
    assert V[3] == 17


def test_tracebacks_have_the_lines_of_the_text() -> None:
    names = load(GENERATED, "program.py")
    with pytest.raises(Fault) as caught:
        names["main"]()
    last = traceback.extract_tb(caught.value.__traceback__)[-1]
    assert (last.filename, last.name, GENERATED.splitlines()[last.lineno - 1].strip()) == (
        "program.py",
        "main",
        "raise ZERO",
    )


def test_lines_that_ran_are_lines_of_the_text() -> None:
    names = load(GENERATED, "program.py")
    names["V"][9] = 1
    seen: set[int] = set()

    def trace(frame: FrameType, event: str, argument: object) -> object:
        if frame.f_code.co_filename != "program.py":
            return None
        if event == "line":
            seen.add(frame.f_lineno)
        return trace

    before = sys.gettrace()
    sys.settrace(trace)
    try:
        names["main"]()
    finally:
        sys.settrace(before)
    skipped = {20, 21}
    assert seen >= {*range(10, 13), *range(15, 26)} - skipped
    assert not seen & skipped


def test_only_the_runtime_can_be_imported() -> None:
    with pytest.raises(ImportError, match="no module named 'os'"):
        load("import os\n", "program.py")
    with pytest.raises(ImportError):
        load("from mcu_runtime_other import x\n", "program.py")


def test_only_built_in_names_of_micropython() -> None:
    with pytest.raises(NameError):
        load("open('x')\n", "program.py")


def test_text_that_does_not_parse() -> None:
    with pytest.raises(ViperError) as caught:
        load("x = 1\ny = = 2\n", "program.py")
    assert (caught.value.message, caught.value.line) == ("SyntaxError: invalid syntax", 2)


@pytest.mark.parametrize(
    ("decorators", "message"),
    [
        ("@micropython.asm", "SyntaxError: invalid micropython decorator"),
        ("@micropython.viper\n@str", "viper32: a second decorator of a viper function"),
    ],
)
def test_decorators(decorators: str, message: str) -> None:
    with pytest.raises(ViperError) as caught:
        load(f"{PREAMBLE}{decorators}\ndef f():\n    pass\n", "program.py")
    assert caught.value.message == message


def test_bytecode_is_python() -> None:
    text = PREAMBLE + '''
class Fault(Exception):
    limit: int = 5
    def __init__(self, kind: unknown):
        super().__init__(kind)
        self.n = [0]
        self.n[0] += 2
@micropython.native
def f(n: unknown) -> unknown:
    x: unknown = 1 << 40
    x *= n
    return [i for i in range(x >> 40) if 0 < i < 3]
error = Fault("zero")
'''
    names = load(text, "program.py")
    assert names["f"](5) == [1, 2]
    assert names["error"].n == [2]
    assert names["error"].limit == 5


def test_a_global_can_be_assigned() -> None:
    text = PREAMBLE + """
n = 0
@micropython.viper
def f(a: int):
    b = 1
    global n
    n = a + b
    g()
def g():
    O[0] = n
"""
    names = load(text, "program.py")
    names["f"](4)
    assert names["n"] == 5
    assert names["O"][0] == 5


def test_each_load_is_its_own() -> None:
    first, second = load(GENERATED, "a.py"), load(GENERATED, "b.py")
    first["V"][9] = 1
    first["main"]()
    assert second["V"][8] == 0


def test_functions_take_positions_only() -> None:
    names = load(GENERATED, "program.py")
    with pytest.raises(TypeError):
        names["TON"](b=20)
    with pytest.raises(TypeError):
        names["TON"]()
