r"""Maximum matching of rows (equations) and columns (unknowns), and the best set of columns to match.

`maximum_matching` is J. E. Hopcroft and R. M. Karp, *An n^{5/2} algorithm for maximum matchings in bipartite graphs*,
SIAM J. Comput. 2 (1973) 225-231, in the C code of scipy. `transversal_basis` is the greedy algorithm on the
transversal matroid of the columns: J. Edmonds and D. R. Fulkerson, *Transversals and matroid partition*, J. Res. Nat.
Bur. Standards 69B (1965) 147-153. Taking the columns in order of preference, each is kept if the columns kept so far
can still all be matched; the result is lexicographically best among all maximum matchings.
"""

from __future__ import annotations

from collections import deque

import numpy as np
from scipy.sparse import csgraph

from acausal.dae.incidence import BoolArray, Incidence, IntArray

_FEW = 64  # exposed rows up to this number are augmented one by one from a given matching


def maximum_matching(g: Incidence, *, allowed: BoolArray | None = None, initial: IntArray | None = None) -> IntArray:
    """Match as many rows as possible to columns of their own.

    Args:
        g: Incidence, shape `(n_rows, n_columns)`.
        allowed: Edges that may be used, shape `(n_edges,)`; all if omitted.
        initial: A matching to improve, as a column of each row or -1, shape `(n_rows,)`. When it leaves only a few
            rows exposed it is augmented, so that most of it is kept.

    Returns:
        Column of each row, -1 for a row without, shape `(n_rows,)`.

    Raises:
        ValueError: If `initial` uses a column twice or an edge that is not there.

    >>> g = Incidence.from_rows([[0, 1], [0], [1, 2], [2]], n_cols=3)
    >>> column_of_row = maximum_matching(g)
    >>> int((column_of_row >= 0).sum())  # four rows compete for three columns
    3
    """
    if allowed is not None:
        g = g.keep_edges(allowed)
    if initial is not None:
        column_of_row = np.array(initial, dtype=np.int64)
        check_matching(g, column_of_row)
        exposed = np.flatnonzero((column_of_row < 0) & (np.diff(g.indptr) > 0))
        if len(exposed) <= _FEW:
            return _augment_rows(g, column_of_row, exposed)
    if g.n_edges == 0:
        return np.full(g.n_rows, -1, dtype=np.int64)
    return np.asarray(csgraph.maximum_bipartite_matching(g.to_scipy(), perm_type="column"), dtype=np.int64)


def row_of_column(column_of_row: IntArray, n_columns: int) -> IntArray:
    """Invert a matching: row of each column or -1, shape `(n_columns,)`."""
    result = np.full(n_columns, -1, dtype=np.int64)
    rows = np.flatnonzero(column_of_row >= 0)
    result[column_of_row[rows]] = rows
    return result


def check_matching(g: Incidence, column_of_row: IntArray) -> None:
    """Raise `ValueError` unless `column_of_row` is a matching of `g`."""
    if column_of_row.shape != (g.n_rows,):
        raise ValueError(f"A matching of {g.n_rows} rows has shape ({g.n_rows},), got {column_of_row.shape}.")
    used = column_of_row[column_of_row >= 0]
    if used.size and int(np.bincount(used).max()) > 1:
        raise ValueError(f"Column {int(np.argmax(np.bincount(used) > 1))} is matched to two rows.")
    on_edge = np.zeros(g.n_rows, dtype=np.bool_)
    owner = g.edge_rows()
    on_edge[owner[g.indices == column_of_row[owner]]] = True
    wrong = np.flatnonzero((column_of_row >= 0) & ~on_edge)
    if wrong.size:
        raise ValueError(f"Row {wrong[0]} is matched to column {column_of_row[wrong[0]]}, which it does not touch.")


def _augment_rows(g: Incidence, column_of_row: IntArray, exposed: IntArray) -> IntArray:
    """Augment from each exposed row along a shortest path; rows of failed searches are never visited again."""
    row_of = row_of_column(column_of_row, g.n_columns)
    dead = np.zeros(g.n_columns, dtype=np.bool_)  # columns reached by a failed search: no free column behind them
    for start in exposed.tolist():
        parent: dict[int, int] = {}  # column -> row it was reached from
        queue: deque[int] = deque([start])
        free = -1
        while queue and free < 0:
            row = queue.popleft()
            for column in g.row(row).tolist():
                if column in parent or dead[column]:
                    continue
                parent[column] = row
                owner = int(row_of[column])
                if owner < 0:
                    free = column
                    break
                queue.append(owner)
        if free < 0:
            dead[list(parent)] = True
            continue
        while free >= 0:
            row = parent[free]
            previous = int(column_of_row[row])
            column_of_row[row], row_of[free] = free, row
            free = previous
    return column_of_row


