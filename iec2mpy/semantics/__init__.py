"""The checker: names, types, constants; from trees to a program in which everything is known."""

from iec2mpy.semantics.checker import check

__all__ = ["check"]
