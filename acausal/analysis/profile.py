"""Profile likelihood: how much worse the fit gets when one parameter is held and the others follow.

The interval is where twice the increase of the cost stays below the squared quantile (Raue et al., Bioinformatics 25,
2009, eq. 5). An open end means that the data set no limit on that side.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ..language.template import Floats

if TYPE_CHECKING:
    from .calibrate import Outcome, Search

STEP = 0.6
"""First step away from the best fit, in standard deviations of the linearized model."""
MARGIN = 1e-4
"""A profile stops so far from a bound, as a part of the interval."""


@dataclass(frozen=True, slots=True, eq=False)
class Profile:
    """The profile of one parameter.

    Attributes:
        name: of the parameter.
        values: held values, increasing, (n,).
        increase: twice the increase of the cost over the best fit, (n,).
        parameters: values of all free quantities along the profile, (n, n_free).
        threshold: increase at the ends of the interval.
        interval: lower and upper end; an end that the data do not limit is the last value looked at.
        open: for each end whether the data set no limit there.
    """

    name: str
    values: Floats
    increase: Floats
    parameters: Floats
    threshold: float
    interval: tuple[float, float]
    open: tuple[bool, bool]

    def plot(self, ax: Any = None) -> Any:
        """The profile with its threshold; returns the figure."""
        from .fit_plots import plot_profile

        return plot_profile(self, ax)


def profile(
    search: Search, best: Outcome, sigma: Floats, k: int, spread: float, quantile: float, points: int
) -> Profile:
    """Follow the profile of free quantity `k` to both sides.

    Args:
        search: optimizer.
        best: the best fit.
        sigma: noise of the samples.
        k: index of the parameter.
        spread: its standard deviation on the natural scale.
        quantile: half width of the interval in standard deviations.
        points: most values on each side.
    """
    threshold = quantile**2
    prior = search.problem.free[k].prior
    centre = float(prior.natural(best.values[k]))
    sides = [_side(search, best, sigma, k, spread, threshold, points, sign) for sign in (-1.0, 1.0)]
    ends: list[float] = []
    opened: list[bool] = []
    for natural, increase, _ in sides:
        u, rise = np.array([centre, *natural]), np.sqrt(np.maximum(np.array([0.0, *increase]), 0.0))
        over = np.flatnonzero(rise >= quantile)
        opened.append(not len(over))
        if len(over):
            j = int(over[0])
            part = (quantile - rise[j - 1]) / (rise[j] - rise[j - 1])
            ends.append(float(prior.value(u[j - 1] + part * (u[j] - u[j - 1]))))
        else:
            ends.append(float(prior.value(u[-1])))
    (below, d_below, p_below), (above, d_above, p_above) = sides
    values = prior.value(np.array([*below[::-1], centre, *above]))
    increase = np.array([*d_below[::-1], 0.0, *d_above])
    parameters = np.array([*p_below[::-1], best.values, *p_above])
    name = search.problem.free[k].name
    return Profile(name, values, increase, parameters, threshold, (ends[0], ends[1]), (opened[0], opened[1]))


def _side(
    search: Search, best: Outcome, sigma: Floats, k: int, spread: float, threshold: float, points: int, sign: float
) -> tuple[list[float], list[float], list[Floats]]:
    """Natural values, increases and parameters on one side, outwards until the threshold is passed."""
    prior = search.problem.free[k].prior
    held = np.arange(len(best.z)) == k
    centre = float(prior.natural(best.values[k]))
    low, high = (float(prior.natural(q)) for q in prior.quantile(np.array([MARGIN, 1 - MARGIN])))
    step = STEP * min(spread, 0.2 * (high - low))
    natural: list[float] = []
    increase: list[float] = []
    parameters: list[Floats] = []
    z, at = best.z, centre
    for _ in range(points):
        if (at <= low and sign < 0) or (at >= high and sign > 0):
            break
        at = float(np.clip(at + sign * step, low, high))
        z = z.copy()
        z[k] = prior.internal(float(prior.value(at)))
        outcome = search.run(z, sigma, held)
        z = outcome.z
        natural.append(at)
        increase.append(2.0 * (outcome.cost - best.cost))
        parameters.append(outcome.values)
        if increase[-1] > threshold:
            break
        expected = ((at - centre) / spread) ** 2
        if increase[-1] < 0.5 * expected or len(natural) > points // 2:
            step *= 2.0
    return natural, increase, parameters
