"""The words of the language: which are reserved, and which have a meaning in one place only.

6.1.3: a keyword has no other use. Words that mean something in one place only (TASK, ON, WITH, PRIORITY, STEP,
FINAL, PUBLIC, …) can still name a variable anywhere else: whoever parses that place looks for them by their text.
Names of standard functions and function blocks are not reserved either.
"""

from __future__ import annotations

BLOCK_ENDS = {
    "IF": "END_IF",
    "CASE": "END_CASE",
    "FOR": "END_FOR",
    "WHILE": "END_WHILE",
    "REPEAT": "END_REPEAT",
}
"""The statements that hold others, with the word that ends each."""

OPTIONAL_SEMICOLON = frozenset({*BLOCK_ENDS.values(), "END_STRUCT"})
"""Words behind which some dialects need no `;`."""

POU_ENDS = {"FUNCTION": "END_FUNCTION", "FUNCTION_BLOCK": "END_FUNCTION_BLOCK", "PROGRAM": "END_PROGRAM"}

FOREIGN_ENDS = {"CLASS": "END_CLASS", "INTERFACE": "END_INTERFACE", "NAMESPACE": "END_NAMESPACE"}
"""Declarations that are recognised and not supported yet."""

SECTION_WORDS = (
    "VAR", "VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT", "VAR_TEMP", "VAR_STAT", "VAR_GLOBAL", "VAR_EXTERNAL",
    "VAR_ACCESS", "VAR_CONFIG",
)  # fmt: skip

STATEMENT_WORDS = (*BLOCK_ENDS, "EXIT", "CONTINUE", "RETURN")

ELEMENTARY_TYPES = frozenset({
    "BOOL", "BYTE", "WORD", "DWORD", "LWORD", "SINT", "INT", "DINT", "LINT", "USINT", "UINT", "UDINT", "ULINT",
    "REAL", "LREAL", "TIME", "LTIME", "DATE", "LDATE", "TIME_OF_DAY", "TOD", "LTIME_OF_DAY", "LTOD", "DATE_AND_TIME",
    "DT", "LDATE_AND_TIME", "LDT", "CHAR", "WCHAR",
})  # fmt: skip

KEYWORDS: dict[str, str] = {
    word: word
    for word in (
        *BLOCK_ENDS, *BLOCK_ENDS.values(), *POU_ENDS, *POU_ENDS.values(), *FOREIGN_ENDS, *FOREIGN_ENDS.values(),
        *SECTION_WORDS, "END_VAR", "TYPE", "END_TYPE", "STRUCT", "END_STRUCT", "ARRAY", "OF",
        "CONFIGURATION", "END_CONFIGURATION", "RESOURCE", "END_RESOURCE", "METHOD", "END_METHOD",
        "CONSTANT", "RETAIN", "NON_RETAIN", "AT", "R_EDGE", "F_EDGE", "REF_TO", "REF", "NULL",
        "THEN", "ELSIF", "ELSE", "TO", "BY", "DO", "UNTIL", "EXIT", "CONTINUE", "RETURN",
        "AND", "OR", "XOR", "NOT", "MOD", "USING", "EXTENDS", "IMPLEMENTS", "THIS", "SUPER",
        "AND_THEN", "OR_ELSE", "INITIAL_STEP", "END_STEP", "END_TRANSITION", "END_ACTION",
    )
}  # fmt: skip
"""Reserved words with the type of their token."""
KEYWORDS |= dict.fromkeys(ELEMENTARY_TYPES, "ELEMENTARY")
KEYWORDS |= dict.fromkeys(("STRING", "WSTRING"), "STRING")
KEYWORDS |= dict.fromkeys(("TRUE", "FALSE"), "LITERAL")

ACCESS_WORDS = frozenset({"PUBLIC", "PROTECTED", "PRIVATE", "INTERNAL"})
CLASS_WORDS = frozenset({"FINAL", "ABSTRACT"})
SFC_WORDS = frozenset({"STEP", "TRANSITION", "ACTION"})
CONFIGURATION_WORDS = frozenset({"TASK", "ON", "WITH"})

DIALECT_WORDS = {"VAR_STAT": "static-variables", "AND_THEN": "short-circuit", "OR_ELSE": "short-circuit"}
"""Words that are names in the standard, with the extension that makes them keywords."""

IL_OPERATORS = frozenset({
    "LD", "LDN", "ST", "STN", "ST?", "NOT", "S", "R", "S1", "R1", "CLK", "CU", "CD", "PV", "IN", "PT", "AND", "&", "OR",
    "XOR", "ANDN", "&N", "ORN", "XORN", "ADD", "SUB", "MUL", "DIV", "MOD", "GT", "GE", "EQ", "LT", "LE", "NE",
    "CAL", "CALC", "CALCN", "RET", "RETC", "RETCN", "JMP", "JMPC", "JMPCN",
})  # fmt: skip
"""Table 68 and the grammar's IL_Simple_Operator and its like."""

MISSPELLINGS: dict[str, str | None] = {
    "ELSEIF": "ELSIF", "ELIF": "ELSIF", "ELSE_IF": "ELSIF",
    "ENDIF": "END_IF", "ENDCASE": "END_CASE", "ENDFOR": "END_FOR", "ENDWHILE": "END_WHILE", "ENDREPEAT": "END_REPEAT",
    "FI": "END_IF", "BREAK": "EXIT", "SWITCH": "CASE", "END": None,
}  # fmt: skip
"""Words of other languages, with what is meant, where a statement starts with one of them. They can be names."""

KEYWORDS |= dict.fromkeys(MISSPELLINGS, "MISSPELT")
