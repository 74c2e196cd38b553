"""A program with its controller, in virtual time. It runs in this process, and in MicroPython behind `server.py`:
it uses only what MicroPython has."""

from mcu_runtime.clock import VirtualClock
from mcu_runtime.controller import Controller


class ProgramFailed(Exception):
    """The program raised what is no fault: generated code or a library has a bug."""


class _Program:
    """What the controller takes from a module, made of the namespace that `exec` filled."""

    def __init__(self, namespace: dict) -> None:
        self.V = namespace["V"]
        self.O = namespace["O"]
        self.reset = namespace["reset"]
        self.TASKS = namespace["TASKS"]
        self.UNTIMED = namespace["UNTIMED"]
        self.RETAIN = namespace["RETAIN"]


class _HeldInputs:
    """`io` of the controller: inputs have what was last written to them, whatever the program does to their slots."""

    def __init__(self) -> None:
        self.held = {}

    def read(self, V) -> None:
        for slot, value in self.held.items():
            V[slot] = value

    def write(self, V) -> None:
        """Outputs are read from V."""

    def safe(self, V) -> None:
        """There is nothing to protect; what the outputs were stays readable."""


class Simulated:
    """The calls of `base.Engine`, without `close`."""

    def __init__(self, namespace: dict) -> None:
        program = _Program(namespace)
        self._arrays = {"V": program.V, "O": program.O}
        self._inputs = {slot for _, slot in namespace["INPUTS"]}
        self._io = _HeldInputs()
        self._controller = Controller(program, self._io, VirtualClock())
        self.period = self._controller.period

    def restart(self, cold: bool) -> None:
        self._controller.restart(cold)
        self._io.read(self._arrays["V"])

    def scan(self, n: int) -> tuple | None:
        controller = self._controller
        for _ in range(n):
            controller.scan()
            if controller.fault:
                break
        if controller.detail:
            raise ProgramFailed(controller.detail)
        return controller.fault

    def read(self, places: list) -> list:
        return [self._arrays[array][slot] for array, slot in places]

    def write(self, items: list) -> None:
        for array, slot, value in items:
            self._arrays[array][slot] = value
            if array == "V" and slot in self._inputs:
                self._io.held[slot] = value
