"""LU factors of W = d M - J with a fixed pattern: order and fill are found once, numbers at every step.

The order reduces fill (minimum degree on the pattern of A + A^T, as SuperLU finds it). Pivots are fixed by a matching
of rows and columns; the runtime checks them and pivots freely where they are too small.
Source: Davis (2006), Direct Methods for Sparse Linear Systems, ch. 6 and 7.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import maximum_bipartite_matching, min_weight_full_bipartite_matching
from scipy.sparse.linalg import splu

from ...language.template import Floats, Ints


class SingularPattern(Exception):
    """The entries of the algebraic equations have no matching.

    Attributes:
        rows, columns: equations and algebraic unknowns that are left over.
    """

    def __init__(self, rows: list[int], columns: list[int]) -> None:
        super().__init__("the algebraic equations are structurally singular")
        self.rows, self.columns = rows, columns


UNROLLED = 3000
"""Multiplications of a factorisation up to which it is written out."""


@dataclass(eq=False)
class Factorisation:
    """Pattern of the factors.

    Attributes:
        n: number of unknowns.
        rows, columns: pivot k is in row `rows[k]` and column `columns[k]` of W.
        entry: for each entry of the factors, in row order of the permuted matrix, its position in the values of J
            (-1: fill, or the diagonal of M only).
        indptr, indices: pattern of L + U of the permuted matrix, columns increasing in each row.
        on_mass: for each entry, whether it is on the diagonal of M.
    """

    n: int
    rows: Ints
    columns: Ints
    indptr: Ints
    indices: Ints
    entry: Ints
    on_mass: Any

    @cached_property
    def diagonal(self) -> Ints:
        """Position of each row's pivot among the entries."""
        row = np.repeat(np.arange(self.n), np.diff(self.indptr))
        return np.flatnonzero(row == self.indices)

    @cached_property
    def operations(self) -> int:
        """Multiplications of one factorisation."""
        upper = self.indptr[1:] - self.diagonal - 1
        row = np.repeat(np.arange(self.n), np.diff(self.indptr))
        below = self.indices < row
        return int((upper[self.indices[below]] + 1).sum())

    @property
    def size(self) -> int:
        """Numbers that the factors hold: the entries, and the inverse pivots."""
        return len(self.indices) + self.n


def plan_factors(pattern: Any, mass: Any, weights: Floats | None = None) -> Factorisation:
    """Order and fill of W = d M - J.

    Args:
        pattern: CSR of J, (n, n); its `data` are the positions of the values.
        mass: mask (n,) of the rows with a derivative.
        weights: size of each value of J, where it is known, for the choice of pivots.
    """
    n = len(mass)
    partner = _matching(pattern, mass, weights)
    coo = pattern.tocoo()
    where = np.flatnonzero(mass)
    rows = np.concatenate([coo.row, where])
    columns = np.concatenate([coo.col, where])
    row_of = np.empty(n, np.int64)
    row_of[partner] = np.arange(n)  # column c has its pivot in row row_of[c]
    new_row = partner[rows]  # renumbered so that pivots are on the diagonal
    full = sparse.csc_matrix((np.ones(len(rows)), (new_row, columns)), shape=(n, n))
    order = _order(full)
    position = np.empty(n, np.int64)
    position[order] = np.arange(n)
    indptr, indices = _fill(full, order)
    keys = np.repeat(np.arange(n), np.diff(indptr)) * n + indices
    entry = np.full(len(indices), -1)
    entry[np.searchsorted(keys, position[partner[coo.row]] * n + position[coo.col])] = coo.data
    on_mass = np.zeros(len(indices), bool)
    on_mass[np.searchsorted(keys, position[where] * n + position[where])] = True
    return Factorisation(n, row_of[order], order, indptr, indices, entry, on_mass)


def _matching(pattern: Any, mass: Any, weights: Floats | None) -> Ints:
    """For each row the column of its pivot: its own for rows with a derivative."""
    n = len(mass)
    partner = np.arange(n)
    rest = np.flatnonzero(~np.asarray(mass))
    if not len(rest):
        return partner
    block = pattern[rest][:, rest].tocoo()
    if weights is not None:
        size = np.abs(weights[block.data.astype(int)])
        good = np.isfinite(size) & (size > 0)
        cost = np.log(size[good])
        cost = cost.max(initial=0.0) - cost + 1.0
        graph = sparse.csr_matrix((cost, (block.row[good], block.col[good])), shape=block.shape)
        try:
            found_rows, found = min_weight_full_bipartite_matching(graph)
            partner[rest[found_rows]] = rest[found]
            return partner
        except ValueError:
            pass
    graph = sparse.csr_matrix((np.ones(block.nnz), (block.row, block.col)), shape=block.shape)
    found = maximum_bipartite_matching(graph, perm_type="column")
    if (found < 0).any():
        left = np.setdiff1d(np.arange(len(rest)), found[found >= 0])
        raise SingularPattern(rest[found < 0].tolist(), rest[left].tolist())
    partner[rest] = rest[found]
    return partner


