"""Operations on native values: registers of 32 bits.

A result that cannot leave its 32 bits is not wrapped, and neither is an operand of which only the low bits count.
"""

from __future__ import annotations

import ast

from iec2mpy.simulator.viper32.code import binary, bind, call, choose, compare, constant, is_simple, name
from iec2mpy.simulator.viper32.machine import INT_HIGH, INT_LOW, SMALL_HIGH, SMALL_LOW, UINT_HIGH
from iec2mpy.simulator.viper32.scope import Scope
from iec2mpy.simulator.viper32.values import NUMBERS, Kind, Value, an_object, bounds, immediate, is_unsigned, native

_RING = (ast.Add, ast.Sub, ast.Mult)
_BITWISE = (ast.BitAnd, ast.BitOr, ast.BitXor)
_COMPARED = (ast.Lt, ast.Gt, ast.Eq, ast.LtE, ast.GtE, ast.NotEq)


def _wrapped(kind: Kind, bits: ast.expr, scope: Scope) -> Value:
    """The register of `kind` that holds the low 32 bits of `bits`."""
    low, high = bounds(kind)
    if is_unsigned(kind):
        return Value(kind, binary(bits, ast.BitAnd(), constant(UINT_HIGH)), low, high, bits)
    temporary = scope.fresh()
    in_range = compare(constant(INT_LOW), (ast.LtE(), bind(temporary, bits)), (ast.LtE(), constant(INT_HIGH)))
    return Value(kind, choose(in_range, name(temporary), call("$wrap", name(temporary))), low, high, bits)


def _fitting(kind: Kind, exact: ast.expr, bits: ast.expr, range_: tuple[int, int], scope: Scope) -> Value:
    """`exact` if all of its `range_` fits the register, otherwise `bits`, wrapped."""
    low, high = bounds(kind)
    if low <= range_[0] and range_[1] <= high:
        return Value(kind, exact, *range_)
    return _wrapped(kind, bits, scope)


def retype(value: Value, kind: Kind, scope: Scope) -> Value:
    """The same register, read as another native type: viper's cast of a native value."""
    if value.immediate is not None:
        return immediate(kind, value.immediate)
    if value.kind is Kind.NONE:
        return Value(kind, constant(0), 0, 0)
    code = ast.UnaryOp(ast.UAdd(), value.code) if value.kind is Kind.BOOL else value.code  # True becomes 1
    low, high = bounds(kind)
    if low <= value.low and value.high <= high:
        return Value(kind, code, value.low, value.high, value.bits, in_local=value.in_local)
    result = _wrapped(kind, code if value.bits is None else value.bits, scope)
    return Value(kind, result.code, low, high, result.bits, in_local=value.in_local)


def to_object(value: Value) -> ast.expr:
    """MicroPython's object for a native value or an object, as an argument, an element or a result."""
    if value.kind is Kind.OBJECT:
        return value.code
    if value.kind is Kind.NONE:
        return constant(None)
    if value.kind is Kind.BOOL:
        return value.code if isinstance(value.code, ast.Compare) else compare(value.code, (ast.NotEq(), constant(0)))
    if value.low >= SMALL_LOW and value.high <= SMALL_HIGH:
        return value.code
    return call("$object", value.code)


def is_decided(left: Kind, right: Kind) -> bool:
    """Whether an operation between the two is one of registers."""
    return left in NUMBERS and right in NUMBERS


def binary_operation(operator: ast.operator, left: Value, right: Value, scope: Scope) -> Value:
    """An operation of two numbers; the result has the type of the left one."""
    kind = left.kind
    if isinstance(operator, ast.FloorDiv | ast.Mod):
        if kind is Kind.UINT:
            scope.report("div/mod not implemented for uint")
            return native(Kind.INT, constant(0))
        return _division(operator, left, retype(right, Kind.INT, scope), scope)
    if isinstance(operator, ast.LShift | ast.RShift):
        return _shift(operator, left, right, scope)
    if isinstance(operator, _BITWISE):
        return _bitwise(operator, left, retype(right, kind, scope), scope)
    if isinstance(operator, _RING):
        exact = binary(left.code, operator, right.code)
        bits = binary(left.low_bits, operator, right.low_bits)
        return _fitting(kind, exact, bits, _range(operator, left, right), scope)
    scope.report("binary op  not implemented")
    return left


