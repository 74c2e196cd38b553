from support import raises

from mcu_runtime.arithmetic import (
    bits_to_real,
    f32,
    real_acos,
    real_asin,
    real_atan2,
    real_exp,
    real_ln,
    real_log,
    real_pow,
    real_sin,
    real_sqrt,
    real_tan,
    real_to_bits,
    real_to_int,
    real_trunc,
)
from mcu_runtime.faults import RANGE

INFINITY = float("inf")
NAN = float("nan")


def test_f32_rounds_to_single():
    assert f32(0.1) == 0.10000000149011612
    assert f32(16777217.0) == 16777216.0
    assert f32(1e39) == INFINITY
    assert f32(-1e39) == -INFINITY
    assert f32(1e-50) == 0.0
    assert f32(NAN) != f32(NAN)


def test_real_to_int_rounds_half_to_even():
    assert [real_to_int(x, -100, 100) for x in (0.5, 1.5, 2.5, -0.5, -1.5, 2.51)] == [0, 2, 2, 0, -2, 3]


def test_real_to_int_range():
    assert real_to_int(32767.4, -32768, 32767) == 32767
    assert real_to_int(4294967040.0, 0, 4294967295) == 4294967040  # the largest single that fits
    for x in (32767.5, -32769.0, NAN, INFINITY, -INFINITY, 1e30):
        raises(RANGE, real_to_int, x, -32768, 32767)


def test_real_trunc():
    assert [real_trunc(x, -10, 10) for x in (1.9, -1.9, 10.9)] == [1, -1, 10]
    raises(RANGE, real_trunc, 11.0, -10, 10)
    raises(RANGE, real_trunc, NAN, -10, 10)


def test_domains():
    assert real_sqrt(2.25) == 1.5
    assert real_ln(1.0) == 0.0
    assert real_log(1000.0) == 3.0
    assert real_tan(0.0) == 0.0
    assert real_atan2(0.0, 1.0) == 0.0
    raises(RANGE, real_sqrt, -1.0)
    raises(RANGE, real_ln, 0.0)
    raises(RANGE, real_log, -1.0)
    raises(RANGE, real_asin, 1.5)
    raises(RANGE, real_acos, -1.5)
    raises(RANGE, real_sin, INFINITY)


def test_nan_passes_through():
    for function in (real_sqrt, real_ln, real_sin, real_asin, real_exp):
        x = function(NAN)
        assert x != x
    x = real_pow(NAN, 2.0)
    assert x != x


def test_exp_overflows_to_infinity():
    assert real_exp(0.0) == 1.0
    assert real_exp(1000.0) == INFINITY
    assert real_exp(-1000.0) == 0.0


def test_real_pow():
    assert real_pow(2.0, 10.0) == 1024.0
    assert real_pow(-2.0, 3.0) == -8.0
    assert real_pow(2.0, -1.0) == 0.5
    assert real_pow(1e200, 2.0) == INFINITY
    assert real_pow(-1e200, 3.0) == -INFINITY
    assert real_pow(-1e200, 2.0) == INFINITY
    assert real_pow(0.0, 0.0) == 1.0
    assert real_pow(-2.0, INFINITY) == INFINITY
    raises(RANGE, real_pow, 0.0, -1.0)
    raises(RANGE, real_pow, -8.0, 0.5)


def test_bits():
    assert real_to_bits(1.0) == 0x3F800000
    assert real_to_bits(-0.0) == 0x80000000
    assert real_to_bits(INFINITY) == 0x7F800000
    assert bits_to_real(0xC0000000) == -2.0
    assert bits_to_real(0xC0000000 - 0x100000000) == -2.0
    assert bits_to_real(0x7F800000) == INFINITY
