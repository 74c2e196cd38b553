"""`program.names`: finds a variable by its path, and says how its value looks.

The file is read line by line when something is asked for, as a board has no room for a table of names.
"""

from mcu_runtime.arithmetic import bits_to_lreal, bits_to_real, f32, lreal_to_bits, real_to_bits
from mcu_runtime.date_texts import date_to_str, is_date, str_to_date
from mcu_runtime.faults import Catchable, forget_tracebacks


class Names:
    def __init__(self, path):
        self._path = path

    def resolve(self, path):
        """The `Place` of a variable such as `main.a[3].x`; KeyError where there is none."""
        pattern, subscripts = _pattern(path)
        fields = self._line(pattern)
        if fields is None:
            raise KeyError("there is no variable %s" % path)
        _, type_name, array, slot, low, high, dimensions = fields
        slot = int(slot)
        dimensions = dimensions.split(";")
        for i, index in enumerate(subscripts):
            first, last, stride = [int(number) for number in dimensions[i].split(":")]
            if not first <= index <= last:
                raise KeyError("%s: the subscript %d is not in %d..%d" % (path, index, first, last))
            slot += (index - first) * stride
        enumeration = self._line("=" + type_name) if low and type_name not in _ELEMENTARY else None
        members = {}
        for member in enumeration[1:] if enumeration else ():
            name, number = member.split(":")
            members[name] = int(number)
        return Place(path, type_name, array, slot, int(low) if low else None, int(high) if high else None, members)

    def place(self, site):
        """Where a fault was raised: `main.st:12 (main)`; "" for site 0, and where the file does not say."""
        fields = self._line("@%d" % site) if site else None
        return "%s:%s (%s)" % (fields[1], fields[2], fields[3]) if fields else ""

    def _line(self, key):
        """The fields of the line that starts with `key`, or None."""
        start = key + "\t"
        with open(self._path) as file:
            for line in file:
                if line.startswith(start):
                    return line.rstrip("\r\n").split("\t")
        return None


_ELEMENTARY = (
    "BOOL",
    "SINT",
    "INT",
    "DINT",
    "LINT",
    "USINT",
    "UINT",
    "UDINT",
    "ULINT",
    "BYTE",
    "WORD",
    "DWORD",
    "LWORD",
    "TIME",
    "LTIME",
    "CHAR",
    "DATE",
    "TOD",
    "DT",
    "LDATE",
    "LTOD",
    "LDT",
    "STRING",
    "WSTRING",
)


