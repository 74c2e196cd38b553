"""What is on a board, and whether files that mpy-cross made will run there. Nothing here writes to the board."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from iec2mpy.device.errors import NotMicroPython, WrongChip, WrongRelease
from iec2mpy.device.transport import Link

OLDEST_RELEASE = (1, 23)
"""The first release of MicroPython that takes `.mpy` files of version 6.3."""

PLC_STARTER = "plc_boot"
"""The module that starts the PLC: who does that from a `main.py` of their own has the word in it."""

_UPDATE = (
    f"Flash MicroPython {OLDEST_RELEASE[0]}.{OLDEST_RELEASE[1]} or later, from micropython.org; "
    "`iec2mpy boards NAME` says how."
)

# The numbers in sys.implementation._mpy and in the third byte of a file: "MicroPython .mpy files" in its documentation
_ARCHITECTURES = (
    "",
    "x86",
    "x64",
    "armv6",
    "armv6m",
    "armv7m",
    "armv7em",
    "armv7emsp",
    "armv7emdp",
    "xtensa",
    "xtensawin",
    "rv32imc",
    "rv64imc",
)
_THUMB = range(4, 9)  # each of these also runs code for those before it in this range (py/persistentcode.h)

_SURVEY = """
import sys,os
if sys.platform in ('rp2','esp32'):
 os.chdir('/')
def t(p):
 try:
  with open(p) as f:
   return f.read().strip()
 except OSError:
  return ''
m=t('main.py')
i=sys.implementation
print((i.name,tuple(i.version)[:2],getattr(i,'_mpy',0),getattr(i,'_machine',sys.platform),
 t('active'),{mark!r} in m if m else None,
 [e[0] for e in os.ilistdir('.') if e[0].startswith('plc-')],os.statvfs('.')[0]))
"""


@dataclass(frozen=True, slots=True)
class BoardState:
    """`release`: of MicroPython, two numbers. `mpy`: its `sys.implementation._mpy`. `active`: the folder of the program
    that starts with the board, "" where there is none. `folders`: of programs, the active one among them.
    `main_starts_plc`: whether its `main.py` does, None where there is none. `block`: bytes, of its file system."""

    release: tuple[int, int]
    mpy: int
    machine: str
    active: str
    main_starts_plc: bool | None
    folders: tuple[str, ...]
    block: int


def survey(link: Link) -> BoardState:
    """Looks at a board. Raises NotMicroPython for other Pythons."""
    name, release, mpy, machine, active, main, folders, block = link.ask(_SURVEY.format(mark=PLC_STARTER))
    if name != "micropython":
        hint = f"iec2mpy needs MicroPython. {_UPDATE}"
        raise NotMicroPython(f"The board on {link.port} runs {name}, not MicroPython.", hint)
    return BoardState(
        release=(release[0], release[1]),
        mpy=mpy,
        machine=machine,
        active=active if active in folders else "",
        main_starts_plc=main,
        folders=tuple(folders),
        block=max(block, 1),
    )


def check_fits(files: Mapping[str, bytes], board: BoardState) -> None:
    """Raises WrongRelease or WrongChip where the board's MicroPython cannot load one of the `.mpy` files."""
    release = f"{board.release[0]}.{board.release[1]}"
    if board.release < OLDEST_RELEASE or not board.mpy:
        raise WrongRelease(f"The board runs MicroPython {release}, which is too old.", _UPDATE)
    for name, data in files.items():
        if name.endswith(".mpy"):
            _check_file(name, data, board, release)


def _check_file(name: str, data: bytes, board: BoardState, release: str) -> None:
    """The first four bytes of a file: "M", version, features (sub-version in two bits, then architecture), int bits."""
    version, sub, architecture = data[1], data[2] & 3, data[2] >> 2 & 0x0F
    board_version, board_sub, board_arch = board.mpy & 0xFF, board.mpy >> 8 & 3, board.mpy >> 10 & 0x0F
    wanted, there = (version, sub if architecture else 0), (board_version, board_sub if architecture else 0)
    if wanted != there:
        too = "too old" if there < wanted else "too new"
        message = f"The board runs MicroPython {release}, which is {too} for {name}: it takes .mpy files of version "
        hint = _UPDATE if there < wanted else "Update iec2mpy: `pip install --upgrade iec2mpy`."
        raise WrongRelease(f"{message}{there[0]}.{there[1]}, not {wanted[0]}.{wanted[1]}.", hint)
    same_family = architecture in _THUMB and board_arch in _THUMB and architecture <= board_arch
    if architecture and architecture != board_arch and not same_family:
        there_runs = f"{board.machine} runs {_architecture(board_arch)}"
        message = f"{name} is built for {_architecture(architecture)}, but {there_runs}."
        hint = 'Name the right board in iec2mpy.toml. With `emitter = "portable"` it runs everywhere, but slowly.'
        raise WrongChip(message, hint)


def _architecture(number: int) -> str:
    if not number:
        return "no machine code at all"
    return _ARCHITECTURES[number] if number < len(_ARCHITECTURES) else f"an unknown architecture ({number})"
