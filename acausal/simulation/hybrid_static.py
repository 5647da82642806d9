"""Stretches between events for models without states: the equations are solved at the output times, and where a
condition has switched between two of them its time is found by bisection."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from acausal.errors import SimulationError
from acausal.lowering.hybrid import Hybrid

from .conditions import modes, sides
from .continuation import MOVED, SMALLEST
from .event_iteration import Equations
from .hybrid_run import EVENT, Integrate
from .native_library import Floats

BETWEEN = 4
"""Points between two output times at which conditions are looked at, the later one included."""
TANGENT = 1e-6
"""Difference of time for the tangent, relative to the step."""


@dataclass(eq=False)
class Stretch:
    """As `acausal.simulation.hybrid_run.Segment`."""

    z: Floats
    code: int
    saved: int
    t_end: float
    z_end: Floats
    step: float = 0.0
    switched: Any = None
    counts: dict[str, int] = field(default_factory=dict[str, int])
    passed: Sequence[tuple[float, int, Any]] = ()


def static_integrate(hybrid: Hybrid, equations: Equations, nominal: Floats) -> Integrate:
    """Stretches of a model without states, whose unknowns have the sizes `nominal`."""

    def attempt(t: float, z: Floats, p: Floats) -> Floats | None:
        p = p.copy()
        equations.feed(t, p)
        return equations.settle(t, z, p)

    def solved(begin: float, t: float, z: Floats, p: Floats) -> Floats:
        """From z at `begin`, along the tangent, in steps that the corrector follows with a small move."""
        here, h, found = begin, t - begin, z
        while here < t:
            h = min(h, t - here)
            beside = attempt(here + TANGENT * h, z, p)
            ahead = z if beside is None else z + (beside - z) / TANGENT
            found = attempt(here + h, ahead, p)
            last = h <= SMALLEST * (t - begin)
            if found is None and last:
                break
            near = found is not None and np.all(np.abs(found - ahead) <= MOVED * np.maximum(nominal, np.abs(z)))
            if found is not None and (near or last):
                here, z, h = (t if here + h >= t else here + h), found, 2.0 * h
            else:
                h *= 0.5
        if found is None:
            raise SimulationError(f"At t = {t:.12g} s the algebraic equations have no solution near the last one.")
        return found

    def integrate(
        t: float, stop: float, z: Floats, p: Floats, save: Floats, step: float, end_open: bool, steps: int
    ) -> Stretch:
        at_zero = modes(hybrid, p) == hybrid.roots.strict
        first = sides(hybrid, equations, t, z, p)
        slack = np.where((first > 0.0) | (at_zero & (first == 0.0)), 10.0 * np.abs(first) + 1e-12, 0.0)

        def switched(t: float, z: Floats) -> Any:
            beyond = sides(hybrid, equations, t, z, p)
            return np.where(slack > 0.0, beyond > slack, (beyond > 0.0) | (at_zero & (beyond == 0.0)))

        kept = [np.tile(z, (int((save <= t).sum()) if not (end_open and stop <= t) else 0, 1))]
        n = len(kept[0])
        here, count = t, 0
        while here < stop:
            target = float(min(save[n], stop)) if n < len(save) else stop
            for k in range(1, BETWEEN + 1):
                there = target if k == BETWEEN else here + (target - here) * k / BETWEEN
                z_there = solved(here, there, z, p)
                count += 1
                if switched(there, z_there).any():
                    low, high = here, there
                    while (middle := 0.5 * (low + high)) not in (low, high):
                        z_middle = solved(here, middle, z, p)
                        if switched(middle, z_middle).any():
                            high, z_there = middle, z_middle
                        else:
                            low = middle
                    mask = switched(high, z_there)
                    return Stretch(np.concatenate(kept), EVENT, n, high, z_there, 0.0, mask, {"steps": count})
                here, z = there, z_there
            if n < len(save) and save[n] <= here and not (end_open and here >= stop):
                m = int((save[n:] <= here).sum())
                kept.append(np.tile(z, (m, 1)))
                n += m
        return Stretch(np.concatenate(kept), 0, n, stop, z, 0.0, None, {"steps": count})

    return integrate
