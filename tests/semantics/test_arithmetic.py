"""The meaning of operations, against plain statements of it."""

from __future__ import annotations

import math
import struct
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from iec2mpy.semantics.arithmetic import (
    ArithmeticFault,
    binary,
    builtin,
    convert,
    modulo,
    to_single,
    truncating_divide,
    unary,
    wrap,
)
from iec2mpy.semantics.types import (
    BOOL,
    BYTE,
    DINT,
    DWORD,
    ELEMENTARY,
    INT,
    REAL,
    SINT,
    TIME,
    UDINT,
    UINT,
    WORD,
    ElementaryType,
    Kind,
    StringType,
)

INTEGERS = [t for t in ELEMENTARY.values() if t.kind in (Kind.SIGNED, Kind.UNSIGNED)]
BITS = [t for t in ELEMENTARY.values() if t.kind in (Kind.BOOL, Kind.BITS)]
integer_types = st.sampled_from(INTEGERS)
any_integer = st.integers(-(2**66), 2**66)
singles = st.floats(width=32, allow_nan=False, allow_infinity=False)


def values_of(t: ElementaryType) -> st.SearchStrategy[int]:
    return st.integers(t.low, t.high)


typed_pair = integer_types.flatmap(lambda t: st.tuples(st.just(t), values_of(t), values_of(t)))


@given(any_integer, st.sampled_from(INTEGERS + BITS + [TIME]))
def test_wrap_is_the_only_value_of_the_type_with_the_same_low_bits(value: int, t: ElementaryType) -> None:
    wrapped = wrap(value, t)
    assert t.low <= wrapped <= t.high
    assert (wrapped - value) % 2**t.bits == 0


@given(typed_pair, st.sampled_from("+-*"))
def test_integer_operations_wrap(pair: tuple[ElementaryType, int, int], operator: str) -> None:
    t, a, b = pair
    exact = {"+": a + b, "-": a - b, "*": a * b}[operator]
    result = binary(operator, a, b, t, t)
    assert isinstance(result, int)
    assert t.low <= result <= t.high
    assert (result - exact) % 2**t.bits == 0


@given(st.integers(), st.integers().filter(bool))
def test_division_truncates_and_modulo_is_what_is_left(a: int, b: int) -> None:
    assert truncating_divide(a, b) == math.trunc(Fraction(a, b))
    assert truncating_divide(a, b) * b + modulo(a, b) == a
    assert abs(modulo(a, b)) < abs(b)


def test_division_by_zero_faults_and_modulo_gives_zero() -> None:
    for left, right, t in ((1, 0, INT), (1.0, 0.0, REAL), (1, 0, TIME)):
        with pytest.raises(ArithmeticFault) as fault:
            binary("/", left, right, t, t)
        assert fault.value.kind == "zero"
    assert binary("MOD", 7, 0, INT, INT) == 0


def test_smallest_integer_divided_by_minus_one_wraps() -> None:
    assert binary("/", -32768, -1, INT, INT) == -32768
    assert unary("-", -128, SINT) == -128
    assert builtin("ABS", [-128], SINT) == -128


@given(singles, singles, st.sampled_from("+-*"))
def test_real_operations_are_those_of_single_hardware(a: float, b: float, operator: str) -> None:
    exact = {"+": Fraction(a) + Fraction(b), "-": Fraction(a) - Fraction(b), "*": Fraction(a) * Fraction(b)}[operator]
    result = binary(operator, a, b, REAL, REAL)
    assert isinstance(result, float)
    if math.isinf(result):
        assert abs(exact) >= Fraction(2) ** 128 - Fraction(2) ** 103
        return
    # no other single-precision number is nearer to the exact result
    bits = struct.unpack("<I", struct.pack("<f", abs(result)))[0]
    for neighbour_bits in {max(bits - 1, 0), bits + 1}:
        neighbour = math.copysign(struct.unpack("<f", struct.pack("<I", neighbour_bits))[0], result)
        if math.isfinite(neighbour):
            assert abs(Fraction(result) - exact) <= abs(Fraction(neighbour) - exact)


