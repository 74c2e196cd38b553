"""`python -m iec2mpy` is `iec2mpy`."""

import sys

from iec2mpy.cli import main

sys.exit(main())