def _range(operator: ast.operator, left: Value, right: Value) -> tuple[int, int]:
    if isinstance(operator, ast.Add):
        return left.low + right.low, left.high + right.high
    if isinstance(operator, ast.Sub):
        return left.low - right.high, left.high - right.low
    corners = [a * b for a in (left.low, left.high) for b in (right.low, right.high)]
    return min(corners), max(corners)


def _bitwise(operator: ast.operator, left: Value, right: Value, scope: Scope) -> Value:
    """Both have one type. A mask that is not negative takes low bits only, so its operand needs no wrapping."""
    if isinstance(operator, ast.BitAnd):
        masks = [value.high for value in (left, right) if value.low >= 0]
        exact = [value.immediate is not None and value.low >= 0 for value in (left, right)]
        if any(exact):
            return Value(left.kind, binary(left.low_bits, operator, right.low_bits), 0, min(masks))
        if masks:
            return Value(left.kind, binary(left.code, operator, right.code), 0, min(masks))
    elif left.low >= 0 and right.low >= 0:
        high = (1 << max(left.high, right.high).bit_length()) - 1
        return Value(left.kind, binary(left.code, operator, right.code), 0, high)
    return native(left.kind, binary(left.code, operator, right.code))


def _shift(operator: ast.operator, left: Value, right: Value, scope: Scope) -> Value:
    count = right.code
    if right.low < 0 or right.high > 31:
        if not is_simple(count):
            temporary = scope.fresh()
            count, tested = name(temporary), bind(temporary, count)
        else:
            tested = count
        valid = compare(constant(0), (ast.LtE(), tested), (ast.LtE(), constant(31)))
        count = choose(valid, count, call("$shift", count))
    least, most = max(0, min(right.low, 31)), max(0, min(right.high, 31))
    if isinstance(operator, ast.RShift):
        lowest, highest = min(left.low >> least, left.low >> most), max(left.high >> least, left.high >> most)
        return Value(left.kind, binary(left.code, operator, count), lowest, highest)
    range_ = (min(left.low << least, left.low << most), max(left.high << least, left.high << most))
    exact, bits = binary(left.code, operator, count), binary(left.low_bits, operator, count)
    return _fitting(left.kind, exact, bits, range_, scope)


def _division(operator: ast.operator, left: Value, right: Value, scope: Scope) -> Value:
    """Rounds down. A quotient by a positive constant is exact where the sum that comes first cannot overflow."""
    divisor = right.immediate
    if isinstance(operator, ast.Mod):
        if divisor in (None, 0, -1):
            return native(Kind.INT, call("$mod", left.code, right.code))
        low, high = (0, divisor - 1) if divisor > 0 else (divisor + 1, 0)
        return Value(Kind.INT, binary(left.code, operator, right.code), low, high)
    if divisor is not None and divisor > 0 and left.low >= INT_LOW + divisor - 1:
        return Value(Kind.INT, binary(left.code, operator, right.code), left.low // divisor, left.high // divisor)
    return native(Kind.INT, call("$floordiv", left.code, right.code))


def comparison(operator: ast.cmpop, left: Value, right: Value, scope: Scope) -> Value:
    """Of two values of any types."""
    if is_decided(left.kind, right.kind):
        if not isinstance(operator, _COMPARED):
            scope.report("binary op  not implemented")
            return left
        if left.kind is not right.kind:
            scope.report("comparison of int and uint")
        return Value(Kind.BOOL, compare(left.code, (operator, right.code)), 0, 1)
    if left.kind is Kind.OBJECT and right.kind is Kind.OBJECT:
        return an_object(call(f"${type(operator).__name__}", left.code, right.code))
    return mismatch(left, right, scope)


def mismatch(left: Value, right: Value, scope: Scope) -> Value:
    scope.report(f"can't do binary op between '{left.kind.shown}' and '{right.kind.shown}'")
    return left


