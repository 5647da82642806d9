"""Stretches between events for models without states: the equations are followed from one output time to the next, and
the first switch between two of them is found by looking at the conditions closely enough, and by bisection."""

from __future__ import annotations

from bisect import bisect_right
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
from .scan import Scan

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


@dataclass(eq=False)
class _Path:
    """Solutions of the equations of a stretch along time, with its modes.

    Attributes:
        equations: as an engine evaluates them.
        nominal: sizes of the unknowns.
        p: parameters and slots.
        times, solutions: those that are known, in order.
        count: how many have been asked for.
    """

    equations: Equations
    nominal: Floats
    p: Floats
    times: list[float]
    solutions: list[Floats]
    count: int = 0

    def at(self, t: float) -> Floats:
        """The solution at a time, followed from the nearest one before it."""
        k = bisect_right(self.times, t)
        if self.times[k - 1] != t:
            self.count += 1
            z = self._followed(self.times[k - 1], t, self.solutions[k - 1])
            self.times.insert(k, t)
            self.solutions.insert(k, z)
            return z
        return self.solutions[k - 1]

    def forget(self, t: float) -> None:
        """Forget what is before a time."""
        k = bisect_right(self.times, t) - 1
        del self.times[:k], self.solutions[:k]

    def _attempt(self, t: float, z: Floats) -> Floats | None:
        p = self.p.copy()
        self.equations.feed(t, p)
        return self.equations.settle(t, z, p)

    def _followed(self, begin: float, t: float, z: Floats) -> Floats:
        """From z at `begin`, along the tangent, in steps that the corrector follows with a small move."""
        here, h, found = begin, t - begin, z
        while here < t:
            h = min(h, t - here)
            beside = self._attempt(here + TANGENT * h, z)
            ahead = z if beside is None else z + (beside - z) / TANGENT
            found = self._attempt(here + h, ahead)
            last = h <= SMALLEST * (t - begin)
            if found is None and last:
                break
            near = found is not None and np.all(np.abs(found - ahead) <= MOVED * np.maximum(self.nominal, np.abs(z)))
            if found is not None and (near or last):
                here, z, h = (t if here + h >= t else here + h), found, 2.0 * h
            else:
                h *= 0.5
        if found is None:
            raise SimulationError(f"At t = {t:.12g} s the algebraic equations have no solution near the last one.")
        return found


def static_integrate(hybrid: Hybrid, equations: Equations, nominal: Floats) -> Integrate:
    """Stretches of a model without states, whose unknowns have the sizes `nominal`."""

    def integrate(
        t: float, stop: float, z: Floats, p: Floats, save: Floats, step: float, end_open: bool, steps: int
    ) -> Stretch:
        path = _Path(equations, nominal, p, [t], [z])
        scan = _conditions(hybrid, path)
        kept = [np.tile(z, (int((save <= t).sum()) if not (end_open and stop <= t) else 0, 1))]
        n, here = len(kept[0]), t
        while here < stop:
            target = float(min(save[n], stop)) if n < len(save) else stop
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
                return Stretch(rows, EVENT, n, high, path.at(high), 0.0, mask, {"steps": path.count})
            here, z = target, path.at(target)
            path.forget(here)
            if n < len(save) and save[n] <= here and not (end_open and here >= stop):
                m = int((save[n:] <= here).sum())
                kept.append(np.tile(z, (m, 1)))
                n += m
        return Stretch(np.concatenate(kept), 0, n, stop, z, 0.0, None, {"steps": path.count})

    return integrate


def _conditions(hybrid: Hybrid, path: _Path) -> Scan:
    """Conditions along a path; those at their switch at its start but for rounding have some slack."""
    equations, p = path.equations, path.p
    at_zero = modes(hybrid, p) == hybrid.roots.strict
    first = sides(hybrid, equations, path.times[0], path.solutions[0], p)
    slack = np.where((first > 0.0) | (at_zero & (first == 0.0)), 10.0 * np.abs(first) + 1e-12, 0.0)

    def beyond(t: float) -> Floats:
        return sides(hybrid, equations, t, path.at(t), p) - slack

    return Scan(beyond, at_zero & (slack == 0.0))
