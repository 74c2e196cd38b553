"""Random programs with branches, loops, functions and blocks over a few small variables. They may fault."""

from __future__ import annotations

from random import Random

_HEAD = """
TYPE Small : INT (0..7); Row : ARRAY[0..5] OF INT; END_TYPE
VAR_GLOBAL g : INT; gr : Row; END_VAR
"""
_FUNCTION = """
FUNCTION F{n} : INT
VAR_INPUT x : INT; y : INT := {n}; END_VAR
VAR_IN_OUT io : INT; row : Row; END_VAR
VAR_OUTPUT o : INT; END_VAR
VAR_EXTERNAL g : INT; gr : Row; END_VAR
VAR i0 : INT; k0, k1, k2, k3 : INT; END_VAR
{body}
F{n} := {value};
END_FUNCTION
"""
_BLOCK = """
FUNCTION_BLOCK B{n}
VAR_INPUT x : INT; y : Small; END_VAR
VAR_IN_OUT io : INT; row : Row; END_VAR
VAR_OUTPUT o : INT; b0 : BOOL; END_VAR
VAR_EXTERNAL g : INT; gr : Row; END_VAR
VAR i0 : INT := {n}; {inner} END_VAR
VAR_TEMP k0, k1, k2, k3 : INT; END_VAR
{body}
o := {value};
END_FUNCTION_BLOCK
"""
_PROGRAM = """
PROGRAM main
VAR_EXTERNAL g : INT; gr : Row; END_VAR
VAR
  i0, i1, i2, k0, k1, k2, k3 : INT; s0 : SINT := -3; u0 : USINT := 250; r0 : Small := 7; b0, b1 : BOOL;
  row, other : Row; m0 AT %MW2 : INT; one, two : B0; three : B1; several : ARRAY[0..1] OF B0;
END_VAR
{body}
END_PROGRAM
"""