def test_real_overflow_is_infinite_and_nan_passes_through() -> None:
    assert binary("*", 3e38, -10.0, REAL, REAL) == -math.inf
    assert math.isnan(binary("+", math.nan, 1.0, REAL, REAL))  # type: ignore[arg-type]
    assert builtin("EXP", [1000.0], REAL) == math.inf


@pytest.mark.parametrize(
    ("name", "arguments"),
    [("SQRT", [-1.0]), ("LN", [0.0]), ("LOG", [-1.0]), ("ASIN", [1.5]), ("ACOS", [-2.0]), ("SIN", [math.inf])],
)
def test_outside_of_the_domain_faults(name: str, arguments: list[float]) -> None:
    with pytest.raises(ArithmeticFault, match="range"):
        builtin(name, arguments, REAL)


def test_power() -> None:
    assert binary("**", 2.0, 10.0, REAL, REAL) == 1024.0
    assert binary("**", -10.0, 39.0, REAL, REAL) == -math.inf
    assert binary("**", -1e30, 1e19 + 0.0, REAL, REAL) == math.inf
    with pytest.raises(ArithmeticFault, match="range"):
        binary("**", -8.0, 0.5, REAL, REAL)


def test_time_by_numbers() -> None:
    assert binary("*", 1500, 3, TIME, INT) == 4500
    assert binary("/", 1000, 3, TIME, UINT) == 333
    assert binary("*", 1000, 2.5, TIME, REAL) == 2500
    assert binary("/", 5, 2.0, TIME, REAL) == 2  # half to even
    with pytest.raises(ArithmeticFault, match="range"):
        binary("*", 2_000_000_000, 2.0, TIME, REAL)


@given(singles)
def test_real_to_integer_rounds_half_to_even(value: float) -> None:
    if DINT.low <= round(Fraction(value)) <= DINT.high:
        assert convert(value, REAL, DINT) == round(Fraction(value))
    else:
        with pytest.raises(ArithmeticFault, match="range"):
            convert(value, REAL, DINT)


def test_rounding_and_truncation() -> None:
    assert [convert(x, REAL, INT) for x in (1.5, 2.5, -1.5, -2.5)] == [2, 2, -2, -2]
    assert [convert(x, REAL, SINT, truncate=True) for x in (1.6, -1.6, -1.4)] == [1, -1, -1]


@given(integer_types.flatmap(lambda t: st.tuples(st.just(t), values_of(t))), integer_types)
def test_numbers_keep_their_value_or_fault(source: tuple[ElementaryType, int], target: ElementaryType) -> None:
    t, value = source
    if target.low <= value <= target.high:
        assert convert(value, t, target) == value
    else:
        with pytest.raises(ArithmeticFault, match="range"):
            convert(value, t, target)


def test_bit_strings_keep_the_low_bits() -> None:
    assert convert(-1, SINT, DWORD) == 0xFF  # no sign extension: 6.6.2.5.5
    assert convert(0xFF, BYTE, SINT) == -1
    assert convert(0xFF, BYTE, INT) == 255
    assert convert(0x1234, WORD, BYTE) == 0x34
    assert convert(0x12, BYTE, BOOL) == 0
    assert convert(3, INT, BOOL) == 1
    assert convert(0xFFFFFFFF, DWORD, DINT) == -1


@given(singles)
def test_real_and_dword_exchange_their_pattern(value: float) -> None:
    pattern = convert(value, REAL, DWORD)
    assert isinstance(pattern, int)
    assert struct.pack("<I", pattern) == struct.pack("<f", value)
    assert convert(pattern, DWORD, REAL) == value


@given(st.integers(INT.low, INT.high))
def test_text_of_integers_reads_back(value: int) -> None:
    text = convert(value, INT, StringType())
    assert convert(text, StringType(), INT) == value


