"""The intermediate representation, which all five languages become, and the builder that makes it."""

from iec2mpy.ir.build import build
from iec2mpy.ir.nodes import Module

__all__ = ["Module", "build"]
