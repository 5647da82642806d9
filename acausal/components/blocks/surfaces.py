"""Functions of two variables through a grid of points."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import acausal as ac
from acausal import DeclarationError, Expr, where

from .akima_surface import akima_surface
from .piecewise import SMOOTHNESS, Points, check_points, interpolate, piecewise, wrapped

SURFACES = SMOOTHNESS[:3]
"""Kinds that there are in two dimensions."""


def interpolate2(
    u1: Expr, u2: Expr, rows: Points, columns: Points, values: Sequence[Points], smoothness: str = "LinearSegments",
    extrapolation: str = "LastTwoPoints",
) -> Expr:  # fmt: skip
    """The function with ``values[i][j]`` at ``(rows[i], columns[j])``, at (u1, u2).

    It is bilinear, the value at the lower left corner, or Akima's surface. Values at corners, too, are continued by
    bilinear functions (`LastTwoPoints`).

    Raises:
        DeclarationError: points that decrease, or a name that is not known here.
    """
    for points in (rows, columns):
        check_points(points, smoothness, extrapolation)
    if smoothness not in SURFACES:
        raise DeclarationError(f"smoothness={smoothness!r}: a table over two signals has {' or '.join(SURFACES)}")
    if extrapolation == "HoldLastPoint":
        u1, u2 = ac.clip(u1, rows[0], rows[-1]), ac.clip(u2, columns[0], columns[-1])
    if extrapolation == "Periodic":
        u1, u2 = wrapped(u1, rows), wrapped(u2, columns)
    if smoothness == "ContinuousDerivative":
        return _smooth(u1, u2, rows, columns, values)
    if smoothness == "LinearSegments":
        return _bilinear(u1, u2, rows, columns, values)
    lines = [
        interpolate(u1, rows, [line[j] for line in values], smoothness, "HoldLastPoint") for j in range(len(columns))
    ]
    corner = piecewise(u2, list(columns[1:]), lines)
    if extrapolation != "LastTwoPoints":
        return corner
    inside = (u1 >= rows[0]) & (u1 <= rows[-1]) & (u2 >= columns[0]) & (u2 <= columns[-1])
    return where(inside, corner, _bilinear(u1, u2, rows, columns, values))


def _bilinear(u1: Expr, u2: Expr, rows: Points, columns: Points, values: Sequence[Points]) -> Expr:
    along = [interpolate(u1, rows, [line[j] for line in values]) for j in range(len(columns))]
    if len(columns) == 1:
        return along[0]
    pieces = [
        a + (b - a) * ((u2 - left) / (right - left))
        for (a, b), (left, right) in zip(pairwise(along), pairwise(columns), strict=True)
    ]
    return piecewise(u2, list(columns[1:-1]), pieces)


def _smooth(u1: Expr, u2: Expr, rows: Points, columns: Points, values: Sequence[Points]) -> Expr:
    if len(rows) == 1:
        return interpolate(u2, columns, values[0], "ContinuousDerivative")
    if len(columns) == 1:
        return interpolate(u1, rows, [line[0] for line in values], "ContinuousDerivative")
    return akima_surface(u1, u2, rows, columns, values)
