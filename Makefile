# Needs Python >= 3.11 with pip, and make. Choose the interpreter with `make demo PYTHON=python3.12`.
PYTHON ?= python3
VENV ?= .venv
ifeq ($(OS),Windows_NT)
BIN := $(VENV)/Scripts
else
BIN := $(VENV)/bin
endif
PIP := $(BIN)/python -m pip --disable-pip-version-check install --quiet
WORKERS ?= 2

.PHONY: demo test slow lint ruff pyright bench clean

demo: ## a fresh virtual environment, install, simulate the four cranes, draw the figures
	@echo "Installing into a fresh virtual environment, $(VENV) ..."
	$(PYTHON) -m venv --clear $(VENV)
	$(PIP) -e .
	@echo "Simulating the crane ..."
	$(BIN)/python -m acausal demo $(DEMO)

$(VENV)/.installed-test: pyproject.toml
	$(PYTHON) -m venv $(VENV)
	$(PIP) -e ".[test]"
	$(BIN)/python -c "import pathlib; pathlib.Path('$@').touch()"

$(VENV)/.installed-dev: pyproject.toml
	$(PYTHON) -m venv $(VENV)
	$(PIP) -e ".[dev]"
	$(BIN)/python -c "import pathlib; pathlib.Path('$@').touch()"

$(VENV)/.installed-bench: pyproject.toml
	$(PYTHON) -m venv $(VENV)
	$(PIP) -e ".[test,bench]"
	$(BIN)/python -c "import pathlib; pathlib.Path('$@').touch()"

test: $(VENV)/.installed-test ## the tests that are not slow
	$(BIN)/python -m pytest -n $(WORKERS) --dist worksteal $(ARGS)

slow: $(VENV)/.installed-test ## the slow tests
	$(BIN)/python -m pytest -m slow $(ARGS)

lint: ruff pyright ## ruff and pyright

ruff: $(VENV)/.installed-dev
	$(BIN)/python -m ruff check .

pyright: $(VENV)/.installed-dev
	$(BIN)/python -m pyright --pythonpath $(BIN)/python

bench: $(VENV)/.installed-bench ## every table of benchmarks/RESULTS.md
	$(BIN)/python -m benchmarks

clean:
	$(PYTHON) -c "import shutil; shutil.rmtree('$(VENV)', ignore_errors=True)"
