"""`iec2mpy boards`."""

from __future__ import annotations

import pytest

from iec2mpy.cli import main


def test_list(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["boards"]) == 0
    out = capsys.readouterr().out
    for name in ("pico", "pico_w", "esp32_devkit", "RP2040", "8 din"):
        assert name in out


def test_one_board(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["boards", "pico"]) == 0
    out = capsys.readouterr().out
    rows = {line.split()[0]: line for line in out.splitlines() if line.startswith("%")}
    assert len(rows) == 22
    assert "LED on the board" in rows["%QX0.0"]
    assert "pull-up, TRUE when low" in rows["%IX0.0"]
    assert "0 to 32767" in rows["%IW0"]
    assert "https://datasheets.raspberrypi.com/" in out


def test_lines_fit_a_terminal(capsys: pytest.CaptureFixture[str]) -> None:
    for name in ("pico", "pico_w", "esp32_devkit"):
        main(["boards", name])
        rows = [line for line in capsys.readouterr().out.splitlines() if line[:2] in ("%I", "%Q")]
        assert all(len(row.split("  ")) >= 4 for row in rows)  # none is folded


@pytest.mark.parametrize(("name", "says"), [("pcio", "Did you mean `pico`?"), ("zzz", "The boards are")])
def test_unknown_board(name: str, says: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["boards", name]) == 2
    err = capsys.readouterr().err
    assert f"There is no board `{name}`." in err
    assert says in err
