"""The bridge to SymPy: values agree, and the way back gives the same value."""

from __future__ import annotations

import math

import numpy as np
import pytest
import sympy

import acausal as ac
from acausal.symbolic.expr import Expr, symbol
from acausal.symbolic.sympy_bridge import from_sympy, to_sympy
from acausal.symbolic.traverse import evaluate

x, y = symbol(("x",)), symbol(("port", "y"))

EXPRESSIONS = [
    x + 2 * y - 3, x * y / (x + y), ac.sqrt(x**2 + y**2), ac.sin(x) * ac.exp(-y), ac.atan2(y, x), ac.abs(x - y),
    ac.max(x, y) - ac.min(x, y), ac.log(x) + ac.log10(y), ac.tanh(ac.PI * x), x**y, ac.clip(x, 0, 0.5),
    ac.where(x > y, x, 2 * y), ac.sign(y - x),
]  # fmt: skip


def value(e: Expr) -> float:
    point = {x: 0.7, y: 1.3}
    return float(evaluate((e,), lambda leaf: point[leaf], np)[0])


@pytest.mark.parametrize("e", EXPRESSIONS, ids=str)
def test_values_agree(e: Expr) -> None:
    there = to_sympy(e)
    got = there.subs({sympy.Symbol("x", real=True): 0.7, sympy.Symbol("port.y", real=True): 1.3}).evalf()
    assert math.isclose(float(got), value(e), rel_tol=1e-12)


@pytest.mark.parametrize("e", [e for e in EXPRESSIONS if "where" not in str(e)], ids=str)
def test_there_and_back(e: Expr) -> None:
    again = from_sympy(to_sympy(e), {"x": x, "port.y": y})
    assert math.isclose(value(again), value(e), rel_tol=1e-12)


def test_unknown_symbols_and_functions() -> None:
    with pytest.raises(ValueError, match="`z` is not among x"):
        from_sympy(sympy.Symbol("z"), {"x": x})
    with pytest.raises(ValueError, match="`gamma` has no counterpart"):
        from_sympy(sympy.gamma(sympy.Symbol("x")), {"x": x})
