# make demo: see a program run.  make test: run every test.
# Needs Python 3.11 or later, and git; everything else goes into .venv, and is fetched once.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
DEMO := build/demo

.PHONY: help demo test lint clean

help:
	@echo "make demo   simulate examples/tank for a minute, and draw what happened"
	@echo "make test   run every test"
	@echo "make lint   ruff and pyright"
	@echo "make clean  remove .venv and everything that was built"

$(VENV)/installed: pyproject.toml .ci/make_venv.py
	@echo "Installing iec2mpy into $(VENV)"
	@$(PYTHON) .ci/make_venv.py $(VENV)
	@$(BIN)/python -m pip install --quiet --editable '.[plot]'
	@touch $@

$(VENV)/installed-dev: $(VENV)/installed
	@echo "Installing what the tests need into $(VENV)"
	@$(BIN)/python -m pip install --quiet --editable '.[dev]'
	@touch $@

demo: $(VENV)/installed
	@mkdir -p $(DEMO)
	$(BIN)/iec2mpy run examples/tank --for T#60s --set main.simulated=true \
	    --watch main.level --trace $(DEMO)/tank.csv --plot $(DEMO)/tank.svg

test: $(VENV)/installed-dev
	PATH="$(CURDIR)/$(BIN):$$PATH" $(BIN)/python -m pytest -n auto

lint: $(VENV)/installed-dev
	$(BIN)/ruff check .
	$(BIN)/pyright --pythonpath $(BIN)/python

clean:
	rm -rf $(VENV) build dist .pytest_cache .ruff_cache
