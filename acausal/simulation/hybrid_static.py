"""Stretches between events for models without states: the equations are followed from one output time to the next, and
the first switch between two of them is found by looking at the conditions closely enough, and by bisection."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from acausal.errors import SimulationError
from acausal.lowering.hybrid import Hybrid

from .conditions import modes
from .event_iteration import EventIteration
from .hybrid_run import EVENT, Integrate
from .native_library import Floats
from .scan import Scan

TINY = 1e-300
"""Slack of what is at its switch exactly: just not zero."""

Look = Callable[[float, float, Floats, Floats], tuple[Floats, Floats]]
"""(time, later time, solution at the first, parameters) to the solution at the second, and how far each condition is
on the other side there than its mode says."""


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


@dataclass(eq=False)
class _Path:
    """Solutions of the equations of a stretch along time, with its modes.

    Attributes:
        look: follows the equations.
        p: parameters and slots.
        times, known: the solutions and conditions that are known, in order.
        count: how many have been asked for.
    """

    look: Look
    p: Floats
    times: list[float]
    known: list[tuple[Floats, Floats]]
    count: int = 0

    def at(self, t: float) -> tuple[Floats, Floats]:
        """The solution at a time and the conditions there, followed from the nearest one before it."""
        k = bisect_right(self.times, t)
        if self.times[k - 1] != t:
            self.count += 1
            found = self.look(self.times[k - 1], t, self.known[k - 1][0], self.p)
            if not np.isfinite(found[0]).all():
                raise SimulationError(f"At t = {t:.12g} s the algebraic equations have no solution near the last one.")
            self.times.insert(k, t)
            self.known.insert(k, found)
            return found
        return self.known[k - 1]

    def forget(self, t: float) -> None:
        """Forget what is before a time."""
        k = bisect_right(self.times, t) - 1
        del self.times[:k], self.known[:k]


def static_integrate(iteration: EventIteration, look: Look, kink: Callable[[float, float, Floats], float]) -> Integrate:
    """Stretches of a model without states; it is looked at where its inputs have kinks, too.

    Args:
        iteration: carries out its events.
        look: follows its equations.
        kink: (time, end of the stretch, parameters and slots) to the first time behind at which inputs or tables over
            time have a kink.
    """
    hybrid = iteration.hybrid

    def integrate(
        t: float, stop: float, z: Floats, p: Floats, save: Floats, step: float, end_open: bool, steps: int
    ) -> Stretch:
        path = _Path(look, p, [t], [(z, look(t, t, z, p)[1])])
        scan = _conditions(hybrid, iteration.noise, path)
        kept = [np.tile(z, (int((save <= t).sum()) if not (end_open and stop <= t) else 0, 1))]
        n, here = len(kept[0]), t
        while here < stop:
            target = float(min([*save[n : n + 1], kink(here, stop, p), stop]))
            around = scan.first(here, target)
            if around is not None:
                low, high = around
                while (middle := 0.5 * (low + high)) not in (low, high):
                    if scan.switched(scan.beyond(middle)).any():
                        high = middle
                    else:
                        low = middle
                mask = scan.switched(scan.beyond(high))
                rows = np.concatenate(kept)
                return Stretch(rows, EVENT, n, high, path.at(high)[0], 0.0, mask, {"steps": path.count})
            here, z = target, path.at(target)[0]
            path.forget(here)
            if n < len(save) and save[n] <= here and not (end_open and here >= stop):
                m = int((save[n:] <= here).sum())
                kept.append(np.tile(z, (m, 1)))
                n += m
        return Stretch(np.concatenate(kept), 0, n, stop, z, 0.0, None, {"steps": path.count})

    return integrate


def _conditions(hybrid: Hybrid, noise: Floats, path: _Path) -> Scan:
    """Conditions along a path; those at their switch at its start but for rounding have some slack."""
    at_zero, first = modes(hybrid, path.p) == hybrid.roots.strict, path.known[0][1]
    slack = np.where((first > 0.0) | (at_zero & (first == 0.0)), 10.0 * (np.abs(first) + noise) + TINY, 0.0)
    return Scan(lambda t: path.at(t)[1] - slack, at_zero & (slack == 0.0))
