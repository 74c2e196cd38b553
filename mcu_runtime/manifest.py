"""Which modules a deployed program needs on the board; for tools on the host, not deployed itself.

A program's folder holds a runtime of its own, so that replacing `active` replaces both at once.
"""

PACKAGE = (
    "__init__",
    "arithmetic",
    "background",
    "bcd",
    "characters",
    "clock",
    "controller",
    "date_texts",
    "dates",
    "decimals",
    "faults",
    "memory",
    "names",
    "ports",
    "process_image",
    "slots",
    "strings",
)
"""Go to `<folder>/mcu_runtime/`."""

FOLDER = ("plc",)
"""Go to `<folder>/`, beside `program`, `program.names` and `board.py`."""

ROOT = {"boot": "plc_boot"}
"""Go to the root of the file system, under another name, as no folder is on the path yet."""

MAIN = "import plc_boot\nplc_boot.run()\n"
"""What `main.py` says. A small file `active` at the root names the folder."""
