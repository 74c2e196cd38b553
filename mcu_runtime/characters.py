"""Characters of strings (6.4.2.2), and strings of other characters (table 27). A character is its code."""

from mcu_runtime.faults import INDEX


def character(s, position):
    """The code of the character at `position` (from 1); faults `index` where there is none."""
    if not 1 <= position <= len(s):
        raise INDEX
    return ord(s[position - 1])


def with_character(s, position, code):
    """The string with another character at `position`; faults `index` where it has none there."""
    if not 1 <= position <= len(s):
        raise INDEX
    return s[: position - 1] + chr(code) + s[position:]


def first_character(s):
    """The code of the first character; 0 for the empty string."""
    return ord(s[0]) if s else 0


def to_narrow(s):
    """A WSTRING as a STRING, with `?` for each character that a STRING cannot have."""
    for c in s:
        if ord(c) > 0xFF:
            return "".join([c if ord(c) <= 0xFF else "?" for c in s])
    return s
