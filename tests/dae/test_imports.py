"""The structural algorithms see integers only."""

import ast
import doctest
import importlib
import sys
from pathlib import Path

import pytest

import acausal.dae

FILES = sorted(Path(acausal.dae.__path__[0]).glob("*.py"))
ALLOWED = [*sys.stdlib_module_names, "numpy", "scipy"]


@pytest.mark.parametrize("path", FILES, ids=lambda p: p.stem)
def test_imports_only_numpy_scipy_and_the_standard_library(path: Path) -> None:
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        names: list[str] = []
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path.name}:{node.lineno}: relative import"
            names = [node.module or ""]
        for name in names:
            own = name == "acausal.dae" or name.startswith("acausal.dae.")
            assert own or name.split(".")[0] in ALLOWED, f"{path.name}:{node.lineno}: imports {name}"


@pytest.mark.parametrize("path", FILES, ids=lambda p: p.stem)
def test_docstring_examples(path: Path) -> None:
    name = "acausal.dae" if path.stem == "__init__" else f"acausal.dae.{path.stem}"
    module = importlib.import_module(name)
    result = doctest.testmod(module)
    assert result.failed == 0
    assert result.attempted > 0 or path.stem == "__init__"
