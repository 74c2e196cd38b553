"""What scenarios share; MicroPython runs it too."""


def raises(expected, function, *arguments):
    """The error that the call raises: of the class, or the very object, `expected`."""
    try:
        result = function(*arguments)
    except Exception as error:
        if error is expected or (isinstance(expected, type) and isinstance(error, expected)):
            return error
        raise
    raise AssertionError(f"nothing raised, but {result!r} returned")


class Program:
    """Looks like a generated module: a slot 8, which counts what runs, and a log of (task, NOW)."""

    HASH = "c0ffee"
    INPUTS = ()
    OUTPUTS = ()

    def __init__(self, tasks=(), untimed=None, retain=((), ())):
        from array import array

        self.V = array("i", [0] * 16)
        self.O = ["", 0.0, ""]
        self.TASKS = tasks
        self.UNTIMED = untimed
        self.RETAIN = retain
        self.log = []

    def reset(self):
        for slot in range(8, 16):
            self.V[slot] = 0
        self.O[1] = 0.5
        self.O[2] = "new"

    def runs(self, name):
        def run():
            self.V[8] += 1
            self.log.append((name, self.V[1]))

        return run


class IO:
    """Logs what the controller asks of it."""

    def __init__(self):
        self.log = []

    def read(self, V):
        self.log.append("read")

    def write(self, V):
        self.log.append("write")

    def safe(self, V):
        self.log.append("safe")
