"""Deploying, over a real serial line to a real MicroPython."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import pytest

from iec2mpy.device.deploy import Deployed, Payload, deploy
from iec2mpy.device.errors import (
    BoardFull,
    ForeignMain,
    LineBroken,
    StartFailed,
    UploadDamaged,
    WrongChip,
    WrongRelease,
)
from iec2mpy.device.transport import Link, connect
from tests.device.board import Board
from tests.device.programs import counting, counting_viper, faulting, not_loading

MakeBoard = Callable[..., Board]


@contextmanager
def linked(board: Board) -> Iterator[Link]:
    link = connect(board.port)
    try:
        yield link
    finally:
        link.leave()


def put(board: Board, payload: Payload) -> Deployed:
    with linked(board) as link:
        return deploy(link, payload, lambda done, total: None)


def plc(board: Board, expression: str) -> Any:
    """What Python at the board's prompt says, while the PLC runs."""
    with linked(board) as link:
        return link.ask(f"import plc\nprint(repr({expression}))")


def entries(board: Board) -> list[str]:
    return sorted(path.name for path in board.files.iterdir())


def test_program_runs_and_the_prompt_stays_free(board: Board) -> None:
    done = put(board, counting(1))
    assert done.status["running"]
    assert done.status["program"] == "step1"
    assert entries(board) == ["active", "main.py", done.folder, "plc_boot.mpy"]
    before = time.monotonic()
    first = plc(board, 'plc.read("main.count")')
    time.sleep(0.3)
    second = plc(board, 'plc.read("main.count")')
    elapsed = time.monotonic() - before
    assert first > 0
    assert 10 <= second - first <= elapsed / 0.01 + 2  # a scan each 10 ms; a busy host may lose some
    plc(board, 'plc.write("main.button", True)')
    assert plc(board, 'plc.read("main.button")') is True


def test_connecting_does_not_restart_the_program(board: Board) -> None:
    put(board, counting(1))
    starts = board.starts
    before = plc(board, "plc.status()")["scans"]
    assert plc(board, "plc.status()")["scans"] > before
    assert board.starts == starts


def test_second_version_replaces_the_first(board: Board) -> None:
    first = put(board, counting(1))
    second = put(board, counting(1000))
    assert second.folder != first.folder
    assert entries(board) == ["active", "main.py", second.folder, "plc_boot.mpy"]
    count = plc(board, 'plc.read("main.count")')
    assert count > 0
    assert count % 1000 == 0


def test_same_version_is_not_uploaded_again(board: Board) -> None:
    first = put(board, counting(1))
    second = put(board, counting(1))
    assert first.uploaded > 0
    assert second.uploaded == 0
    assert second.folder == first.folder
    assert second.status["running"]


def test_damaged_folder_of_the_same_version_is_uploaded_beside_it(board: Board) -> None:
    first = put(board, counting(1))
    (board.files / first.folder / "program.py").write_text("spoilt")
    second = put(board, counting(1))
    assert second.folder == f"{first.folder}b"
    assert second.status["running"]
    assert first.folder not in entries(board)


def test_program_survives_a_power_cut(board: Board) -> None:
    put(board, counting(1))
    with linked(board) as link:
        link.restart(10)
        assert link.ask('import plc\nprint(plc.read("main.count"))') > 0


def test_machine_code_runs(board: Board) -> None:
    assert put(board, counting_viper("x64")).status["running"]
    assert plc(board, 'plc.read("main.count")') > 0


def test_progress_goes_from_nothing_to_all(board: Board) -> None:
    payload = counting(1)
    seen: list[tuple[int, int]] = []
    with linked(board) as link:
        deploy(link, payload, lambda done, total: seen.append((done, total)))
    assert seen[-1][0] == seen[-1][1] == sum(map(len, payload.folder.values()))
    assert [done for done, _ in seen] == sorted(done for done, _ in seen)


@pytest.mark.parametrize("share", [0.05, 0.3, 0.6, 0.9])
def test_broken_line_leaves_the_old_program(make_board: MakeBoard, share: float) -> None:
    board = make_board()
    sent: list[int] = []
    board.on_bytes = sent.append
    put(board, counting(1))
    bytes_of_a_deployment = sent[-1]
    old = (board.files / "active").read_text()

    def cut(count: int) -> None:
        if count > bytes_of_a_deployment * (1 + share):
            board.unplug()

    board.on_bytes = cut
    with pytest.raises(LineBroken, match="broke"):
        put(board, counting(2))
    assert (board.files / "active").read_text() == old
    board.power_cycle()
    assert plc(board, 'plc.read("main.count")') > 0
    assert plc(board, "plc.status()")["program"] == "step1"
    assert put(board, counting(2)).status["program"] == "step2"
    assert len([name for name in entries(board) if name.startswith("plc-")]) == 1


def test_program_that_faults_at_once_gives_way_to_the_old_one(board: Board) -> None:
    old = put(board, counting(1)).folder
    with pytest.raises(StartFailed, match=r"zero.*The program before it is back"):
        put(board, faulting())
    assert (board.files / "active").read_text() == old
    assert plc(board, 'plc.read("main.count")') > 0
    assert [name for name in entries(board) if name.startswith("plc-")] == [old]


