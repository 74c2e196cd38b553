"""Slots of V that belong to the controller. Slot 0 holds nothing; `backends/layout.py` has the same numbers."""

NOW = 1  # ms, signed 32 bits, wraps: the time of the task that runs
LOOP = 2  # passes that loops without a proven bound may still make before they ask
SITE = 3  # number of the place that raised the last fault
FIRST = 8  # of the program's variables
