"""What the host and a MicroPython child say to each other: texts with their length before them, and values as words of
such a text. Both sides use this file, so it uses only what MicroPython has.

A value is one word: `i-5` an integer, `f3ff0000000000000` the bits of a double, `s6162` a text in UTF-8. So every value
arrives exactly as it was sent.
"""

import binascii
import struct

HEADER = 8  # hexadecimal digits: the length of the text in bytes


def frame(text: str) -> bytes:
    """A text with its length before it."""
    data = text.encode()
    return b"%08x" % len(data) + data


def word(value: object) -> str:
    """A value as a word."""
    if isinstance(value, str):
        return "s" + binascii.hexlify(value.encode()).decode()
    if isinstance(value, float):
        return "f" + binascii.hexlify(struct.pack(">d", value)).decode()
    return f"i{value}"


def value(text: str) -> object:
    """The value that a word stands for."""
    kind, rest = text[0], text[1:]
    if kind == "s":
        return binascii.unhexlify(rest).decode()
    if kind == "f":
        return struct.unpack(">d", binascii.unhexlify(rest))[0]
    return int(rest)
