r"""The differentiation index of a small system, from the rank of its derivative array.

The array of order k holds the equations and their derivatives up to the k-th, \(F = 0, F' = 0, ..., F^{(k)} = 0\). The
index is the smallest k for which these determine the derivatives of all variables (Brenan, Campbell and Petzold 1996,
Numerical Solution of Initial-Value Problems in DAEs, definition 2.2.2): the columns of the wanted derivatives must be
independent of each other and of those of higher derivatives (the array is *1-full*, section 2.5).

The structural index is an upper bound. It is too high where an unknown seems to follow from equations that cancel in
it, as in the systems of Reissig, Martinson and Barton (2000).

Ranks are those at points in general position first. Where these say that the index is lower, they are taken again at
points that solve the equations of the array: terms such as ``g(x)^3`` change the rank everywhere but there.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..language.flat_model import Family, FlatModel, canonical
from ..language.template import Floats, Ints
from ..symbolic.differentiate import differentiate
from ..symbolic.expr import ONE, ZERO, Expr, var
from ..symbolic.gradient import Sampler
from ..symbolic.traverse import postorder
from .aliases import Reduced
from .structure import Rows

if TYPE_CHECKING:
    from .singular_blocks import Parameters

LARGEST, LARGEST_EXPRESSIONS = 300, 10_000
"""Rows of the derivative array, and nodes of the expressions in its last derivatives, up to which it is set up."""
POINTS = 2
ITERATIONS, SOLVED = 20, 1e-9
"""Gauss-Newton steps towards a solution, and the residual relative to the slopes that is one."""
ZERO_BELOW, CLEAR_FROM = 1e-12, 1e-8
"""Singular values below the first, relative to the largest, are zero, those above the second are not; between them
nothing is said."""


def differentiation_index(reduced: Reduced, structural: int, parameters: Parameters) -> int:
    """The differentiation index, or the structural one where that is 0 or 1, or the system is too large to say.

    Args:
        reduced: the equations, not differentiated.
        structural: their structural index.
        parameters: draws parameter values.
    """
    count = len(Rows(reduced.families))
    if structural < 2 or count * structural > LARGEST or reduced.rules:
        return structural
    array = _Array(reduced, structural)
    random = np.random.default_rng(1996)
    points = array.points(parameters, random)
    for k in range(structural):
        array.extend()
        if len(postorder([family.residual for family in array.families[-1]])) > LARGEST_EXPRESSIONS:
            return structural
        if array.determines(k, points) is not False:
            break
    else:
        return structural
    for _ in range(k + 1, structural):
        array.extend()
    if not array.solve(points):
        return structural
    return next((order for order in range(k, structural) if array.determines(order, points)), structural)


@dataclass(frozen=True, slots=True, eq=False)
class _Points:
    """Values of all columns (points, columns), of the parameters, and the times."""

    values: Floats
    parameters: Floats
    times: Floats


class _Array:
    """Equations and their derivatives, with columns for all derivatives that can occur in them."""

    def __init__(self, reduced: Reduced, orders: int) -> None:
        self.flat: FlatModel = reduced.flat
        self.families: list[list[Family]] = []  # by how often they have been differentiated
        self.first = reduced.families
        parent = reduced.flat.parent[: len(reduced.unknown)]  # index reduction has added to it
        lowest = np.zeros(0, np.int64)
        ids = np.unique(np.concatenate([lowest, *(f.var_rows.ravel() for f in reduced.families)]))
        wanted: dict[int, int] = {}  # of each variable the order whose value has to follow
        for column in ids.tolist():
            base, order = _base(column, parent)
            wanted[base] = max(wanted.get(base, 1), order)
        declared = np.arange(reduced.flat.n_var)
        stands_for = reduced.representative[declared]
        for column in np.unique(stands_for[(stands_for != declared) & (reduced.sign[declared] != 0)]).tolist():
            base, order = _base(column, parent)
            if order and base in wanted:  # a variable that alias elimination made a name for a derivative
                wanted[base] = max(wanted[base], order + 1)
        derivative_of = [-1] * len(parent)
        for column in np.flatnonzero(parent >= 0).tolist():
            derivative_of[int(parent[column])] = column
        self.lower: list[int] = []
        self.needed: list[int] = []
        self.higher: list[int] = []
        for base, order in wanted.items():
            column = base
            for j in range(order + orders + 1):
                (self.lower if j < order else self.needed if j == order else self.higher).append(column)
                if derivative_of[column] < 0:
                    derivative_of[column] = len(derivative_of)
                    derivative_of.append(-1)
                column = derivative_of[column]
        self.derivative_of: Ints = np.array(derivative_of, np.int64)

    def points(self, parameters: Parameters, random: np.random.Generator) -> _Points:
        """Points in general position near the start values."""
        shape = POINTS, len(self.derivative_of)
        values = random.uniform(0.3, 1.3, shape) * random.choice([-1.0, 1.0], shape)
        start = np.nan_to_num(self.flat.start[: self.flat.n_var])
        near = np.abs(0.1 * values[:, : len(start)])
        values[:, : len(start)] = start + np.maximum(np.abs(start), 1.0) * near
        drawn = np.stack([parameters(random) for _ in range(POINTS)])
        return _Points(values, drawn, random.uniform(0.1, 1.0, POINTS))

    def extend(self) -> None:
        """Differentiate once more."""
        self.families.append([self._derivative(f) for f in self.families[-1]] if self.families else self.first)

    def _derivative(self, family: Family) -> Family:
        k = family.var_rows.shape[1]

        def tangent(leaf: Expr) -> Expr:
            if leaf.op == "var":
                return var(k + leaf.value)
            return ONE if leaf.op == "time" else ZERO

        residual = differentiate((family.residual,), tangent)[0]
        both = np.concatenate([family.var_rows, self.derivative_of[family.var_rows]], axis=1)
        return Family(*canonical(residual, both, family.par_rows), family.source, family.ordinal)

    def solve(self, points: _Points) -> bool:
        """Move points, in place, to where all equations of the array hold: Gauss-Newton steps of least norm."""
        columns = [*self.lower, *self.needed, *self.higher]
        for _ in range(ITERATIONS):
            residuals, matrices = self._linearized(points, columns, len(self.families))
            if not (np.isfinite(residuals).all() and np.isfinite(matrices).all()):
                return False
            size = np.abs(matrices).max(axis=2, initial=0.0)
            size = np.where(size > 0, size, 1.0)
            if (np.abs(residuals) <= SOLVED * size).all():
                return True
            for k in range(POINTS):
                matrix, rest = matrices[k] / size[k][:, None], residuals[k] / size[k]
                points.values[k, columns] -= np.linalg.lstsq(matrix, rest, rcond=1e-11)[0]
        return False

    def determines(self, order: int, points: _Points) -> bool | None:
        """Whether the array up to an order determines the wanted derivatives; None where numbers do not say."""
        _, matrices = self._linearized(points, [*self.needed, *self.higher], order + 1)
        found = [self._is_full(matrix) for matrix in matrices]
        return None if None in found else all(found)

    def _is_full(self, matrix: Floats) -> bool | None:
        """Whether the first columns, of the wanted derivatives, are independent of each other and of the others."""
        if not np.isfinite(matrix).all():
            return None
        for axis in (1, 0, 1):
            size = np.abs(matrix).max(axis=axis, keepdims=True, initial=0.0)
            matrix = matrix / np.where(size > 0, size, 1.0)
        wanted, others = np.split(matrix, [len(self.needed)], axis=1)
        left, sigma, _ = np.linalg.svd(others)
        sigma = np.concatenate([sigma, np.zeros(len(left) - len(sigma))])
        rank = _rank(sigma)
        if rank is None:
            return None
        free = left[:, rank:].T @ wanted  # what the array says of the wanted derivatives alone
        if len(free) < len(self.needed):
            return False
        rank = _rank(np.concatenate([[1.0], np.linalg.svd(free, compute_uv=False)]))
        return None if rank is None else rank == 1 + len(self.needed)

    def _linearized(self, points: _Points, columns: list[int], levels: int) -> tuple[Floats, Floats]:
        """Residuals (points, rows) and Jacobians (points, rows, columns) of the first levels."""
        place = np.full(len(self.derivative_of), -1, np.int64)
        place[columns] = np.arange(len(columns))
        parts = [self._family(f, points, place, len(columns)) for level in self.families[:levels] for f in level]
        residuals, matrices = zip(*parts, strict=True)
        return np.concatenate(residuals, axis=1), np.concatenate(matrices, axis=1)

    def _family(self, family: Family, points: _Points, place: Ints, n_columns: int) -> tuple[Floats, Floats]:
        """Residuals and Jacobians of one family."""

        def leaf(node: Expr) -> Floats:
            if node.op == "time":
                return points.times[:, None]
            if node.op == "par":
                return points.parameters[:, family.par_rows[:, node.value]]
            return points.values[:, family.var_rows[:, node.value]]

        sampler, row = Sampler(leaf, lambda: True, lambda: 1.0), np.arange(family.size)
        value = np.broadcast_to(sampler.values((family.residual,))[0], (POINTS, family.size))
        out = np.zeros((POINTS, family.size, n_columns))
        for node, slope in sampler.gradient(family.residual).items():
            if node.op == "var":
                at = place[family.var_rows[:, node.value]]
                kept = at >= 0
                out[:, row[kept], at[kept]] += np.broadcast_to(slope, out.shape[:2])[:, kept]
        return value, out


def _base(column: int, parent: Ints) -> tuple[int, int]:
    """The variable that a column is a derivative of, and which one."""
    order = 0
    while parent[column] >= 0:
        column, order = int(parent[column]), order + 1
    return column, order


def _rank(sigma: Floats) -> int | None:
    """Number of singular values that are not zero, None if that is unclear."""
    largest = sigma.max(initial=0.0)
    if ((sigma > ZERO_BELOW * largest) & (sigma < CLEAR_FROM * largest)).any():
        return None
    return int((sigma >= CLEAR_FROM * largest).sum()) if largest else 0
