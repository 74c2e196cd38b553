import gc

from mcu_runtime import faults
from mcu_runtime.arithmetic import real_sqrt
from mcu_runtime.faults import Catchable, forget_tracebacks, kind_of

KINDS = {
    "zero": faults.ZERO,
    "index": faults.INDEX,
    "range": faults.RANGE,
    "NULL": faults.NULL,
    "recursion": faults.RECURSION,
    "loop": faults.LOOP,
}


def test_each_fault_has_its_word():
    for word, fault in KINDS.items():
        assert kind_of(fault) == word
    assert kind_of(ValueError("range")) is None
    assert kind_of(Catchable("zero")) is None, "only the objects made at load are faults"


def test_a_call_with_eno_catches_all_but_loop():
    caught = [word for word, fault in KINDS.items() if isinstance(fault, Catchable)]
    assert sorted(caught) == ["NULL", "index", "range", "recursion", "zero"]


def catch(times):
    for _ in range(times):
        try:
            real_sqrt(-1.0)
        except Catchable:
            forget_tracebacks()


def test_faults_that_were_caught_take_no_memory():
    if not hasattr(gc, "mem_alloc"):
        return  # CPython does not say
    catch(10)
    gc.collect()
    before = gc.mem_alloc()
    catch(2000)
    gc.collect()
    assert gc.mem_alloc() - before < 200, gc.mem_alloc() - before
