"""Equations that have been differentiated and jump at events: the derivative is an impulse there.

Between events, what switches is smooth, and an equation such as ``x == where(time > 1, 1, 0)`` is differentiated as it
is then. If its sides no longer agree behind an event, x jumps, and `der(x)` has a Dirac impulse. A solver's results do
not show it; and where a state is driven by it, as z of ``der(z) == der(x) - z``, they would be wrong from then on.
"""

from __future__ import annotations

import numpy as np

from ..language.flat_model import Family
from ..language.template import Ints
from ..symbolic.differentiate import partial
from ..symbolic.expr import Expr, var
from .schedule import Schedule


def jumping(schedule: Schedule) -> list[tuple[Family, Ints]]:
    """Differentiated equations that hold what changes at events (modes, discrete variables), with their row numbers."""
    reduced = schedule.reduced
    first = reduced.flat.n_par + len(reduced.flat.inputs)
    found: list[tuple[Family, Ints]] = []
    for k, family in enumerate(reduced.families):
        rows = np.arange(family.size) + reduced.rows.offset[k]
        keep = (reduced.row_derivative[rows] >= 0) & (family.par_rows >= first).any(axis=1)
        if keep.any():
            found.append((family.select(keep), rows[keep]))
    return found


def terms_and_slopes(family: Family) -> tuple[tuple[Expr, ...], int]:
    """The terms of a residual, then its slopes by each of its variables; and the number of terms."""
    residual = family.residual
    terms = residual.args if residual.op == "add" else (residual,)
    slopes = tuple(partial(residual, var(slot)) for slot in range(family.var_rows.shape[1]))
    return (*terms, *slopes), len(terms)


def driven_states(schedule: Schedule, row: int) -> Ints:
    """The states that an impulse in the derivative of equation `row` reaches.

    Those of the equation itself where it is an invariant, so that the states themselves would have to jump; else those
    whose derivatives follow from the derivatives of what the equation determines.
    """
    reduced, states = schedule.reduced, schedule.states
    hit = np.zeros(len(reduced.unknown), bool)
    determined = False
    for group in schedule.groups:
        blocks = (group.equations == row).any(axis=1)
        if blocks.any():
            hit[group.unknowns[blocks]] = determined = True
    if not determined:
        family, k = reduced.rows.locate(row)
        return np.intersect1d(states, family.var_rows[k])
    at = np.flatnonzero(hit)
    hit[:] = False
    while len(at):
        at = reduced.derivative_of[at]
        at = at[at >= 0]
        hit[at] = True
    for group in schedule.groups:
        hit[group.unknowns[hit[group.var_rows].any(axis=1)]] = True
    return states[hit[reduced.derivative_of[states]]]
