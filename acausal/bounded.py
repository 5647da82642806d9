"""Bounds that are declared of variables, checked at the points of a result.

An equation may have solutions that no quantity of its kind can have, as concentrations below zero. Newton's method may
begin at one, and a step that is long enough passes a pole to one: nothing else tells.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from .errors import SimulationError
from .language.places import users_field
from .language.template import Floats, Ints
from .lowering.bounds import declared_bounds

if TYPE_CHECKING:
    from .simulation.solution import Solution


def check_bounds(solution: Solution, values: Callable[[Ints], Floats], rtol: float) -> None:
    """Check all variables with ``min`` or ``max`` of a solution with concrete values.

    Args:
        solution: of one run.
        values: of the variables with these numbers at the points of the solution, (n_t, n).
        rtol: its relative tolerance: a bound may be passed by as much as this of the nominal value, ten times as much
            of the bound.

    Raises:
        SimulationError: a value lies outside; the first one is named.
    """
    flat = solution.system.stages.flat
    low, high = declared_bounds(flat.root, parameters=False)
    bounded = np.flatnonzero(np.isfinite(low) | np.isfinite(high))
    if not len(bounded) or not len(solution.t):
        return
    found = np.asarray(values(bounded), float).T
    low, high = low[bounded, None], high[bounded, None]
    nominal = np.where(np.isnan(flat.nominal[bounded]), 1.0, flat.nominal[bounded])[:, None]
    with np.errstate(invalid="ignore"):  # an infinite bound has no slack
        outside = (found < low - rtol * (nominal + 10.0 * np.abs(low))) | (
            found > high + rtol * (nominal + 10.0 * np.abs(high))
        )
    if not outside.any():
        return
    at = int(np.argmax(outside.any(axis=0)))
    i = int(np.argmax(outside[:, at]))
    name = flat.names.variable(int(bounded[i]))
    field = users_field(flat.root, name)
    raise SimulationError(
        f"At t = {float(solution.t[at]):.9g} s `{name}` = {found[i, at]:.6g} lies outside its bounds "
        f"[{low[i, 0]:.6g}, {high[i, 0]:.6g}]{', declared in' if field else '.'}\n"
        + (f"    {field}\n" if field else "")
        + "Often: the equations have another solution there, that Newton's method or a long step has come to. Try: a "
        "start value near the solution that is meant, the `nominal` of what is small, a smaller `rtol`."
    )
