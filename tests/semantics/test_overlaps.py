"""Which addresses share storage, and what cannot."""

from __future__ import annotations

import pytest

from iec2mpy.semantics.overlaps import byte_addresses
from tests.semantics.checking import checked, codes_of, program


def _shared(variables: str) -> dict[str, tuple[list[str], int]]:
    """By name: the bytes, and the first bit among them, of each variable that shares its storage."""
    variables_of = checked(program(variables, ";")).pous[0].variables.values()
    return {v.name: (byte_addresses(v.shared.storage), v.shared.bit) for v in variables_of if v.shared is not None}


def test_bits_bytes_and_words() -> None:
    found = _shared("w AT %MW10 : WORD; b AT %MB21 : BYTE; x AT %MX20.3 : BOOL; y AT %MX170 : BOOL;")
    bytes_of = ["%MB20", "%MB21"]
    assert found == {"w": (bytes_of, 0), "b": (bytes_of, 8), "x": (bytes_of, 3), "y": (bytes_of, 10)}


def test_what_lies_beyond_its_address_overlaps_too() -> None:
    found = _shared("a AT %MW0 : ARRAY[0..9] OF WORD; b AT %MW9 : WORD; c AT %MW10 : WORD;")
    assert {name: bit for name, (_, bit) in found.items()} == {"a": 0, "b": 144}


def test_two_types_at_one_address() -> None:
    assert _shared("a AT %MW3.1.7 : WORD; b AT %MW3.1.7 : INT; c AT %MW3.1.8 : INT;") == {
        "a": (["%MW3.1.7"] * 2, 0),
        "b": (["%MW3.1.7"] * 2, 0),
    }


@pytest.mark.parametrize(
    "variables",
    [
        "a AT %MW10 : WORD; b AT %MW10 : WORD; c AT %MW11 : WORD;",
        "x AT %IX0.0 : BOOL; w AT %IW0 : WORD;",
        "s AT %MB20 : STRING[5]; w AT %MW20 : WORD;",
        "w AT %MW10.3 : WORD; v AT %MW10 : WORD;",
    ],
)
def test_places_of_their_own(variables: str) -> None:
    assert _shared(variables) == {}


def test_inputs_and_outputs_over_several_channels_lie_among_bytes() -> None:
    found = _shared("b AT %IB1 : BYTE; d AT %QD0 : DWORD; a AT %QX4.0 : ARRAY[0..9] OF BOOL; w AT %QW9 : INT;")
    assert {name: addresses for name, (addresses, _) in found.items()} == {
        "b": ["%IB1"],
        "d": ["%QB0", "%QB1", "%QB2", "%QB3"],
        "a": ["%QB4", "%QB5"],
    }


@pytest.mark.parametrize(
    "variables",
    [
        "s AT %MB20 : STRING[5]; w AT %MW10 : WORD;",
        "i AT %MX20.3 : INT; w AT %MW10 : WORD;",
        "a AT %MX20.3 : ARRAY[0..1] OF BYTE; w AT %MW10 : WORD;",
    ],
)
def test_what_cannot_share(variables: str) -> None:
    assert codes_of(variables, ";") == ["E0711"]


def test_initial_values_come_together() -> None:
    text = "w AT %MW10 : WORD := 16#0100; x AT %MX20.7 : BOOL := TRUE; b AT %MB20 : BYTE; n AT %MB21 : SINT := -1;"
    (storage,) = checked(program(text, ";")).storages
    assert storage.initial == (0x80, 0xFF)