def test_program_that_does_not_load_says_why(board: Board) -> None:
    with pytest.raises(StartFailed, match=r"no_such_module.*No program runs"):
        put(board, not_loading())


def test_main_of_somebody_else_is_not_touched(board: Board) -> None:
    (board.files / "main.py").write_text("print('mine')\n")
    with pytest.raises(ForeignMain, match=r"main\.py of its own"):
        put(board, counting(1))
    assert entries(board) == ["main.py"]
    assert (board.files / "main.py").read_text() == "print('mine')\n"


def test_main_of_somebody_else_may_start_the_plc(board: Board) -> None:
    text = f"# {'x' * 500}\nimport plc_boot\nmine = 1\nplc_boot.run()\n"
    (board.files / "main.py").write_text(text)
    assert put(board, counting(1)).status["running"]
    assert (board.files / "main.py").read_text() == text


def test_other_architecture_is_refused_before_anything_is_written(board: Board) -> None:
    with pytest.raises(WrongChip, match=r"program\.mpy is built for armv6m, but .* runs x64"):
        put(board, counting_viper("armv6m"))
    assert entries(board) == []


def test_newer_mpy_version_is_refused_before_anything_is_written(board: Board) -> None:
    payload = counting_viper("x64")
    folder = dict(payload.folder)
    folder["program.mpy"] = b"M\x07" + folder["program.mpy"][2:]
    with pytest.raises(WrongRelease, match=r"too old for program\.mpy"):
        put(board, Payload(folder, payload.root, payload.main))
    assert entries(board) == []


def large() -> Payload:
    """More than the boards of the next tests have room for."""
    payload = counting(1)
    return Payload({**payload.folder, "table.bin": bytes(40_000)}, payload.root, payload.main)


RAM_DISK = """
class _Disk:
    def __init__(self, blocks):
        self.data = bytearray(blocks * 512)
    def readblocks(self, n, buf, off=0):
        buf[:] = self.data[n * 512 + off:n * 512 + off + len(buf)]
    def writeblocks(self, n, buf, off=0):
        self.data[n * 512 + off:n * 512 + off + len(buf)] = buf
    def ioctl(self, op, arg):
        return len(self.data) // 512 if op == 4 else 512 if op == 5 else 0
import vfs, os
_disk = _Disk({blocks})
vfs.{kind}.mkfs(_disk)
_real = vfs.{kind}(_disk)
vfs.mount(_real, '/ram')
os.chdir('/ram')
"""
SPOILING = """
os.chdir('/')
vfs.umount('/ram')
class _File:
    def __init__(self, file):
        self.file = file
        self.close = file.close
    def write(self, data):
        return self.file.write(bytes(len(data)))
class _Spoiling:
    def __getattr__(self, name):
        return getattr(_real, name)
    def open(self, path, mode):
        file = _real.open(path, mode)
        return _File(file) if mode == 'wb' and path.endswith('program.names') else file
vfs.mount(_Spoiling(), '/ram')
os.chdir('/ram')
"""
# Says that there is room, so that it is only noticed when a write fails, as with a file system that cannot know.
LYING = """
os.chdir('/')
vfs.umount('/ram')
class _Lying:
    def __getattr__(self, name):
        return getattr(_real, name)
    def statvfs(self, path):
        return (512, 512, 9999, 9999, 9999, 0, 0, 0, 0, 255)
vfs.mount(_Lying(), '/ram')
os.chdir('/ram')
"""


@pytest.mark.parametrize("kind", ["VfsLfs2", "VfsFat"])
def test_board_that_is_too_small_is_noticed_before_anything_is_written(make_board: MakeBoard, kind: str) -> None:
    board = make_board(RAM_DISK.format(blocks=50, kind=kind))
    with linked(board) as link:
        with pytest.raises(BoardFull, match="full"):
            deploy(link, large(), lambda done, total: None)
        assert link.ask("import os\nprint(os.listdir('.'))") == []


@pytest.mark.parametrize("kind", ["VfsLfs2", "VfsFat"])
def test_board_that_fills_up_while_writing_is_cleaned(make_board: MakeBoard, kind: str) -> None:
    board = make_board(RAM_DISK.format(blocks=50, kind=kind) + LYING)
    with linked(board) as link:
        with pytest.raises(BoardFull, match="full"):
            deploy(link, large(), lambda done, total: None)
        assert link.ask("import os\nprint([e for e in os.listdir('.') if e.startswith('plc-')])") == []


def test_damaged_upload_is_noticed(make_board: MakeBoard) -> None:
    board = make_board(RAM_DISK.format(blocks=200, kind="VfsLfs2") + SPOILING)
    with linked(board) as link:
        with pytest.raises(UploadDamaged, match=r"program\.names is not on the board as it was sent"):
            deploy(link, counting(1), lambda done, total: None)
        assert link.ask("import os\nprint(os.listdir('.'))") == []
