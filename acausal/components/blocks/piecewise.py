"""Functions of one variable through tabulated points."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np

import acausal as ac
from acausal import DeclarationError, Expr, where

from ...symbolic.expr import as_expr

SMOOTHNESS = ("LinearSegments", "ConstantSegments", "ContinuousDerivative", "ModifiedContinuousDerivative",
              "MonotoneContinuousDerivative1", "MonotoneContinuousDerivative2")  # fmt: skip
EXTRAPOLATION = ("HoldLastPoint", "LastTwoPoints", "Periodic", "NoExtrapolation")
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


def continued(u: Expr, x: Points, pieces: Sequence[Expr], first: Expr, last: Expr) -> Expr:
    """``pieces[k]`` from ``x[k]`` to ``x[k+1]``, `first` below and `last` above; the last point has the last piece."""
    return where(u > x[-1], last, piecewise(u, list(x[:-1]), [first, *pieces]))


def interpolate(
    u: Expr, x: Points, y: Points, smoothness: str = "LinearSegments", extrapolation: str = "LastTwoPoints"
) -> Expr:
    """The function through the points (x, y) at `u`.

    Two points with the same `x` make a jump, at which the second holds. Cubics are Akima's (`ContinuousDerivative`),
    Fritsch and Butland's (`MonotoneContinuousDerivative1`), Steffen's (`MonotoneContinuousDerivative2`) or the modified
    ones of Akima (`ModifiedContinuousDerivative`); the monotone ones begin and end with the slopes between the last two
    points, as in Modelica. `LastTwoPoints` are continued by the line through them, or held where they are a jump;
    cubics by their tangents.

    Raises:
        DeclarationError: x that decrease, or a name that is not known.
    """
    check_points(x, smoothness, extrapolation)
    if len(x) == 1:
        return as_expr(y[0])
    if extrapolation == "Periodic":
        u = wrapped(u, x)
    if extrapolation == "NoExtrapolation":
        extrapolation = "LastTwoPoints"
    if smoothness == "LinearSegments" and len(x) > LONG and all(b > a for a, b in pairwise(x)):
        return _long(u, tuple(x), tuple(y), extrapolation)
    intervals, coefficients = _coefficients(tuple(x), tuple(y), smoothness)
    polynomials = [polynomial(u, *c) for c in coefficients]
    if extrapolation == "HoldLastPoint":
        pieces = [as_expr(y[0]), *polynomials, as_expr(y[-1])]
        return piecewise(u, [x[0], *(b for _, b in intervals)], pieces)
    if extrapolation == "LastTwoPoints" and smoothness not in SMOOTHNESS[:2]:
        ends = [_tangent(u, x[0], coefficients[0]), _tangent(u, x[-1], coefficients[-1])]
        return continued(u, x, polynomials, *ends)
    as_they_are = smoothness == "LinearSegments" and x[0] < x[1] and x[-2] < x[-1]
    if extrapolation == "LastTwoPoints" and not as_they_are:
        pieces = [_line(u, x[:2], y[:2], y[0]), *polynomials, _line(u, x[-2:], y[-2:], y[-1])]
        return piecewise(u, [x[0], *(b for _, b in intervals)], pieces)
    return piecewise(u, [b for _, b in intervals[:-1]], polynomials)


def wrapped(u: Expr, x: Points) -> Expr:
    """`u` less as many periods, from the first to the last of the points, as bring it among them."""
    if x[-1] <= x[0]:
        raise DeclarationError(f"a table that repeats needs two different points, not {list(x)}")
    return x[0] + (u - x[0]) - (x[-1] - x[0]) * ac.floor((u - x[0]) / (x[-1] - x[0]))


def check_points(x: Points, smoothness: str, extrapolation: str) -> None:
    """Raise a DeclarationError for points that decrease, or a name that is not known."""
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
    cubics = _cubics(x, y, smoothness)
    return intervals, [(a, *(float(c) for c in cubics[::-1, i])) for i, a, _ in spans]


def _cubics(x: Points, y: Points, smoothness: str) -> Any:
    """Coefficients of the cubic of each interval, the highest power first: (4, n - 1)."""
    from scipy.interpolate import Akima1DInterpolator, CubicHermiteSpline, PchipInterpolator

    if smoothness.startswith("Monotone"):
        across = np.diff(y) / np.diff(x)
        inner = PchipInterpolator(x, y).derivative()(x) if smoothness[-1] == "1" else _steffen(np.diff(x), across)
        return CubicHermiteSpline(x, y, [across[0], *inner[1:-1], across[-1]]).c
    if len(x) == 2:  # Akima's are straight then
        return np.array([[0.0], [0.0], [(y[1] - y[0]) / (x[1] - x[0])], [y[0]]])
    return Akima1DInterpolator(x, y, method="akima" if smoothness == "ContinuousDerivative" else "makima").c


def _steffen(h: Any, s: Any) -> Any:
    """Slopes of a monotone cubic at its points, from lengths and slopes of the intervals; not at the ends.

    Source: Steffen (1990), Astronomy and Astrophysics 239, equations 8 to 11.
    """
    p = (s[:-1] * h[1:] + s[1:] * h[:-1]) / (h[:-1] + h[1:])
    small = np.minimum(np.minimum(np.abs(s[:-1]), np.abs(s[1:])), np.abs(p) / 2)
    return np.concatenate([s[:1], (np.sign(s[:-1]) + np.sign(s[1:])) * small, s[-1:]])


def polynomial(u: Expr, origin: float, *coefficients: float) -> Expr:
    """The polynomial of ``u - origin`` with these coefficients, the constant first."""
    s = u - origin
    result = as_expr(coefficients[0])
    for power, c in enumerate(coefficients[1:], start=1):
        if c:
            result = result + c * s**power
    return result


def _line(u: Expr, x: Points, y: Points, held: float) -> Expr:
    """The line through two points; the value that is held where they are a jump."""
    return as_expr(held) if x[0] == x[1] else y[0] + (u - x[0]) * ((y[1] - y[0]) / (x[1] - x[0]))


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
