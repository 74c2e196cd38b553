import os

from support import Program, raises

from mcu_runtime.names import Names

FILE = f"names_{id(os)}.txt"
TEXT = """=Colour|red:0|Green:2
main.b|BOOL|V|8|0|1|
main.n|INT|V|9|-32768|32767|
main.level|INT (0..100)|V|10|0|100|
main.u|UDINT|V|11|0|4294967295|
main.c|Colour|V|12|0|2|
main.x|REAL|O|1|||
main.s|STRING|O|2|0|5|
main.t|TIME|V|13|-2147483648|2147483647|
main.a[]|INT|V|20|-32768|32767|1:3:1
main.m[,].on|BOOL|V|30|0|1|0:1:6;-1:1:2
main.text|STRING|O|3|0|254|
main.wide|WSTRING|O|4|0|3|
main.ch|CHAR|V|14|0|255|
main.wch|CHAR|V|15|0|65535|
main.l|ULINT|O|5|0|18446744073709551615|
main.d|LTIME|O|6|-9223372036854775808|9223372036854775807|
main.y|LREAL|O|7|||
main.low|BYTE|B8|64|0|255|
main.bit[]|BOOL|B1|67|0|1|0:9:1
main.both|INT|B16|64|-32768|32767|
main.real|REAL|B32|64|||
main.mode|Colour|B16|80|0|2|
@12|src/main.st|7|main
@1|src/other.st|3|Valve
""".replace("|", "\t")


def place(path):
    with open(FILE, "w") as file:
        file.write(TEXT)
    try:
        return Names(FILE).resolve(path)
    finally:
        os.remove(FILE)


def test_paths():
    found = place("Main.B")
    assert (found.array, found.slot, found.type, found.low, found.high) == ("V", 8, "BOOL", 0, 1)
    assert place("main.a[3]").slot == 22
    assert place("main.m[1, 0].ON").slot == 38
    assert (place("main.x").array, place("main.x").slot) == ("O", 1)


def test_unknown_names():
    assert "main.zz" in str(raises(KeyError, place, "main.zz"))
    assert "1..3" in str(raises(KeyError, place, "main.a[4]"))
    raises(KeyError, place, "main.a")
    raises(KeyError, place, "main.a[1")
    raises(KeyError, place, "main.a[x]")
    raises(KeyError, place, "main.a[1,2]")
    raises(KeyError, place, "main")


def test_wide_values():
    assert place("main.l").encode(18446744073709551615) == 18446744073709551615
    assert place("main.d").encode(-5_000_000_000) == -5_000_000_000
    assert place("main.l").decode(1 << 40) == 1 << 40
    assert place("main.y").encode(0.1) == 0.1
    assert "ULINT" in str(raises(ValueError, place("main.l").encode, -1))
    raises(ValueError, place("main.d").encode, 1.5)
    raises(ValueError, place("main.l").encode, 1 << 64)


def test_decode():
    assert place("main.b").decode(1) is True
    assert place("main.u").decode(-1) == 4294967295
    assert place("main.n").decode(-1) == -1
    assert place("main.c").decode(2) == "Green"
    assert place("main.c").decode(1) == 1
    assert place("main.x").decode(0.5) == 0.5
    assert place("main.ch").decode(65) == "A"
    assert place("main.wch").decode(937) == "\u03a9"


def test_encode():
    assert place("main.b").encode(True) == 1
    assert place("main.b").encode(0) == 0
    assert place("main.n").encode(-5) == -5
    assert place("main.u").encode(4294967295) == -1
    assert place("main.c").encode("green") == 2
    assert place("main.x").encode(1) == 1.0
    assert place("main.x").encode(0.1) == 0.10000000149011612
    assert place("main.s").encode("abcde") == "abcde"
    assert place("main.t").encode(1500) == 1500
    assert place("main.wide").encode("\u03a9") == "\u03a9"
    assert place("main.ch").encode("\xff") == 255
    assert place("main.wch").encode("\u03a9") == 937


def test_encode_refuses():
    assert "0 to 100" in str(raises(ValueError, place("main.level").encode, 101))
    assert "red, Green" in str(raises(ValueError, place("main.c").encode, "blue"))
    assert "5 characters" in str(raises(ValueError, place("main.s").encode, "abcdef"))
    assert "254 characters" in str(raises(ValueError, place("main.text").encode, "x" * 255))
    assert "up to 255" in str(raises(ValueError, place("main.text").encode, "\u03a9"))
    assert "one character" in str(raises(ValueError, place("main.ch").encode, "ab"))
    assert "up to 255" in str(raises(ValueError, place("main.ch").encode, "\u03a9"))
    for path, value in (
        ("main.b", 2),
        ("main.b", "TRUE"),
        ("main.n", True),
        ("main.n", 1.5),
        ("main.n", 40000),
        ("main.u", -1),
        ("main.c", 1),
        ("main.x", "1"),
        ("main.x", True),
        ("main.s", 1),
        ("main.t", "T#1s"),
    ):
        raises(ValueError, place(path).encode, value)


def test_shared_bytes():
    program = Program()

    def read(path):
        return place(path).decode(place(path).load(program))

    def write(path, value):
        place(path).store(program, place(path).encode(value))

    write("main.real", -2.5)
    assert list(program.V[8:12]) == [0, 0, 0x20, 0xC0]
    assert read("main.real") == -2.5
    write("main.both", -2)
    assert (read("main.both"), read("main.low")) == (-2, 254)
    write("main.bit[0]", False)
    write("main.bit[5]", False)
    assert (read("main.bit[4]"), read("main.bit[5]")) == (True, False)
    assert list(program.V[8:12]) == [0xF6, 0xFE, 0x20, 0xC0]
    write("main.mode", "green")
    assert read("main.mode") == "Green"
    assert list(program.V[10:12]) == [2, 0]
    raises(ValueError, place("main.low").encode, 256)


def test_places():
    with open(FILE, "w") as file:
        file.write(TEXT)
    names = Names(FILE)
    assert names.place(12) == "src/main.st:7 (main)"
    assert names.place(1) == "src/other.st:3 (Valve)"
    assert names.place(2) == ""
    assert names.place(0) == ""
    os.remove(FILE)
