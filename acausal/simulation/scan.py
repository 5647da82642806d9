"""The first switch within a stretch, for conditions that are known at single times only.

As `acausal/lowering/c/runtime/scan.h`: the conditions are looked at in intervals over which a cubic through four of
their values tells others; intervals where it does not, and where it matters, are halved. Shampine, Gladwell and Brankin
(1991), Reliable solution of special event location problems for ODEs, ACM TOMS 17(1).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from .native_library import Floats

LOOKS = np.array([0.0, 0.2329173741, 0.5131842019, 0.7874513277, 1.0])
"""Where in an interval conditions are looked at: not evenly and at no simple fractions, so as not to fall in step with
a swing."""
FURTHER = 0.3719042273, 0.6527719033, 0.1136592107, 0.9023316619
"""Where else, if a condition is within reach of its switch."""
NODES = [0, 1, 3, 4]
CUBIC = np.linalg.inv(np.vander(LOOKS[NODES], 4, increasing=True))
TRUST = 4.0
"""The cubic may be wrong by so many times what it is wrong by where it is compared."""
FAR = 10.0
"""A condition is out of reach if it is so many times its variation away from its switch."""
EPS = float(np.finfo(float).eps)
NARROWEST = 1e-6
"""Intervals are halved to this part of the stretch; a rest that is shorter is taken along with what is before it."""
ROUNDING = 1e-13


@dataclass(frozen=True, slots=True, eq=False)
class Scan:
    """Conditions over time.

    Attributes:
        beyond: how far each condition is behind its switch at a time, (n,).
        at_zero: (n,) whether it has switched at 0 already.
    """

    beyond: Callable[[float], Floats]
    at_zero: Any

    def switched(self, values: Floats) -> Any:
        """Which conditions have switched."""
        return (values > 0.0) | (self.at_zero & (values == 0.0))

    def first(self, begin: float, end: float) -> tuple[float, float] | None:
        """Two times around the first switch in (begin, end]; None if there is none."""
        here, width, start = begin, end - begin, self.beyond(begin)
        narrowest = max(NARROWEST * width, 4.0 * EPS * max(abs(begin), abs(end)))  # times can be told apart
        while here < end:
            last = here + width >= end - narrowest
            span = end - here if last else width
            times = here + LOOKS * span
            times[-1] = end if last else times[-1]
            values = np.array([start, *(self.beyond(t) for t in times[1:].tolist())])
            peak = self._peak(here, span, values)
            if peak is None and span > 2.0 * narrowest:
                width = 0.5 * span
                continue
            on = self.switched(values).any(axis=1)
            seen = int(np.argmax(on[1:])) + 1 if on[1:].any() else len(LOOKS)
            if peak is not None and peak < (LOOKS[seen] if seen < len(LOOKS) else 1.0):
                top = here + peak * span
                if self.switched(self.beyond(top)).any():
                    return float(times[np.searchsorted(times, top) - 1]), top
                if span > 2.0 * narrowest:
                    width = 0.5 * span
                    continue
            if seen < len(LOOKS):
                return float(times[seen - 1]), float(times[seen])
            here, width, start = float(times[-1]), 2.0 * span, values[-1]
        return None

    def _peak(self, begin: float, span: float, values: Floats) -> float | None:
        """The earliest place of the interval where a condition may switch there and back between two values, 2 for
        none; None where the values do not tell what happens."""
        a = CUBIC @ values[NODES]
        most, extent = values.max(axis=0), np.ptp(values, axis=0)
        x = _top(a)
        height = np.where(x > 0.0, np.maximum(most, _of(a, x)), most)

        def tells(place: float, found: Floats) -> bool:
            error = TRUST * np.abs(found - _of(a, place))
            matters = np.where(most >= 0.0, error > 0.1 * extent, height + error > 0.0)
            return not (matters & (error > ROUNDING * extent)).any()

        if not np.isfinite(values).all() or not tells(float(LOOKS[2]), values[2]):
            return None
        if (most + FAR * extent > 0.0).any():
            for place in FURTHER:
                if not tells(place, self.beyond(begin + place * span)):
                    return None
        return float(np.where((most < 0.0) & (height >= 0.0), x, 2.0).min(initial=2.0))


def _of(a: Floats, x: Any) -> Any:
    """The cubics with coefficients a (4, n) at x."""
    return a[0] + x * (a[1] + x * (a[2] + x * a[3]))


def _top(a: Floats) -> Floats:
    """Where in (0, 1) each cubic is largest, -1 for those that are largest at an end; (n,)."""
    with np.errstate(all="ignore"):
        square = a[2] ** 2 - 3.0 * a[3] * a[1]
        root = np.sqrt(square)
        x = np.where(a[2] > 0.0, (-a[2] - root) / (3.0 * a[3]), a[1] / (root - a[2]))
        inside = (square > 0.0) & (x > 0.0) & (x < 1.0)
        x = np.where(inside, x, 0.5)
        height = _of(a, x)
    return np.where(inside & (height > a[0]) & (height > _of(a, 1.0)), x, -1.0)
