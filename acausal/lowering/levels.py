"""Which variables may jump together: velocities with velocities, positions with positions and all that follows them.

An impulse acts on the highest derivatives, so what jumps are the values that are one differentiation below; what is two
below them stays continuous. Brogliato (2016), Nonsmooth Mechanics, 3rd ed., ch. 1.
"""

from __future__ import annotations

import numpy as np

from ..language.template import Ints
from .lowered import Lowered


def levels(lowered: Lowered) -> Ints:
    """How many differentiations below the highest derivatives each reduced variable is, (n_ids,).

    A variable whose derivative is a variable is one level above it; so is a state whose rate is equal to another state.
    """
    derivative_of = lowered.schedule.reduced.derivative_of
    rate = derivative_of.copy()
    for state, equal in _equal_rates(lowered):
        if not _leads(rate, equal, state):  # of two variables that are each other's rate none is above the other
            rate[state] = equal
    level = np.zeros(lowered.n_ids, np.int64)
    has = np.flatnonzero(rate >= 0)
    while True:  # as many turns as there are levels
        raised = 1 + np.maximum(level[rate[has]], level[np.maximum(derivative_of[has], 0)])
        if (raised == level[has]).all():
            return level
        level[has] = raised


def _leads(rate: Ints, start: int, end: int) -> bool:
    while start >= 0 and start != end:
        start = int(rate[start])
    return start == end


def _equal_rates(lowered: Lowered) -> list[tuple[int, int]]:
    """States whose derivative is plus or minus another variable, and that variable."""
    state_of = {int(d): int(s) for s, d in zip(lowered.schedule.states, lowered.dx_ids, strict=True)}
    pairs: list[tuple[int, int]] = []
    for group in lowered.schedule.groups:
        for u, expression in group.kernel.steps:
            leaf = expression.args[0] if expression.op == "neg" else expression
            if leaf.op == "var":
                rows = group.var_rows[:, [u, leaf.value]].tolist()
                pairs += [(state_of[d], v) for d, v in rows if d in state_of]
    return pairs
