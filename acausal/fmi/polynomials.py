"""Extrapolation and interpolation of signals between communication points.

Source: Busch (2012), Zur effizienten Kopplung von Simulationsprogrammen, ch. 3; Hermite interpolation as in Stoer and
Bulirsch, Introduction to Numerical Analysis, 2.1.5.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence

import numpy as np

from .participant import DEGREE, Floats


class History:
    """The last values of one signal at communication points, with the derivatives that are exchanged.

    Args:
        known: derivatives known at each point (0 to 2).
    """

    def __init__(self, known: int) -> None:
        self.known = known
        self.points: deque[tuple[float, Floats]] = deque(maxlen=DEGREE)

    def add(self, t: float, values: Floats) -> None:
        """Value and derivatives at time t; a second entry for a time replaces the first."""
        entry = values[: self.known + 1].copy()
        if self.points and self.points[-1][0] == t:
            self.points[-1] = (t, entry)
        else:
            self.points.append((t, entry))

    def copy(self) -> History:
        """An independent copy."""
        made = History(self.known)
        made.points.extend(self.points)
        return made

    def extrapolate(self, order: int) -> Floats:
        """Taylor coefficients about the last point: known derivatives, the highest extrapolated with degree `order`.

        Through fewer points than `order` + 1 the degree is as high as they allow.
        """
        m = self.known
        t_last, last = self.points[-1]
        coefficients = np.zeros(DEGREE + 1)
        for j in range(m + 1):
            coefficients[j] = last[j] / math.factorial(j)
        recent = list(self.points)[-(order + 1) :]
        s = [t - t_last for t, _ in recent]
        y = [float(values[m]) for _, values in recent]
        for i, q in enumerate(newton_coefficients(s, y)):
            if 0 < i and i + m <= DEGREE:
                coefficients[i + m] = q * math.factorial(i) / math.factorial(i + m)
        return coefficients


def newton_coefficients(s: Sequence[float], y: Sequence[float]) -> list[float]:
    """Power-series coefficients of the polynomial through the points (s, y), by divided differences."""
    divided = [float(v) for v in y]
    n = len(divided)
    for k in range(1, n):
        for i in range(n - 1, k - 1, -1):
            divided[i] = (divided[i] - divided[i - 1]) / (s[i] - s[i - k])
    coefficients = [0.0] * n
    for k in range(n - 1, -1, -1):
        for i in range(n - 1, 0, -1):
            coefficients[i] = coefficients[i - 1] - s[k] * coefficients[i]
        coefficients[0] = divided[k] - s[k] * coefficients[0]
    return coefficients


def interpolate(h: float, first: Floats, last: Floats, known: int) -> Floats:
    """Coefficients of a signal over a step of length h: linear, or cubic Hermite where slopes are known.

    Args:
        first: value and derivatives at the beginning.
        last: value and derivatives at the end.
        known: number of derivatives to meet (more than one counts as one).
    """
    coefficients = np.zeros(DEGREE + 1)
    rise = last[0] - first[0]
    if known == 0:
        coefficients[:2] = first[0], rise / h
        return coefficients
    d0, d1 = first[1], last[1]
    coefficients[:] = first[0], d0, (3 * rise / h - 2 * d0 - d1) / h, (d0 + d1 - 2 * rise / h) / h**2
    return coefficients