class _Writer:
    """Writes one POU: `integers` and `booleans` are the variables that it may read and write."""

    def __init__(self, random: Random, integers: list[str], readable: list[str], booleans: list[str], rows: list[str]):
        self.random = random
        self.integers = integers
        self.readable = readable
        self.booleans = booleans
        self.rows = rows
        self.functions: list[int] = []
        self.instances: list[tuple[str, bool]] = []
        self.free_counters = ["k0", "k1", "k2", "k3"]

    def integer(self, depth: int = 3) -> str:
        choose = self.random.choice
        kinds = ["leaf", "leaf", "binary", "binary", "element", "call", "abs", "sel", "limit"]
        match choose(kinds) if depth else "leaf":
            case "binary":
                operator = choose(["+", "-", "*", "+", "-", "/", "MOD"])
                right = self.integer(depth - 1)
                if operator == "/":
                    right = f"({right} + {choose(self.integers)})"
                    right = f"(ABS({right} MOD 7) + 1)" if self.random.random() < 0.98 else right
                return f"({self.integer(depth - 1)} {operator} {right})"
            case "element":
                return self.element(depth - 1)
            case "call" if self.functions:
                return self.call(depth - 1)
            case "abs":
                return f"ABS({self.integer(depth - 1)})"
            case "sel":
                return f"SEL({self.boolean(depth - 1)}, {self.integer(depth - 1)}, {self.integer(depth - 1)})"
            case "limit":
                return f"LIMIT(0, {self.integer(depth - 1)}, 5)"
            case _:
                return choose([*self.integers, *self.readable, str(self.random.randint(-9, 9)), "100", "5"])

    def element(self, depth: int) -> str:
        subscript = f"({self.integer(depth)} + {self.random.choice(self.integers)})"
        if self.random.random() < 0.99:
            subscript = f"LIMIT(0, {subscript}, 5)" if self.random.random() < 0.5 else f"ABS({subscript} MOD 6)"
        return f"{self.row()}[{subscript}]"

    def row(self) -> str:
        return self.random.choice(self.rows)

    def target(self, depth: int) -> str:
        return self.element(depth) if self.random.random() < 0.3 else self.random.choice(self.integers)

    def call(self, depth: int) -> str:
        arguments = [f"x := {self.integer(depth)}", f"io := {self.target(0)}", f"row := {self.row()}"]
        if self.random.random() < 0.5:
            arguments.append(f"y := {self.integer(depth)}")
        if self.random.random() < 0.5:
            arguments.append(f"o => {self.target(0)}")
        self.random.shuffle(arguments)
        return f"F{self.random.choice(self.functions)}({', '.join(arguments)})"

    def boolean(self, depth: int = 2) -> str:
        choose = self.random.choice
        kind = choose(["compare", "compare", "variable", "not", "and"]) if depth else "variable"
        match kind:
            case "compare":
                operator = choose(["=", "<>", "<", ">", "<=", ">="])
                return f"({self.integer(depth - 1)} {operator} {self.integer(depth - 1)})"
            case "not":
                return f"NOT ({self.boolean(depth - 1)})"
            case "and":
                return f"({self.boolean(depth - 1)} {choose(['AND', 'OR', 'XOR'])} {self.boolean(depth - 1)})"
            case _:
                return choose([*self.booleans, "TRUE", f"({self.random.choice(self.integers)} > 3)"])

    def body(self, depth: int, in_loop: bool = False) -> str:
        return "\n".join(self.statement(depth, in_loop) for _ in range(self.random.randint(1, 4)))

    def statement(self, depth: int, in_loop: bool) -> str:
        kinds = ["assign"] * 4 + ["flag", "invoke", "copy"] + ["leave"] * in_loop
        if depth:
            kinds += ["if", "case", "for", "while", "repeat"]
        match self.random.choice(kinds):
            case "flag" if self.booleans:
                return f"{self.random.choice(self.booleans)} := {self.boolean()};"
            case "copy":
                return f"{self.row()} := {self.row()};"
            case "invoke" if self.instances:
                return self.invocation()
            case "leave":
                return f"IF {self.boolean()} THEN {self.random.choice(['EXIT', 'CONTINUE'])}; END_IF;"
            case "if":
                middle = f"ELSIF {self.boolean()} THEN\n{self.body(depth - 1, in_loop)}\n" * self.random.randint(0, 1)
                return (
                    f"IF {self.boolean()} THEN\n{self.body(depth - 1, in_loop)}\n{middle}"
                    f"ELSE\n{self.body(depth - 1, in_loop)}\nEND_IF;"
                )
            case "case":
                return (
                    f"CASE {self.integer(2)} OF\n-3..-1, 2: {self.body(depth - 1, in_loop)}\n"
                    f"0: {self.body(depth - 1, in_loop)}\nELSE\n{self.body(depth - 1, in_loop)}\nEND_CASE;"
                )
            case "for" | "while" | "repeat" as kind if self.free_counters:
                counter = self.free_counters.pop()
                loop = self.loop(kind, counter, self.body(depth - 1, in_loop=True))
                self.free_counters.append(counter)
                return loop
            case _:
                return f"{self.target(2)} := {self.integer()};"

    def loop(self, kind: str, counter: str, body: str) -> str:
        use = f"{self.row()}[{counter}] := {self.random.choice(self.integers)} + {counter};\n{body}"
        if kind == "for":
            ends = ["0 TO 5", "5 TO 0 BY -1", f"0 TO {self.integer(1)} MOD 6", "1 TO 5 BY g MOD 3 + 3"]
            return f"FOR {counter} := {self.random.choice(ends)} DO\n{use}\nEND_FOR;"
        start, step = f"{counter} := 0;", f"{counter} := {counter} + 1;"
        if kind == "while":
            return f"{start}\nWHILE {counter} < 4 AND {self.boolean()} DO\n{step}\n{use}\nEND_WHILE;"
        return f"{start}\nREPEAT\n{step}\n{use}\nUNTIL {counter} > 3 OR {self.boolean()} END_REPEAT;"

    def invocation(self) -> str:
        instance, is_array = self.random.choice(self.instances)
        if is_array:
            instance += f"[ABS(({self.integer(1)} + {self.random.choice(self.integers)}) MOD 2)]"
        arguments = [f"io := {self.target(0)}", f"row := {self.row()}"]
        if self.random.random() < 0.7:
            arguments.append(f"x := {self.integer(2)}")
        if self.random.random() < 0.4:
            y = f"({self.integer(1)} + {self.random.choice(self.integers)})"
            arguments.append(f"y := LIMIT(0, {y}, 7)" if self.random.random() < 0.9 else f"y := {y}")
        if self.random.random() < 0.5:
            arguments.append(f"o => {self.target(0)}")
        return f"{instance}({', '.join(arguments)});"


def program(seed: int) -> str:
    """The text of a program with two functions, two blocks and `PROGRAM main`; the same for the same seed."""
    random = Random(seed)
    parts = [_HEAD]
    for number in range(2):
        writer = _Writer(random, ["io", "o", "i0", "g"], ["x", "y"], [], ["row", "gr"])
        writer.functions = list(range(number))
        body = writer.body(1)
        if random.random() < 0.5:
            body = f"IF {writer.boolean()} THEN\nF{number} := {writer.integer(1)};\nRETURN;\nEND_IF;\n{body}"
        parts.append(_FUNCTION.format(n=number, body=body, value=writer.integer()))
    for number in range(2):
        writer = _Writer(random, ["io", "i0", "g"], ["x", "y"], ["b0"], ["row", "gr"])
        writer.functions = [0, 1]
        writer.instances = [("inner", False)] * number
        inner = "inner : B0;" * number
        parts.append(_BLOCK.format(n=number, inner=inner, body=writer.body(1), value=writer.integer(2)))
    readable = ["s0", "USINT_TO_INT(u0)", "r0", "one.o"]
    writer = _Writer(random, ["i0", "i1", "i2", "g", "m0"], readable, ["b0", "b1"], ["row", "other", "gr"])
    writer.functions = [0, 1]
    writer.instances = [("one", False), ("two", False), ("three", False), ("several", True)]
    lines = [writer.body(2), writer.body(2)]
    lines.append(f"s0 := INT_TO_SINT(({writer.integer(1)} + i0) MOD 140);")
    lines.append(f"r0 := ABS(({writer.integer(1)} + i1) MOD 9);")
    parts.append(_PROGRAM.format(body="\n".join([*lines, writer.body(2)])))
    return "".join(parts)
