"""Layout of the memory image, and text of MicroPython from the IR."""

from iec2mpy.backends.generator import GeneratedProgram, TooLarge, generate
from iec2mpy.backends.target import Target

__all__ = ["GeneratedProgram", "Target", "TooLarge", "generate"]
