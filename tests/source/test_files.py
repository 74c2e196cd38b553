"""Files are read, or it is said what is wrong with them."""

from __future__ import annotations

from pathlib import Path

import pytest

from iec2mpy.source.diagnostics import CompileError, Diagnostic
from iec2mpy.source.files import load_file, read_sources


def _problem(path: Path | str) -> Diagnostic:
    with pytest.raises(CompileError) as caught:
        load_file(path)
    (diagnostic,) = caught.value.diagnostics
    return diagnostic


@pytest.mark.parametrize(
    "data",
    [b"a\n\xc3\xa4\n", b"\xef\xbb\xbfa\n\xc3\xa4\n", b"a\r\n\xc3\xa4\r\n", b"a\r\xc3\xa4\r"],
    ids=["plain", "mark", "crlf", "cr"],
)
def test_text(tmp_path: Path, data: bytes) -> None:
    path = tmp_path / "a.st"
    path.write_bytes(data)
    file = load_file(path)
    assert (file.text, file.path) == ("a\nä\n", str(path))


def test_path_is_shown_as_given(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "a.st").write_text("x")
    monkeypatch.chdir(tmp_path)
    assert load_file("./a.st").path == "./a.st"


def test_missing_file(tmp_path: Path) -> None:
    found = _problem(tmp_path / "a.st")
    assert found.code == "E0001" and "There is no file" in found.message and "a.st" in found.message


def test_folder(tmp_path: Path) -> None:
    assert "is a folder" in _problem(tmp_path).message


def test_name_that_no_file_can_have() -> None:
    assert _problem("a\0b.st").code == "E0001"


def test_wrong_byte_is_named_with_its_place(tmp_path: Path) -> None:
    path = tmp_path / "a.st"
    path.write_bytes(b"\xef\xbb\xbfab\nc\xe4d\n")
    found = _problem(path)
    assert found.code == "E0002" and "byte 2 of line 2 is 0xE4" in found.message


@pytest.mark.parametrize(("encoding", "name"), [("utf-16", "UTF-16"), ("utf-32", "UTF-32")])
def test_other_encodings_are_named(tmp_path: Path, encoding: str, name: str) -> None:
    path = tmp_path / "a.st"
    path.write_text("PROGRAM", encoding=encoding)
    assert f"is {name}, not UTF-8" in _problem(path).message


def test_no_text_at_all(tmp_path: Path) -> None:
    path = tmp_path / "a.st"
    path.write_bytes(b"MZ\0\0")
    assert _problem(path).code == "E0002"


def test_all_problems_are_told_at_once(tmp_path: Path) -> None:
    (tmp_path / "good.st").write_text("x")
    assert [file.text for file in read_sources([tmp_path / "good.st"])] == ["x"]
    with pytest.raises(CompileError) as caught:
        read_sources([tmp_path / "a.st", tmp_path / "good.st", tmp_path / "b.st"])
    assert len(caught.value.diagnostics) == 2
