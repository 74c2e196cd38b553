"""The stored tables are those of the grammar, and every rule has its action."""

from __future__ import annotations

import json
import logging
from pathlib import Path

import lark
import pytest

from iec2mpy import syntax
from iec2mpy.syntax import tables
from iec2mpy.syntax.actions import ACTIONS

_FOLDER = Path(syntax.__file__).parent


def test_stored_tables_fit_the_grammar() -> None:
    """If this fails: python -c "from iec2mpy.syntax.tables import write; write()"."""
    stored = json.loads((_FOLDER / "st.tables.json").read_text(encoding="utf-8"))
    assert stored == tables.build()


def test_tables_are_made_anew_where_the_stored_ones_do_not_fit(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    stale = tmp_path / "st.tables.json"
    stale.write_text('{"grammar": "of another time"}', encoding="utf-8")
    monkeypatch.setattr(tables, "_TABLES", stale)
    assert tables.load.__wrapped__() == tables.load()


def test_written_tables_are_read_again(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(tables, "_TABLES", tmp_path / "st.tables.json")
    tables.write()
    monkeypatch.setattr(tables, "build", lambda: pytest.fail("the stored tables were not used"))
    assert tables.load.__wrapped__().starts.keys() == set(tables.START_RULES)


def test_every_rule_has_its_action_and_every_action_a_rule() -> None:
    assert {rule.action for rule in tables.load().rules} - {None} == set(ACTIONS)


def test_grammar_has_no_conflicts(caplog: pytest.LogCaptureFixture) -> None:
    """Lark resolves a shift/reduce conflict without an error, and says so only in its log."""
    grammar = (_FOLDER / "st.lark").read_text(encoding="utf-8")
    with caplog.at_level(logging.DEBUG, logger=lark.logger.name):
        lark.Lark(grammar, parser="lalr", lexer="basic", start=list(tables.START_RULES), debug=True)
    assert not [record for record in caplog.records if "onflict" in record.getMessage()]