def transversal_basis(g: Incidence, order_of_columns: IntArray, allowed: BoolArray | None = None) -> IntArray:
    """Maximum matching whose set of columns is the best in a given order of preference.

    Only the under-determined part (columns that some maximum matching leaves out) needs a choice; the rest is taken
    from any maximum matching.

    Args:
        g: Incidence, shape `(n_rows, n_columns)`.
        order_of_columns: The columns that may be used, most wanted first. Columns not listed are never matched.
        allowed: Edges that may be used, shape `(n_edges,)`; all if omitted.

    Returns:
        Column of each row, -1 for a row without, shape `(n_rows,)`.

    >>> g = Incidence.from_rows([[0, 1, 2], [2, 3]], n_cols=4)
    >>> sorted(transversal_basis(g, np.array([2, 3, 1, 0])).tolist())
    [2, 3]
    >>> sorted(transversal_basis(g, np.array([0, 1, 2, 3])).tolist())  # 0 and 1 cannot both be matched
    [0, 2]
    """
    order = np.asarray(order_of_columns, dtype=np.int64)
    listed = np.zeros(g.n_columns, dtype=np.bool_)
    listed[order] = True
    usable = listed[g.indices] if allowed is None else listed[g.indices] & allowed
    g = g.keep_edges(usable)
    column_of_row = maximum_matching(g)
    by_column = g.transpose()
    row_of = row_of_column(column_of_row, g.n_columns)
    free = np.flatnonzero((row_of < 0) & (np.diff(by_column.indptr) > 0))
    choice = reachable_from(by_column, column_of_row, free)
    matched = np.flatnonzero(column_of_row >= 0)
    column_of_row[matched[choice[column_of_row[matched]]]] = -1
    _greedy(by_column, order[choice[order]], column_of_row)
    return column_of_row


def reachable_from(g: Incidence, row_of: IntArray, start: IntArray) -> BoolArray:
    """Rows of `g` reached from the rows `start` by alternating paths.

    A step leads from a row over any edge to a column, and over the matched edge to that column's row.

    Args:
        g: Incidence.
        row_of: Row of each column or -1, shape `(n_columns,)`.
        start: Rows to start from.

    Returns:
        Mask, shape `(n_rows,)`.
    """
    reached = np.zeros(g.n_rows, dtype=np.bool_)
    if not len(start):
        return reached
    target = row_of[g.indices]
    step = np.flatnonzero(target >= 0)
    source_rows = np.concatenate((g.edge_rows()[step], np.full(len(start), g.n_rows, dtype=np.int64)))
    target_rows = np.concatenate((target[step], start))
    graph = Incidence.from_coo(source_rows, target_rows, g.n_rows + 1, g.n_rows + 1)
    seen = csgraph.breadth_first_order(graph.to_scipy(), g.n_rows, directed=True, return_predecessors=False)
    reached[seen[seen < g.n_rows]] = True
    return reached


def _greedy(by_column: Incidence, order: IntArray, column_of_row: IntArray) -> None:
    """Match the columns of `order` one by one, in place, where an augmenting path of rows exists.

    Rows met by a failed search reach no free row, now or later (Hungarian tree), so they are never searched again.
    """
    indptr, indices = by_column.indptr.tolist(), by_column.indices.tolist()
    row_of: list[int] = row_of_column(column_of_row, by_column.n_rows).tolist()
    owner: list[int] = column_of_row.tolist()
    mark = [-1] * len(owner)  # column whose search met the row; `never` after a failed search
    parent = [-1] * len(owner)  # column the row was reached from
    never = by_column.n_rows
    for start in order.tolist():
        visited: list[int] = []
        queue: deque[int] = deque([start])
        free = -1
        while queue and free < 0:
            column = queue.popleft()
            for row in indices[indptr[column] : indptr[column + 1]]:
                if mark[row] == start or mark[row] == never:
                    continue
                mark[row], parent[row] = start, column
                visited.append(row)
                if owner[row] < 0:
                    free = row
                    break
                queue.append(owner[row])
        if free < 0:
            for row in visited:
                mark[row] = never
            continue
        while free >= 0:
            column = parent[free]
            owner[free], row_of[column], free = column, free, row_of[column]
    column_of_row[:] = owner
