"""Literals of dates and times of day (table 9): what conversions to and from STRING give and take, and what a user
reads and writes."""

from mcu_runtime.dates import concat_date, parts
from mcu_runtime.faults import RANGE

_DAY = 86_400_000_000_000
# Prefix that is written, kind, ns that 1 stands for.
_TYPES = {
    "DATE": ("D", "d", _DAY),
    "LDATE": ("LD", "d", 1),
    "TOD": ("TOD", "t", 1_000_000),
    "LTOD": ("LTOD", "t", 1),
    "DT": ("DT", "dt", 1_000_000),
    "LDT": ("LDT", "dt", 1),
}
# Short and long types share their literals.
_PREFIXES = {
    "d": ("D", "DATE", "LD", "LDATE"),
    "t": ("TOD", "TIME_OF_DAY", "LTOD", "LTIME_OF_DAY"),
    "dt": ("DT", "DATE_AND_TIME", "LDT", "LDATE_AND_TIME"),
}


def is_date(type_name):
    """Whether values of the type are written as such literals."""
    return type_name in _TYPES


def date_to_str(value, type_name):
    """The literal, with three, six or nine digits of a second where they are not 0."""
    prefix, kind, unit = _TYPES[type_name]
    ns = value * unit
    shown = []
    if "d" in kind:
        shown.append("%04d-%02d-%02d" % parts(ns // _DAY))
    if "t" in kind:
        ns %= _DAY
        seconds = ns // 1_000_000_000
        text = "%02d:%02d:%02d" % (seconds // 3600, seconds // 60 % 60, seconds % 60)
        digits = "%09d" % (ns % 1_000_000_000)
        while digits.endswith("000"):
            digits = digits[:-3]
        shown.append(text + "." + digits if digits else text)
    return prefix + "#" + "-".join(shown)


def str_to_date(text, type_name, low, high):
    """The value of a literal of the type; faults `range` where it is none."""
    _, kind, unit = _TYPES[type_name]
    prefix, _, text = text.strip().partition("#")
    if prefix.upper() not in _PREFIXES[kind]:
        raise RANGE
    fields = text.split("-")
    if len(fields) != (3 if "d" in kind else 0) + (1 if "t" in kind else 0):
        raise RANGE
    ns = 0
    if "d" in kind:
        ns = concat_date(_number(fields[0]), _number(fields[1]), _number(fields[2])) * _DAY
    if "t" in kind:
        ns += _time(fields[-1])
    value = ns // unit
    if not low <= value <= high:
        raise RANGE
    return value


def _time(text):
    """Nanoseconds since midnight."""
    fields = text.split(":")
    if len(fields) != 3:
        raise RANGE
    second, point, fraction = fields[2].partition(".")
    hour, minute, second = _number(fields[0]), _number(fields[1]), _number(second)
    if hour > 23 or minute > 59 or second > 59:
        raise RANGE
    ns = ((hour * 60 + minute) * 60 + second) * 1_000_000_000
    if point:
        ns += _number(fraction) * 1_000_000_000 // 10 ** len(fraction.replace("_", ""))
    return ns


def _number(text):
    """Decimal digits, with single underlines between them."""
    if not text or text[0] == "_" or text[-1] == "_" or "__" in text:
        raise RANGE
    n = 0
    for c in text:
        if c != "_":
            if not "0" <= c <= "9":
                raise RANGE
            n = n * 10 + ord(c) - 48
    return n
