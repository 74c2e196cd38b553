"""What runs on the board; also on MicroPython for Linux, and on CPython."""
