"""Functions of one and two variables through tabulated points."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from itertools import pairwise

import acausal as ac
from acausal import DeclarationError, Expr, where

from ...symbolic.expr import as_expr

SMOOTHNESS = ("LinearSegments", "ConstantSegments", "ContinuousDerivative", "MonotoneContinuousDerivative1")
EXTRAPOLATION = ("HoldLastPoint", "LastTwoPoints", "Periodic")
LONG = 40
"""Points from which on a linear table is one interpolation instead of nested conditions."""

Points = Sequence[float]


def piecewise(u: Expr, breaks: Points, pieces: Sequence[Expr]) -> Expr:
    """``pieces[k]`` where ``breaks[k-1] <= u < breaks[k]``; one piece more than breaks."""
    if not breaks:
        return pieces[0]
    middle = len(breaks) // 2
    low = piecewise(u, breaks[:middle], pieces[: middle + 1])
    high = piecewise(u, breaks[middle + 1 :], pieces[middle + 1 :])
    return where(u < breaks[middle], low, high)


def interpolate(
    u: Expr, x: Points, y: Points, smoothness: str = "LinearSegments", extrapolation: str = "LastTwoPoints"
) -> Expr:
    """The function through the points (x, y) at `u`.

    Two points with the same `x` make a jump, at which the second holds. Cubics are Akima's (`ContinuousDerivative`) or
    Fritsch and Butland's (`MonotoneContinuousDerivative1`).

    Raises:
        DeclarationError: x that decrease, or a name that is not known.
    """
    _check(x, smoothness, extrapolation)
    if len(x) == 1:
        return as_expr(y[0])
    if extrapolation == "Periodic":
        u = x[0] + (u - x[0]) - (x[-1] - x[0]) * ac.floor((u - x[0]) / (x[-1] - x[0]))
    if smoothness == "LinearSegments" and len(x) > LONG and all(b > a for a, b in pairwise(x)):
        return _long(u, tuple(x), tuple(y), extrapolation)
    intervals, coefficients = _coefficients(tuple(x), tuple(y), smoothness)
    if extrapolation == "HoldLastPoint":
        pieces = [as_expr(y[0]), *(_polynomial(u, *c) for c in coefficients), as_expr(y[-1])]
        return piecewise(u, [x[0], *(b for _, b in intervals)], pieces)
    if smoothness != "LinearSegments" and extrapolation == "LastTwoPoints":
        first, last = (_tangent(u, x[0], coefficients[0]), _tangent(u, x[-1], coefficients[-1]))
        pieces = [first, *(_polynomial(u, *c) for c in coefficients), last]
        return piecewise(u, [x[0], *(b for _, b in intervals)], pieces)
    return piecewise(u, [b for _, b in intervals[:-1]], [_polynomial(u, *c) for c in coefficients])


def interpolate2(u1: Expr, u2: Expr, rows: Points, columns: Points, values: Sequence[Points]) -> Expr:
    """Bilinear interpolation: ``values[i][j]`` at ``(rows[i], columns[j])``, the last cells continued outside."""
    along = [interpolate(u1, rows, [line[j] for line in values]) for j in range(len(columns))]
    if len(columns) == 1:
        return along[0]
    pieces = [
        a + (b - a) * ((u2 - left) / (right - left))
        for (a, b), (left, right) in zip(pairwise(along), pairwise(columns), strict=True)
    ]
    return piecewise(u2, list(columns[1:-1]), pieces)


def _check(x: Points, smoothness: str, extrapolation: str) -> None:
    if smoothness not in SMOOTHNESS:
        raise DeclarationError(f"smoothness={smoothness!r} is not one of {', '.join(SMOOTHNESS)}")
    if extrapolation not in EXTRAPOLATION:
        raise DeclarationError(f"extrapolation={extrapolation!r} is not one of {', '.join(EXTRAPOLATION)}")
    if not x or any(b < a for a, b in pairwise(x)):
        raise DeclarationError(f"a table needs points whose first coordinate increases, not {list(x)}")


@cache
def _coefficients(
    x: tuple[float, ...], y: tuple[float, ...], smoothness: str
) -> tuple[list[tuple[float, float]], list[tuple[float, ...]]]:
    """Intervals of positive length, and of each (origin, value, slope, second, third coefficient)."""
    spans = [(i, a, b) for i, (a, b) in enumerate(pairwise(x)) if b > a]
    intervals = [(a, b) for _, a, b in spans]
    if smoothness == "ConstantSegments":
        return intervals, [(a, y[i], 0.0, 0.0, 0.0) for i, a, _ in spans]
    if smoothness == "LinearSegments":
        return intervals, [(a, y[i], (y[i + 1] - y[i]) / (b - a), 0.0, 0.0) for i, a, b in spans]
    from scipy.interpolate import Akima1DInterpolator, PchipInterpolator

    spline = (Akima1DInterpolator if smoothness == "ContinuousDerivative" else PchipInterpolator)(x, y)
    return intervals, [(a, *(float(c) for c in spline.c[::-1, i])) for i, a, _ in spans]


def _polynomial(u: Expr, origin: float, *coefficients: float) -> Expr:
    s = u - origin
    result = as_expr(coefficients[0])
    for power, c in enumerate(coefficients[1:], start=1):
        if c:
            result = result + c * s**power
    return result


def _tangent(u: Expr, at: float, coefficients: tuple[float, ...]) -> Expr:
    origin, *c = coefficients
    s = at - origin
    value = sum(k * s**i for i, k in enumerate(c))
    slope = sum(i * k * s ** (i - 1) for i, k in enumerate(c) if i)
    return value + slope * (u - at)


@cache
def _table(x: tuple[float, ...], y: tuple[float, ...]) -> Callable[[Expr], Expr]:
    """The one piecewise linear function through these points, so that equal tables are one function."""
    return ac.table(x, y)


def _long(u: Expr, x: tuple[float, ...], y: tuple[float, ...], extrapolation: str) -> Expr:
    value = _table(x, y)(u)
    if extrapolation == "HoldLastPoint":
        return value
    first, last = (y[1] - y[0]) / (x[1] - x[0]), (y[-1] - y[-2]) / (x[-1] - x[-2])
    return value + first * ac.min(u - x[0], 0.0) + last * ac.max(u - x[-1], 0.0)
