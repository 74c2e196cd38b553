"""x"""

from iec2mpy.simulator.viper32.errors import ViperError, ViperFault
from iec2mpy.simulator.viper32.loader import load
from iec2mpy.simulator.viper32.machine import Stats, stats

__all__ = ["Stats", "ViperError", "ViperFault", "load", "stats"]
