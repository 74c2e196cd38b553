"""Executes programs for the host: MicroPython runs this file, with the directory of `mcu_runtime` as its argument.

A request is a text (see `wire.py`) that starts with a command: `load` and a line end before the program's text,
`restart 1`, `scan 5`, `read V8 O2`, `write V8=i1`. The answer is `ok` with what was asked for, `fault zero 12`, or
`error` and a sentence.
"""

import gc
import sys

# Not the user's own modules: they could hide the runtime.
sys.path[1:] = [".frozen", sys.argv[1]]

import wire  # noqa: E402
from simulated import ProgramFailed, Simulated  # noqa: E402


class Server:
    def __init__(self) -> None:
        self._simulated = None

    def serve(self) -> None:
        """Until the host closes its end."""
        read = sys.stdin.buffer.read
        write = sys.stdout.buffer.write
        while True:
            header = read(wire.HEADER)
            if len(header) < wire.HEADER:
                return
            request = read(int(header, 16)).decode()
            try:
                answer = self._answer(request)
            except ProgramFailed as error:
                answer = f"error {error}"
            except Exception as error:
                answer = f"error {type(error).__name__}: {error}"
            write(wire.frame(answer))

    def _answer(self, request: str) -> str:
        if request.startswith("load\n"):
            return self._load(request[5:])
        words = request.split(" ")
        simulated = self._simulated
        assert simulated
        if words[0] == "scan":
            fault = simulated.scan(int(words[1]))
            return f"fault {fault[0]} {fault[1]}" if fault else "ok"
        if words[0] == "read":
            values = simulated.read([(place[0], int(place[1:])) for place in words[1:]])
            return " ".join(["ok"] + [wire.word(value) for value in values])
        if words[0] == "write":
            items = [item.split("=") for item in words[1:]]
            simulated.write([(place[0], int(place[1:]), wire.value(value)) for place, value in items])
            return "ok"
        simulated.restart(words[1] == "1")
        return "ok"

    def _load(self, text: str) -> str:
        self._simulated = None
        gc.collect()
        namespace = {"__name__": "program"}
        exec(compile(text, "program.py", "exec"), namespace)
        self._simulated = Simulated(namespace)
        return f"ok {self._simulated.period}"


Server().serve()
