"""Events that accumulate (Zeno): where a `reinit` turns a condition back, and the way back is too short to be resolved.

A bouncing ball leaves its floor after each bounce, by less and less. Once the flight is as high as the rounding of the
height, the floor is not left any more, and the ball would fall through it.
Zhang, Johansson, Lygeros and Sastry (2001), Zeno hybrid systems, Int. J. Robust Nonlinear Control 11.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from .conditions import sides
from .event_iteration import EventIteration, Outcome
from .event_tangents import EventTangents
from .native_library import Floats

NEAR = 1e7
"""A condition is at its switch if it is no further from it than so many times its rounding: it is not set elsewhere."""
SLOW = 1e-6
"""A condition is turned back if it returns at no less than this part of the rate at which it came."""


@dataclass(eq=False)
class TurnedBack:
    """Conditions that have to switch back before anything else happens to them.

    Attributes:
        span: length of the run [s].
        waiting: their numbers, among the roots; how far they may be from their switch without being away from it, and
            at which rates they came.
    """

    iteration: EventIteration
    span: float
    waiting: dict[int, tuple[float, float]] = field(default_factory=dict[int, tuple[float, float]])

    def event(self, t: float, before: tuple[Floats, Floats], after: Outcome, switched: Any) -> None:
        """Note the conditions that have switched and that a `reinit` has turned back.

        Those that wait, and that this event sets elsewhere or turns again, wait no longer.

        Args:
            t: time [s].
            before: z and p up to the event.
            after: what it has led to.
            switched: mask of the roots.
        """
        candidates = self._switched(before, after, switched)
        if not len(candidates) and not self.waiting:
            return
        came, goes = self._rates(t, *before), self._rates(t, after.z, after.p)
        far = np.abs(sides(self.iteration.hybrid, self.iteration.equations, t, after.z, after.p))
        noise = self.iteration.noise
        turns = {k: w for k, w in self.waiting.items() if far[k] <= w[0]}
        turns |= {k: (10.0 * float(far[k] + noise[k]), float(came[k])) for k in candidates.tolist()
                  if far[k] <= NEAR * noise[k]}  # fmt: skip
        self.waiting = {k: w for k, w in turns.items() if goes[k] * w[1] < -SLOW * w[1] ** 2}

    def _switched(self, before: tuple[Floats, Floats], after: Outcome, switched: Any) -> Any:
        """Numbers of the roots that have switched, at an event with a `reinit`."""
        if switched is None or not any(len(rows) for move in self.iteration.moves for rows in move.reinits):
            return np.zeros(0, np.int64)
        slots = self.iteration.hybrid.roots.slots
        held = (slots >= 0) & (after.p[np.maximum(slots, 0)] != before[1][np.maximum(slots, 0)])
        return np.flatnonzero(np.asarray(switched, bool) & held)

    def segment(self, t: float, z: Floats, p: Floats, switched: Any) -> list[int]:
        """Slots of the conditions that are away from their switch at the end of a stretch, and never were beyond it."""
        if not self.waiting:
            return []
        for k in np.flatnonzero(switched).tolist() if switched is not None else ():
            self.waiting.pop(k, None)
        beyond = sides(self.iteration.hybrid, self.iteration.equations, t, z, p)
        missed = [k for k, (slack, _) in self.waiting.items() if beyond[k] < -slack]
        return self.iteration.hybrid.roots.slots[missed].tolist()

    def _rates(self, t: float, z: Floats, p: Floats) -> Floats:
        step = 1e-7 * self.span

        def inputs(at: float) -> Floats:
            now, later = p.copy(), p.copy()
            self.iteration.equations.feed(at, now)
            self.iteration.equations.feed(at + step, later)
            first = self.iteration.hybrid.flat.n_par
            return (later - now)[first : self.iteration.hybrid.first] / step

        return EventTangents(self.iteration, inputs).passing(t, z, p)
