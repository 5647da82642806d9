"""Random expressions of three leaves."""

from __future__ import annotations

from typing import Any

from hypothesis import strategies as st

import acausal as ac
from acausal.symbolic.expr import Expr, const, symbol

LEAVES = symbol(("x",)), symbol(("y",)), symbol(("z",))

SMOOTH = [
    lambda a, b: a + b,
    lambda a, b: a - b,
    lambda a, b: a * b,
    lambda a, b: a / (b * b + 1.5),
    lambda a, b: ac.sin(a) * b,
    lambda a, b: ac.cos(a + b),
    lambda a, b: ac.tanh(a) + b,
    lambda a, b: ac.sqrt(a * a + 1.0) * b,
    lambda a, b: ac.exp(-(a * a)) + b,
    lambda a, b: (a * a + 0.5) ** 0.75 - b,
    lambda a, b: ac.atan2(a, b * b + 2.0),
    lambda a, b: (ac.tanh(a) + 2.0) ** ac.tanh(b),
    lambda a, b: -a * b,
]
KINKED = [
    lambda a, b: ac.max(a, b),
    lambda a, b: ac.min(a, b),
    lambda a, b: ac.abs(a) + b,
    lambda a, b: ac.clip(a, -0.5, b * b),
    lambda a, b: ac.where(a > b, a, b * b),
]


def expressions(kinked: bool = True) -> st.SearchStrategy[Expr]:
    """Expressions of up to a few dozen nodes, finite for moderate values of the leaves."""
    atoms: st.SearchStrategy[Any] = st.one_of(
        st.sampled_from(LEAVES), st.sampled_from([const(v) for v in (-2.0, -0.5, 0.0, 1.0, 0.25, 3.0)])
    )
    rules = SMOOTH + KINKED if kinked else SMOOTH
    combine = st.sampled_from(rules)
    return st.recursive(atoms, lambda below: st.builds(lambda f, a, b: f(a, b), combine, below, below), max_leaves=8)
