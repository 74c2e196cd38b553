"""Binary-coded decimal: a decimal digit in each four bits (3.10, tables 22 and 39)."""

from mcu_runtime.faults import RANGE


def is_bcd(bits):
    """1 where each four bits are a decimal digit, else 0."""
    while bits:
        if bits & 15 > 9:
            return 0
        bits >>= 4
    return 1


def bcd_to_int(bits, high):
    """The number that the digits say; a fault where they are none, or say one above `high`."""
    number = 0
    scale = 1
    while bits:
        digit = bits & 15
        if digit > 9:
            raise RANGE
        number += digit * scale
        scale *= 10
        bits >>= 4
    if number > high:
        raise RANGE
    return number


def int_to_bcd(number, digits):
    """The digits of a number; a fault where it is negative or has more than `digits`."""
    bits = 0
    for place in range(digits):
        bits |= number % 10 << 4 * place
        number //= 10
    if number:
        raise RANGE
    return bits