def _dominant(full: Any) -> Any:
    """A matrix of the same pattern whose pivots can stay on the diagonal and where nothing cancels."""
    random = np.random.default_rng(0)
    matrix = full.copy()
    matrix.data = random.uniform(0.5, 1.0, matrix.nnz)
    rows = np.asarray(abs(matrix).sum(axis=1)).ravel() + np.asarray(abs(matrix).sum(axis=0)).ravel()
    return (matrix + sparse.diags(rows + 1.0)).tocsc()


def _order(full: Any) -> Ints:
    """Columns in the order of elimination."""
    lu = splu(_dominant(full), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
    return np.argsort(np.asarray(lu.perm_c, np.int64))


def _fill(full: Any, order: Ints) -> tuple[Ints, Ints]:
    """Pattern of L + U for this order, by rows."""
    permuted = _dominant(full)[order][:, order].tocsc()
    lu = splu(permuted, permc_spec="NATURAL", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
    assert (lu.perm_r == np.arange(len(order))).all()
    assert (lu.perm_c == np.arange(len(order))).all()
    both = (abs(lu.L) + abs(lu.U)).tocsr()
    both.sort_indices()
    return both.indptr.astype(np.int64), both.indices.astype(np.int64)


def factor_lines(plan: Factorisation, scale: Floats) -> list[str]:
    """Body of ``int ac_factor(double d, const double *J, double *F)``: 0, or 1 where a pivot is too small.

    Args:
        plan: the pattern.
        scale: nominal values of the unknowns (n,): pivots are compared with the row in these units.
    """
    lines = ["double big; int bad = 0; (void)m;"]
    upper: dict[int, list[tuple[int, int]]] = {}
    for i in range(plan.n):
        place = {int(plan.indices[e]): e for e in range(plan.indptr[i], plan.indptr[i + 1])}
        sizes: list[str] = []
        for j, e in place.items():
            terms = ["d"] if plan.on_mass[e] else []
            terms += [f"J[{plan.entry[e]}]"] if plan.entry[e] >= 0 else []
            text = " - ".join(terms) if plan.on_mass[e] else "-" + terms[0] if terms else "0.0"
            lines.append(f"double w{e} = {text};")
            if terms:
                sizes.append(f"{float(scale[plan.columns[j]])!r} * fabs(w{e})")
        lines.append(f"big = {_largest(sizes)};")
        for k in [j for j in place if j < i]:
            lines.append(f"w{place[k]} *= r{k};")
            lines += [f"w{place[j]} -= w{place[k]} * w{e};" for j, e in upper[k]]
        pivot = place[i]
        lines.append(f"bad |= !({float(scale[plan.columns[i]])!r} * fabs(w{pivot}) > AC_PIVOT * big);")
        lines.append(f"const double r{i} = 1.0 / w{pivot};")
        upper[i] = [(j, e) for j, e in place.items() if j > i]
    lines += [f"F[{e}] = w{e};" for e in range(len(plan.indices))]
    lines += [f"F[{len(plan.indices) + i}] = r{i};" for i in range(plan.n)]
    return [*lines, "return bad;"]


def _largest(sizes: list[str]) -> str:
    text = sizes[0]
    for s in sizes[1:]:
        text = f"ac_max({text}, {s})"
    return text


def solve_lines(plan: Factorisation, kind: str) -> list[str]:
    """Body of ``void ac_solve(const double *F, kind *b)``, in place."""
    lines = ["(void)m;"]
    for i in range(plan.n):
        terms = "".join(f" - F[{e}] * y{plan.indices[e]}" for e in range(plan.indptr[i], plan.diagonal[i]))
        lines.append(f"{kind} y{i} = b[{plan.rows[i]}]{terms};")
    for i in range(plan.n - 1, -1, -1):
        terms = "".join(f" - F[{e}] * y{plan.indices[e]}" for e in range(plan.diagonal[i] + 1, plan.indptr[i + 1]))
        lines.append(f"y{i} = (y{i}{terms}) * F[{len(plan.indices) + i}];")
    lines += [f"b[{plan.columns[i]}] = y{i};" for i in range(plan.n)]
    return lines
