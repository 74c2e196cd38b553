"""From text to the syntax tree."""

from iec2mpy.syntax.parser import parse

__all__ = ["parse"]
