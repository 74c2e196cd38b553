"""REAL as decimal text, and back: exactly, wherever it runs.

With integers, as MicroPython's own conversions round more than once where floats have single precision.
"""

from mcu_runtime.arithmetic import bits_to_real, real_to_bits

_HIDDEN = 1 << 23  # the bit of a normal number that is not stored
_INFINITE = 0x7F800000
_LEAST = -149  # a single is a whole number times 2 to a power from this on


def shortest(x):
    """(digits, exponent): the fewest digits d, from 6 on and without zeros at the end, so that d.ddd times 10 to the
    exponent is read as `x`; `x` is above 0 and finite."""
    bits = real_to_bits(x)
    power = max(bits >> 23, 1) + _LEAST - 1
    above = bits % _HIDDEN + (_HIDDEN if bits >= _HIDDEN else 0)
    below = 1
    if power < 0:
        below <<= -power
    else:
        above <<= power
    exponent = len(str(above)) - len(str(below))
    if above * 10 ** max(-exponent, 0) < below * 10 ** max(exponent, 0):
        exponent -= 1
    for count in (6, 7, 8, 9):
        scale = count - 1 - exponent
        digits = str(_nearest(above * 10 ** max(scale, 0), below * 10 ** max(-scale, 0)))
        if _bits(int(digits), -scale) == bits:
            break
    # 9.9999995 with 6 digits is 10.0000
    return digits.rstrip("0"), exponent + len(digits) - count


def read(digits, exponent):
    """The single that is nearest to a whole number, given as its digits, times 10 to the exponent; or infinity."""
    if len(digits) + exponent > 40:
        exponent = 40 if digits.strip("0") else 0
    elif len(digits) + exponent < -50:
        return 0.0
    return bits_to_real(_bits(int(digits), exponent))


def _bits(n, exponent):
    """The bits of the single nearest to n times 10 to the exponent."""
    if n == 0:
        return 0
    above = n * 10 ** max(exponent, 0)
    below = 10 ** max(-exponent, 0)
    # so that the quotient has 24 bits, or 25
    power = max(len(bin(above)) - len(bin(below)) - 24, _LEAST)
    if above << max(-power, 0) >= below << (max(power, 0) + 24):
        power += 1
    mantissa = _nearest(above << max(-power, 0), below << max(power, 0))
    # a mantissa that was rounded up to 25 bits carries into the exponent
    return min(mantissa + ((power - _LEAST) << 23), _INFINITE)


def _nearest(above, below):
    """The quotient, rounded half to even."""
    quotient = above // below
    rest = 2 * (above - quotient * below)
    return quotient + (rest > below or (rest == below and quotient % 2 == 1))
