"""Coarse Dulmage-Mendelsohn decomposition: where a system has too many equations and where too few.

A. L. Dulmage and N. S. Mendelsohn, *Coverings of bipartite graphs*, Canad. J. Math. 10 (1958) 517-534, computed from a
maximum matching as in A. Pothen and C.-J. Fan, *Computing the block triangular form of a sparse matrix*, ACM Trans.
Math. Softw. 16 (1990) 303-324, section 2. The parts do not depend on which maximum matching is given.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csgraph

from acausal.dae.incidence import BoolArray, Incidence, IntArray
from acausal.dae.matching import reachable_from, row_of_column


@dataclass(frozen=True, eq=False)
class DulmageMendelsohn:
    """Rows and columns of the three parts, each ascending.

    Attributes:
        over_rows: Over-determined: more rows than columns; some row of them has to go.
        over_columns: The columns these rows touch.
        under_rows: Under-determined: fewer rows than columns; the rows that touch an under-determined column.
        under_columns: Columns of which some cannot be determined (those that no row touches included).
        square_rows: Everything else: as many rows as columns, perfectly matched.
        square_columns: The columns matched to `square_rows`.
    """

    over_rows: IntArray
    over_columns: IntArray
    under_rows: IntArray
    under_columns: IntArray
    square_rows: IntArray
    square_columns: IntArray

    @property
    def is_square(self) -> bool:
        """Whether all rows and columns are in the square part."""
        return not (len(self.over_rows) or len(self.under_columns))


def dulmage_mendelsohn(g: Incidence, column_of_row: IntArray) -> DulmageMendelsohn:
    """Split a system in its over-determined, under-determined and square parts.

    Args:
        g: Incidence.
        column_of_row: A maximum matching of `g`, shape `(n_rows,)`.

    Raises:
        ValueError: If the matching is not maximum.

    >>> g = Incidence.from_rows([[0], [0], [1, 2], [2], [3, 4]], n_cols=5)
    >>> dm = dulmage_mendelsohn(g, np.array([0, -1, 1, 2, 3]))
    >>> dm.over_rows.tolist(), dm.over_columns.tolist()  # rows 0 and 1 both determine column 0
    ([0, 1], [0])
    >>> dm.under_rows.tolist(), dm.under_columns.tolist()  # row 4 cannot determine columns 3 and 4
    ([4], [3, 4])
    >>> dm.square_rows.tolist(), dm.square_columns.tolist()
    ([2, 3], [1, 2])
    """
    row_of = row_of_column(column_of_row, g.n_columns)
    over_row = reachable_from(g, row_of, np.flatnonzero(column_of_row < 0))
    over_column = np.zeros(g.n_columns, dtype=np.bool_)
    over_column[g.indices[over_row[g.edge_rows()]]] = True
    by_column = g.transpose()
    under_column = reachable_from(by_column, column_of_row, np.flatnonzero(row_of < 0))
    under_row = np.zeros(g.n_rows, dtype=np.bool_)
    under_row[by_column.indices[under_column[by_column.edge_rows()]]] = True
    if bool(np.any(row_of[over_column] < 0)):
        raise ValueError("The matching is not maximum: an unmatched row reaches an unmatched column.")
    return DulmageMendelsohn(
        *_numbers(over_row, over_column),
        *_numbers(under_row, under_column),
        *_numbers(~(over_row | under_row), ~(over_column | under_column)),
    )


def _numbers(rows: BoolArray, columns: BoolArray) -> tuple[IntArray, IntArray]:
    return np.flatnonzero(rows), np.flatnonzero(columns)


def connected_parts(g: Incidence, rows: IntArray, columns: IntArray) -> list[tuple[IntArray, IntArray]]:
    """Split a part in connected components, so that a message can name a small culprit.

    Args:
        g: Incidence.
        rows: Rows of the part.
        columns: Columns of the part; edges to other columns are ignored.

    Returns:
        The (rows, columns) of each component, ascending; first the components with rows, by lowest row, then the
        columns that no row of the part touches, by number.

    >>> g = Incidence.from_rows([[0], [0], [1], [1], [2, 3]], n_cols=4)
    >>> [(r.tolist(), c.tolist()) for r, c in connected_parts(g, np.arange(4), np.arange(2))]
    [([0, 1], [0]), ([2, 3], [1])]
    """
    rows, columns = np.unique(rows), np.unique(columns)
    inside = np.zeros(g.n_columns, dtype=np.bool_)
    inside[columns] = True
    part = g.select(rows, inside)
    m, n = len(rows), len(rows) + len(columns)
    if n == 0:
        return []
    column_nodes = m + np.searchsorted(columns, part.indices)
    graph = Incidence.from_coo(part.edge_rows(), column_nodes, n, n)
    n_parts, label = csgraph.connected_components(graph.to_scipy(), directed=False)
    # Components in the order of their lowest node (rows come before columns), nodes ascending within.
    first = np.full(n_parts, n, dtype=np.int64)
    np.minimum.at(first, label, np.arange(n))
    by_part = np.lexsort((np.arange(n), first[label]))
    ends = np.cumsum(np.bincount(label, minlength=n_parts)[np.argsort(first)])
    pieces = np.split(by_part, ends[:-1])
    return [(rows[nodes[nodes < m]], columns[nodes[nodes >= m] - m]) for nodes in pieces]
