"""The functions of the runtime that generated code calls: one row each, read by the builder and by the backends."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Runtime:
    """`function` of `module` (in `mcu_runtime`; None for a built-in of Python). `faults`: whether it may raise one.
    `rounds`: whether it gives a REAL that a host with doubles has to round to single."""

    function: str
    module: str | None = "arithmetic"
    faults: bool = False
    rounds: bool = False


def _real(name: str, faults: bool = False) -> Runtime:
    return Runtime(f"real_{name}", faults=faults, rounds=True)


INTRINSICS: Mapping[str, Runtime] = {
    # REAL (tables 28 and 29); ABS and the conversions
    "ABS": Runtime("abs", module=None),
    "SQRT": _real("sqrt", faults=True),
    "LN": _real("ln", faults=True),
    "LOG": _real("log", faults=True),
    "EXP": _real("exp"),
    "SIN": _real("sin", faults=True),
    "COS": _real("cos", faults=True),
    "TAN": _real("tan", faults=True),
    "ASIN": _real("asin", faults=True),
    "ACOS": _real("acos", faults=True),
    "ATAN": _real("atan"),
    "ATAN2": _real("atan2"),
    "EXPT": _real("pow", faults=True),
    "real_to_int": Runtime("real_to_int", faults=True),
    "real_trunc": Runtime("real_trunc", faults=True),
    "real_to_bits": Runtime("real_to_bits"),
    "bits_to_real": Runtime("bits_to_real"),
    "lreal_to_bits": Runtime("lreal_to_bits"),
    "bits_to_lreal": Runtime("bits_to_lreal"),
    "lreal_to_real": Runtime("lreal_to_real", faults=True),
    # an LTIME by a real number (table 35)
    "times_real": Runtime("times_real", faults=True),
    "over_real": Runtime("over_real", faults=True),
    # binary-coded decimal (tables 22 and 39)
    "BCD_TO": Runtime("bcd_to_int", "bcd", faults=True),
    "TO_BCD": Runtime("int_to_bcd", "bcd", faults=True),
    "IS_VALID_BCD": Runtime("is_bcd", "bcd"),
    # strings (table 34) and their conversions
    "cut": Runtime("str_cut", "strings"),
    "LEN": Runtime("len", module=None),
    "LEFT": Runtime("str_left", "strings"),
    "RIGHT": Runtime("str_right", "strings"),
    "MID": Runtime("str_mid", "strings"),
    "CONCAT": Runtime("str_concat", "strings"),
    "INSERT": Runtime("str_insert", "strings"),
    "DELETE": Runtime("str_delete", "strings"),
    "REPLACE": Runtime("str_replace", "strings"),
    "FIND": Runtime("str_find", "strings"),
    # dates and times of day (tables 26, 35, 36)
    "floor_quotient": Runtime("floor_quotient", "dates"),
    "floor_rest": Runtime("floor_rest", "dates"),
    "concat_date": Runtime("concat_date", "dates", faults=True),
    "concat_tod": Runtime("concat_tod", "dates", faults=True),
    "year_of": Runtime("year_of", "dates"),
    "month_of": Runtime("month_of", "dates"),
    "day_of": Runtime("day_of", "dates"),
    "date_to_str": Runtime("date_to_str", "date_texts"),
    "str_to_date": Runtime("str_to_date", "date_texts", faults=True),
    # characters (6.4.2.2, table 27)
    "char_to_str": Runtime("chr", module=None),
    "str_to_char": Runtime("first_character", "characters"),
    "to_narrow": Runtime("to_narrow", "characters"),
    "character": Runtime("character", "characters", faults=True),
    "with_character": Runtime("with_character", "characters", faults=True),
    "int_to_str": Runtime("int_to_str", "strings"),
    "real_to_str": Runtime("real_to_str", "strings"),
    "bool_to_str": Runtime("bool_to_str", "strings"),
    "time_to_str": Runtime("time_to_str", "strings"),
    "str_to_int": Runtime("str_to_int", "strings", faults=True),
    "str_to_real": Runtime("str_to_real", "strings", faults=True, rounds=True),
    "str_to_bool": Runtime("str_to_bool", "strings", faults=True),
    "str_to_time": Runtime("str_to_time", "strings", faults=True),
}
