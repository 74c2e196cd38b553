from support import raises

from mcu_runtime.characters import character, first_character, to_narrow, with_character
from mcu_runtime.faults import INDEX


def test_positions_count_from_1():
    assert character("ABCD", 1) == 65
    assert character("ABCD", 4) == 68
    assert with_character("ABCD", 1, 88) == "XBCD"
    assert with_character("ABCD", 4, 937) == "ABC\u03a9"
    assert character("a\u03a9b", 3) == 98


def test_no_such_position():
    for position in (-1, 0, 3, 100):
        assert raises(INDEX.__class__, character, "AB", position) is INDEX
        assert raises(INDEX.__class__, with_character, "AB", position, 65) is INDEX
    raises(INDEX.__class__, with_character, "", 1, 65)


def test_table_27():
    assert first_character("AB") == 65
    assert first_character("") == 0
    assert to_narrow("\xff\u0100x") == "\xff?x"
    assert to_narrow("") == ""
