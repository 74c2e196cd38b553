from support import raises

from mcu_runtime.arithmetic import f32
from mcu_runtime.faults import RANGE
from mcu_runtime.strings import (
    bool_to_str,
    int_to_str,
    real_to_str,
    str_concat,
    str_cut,
    str_delete,
    str_find,
    str_insert,
    str_left,
    str_mid,
    str_replace,
    str_right,
    str_to_bool,
    str_to_int,
    str_to_real,
    str_to_time,
    time_to_str,
)


def test_table_34():
    assert str_left("ASTR", 3) == "AST"
    assert str_right("ASTR", 3) == "STR"
    assert str_mid("ASTR", 2, 2) == "ST"
    assert str_concat("AB", "CD", "E") == "ABCDE"
    assert str_insert("ABC", "XY", 2) == "ABXYC"
    assert str_delete("ABXYC", 2, 3) == "ABC"
    assert str_replace("ABCDE", "X", 2, 3) == "ABXE"
    assert str_find("ABCBC", "BC") == 2


def test_lengths_and_positions_are_clamped():
    assert str_left("ABC", 9) == "ABC"
    assert str_left("ABC", -1) == ""
    assert str_right("ABC", 9) == "ABC"
    assert str_right("ABC", 0) == ""
    assert str_mid("ABC", 9, 2) == "BC"
    assert str_mid("ABC", 2, 0) == "AB"
    assert str_mid("ABC", 2, 9) == ""
    assert str_mid("ABC", -2, 1) == ""
    assert str_insert("ABC", "X", 9) == "ABCX"
    assert str_insert("ABC", "X", -3) == "XABC"
    assert str_delete("ABC", 9, 2) == "A"
    assert str_delete("ABC", 1, 9) == "ABC"
    assert str_replace("ABC", "X", 9, 9) == "ABCX"


def test_find_nothing():
    assert str_find("ABC", "X") == 0
    assert str_find("ABC", "") == 0


def test_cut():
    assert str_cut("ABC", 2) == "AB"
    assert str_cut("ABC", 3) == "ABC"


def test_numbers_to_text():
    assert int_to_str(-12) == "-12"
    assert bool_to_str(1) == "TRUE"
    assert bool_to_str(0) == "FALSE"


def test_text_to_bool():
    assert [str_to_bool(s) for s in ("TRUE", " true ", "1", "False", "0")] == [1, 1, 1, 0, 0]
    for bad in ("", "yes", "2", "TRUE1"):
        raises(RANGE, str_to_bool, bad)


def test_text_to_int():
    assert str_to_int(" -12 ", -100, 100) == -12
    assert str_to_int("+1_000", 0, 1000) == 1000
    assert str_to_int("16#fF", 0, 255) == 255
    assert str_to_int("2#1010", 0, 255) == 10
    for bad in ("", "-", "12a", "1__0", "_1", "1.0", "3#1", "16#", "300", "0x10"):
        raises(RANGE, str_to_int, bad, 0, 255)


def test_real_to_text_is_the_shortest():
    shown = [real_to_str(f32(x)) for x in (0.0, 1.0, 0.1, -2.5, 16777216.0, 1e10, 1.5e-7, 3.4028234663852886e38)]
    assert shown == ["0.0", "1.0", "0.1", "-2.5", "16777216.0", "1.0E+10", "1.5E-07", "3.4028235E+38"], shown
    assert real_to_str(f32(1e39)) == "inf"


def test_text_to_real():
    assert str_to_real("1.5") == 1.5
    assert str_to_real("-1_0.2_5") == -10.25
    assert str_to_real(" 2E3 ") == 2000.0
    assert str_to_real("2.5e-1") == 0.25
    for bad in ("", "nan", "inf", "1.", ".5", "1e", "1.2.3", "1,5"):
        raises(RANGE, str_to_real, bad)


def test_time_to_text_and_back():
    for ms, text in (
        (0, "T#0s"),
        (1500, "T#1s500ms"),
        (-5, "T#-5ms"),
        (93784005, "T#1d2h3m4s5ms"),
        (-2147483648, "T#-24d20h31m23s648ms"),
    ):
        assert time_to_str(ms) == text, time_to_str(ms)
        assert str_to_time(text) == ms


def test_text_to_time():
    assert str_to_time("time#1.5s") == 1500
    assert str_to_time("t#1h_30m") == 5400000
    assert str_to_time("T#90m") == 5400000
    assert str_to_time("T#0.0005s") == 1
    for bad in ("", "5s", "T#", "T#5", "T#s", "T#1s2h", "T#1.5h2s", "T#25d", "T#1x", "T#1.s"):
        raises(RANGE, str_to_time, bad)
