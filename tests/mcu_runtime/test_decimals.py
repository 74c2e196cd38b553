"""REAL as text and back, against CPython's own conversions, which are exact."""

from __future__ import annotations

import struct

from hypothesis import given
from hypothesis import strategies as st

from mcu_runtime.decimals import read, shortest
from mcu_runtime.strings import real_to_str, str_to_real

_FINITE = st.floats(width=32, allow_nan=False, allow_infinity=False)


def single(x: float) -> float:
    try:
        return struct.unpack("<f", struct.pack("<f", x))[0]
    except OverflowError:
        return float("inf")


@given(_FINITE)
def test_text_is_read_as_the_same_number(x: float) -> None:
    assert struct.pack("<f", str_to_real(real_to_str(x))) == struct.pack("<f", x)


@given(_FINITE.filter(lambda x: x > 0))
def test_no_shorter_text_is(x: float) -> None:
    digits, exponent = shortest(x)
    texts = [f"{x:.{count}e}" for count in range(5, 9)]
    mantissa, _, power = next(text for text in texts if single(float(text)) == x).partition("e")
    assert (digits, exponent) == (mantissa.replace(".", "").rstrip("0"), int(power))


@given(st.text("0123456789", min_size=1, max_size=30), st.integers(-60, 50))
def test_any_digits_are_read_as_the_nearest_single(digits: str, exponent: int) -> None:
    assert read(digits, exponent) == single(float(f"{digits}e{exponent}"))


def test_numbers_far_outside() -> None:
    assert read("1", 400_000) == float("inf")
    assert read("0", 400_000) == 0.0
    assert read("9", -400_000) == 0.0
