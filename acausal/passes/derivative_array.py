r"""The differentiation index of a small system, from the rank of its derivative array.

The array of order k holds the equations and their derivatives up to the k-th, \(F = 0, F' = 0, ..., F^{(k)} = 0\). The
index is the smallest k for which these determine the derivatives of all variables (Brenan, Campbell and Petzold 1996,
Numerical Solution of Initial-Value Problems in DAEs, definition 2.2.2): the columns of the wanted derivatives must be
independent of each other and of those of higher derivatives (the array is *1-full*, section 2.5).

The structural index is an upper bound. It is too high where an unknown seems to follow from equations that cancel in
it, as in the systems of Reissig, Martinson and Barton (2000). Ranks are those at points in general position, not at
solutions.
"""

from __future__ import annotations

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
    points = tuple(map(np.array, zip(*(array.point(parameters(random), random) for _ in range(POINTS)), strict=True)))
    known: list[Floats] = []
    for k in range(structural):
        array.extend()
        if len(postorder([family.residual for family in array.families])) > LARGEST_EXPRESSIONS:
            return structural
        known += [array.slopes(family, *points) for family in array.families]
        found = [array.determines(matrix) for matrix in np.concatenate(known, axis=1)]
        if None in found:
            return structural
        if all(found):
            return k
    return structural


class _Array:
    """Equations and their derivatives, with columns for all derivatives that can occur in them."""

    def __init__(self, reduced: Reduced, orders: int) -> None:
        self.flat: FlatModel = reduced.flat
        self.families: list[Family] = []  # the highest derivatives so far
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
        self.needed: list[int] = []
        self.higher: list[int] = []
        for base, order in wanted.items():
            column = base
            for j in range(order + orders + 1):
                if j == order:
                    self.needed.append(column)
                elif j > order:
                    self.higher.append(column)
                if derivative_of[column] < 0:
                    derivative_of[column] = len(derivative_of)
                    derivative_of.append(-1)
                column = derivative_of[column]
        self.derivative_of: Ints = np.array(derivative_of, np.int64)

    def point(self, parameters: Floats, random: np.random.Generator) -> tuple[Floats, Floats, float]:
        """Values of all columns near the start values, of the parameters, and a time."""
        values = random.uniform(0.3, 1.3, len(self.derivative_of)) * random.choice([-1.0, 1.0], len(self.derivative_of))
        start = np.nan_to_num(self.flat.start[: self.flat.n_var])
        values[: len(start)] = start + np.maximum(np.abs(start), 1.0) * np.abs(0.1 * values[: len(start)])
        return values, parameters, float(random.uniform(0.1, 1.0))

    def extend(self) -> None:
        """Differentiate once more."""
        self.families = [self._derivative(f) for f in self.families] if self.families else self.first

    def _derivative(self, family: Family) -> Family:
        k = family.var_rows.shape[1]

        def tangent(leaf: Expr) -> Expr:
            if leaf.op == "var":
                return var(k + leaf.value)
            return ONE if leaf.op == "time" else ZERO

        residual = differentiate((family.residual,), tangent)[0]
        both = np.concatenate([family.var_rows, self.derivative_of[family.var_rows]], axis=1)
        return Family(*canonical(residual, both, family.par_rows), family.source, family.ordinal)

    def determines(self, matrix: Floats) -> bool | None:
        """Whether the array, of these slopes, determines the wanted derivatives; None where numbers do not say."""
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

    def slopes(self, family: Family, values: Floats, parameters: Floats, time: Floats) -> Floats:
        """Jacobians of a family with respect to the wanted and the higher derivatives: (points, rows, columns)."""

        def leaf(node: Expr) -> Floats:
            if node.op == "time":
                return time[:, None]
            if node.op == "par":
                return parameters[:, family.par_rows[:, node.value]]
            return values[:, family.var_rows[:, node.value]]

        place = np.full(len(self.derivative_of), -1, np.int64)
        place[[*self.needed, *self.higher]] = np.arange(len(self.needed) + len(self.higher))
        out, row = np.zeros((len(time), family.size, len(self.needed) + len(self.higher))), np.arange(family.size)
        for node, slope in Sampler(leaf, lambda: True, lambda: 1.0).gradient(family.residual).items():
            if node.op == "var":
                at = place[family.var_rows[:, node.value]]
                kept = at >= 0
                out[:, row[kept], at[kept]] += np.broadcast_to(slope, out.shape[:2])[:, kept]
        return out


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
