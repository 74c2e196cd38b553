"""Slots of V that belong to the controller. Slot 0 holds nothing; `backends/layout.py` has the same numbers."""

NOW = 1  # ms, signed 32 bits, wraps: the time of the task that runs
LOOP = 2  # passes that loops without a proven bound may still make before they ask
SITE = 3  # number of the place that raised the last fault
NOW_US = 4  # us that have passed since NOW, below 1000
WRAPS = 5  # how often NOW has come to its highest value
FIRST = 8  # of the program's variables


def now_ns(V):
    """The time of the task that runs as an LTIME: ns, to the microsecond."""
    return ((V[WRAPS] * 0x100000000 + V[NOW]) * 1000 + V[NOW_US]) * 1000