class Place:
    """One variable. Values: BOOL bool, integers and bit strings int, TIME int (ms), LTIME int (ns), REAL and LREAL
    float, STRING and WSTRING str, CHAR (a WCHAR too) a str of one character, dates and times of day their literal as a
    str, an enumeration the name of the value, a reference "NULL" or "not NULL". `low` and `high`: of a STRING 0 and its
    capacity, of a REAL or LREAL None.

    `array` is V or O; or B and a number of bits, for a variable among bytes that others share: each byte is in a slot
    of V, and `slot` counts bits from slot 0 on."""

    def __init__(self, path, type_name, array, slot, low, high, members):
        self.path = path
        self.type = type_name
        self.array = array
        self.slot = slot
        self._bits = int(array[1:]) if array[0] == "B" else 0
        # a real number or a text: neither a number with limits nor a name
        self._is_object = low is None or type_name in ("STRING", "WSTRING")
        self.low = low
        self.high = high
        self._members = members

    def load(self, program):
        """What is stored."""
        if not self._bits:
            return (program.O if self.array == "O" else program.V)[self.slot]
        number = 0
        for i, at in enumerate(self._bytes()):
            number |= program.V[at] << 8 * i
        number = number >> (self.slot & 7) & ((1 << self._bits) - 1)
        if self.low is None:
            return bits_to_real(number) if self._bits == 32 else bits_to_lreal(number)
        return number - (1 << self._bits) if self.low < 0 and number >> (self._bits - 1) else number

    def store(self, program, stored):
        """Stores what `encode` gave; other variables in the same bytes keep their bits."""
        if not self._bits:
            (program.O if self.array == "O" else program.V)[self.slot] = stored
            return
        ones = (1 << self._bits) - 1 << (self.slot & 7)
        if self.low is None:
            stored = real_to_bits(stored) if self._bits == 32 else lreal_to_bits(stored)
        number = stored << (self.slot & 7) & ones
        for i, at in enumerate(self._bytes()):
            program.V[at] = program.V[at] & ~(ones >> 8 * i) | number >> 8 * i & 0xFF

    def _bytes(self):
        return range(self.slot >> 3, (self.slot + self._bits + 7) >> 3)

    def decode(self, stored):
        """The value that is stored as `stored`."""
        if self._is_object:
            return stored
        if self.type == "BOOL":
            return stored != 0
        if self.type == "CHAR":
            return chr(stored)
        if self.type == "REF_TO":
            return "not NULL" if stored else "NULL"
        if is_date(self.type):
            return date_to_str(stored, self.type)
        for name, number in self._members.items():
            if number == stored:
                return name
        if self.array == "O":
            return stored
        return stored + 0x100000000 if stored < 0 <= self.low else stored

    def encode(self, value):
        """How `value` is stored; ValueError where the declared type does not have it."""
        if self._is_object:
            return self._object(value)
        if self.type == "REF_TO":
            if value != "NULL":
                raise ValueError("%s is a reference: only \"NULL\" can be written to it" % self.path)
            return 0
        if self._members:
            for name, number in self._members.items():
                if isinstance(value, str) and name.lower() == value.lower():
                    return number
            raise ValueError("%s is one of %s" % (self.path, ", ".join(self._members)))
        if self.type == "CHAR":
            return ord(self._text(value, 1, 1, self.high))
        if is_date(self.type):
            return self._date(value)
        if isinstance(value, bool):
            if self.type != "BOOL":
                value = None
        elif not isinstance(value, int):
            value = None
        if value is None or not self.low <= value <= self.high:
            if self.type == "BOOL":
                raise ValueError("%s is False or True" % self.path)
            raise ValueError("%s is a %s: a whole number from %d to %d" % (self.path, self.type, self.low, self.high))
        value = int(value)
        return value - 0x100000000 if self.array == "V" and value > 0x7FFFFFFF else value

    def _date(self, value):
        try:
            if isinstance(value, str):
                return str_to_date(value, self.type, self.low, self.high)
        except Catchable:
            forget_tracebacks()
        raise ValueError("%s is a %s: a text such as %s" % (self.path, self.type, date_to_str(0, self.type)))

    def _object(self, value):
        if self.high is None:
            if isinstance(value, bool) or not isinstance(value, (int, float)):
                raise ValueError("%s is a %s: a number" % (self.path, self.type))
            return float(value) if self.type == "LREAL" else f32(float(value))
        return self._text(value, 0, self.high, 0xFFFF if self.type == "WSTRING" else 0xFF)

    def _text(self, value, shortest, longest, highest):
        """`highest`: the greatest code that a character may have."""
        if not isinstance(value, str) or not shortest <= len(value) <= longest:
            size = "one character" if shortest else "at most %d characters" % longest
            raise ValueError("%s is a %s: a text of %s" % (self.path, self.type, size))
        for c in value:
            if ord(c) > highest:
                raise ValueError("%s: its characters have codes up to %d" % (self.path, highest))
        return value


def _pattern(path):
    """`Main.A[3, 4].x` gives ("main.a[,].x", [3, 4])."""
    pattern = ""
    subscripts = []
    rest = path.replace(" ", "").lower()
    while "[" in rest:
        before, _, rest = rest.partition("[")
        inside, closed, rest = rest.partition("]")
        try:
            subscripts += [int(number) for number in inside.split(",")]
        except ValueError:
            closed = ""
        if not closed:
            raise KeyError("there is no variable %s: a subscript is a whole number" % path)
        pattern += before + "[" + "," * inside.count(",") + "]"
    return pattern + rest, subscripts
