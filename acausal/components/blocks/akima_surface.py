"""The smooth surface through a grid of points: Akima (1974), Communications of the ACM 17, pages 18 to 20."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from acausal import Expr

from ...symbolic.expr import as_expr
from .piecewise import Points, continued, polynomial


def akima_surface(u1: Expr, u2: Expr, rows: Points, columns: Points, values: Sequence[Points]) -> Expr:
    """The surface ``values[i][j]`` at ``(rows[i], columns[j])``, at least two of each, continued by its tangents.

    Between the points it is cubic in either direction. Its slopes at them follow, in each direction, from the two
    intervals on either side, the steadier of which count more.
    """
    x, y, z = (np.asarray(p, float) for p in (rows, columns, values))
    along_x, along_y, twist = _slopes(x, y, z)
    heights = [_hermite(u1, x, z[:, j], along_x[:, j]) for j in range(len(y))]
    inclines = [_hermite(u1, x, along_y[:, j], twist[:, j]) for j in range(len(y))]
    strips: list[Expr] = []
    for j, length in enumerate(np.diff(y).tolist()):
        mean = (heights[j + 1] - heights[j]) / length
        second = (3 * mean - 2 * inclines[j] - inclines[j + 1]) / length
        third = (inclines[j] + inclines[j + 1] - 2 * mean) / length**2
        s = u2 - float(y[j])
        strips.append(heights[j] + s * (inclines[j] + s * (second + s * third)))
    first, last = (heights[k] + inclines[k] * (u2 - float(y[k])) for k in (0, -1))
    return continued(u2, y.tolist(), strips, first, last)


def _hermite(u: Expr, x: Any, f: Any, slopes: Any) -> Expr:
    """Cubics with these values and slopes at the points, continued by tangents."""
    from scipy.interpolate import CubicHermiteSpline

    cubics = CubicHermiteSpline(x, f, slopes).c[::-1]
    inner = [polynomial(u, float(a), *cubics[:, i].tolist()) for i, a in enumerate(x[:-1])]
    ends = [as_expr(float(f[k])) + float(slopes[k]) * (u - float(x[k])) for k in (0, -1)]
    return continued(u, x.tolist(), inner, *ends)


def _slopes(x: Any, y: Any, z: Any) -> tuple[Any, Any, Any]:
    """Slopes along x and y, and the mixed derivative, at the points (n, m)."""
    x, y = _beyond(x), _beyond(y)
    z = _continued(x, _continued(y, z.T).T)
    h, k = np.diff(x)[:, None], np.diff(y)[None, :]
    left, right, along_x = _weighted(np.diff(z[:, 2:-2], axis=0) / h)
    low, high, along_y = (part.T for part in _weighted((np.diff(z[2:-2], axis=1) / k).T))
    twists = np.diff(np.diff(z, axis=0), axis=1) / (h * k)
    below = left * twists[1:-2, 1:-2] + right * twists[2:-1, 1:-2]
    above = left * twists[1:-2, 2:-1] + right * twists[2:-1, 2:-1]
    return along_x, along_y, (low * below + high * above) / ((left + right) * (low + high))


def _weighted(s: Any) -> tuple[Any, Any, Any]:
    """Weights of the intervals before and after each point, and its slope, from the slopes of intervals."""
    before, after = np.abs(s[3:] - s[2:-1]), np.abs(s[1:-2] - s[:-3])
    neither = (before == 0) & (after == 0)
    before, after = np.where(neither, 1.0, before), np.where(neither, 1.0, after)
    return before, after, (before * s[1:-2] + after * s[2:-1]) / (before + after)


def _beyond(x: Any) -> Any:
    """The points with two more at each end."""
    if len(x) == 2:
        return x[0] + (x[1] - x[0]) * np.arange(-2.0, 4.0)
    first, last = [2 * x[0] - x[2], x[0] + x[1] - x[2]], [x[-1] + x[-2] - x[-3], 2 * x[-1] - x[-3]]
    return np.concatenate([first, x, last])


def _continued(x: Any, z: Any) -> Any:
    """Values at the points and at two more at each end, on a parabola through the last three (Akima 1970)."""
    h = np.diff(x)[:, None]
    s = np.diff(z, axis=0) / h[2:-2]
    bends = (s[1] - s[0], s[-1] - s[-2]) if len(s) > 1 else (0.0, 0.0)
    first = z[0] - h[1] * (s[0] - bends[0])
    last = z[-1] + h[-2] * (s[-1] + bends[1])
    outer = first - h[0] * (s[0] - 2 * bends[0]), last + h[-1] * (s[-1] + 2 * bends[1])
    return np.vstack([outer[0], first, z, last, outer[1]])