def test_text() -> None:
    assert convert(1, BOOL, StringType()) == "TRUE"
    assert convert("false", StringType(), BOOL) == 0
    assert convert("abcdef", StringType(), StringType(3)) == "abc"
    for text in ("", "12x", " 1", "1_0", "99999", "+"):
        with pytest.raises(ArithmeticFault, match="range"):
            convert(text, StringType(), INT)


@given(values_of(WORD), st.integers(0, 40))
def test_shifts_and_rotations(value: int, count: int) -> None:
    bits = f"{value:016b}"
    turn = count % 16
    assert builtin("SHL", [value, count], WORD) == int((bits + "0" * count)[-16:], 2)
    assert builtin("SHR", [value, count], WORD) == int(("0" * count + bits)[:16], 2)
    assert builtin("ROL", [value, count], WORD) == int(bits[turn:] + bits[:turn], 2)
    assert builtin("ROR", [value, count], WORD) == int(bits[16 - turn :] + bits[: 16 - turn], 2)


def test_negative_shift_faults() -> None:
    with pytest.raises(ArithmeticFault, match="range"):
        builtin("SHR", [1, -1], WORD)


def test_complement_stays_within_the_type() -> None:
    assert unary("NOT", 0, BOOL) == 1
    assert unary("NOT", 0x0F, BYTE) == 0xF0
    assert binary("XOR", 0xFF, 0x0F, BYTE, BYTE) == 0xF0


def test_selections() -> None:
    assert builtin("SEL", [1, 10, 20], INT) == 20
    assert builtin("LIMIT", [5, 9, 2], INT) == 2  # MN > MX gives MX
    assert builtin("MAX", [1, 3, 2], INT) == 3
    assert builtin("MIN", ["b", "a"], StringType()) == "a"
    assert builtin("MUX", [1, 10, 20, 30], INT) == 20
    with pytest.raises(ArithmeticFault, match="range"):
        builtin("MUX", [3, 10, 20, 30], INT)


@pytest.mark.parametrize(
    ("name", "arguments", "result"),
    [
        ("LEN", ["ASTRING"], 7),
        ("LEFT", ["ASTR", 3], "AST"),
        ("LEFT", ["ASTR", -1], ""),
        ("RIGHT", ["ASTR", 3], "STR"),
        ("RIGHT", ["ASTR", 9], "ASTR"),
        ("MID", ["ASTR", 2, 2], "ST"),
        ("MID", ["ASTR", 9, 3], "TR"),
        ("CONCAT", ["AB", "CD", "E"], "ABCDE"),
        ("INSERT", ["ABE", "CD", 2], "ABCDE"),
        ("INSERT", ["ABE", "CD", 0], "CDABE"),
        ("DELETE", ["ABXYC", 2, 3], "ABC"),
        ("REPLACE", ["ABCDE", "X", 2, 3], "ABXE"),
        ("FIND", ["ABCBC", "BC"], 2),
        ("FIND", ["ABC", "X"], 0),
    ],
)
def test_string_functions(name: str, arguments: list[str | int], result: str | int) -> None:
    assert builtin(name, arguments, StringType() if isinstance(result, str) else INT) == result


def test_string_result_is_cut() -> None:
    assert builtin("CONCAT", ["ABC", "DEF"], StringType(4)) == "ABCD"


def test_comparisons_give_0_or_1() -> None:
    assert binary("<", "abc", "abd", StringType(), StringType(5)) == 1
    assert binary("<", "ab", "abc", StringType(), StringType()) == 1
    assert binary("=", 4_000_000_000, 4_000_000_000, UDINT, UDINT) == 1
    assert binary(">=", -1.0, 0.0, REAL, REAL) == 0


def test_single_precision() -> None:
    assert to_single(0.1) == 0.10000000149011612
    assert to_single(1e39) == math.inf
    assert to_single(-1e39) == -math.inf
