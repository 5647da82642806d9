"""Groups of Jacobian columns that share no row, so that one directional derivative gives all columns of a group.

A. R. Curtis, M. J. D. Powell and J. K. Reid, *On the estimation of sparse Jacobian matrices*, IMA J. Appl. Math. 13
(1974) 117-119, as the graph colouring of T. F. Coleman and J. J. Moré, *Estimation of sparse Jacobian matrices and
graph coloring problems*, SIAM J. Numer. Anal. 20 (1983) 187-209. The greedy pass keeps the colours used in each row as
the bits of an integer, which makes it linear in the number of entries.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy import sparse

from acausal.dae.incidence import Incidence, IntArray

_SMALL = 20_000  # columns up to which a second order is tried when the first is not optimal for certain


def color_columns(sparsity: Any) -> IntArray:
    """Colour the columns so that no row has two columns of one colour.

    Args:
        sparsity: Sparsity pattern, any scipy sparse or dense matrix of shape `(n_rows, n_columns)`.

    Returns:
        Colour of each column from 0 on, shape `(n_columns,)`. The number of colours is at least the largest number of
        entries in a row; for a banded pattern in natural order it is the bandwidth.

    >>> tridiagonal = np.eye(6, k=-1) + np.eye(6) + np.eye(6, k=1)
    >>> color_columns(tridiagonal).tolist()
    [0, 1, 2, 0, 1, 2]
    """
    matrix: Any = sparse.coo_array(sparsity)
    stored = np.asarray(matrix.data) != 0
    by_column = Incidence.from_coo(matrix.col[stored], matrix.row[stored], matrix.shape[1], matrix.shape[0])
    n = by_column.n_rows
    largest_row = int(np.bincount(by_column.indices).max()) if by_column.n_edges else min(n, 1)
    colors = _greedy(by_column, np.arange(n, dtype=np.int64))
    if n <= _SMALL and n and int(colors.max()) + 1 > largest_row:
        # Widest columns first (Welsh and Powell), ties in natural order.
        other = _greedy(by_column, np.argsort(-np.diff(by_column.indptr), kind="stable"))
        colors = min(colors, other, key=lambda c: int(c.max()))
    return colors


def _greedy(by_column: Incidence, order: IntArray) -> IntArray:
    """Give each column, in this order, the lowest colour that its rows do not have yet."""
    indptr, indices = by_column.indptr.tolist(), by_column.indices.tolist()
    used = [0] * by_column.n_columns  # bit k of used[i]: row i has a column of colour k
    colors = [0] * by_column.n_rows
    for j in order.tolist():
        rows = indices[indptr[j] : indptr[j + 1]]
        taken = 0
        for i in rows:
            taken |= used[i]
        bit = ~taken & (taken + 1)
        colors[j] = bit.bit_length() - 1
        for i in rows:
            used[i] |= bit
    return np.array(colors, dtype=np.int64)
