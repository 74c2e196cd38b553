"""Puts a program on a board such that the one before it runs until the new one is there, whole and checked.

All files go into a folder of their own. A small file `active` names the folder that starts with the board; a new one
is renamed over it, which happens or does not happen, and nothing between. So a line that breaks, or a plug that is
pulled, leaves the old program.
"""

from __future__ import annotations

import hashlib
import zlib
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

from iec2mpy.device.errors import (
    BoardFailed,
    BoardFull,
    DeviceError,
    ForeignMain,
    NoAnswer,
    StartFailed,
    UploadDamaged,
)
from iec2mpy.device.inspect import BoardState, check_fits, survey
from iec2mpy.device.transport import Link, full_board

_START_TIMEOUT = 20  # seconds for `main.py`: loading a large program takes a few
_ACTIVE = "active"

Progress = Callable[[int, int], None]
"""Told how many bytes have been written, and how many there are."""


@dataclass(frozen=True, slots=True)
class Payload:
    """`folder`: the files of the program and of the runtime that goes with it, by their path in the program's folder.
    `root`: those that stand at the root of the file system; `main` is the text of `main.py`."""

    folder: Mapping[str, bytes]
    root: Mapping[str, bytes]
    main: str

    @property
    def name(self) -> str:
        """The folder's name: another one for other files."""
        digest = hashlib.sha256()
        for path, data in sorted(self.folder.items()):
            digest.update(f"{path}\0{len(data)}\0".encode() + data)
        return f"plc-{digest.hexdigest()[:10]}"


@dataclass(frozen=True, slots=True)
class Deployed:
    """What runs now. `status` is what `plc.status()` says on the board."""

    folder: str
    machine: str
    release: tuple[int, int]
    uploaded: int
    status: Mapping[str, Any]


def deploy(link: Link, payload: Payload, progress: Progress) -> Deployed:
    """Uploads, switches, restarts and looks whether it runs. Raises DeviceError; the old program runs then."""
    board = survey(link)
    check_fits({**payload.folder, **payload.root}, board)
    _check_main(board)
    uploaded = 0
    folder = payload.name
    if folder == board.active and not _is_intact(link, folder, payload.folder):
        folder += "b"  # never written over: it is what runs if we do not get to the end
    for leftover in board.folders:
        if leftover not in (board.active, folder):
            link.remove(leftover)
    if folder != board.active:
        uploaded = sum(map(len, payload.folder.values()))
        _upload(link, folder, payload.folder, board, progress)
    _write_root(link, payload, board)
    _switch(link, folder)
    status = _start(link, folder, board.active)
    for old in {board.active} - {folder, ""}:
        _remove_quietly(link, old)
    return Deployed(folder, board.machine, board.release, uploaded, status)


def _check_main(board: BoardState) -> None:
    if board.main_starts_plc is not False:
        return
    hint = (
        "Rename it (`mpremote resume cp :main.py :mine.py + rm :main.py`), or put `import plc_boot; plc_boot.run()` "
        "into it, and deploy again."
    )
    raise ForeignMain("The board has a main.py of its own, which would not start the PLC.", hint)


def _upload(link: Link, folder: str, files: Mapping[str, bytes], board: BoardState, progress: Progress) -> None:
    """A new folder with all the files in it, each checked. Nothing of it stays where that fails."""
    link.remove(folder)
    blocks = sum(-(-len(data) // board.block) + 1 for data in files.values()) + 2 * len(_subfolders(files)) + 4
    free = link.ask("import os\ns=os.statvfs('.')\nprint(s[0]*s[3])")
    if blocks * board.block > free:
        raise full_board()
    try:
        for path in (folder, *(f"{folder}/{sub}" for sub in _subfolders(files))):
            link.run(f"import os\nos.mkdir({path!r})")
        total = sum(map(len, files.values()))
        written = 0

        def advance(count: int) -> None:
            nonlocal written
            written += count
            progress(written, total)

        for name, data in files.items():
            _write_checked(link, f"{folder}/{name}", data, advance)
    except (BoardFull, BoardFailed, UploadDamaged):
        _remove_quietly(link, folder)
        raise


def _subfolders(files: Mapping[str, bytes]) -> list[str]:
    """The folders that the paths name, outer ones first."""
    found: set[str] = set()
    for path in files:
        parts = path.split("/")[:-1]
        found.update("/".join(parts[: n + 1]) for n in range(len(parts)))
    return sorted(found)


def _write_checked(link: Link, path: str, data: bytes, advance: Callable[[int], None]) -> None:
    link.write_file(path, data, advance)
    if not _is_on_board(link, path, data):
        hint = "Deploy again. If it happens once more, the cable or the board's flash memory is bad."
        raise UploadDamaged(f"The file {path} is not on the board as it was sent.", hint)


def _is_on_board(link: Link, path: str, data: bytes) -> bool:
    kind, found = link.digest(path)
    return found == (hashlib.sha256(data).hexdigest() if kind == "sha256" else zlib.crc32(data))


def _is_intact(link: Link, folder: str, files: Mapping[str, bytes]) -> bool:
    """Whether a folder that is there already has all the files, unchanged."""
    try:
        return all(_is_on_board(link, f"{folder}/{name}", data) for name, data in files.items())
    except BoardFailed:
        return False


def _write_root(link: Link, payload: Payload, board: BoardState) -> None:
    """What stands at the root works with the folders of old programs and of new ones."""
    files = dict(payload.root)
    if board.main_starts_plc is None:
        files["main.py"] = payload.main.encode()
    for name, data in files.items():
        if not _is_intact(link, ".", {name: data}):
            _replace(link, name, data)


def _switch(link: Link, folder: str) -> None:
    _replace(link, _ACTIVE, folder.encode())


def _replace(link: Link, name: str, data: bytes) -> None:
    """Writes a file beside the old one, and renames it over that."""
    new = f"{name}.new"
    try:
        _write_checked(link, new, data, lambda count: None)
        link.run(f"import os\nos.rename({new!r}, {name!r})")
    except (BoardFull, BoardFailed, UploadDamaged):
        _remove_quietly(link, new)
        raise


def _start(link: Link, folder: str, before: str) -> Mapping[str, Any]:
    """Soft reset, and a look at what runs. The program before it is started again if the new one does not run."""
    status = _restart(link, folder)
    if status.get("running"):
        return status
    reason = status.get("fault") or status.get("start") or "it does not say why"
    ending = "No program runs on the board now."
    if before not in ("", folder):
        _switch(link, before)
        ending = "The program before it is back." if _restart(link, before).get("running") else ending
        _remove_quietly(link, folder)
    hint = "Run it with `iec2mpy run` to see the fault on this computer."
    raise StartFailed(f"The new program stopped when it was started: {reason}. {ending}", hint)


def _restart(link: Link, folder: str) -> Mapping[str, Any]:
    """What `plc.status()` says after a soft reset, of the program in that folder."""
    try:
        link.restart(_START_TIMEOUT)
    except NoAnswer as error:
        raise StartFailed(error.message, error.hint) from None
    try:
        path, status = link.ask("import plc\nprint((plc.__file__, plc.status()))")
    except BoardFailed as error:
        return {"running": False, "start": error.message.removeprefix("The board reports: ")}
    if not path.startswith(f"{folder}/"):
        return {"running": False, "start": f"the board runs {path} and not {folder}"}
    return status


def _remove_quietly(link: Link, folder: str) -> None:
    """Removes what is in nobody's way: the next deployment does it otherwise."""
    with suppress(DeviceError):
        link.remove(folder)
