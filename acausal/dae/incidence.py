"""Incidence of a system of equations: which columns (variables) each row (equation) touches.

The storage is compressed sparse rows, as in I. S. Duff, A. M. Erisman and J. K. Reid, *Direct Methods for Sparse
Matrices*, 2nd ed., Oxford 2017, section 2.7, without the values.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

IntArray = NDArray[np.int64]
BoolArray = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Incidence:
    """Bipartite graph of rows and columns in compressed rows; edge `k` is position `k` of `indices`.

    Attributes:
        indptr: Start of each row in `indices`, shape `(n_rows + 1,)`.
        indices: Columns of row 0, then of row 1, ..., ascending within a row, shape `(n_edges,)`.
        n_columns: Number of columns, touched or not.

    >>> g = Incidence.from_coo([0, 1, 1, 0, 1], [2, 1, 0, 0, 1], n_rows=2, n_cols=3)
    >>> [g.row(i).tolist() for i in range(g.n_rows)]
    [[0, 2], [0, 1]]
    >>> t = g.transpose()
    >>> [t.row(j).tolist() for j in range(t.n_rows)]
    [[0, 1], [1], [0]]
    """

    indptr: IntArray
    indices: IntArray
    n_columns: int

    @property
    def n_rows(self) -> int:
        """Number of rows."""
        return len(self.indptr) - 1

    @property
    def n_edges(self) -> int:
        """Number of (row, column) pairs."""
        return len(self.indices)

    def row(self, i: int) -> IntArray:
        """Columns of row `i`, ascending (a view)."""
        return self.indices[self.indptr[i] : self.indptr[i + 1]]

    @classmethod
    def from_coo(
        cls, rows: Sequence[int] | IntArray, cols: Sequence[int] | IntArray, n_rows: int, n_cols: int
    ) -> Incidence:
        """Build from pairs in any order, repeated pairs counting once.

        Args:
            rows: Row of each pair, shape `(n,)`.
            cols: Column of each pair, shape `(n,)`.
            n_rows: Number of rows.
            n_cols: Number of columns.

        Raises:
            ValueError: If a pair lies outside `(n_rows, n_cols)` or the shapes differ.
        """
        r = np.asarray(rows, dtype=np.int64)
        c = np.asarray(cols, dtype=np.int64)
        if r.shape != c.shape or r.ndim != 1:
            raise ValueError(f"rows and cols must be vectors of one length, got shapes {r.shape} and {c.shape}.")
        if r.size and (r.min() < 0 or r.max() >= n_rows or c.min() < 0 or c.max() >= n_cols):
            raise ValueError(f"A (row, column) pair lies outside the shape ({n_rows}, {n_cols}).")
        key = r * np.int64(max(n_cols, 1)) + c
        if key.size and not bool(np.all(key[1:] > key[:-1])):
            key = np.sort(key, kind="stable")
            key = key[np.concatenate(([True], key[1:] != key[:-1]))]
            r, c = np.divmod(key, np.int64(max(n_cols, 1)))
        indptr = np.zeros(n_rows + 1, dtype=np.int64)
        np.cumsum(np.bincount(r, minlength=n_rows), out=indptr[1:])
        return cls(indptr, c, n_cols)

    @classmethod
    def from_rows(cls, rows: Sequence[Sequence[int]], n_cols: int) -> Incidence:
        """Build from a list of the columns of each row."""
        flat = np.fromiter((c for row in rows for c in row), dtype=np.int64)
        owner = np.repeat(np.arange(len(rows), dtype=np.int64), [len(row) for row in rows])
        return cls.from_coo(owner, flat, len(rows), n_cols)

    def edge_rows(self) -> IntArray:
        """Row of each edge, shape `(n_edges,)`."""
        return np.repeat(np.arange(self.n_rows, dtype=np.int64), np.diff(self.indptr))

    def select(self, rows: IntArray | None = None, column_mask: BoolArray | None = None) -> Incidence:
        """Sub-incidence of some rows (in the order given) and some columns; columns keep their numbers.

        Args:
            rows: Rows to keep; row `i` of the result is `rows[i]`. All rows if omitted.
            column_mask: Columns to keep, shape `(n_columns,)`. All columns if omitted.
        """
        indptr, indices = self.indptr, self.indices
        if rows is not None:
            edges, counts = gather_ranges(indptr, np.asarray(rows, dtype=np.int64))
            indices = indices[edges]
            indptr = np.concatenate((np.zeros(1, dtype=np.int64), np.cumsum(counts)))
        if column_mask is not None:
            return Incidence(indptr, indices, self.n_columns).keep_edges(column_mask[indices])
        return Incidence(indptr, indices, self.n_columns)

    def keep_edges(self, mask: BoolArray) -> Incidence:
        """Drop the edges where `mask`, shape `(n_edges,)`, is false."""
        kept = np.concatenate((np.zeros(1, dtype=np.int64), np.cumsum(mask, dtype=np.int64)))
        return Incidence(kept[self.indptr], self.indices[mask], self.n_columns)

    def transpose(self) -> Incidence:
        """The columns as rows and the rows as columns."""
        return self.transpose_with_edges()[0]

    def transpose_with_edges(self) -> tuple[Incidence, IntArray]:
        """The transpose, and for each of its edges the number of the same edge here."""
        shape = (self.n_rows, self.n_columns)
        edges = np.arange(self.n_edges, dtype=np.int64)
        matrix: Any = sparse.csr_array((edges, self.indices, self.indptr), shape=shape).tocsc()
        indptr = np.asarray(matrix.indptr, dtype=np.int64)
        return Incidence(indptr, np.asarray(matrix.indices, dtype=np.int64), self.n_rows), np.asarray(matrix.data)

    def to_scipy(self) -> Any:
        """A `scipy.sparse.csr_array` of ones (int8), 32-bit indices where they fit (csgraph wants them)."""
        big = max(self.n_rows, self.n_columns, self.n_edges) > np.iinfo(np.int32).max
        kind = np.int64 if big else np.int32
        data = np.ones(self.n_edges, dtype=np.int8)
        parts = (data, self.indices.astype(kind), self.indptr.astype(kind))
        return sparse.csr_array(parts, shape=(self.n_rows, self.n_columns))


def gather_ranges(indptr: IntArray, rows: IntArray) -> tuple[IntArray, IntArray]:
    """Edge numbers of several rows, one row after the other, and the number of edges of each.

    >>> edges, counts = gather_ranges(np.array([0, 2, 3, 6]), np.array([2, 0]))
    >>> edges.tolist(), counts.tolist()
    ([3, 4, 5, 0, 1], [3, 2])
    """
    starts = indptr[rows]
    counts = indptr[rows + 1] - starts
    ends = np.cumsum(counts)
    total = int(ends[-1]) if len(ends) else 0
    return np.arange(total, dtype=np.int64) + np.repeat(starts - (ends - counts), counts), counts
