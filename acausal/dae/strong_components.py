"""Block lower triangular form: which rows are solved together, in which order, and which may run at the same time.

A strong component of the digraph "row `i` needs the column that row `k` is solved for" is a block of simultaneous
equations: R. Tarjan, *Depth-first search and linear graph algorithms*, SIAM J. Comput. 1 (1972) 146-160 (scipy's C
code is D. J. Pearce's iterative variant). The level of a block is the longest chain of blocks it waits for, by peeling:
A. B. Kahn, *Topological sorting of large networks*, Comm. ACM 5 (1962) 558-562.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csgraph

from acausal.dae.incidence import Incidence, IntArray, gather_ranges
from acausal.dae.matching import row_of_column

_ROUNDS = 256  # peel this many levels in numpy, then look whether the levels are wide enough to go on
_WIDE = 200  # blocks per level from which a numpy round is cheaper than a Python loop


@dataclass(frozen=True, eq=False)
class Blocks:
    """Blocks in evaluation order: by level, then by lowest row.

    Attributes:
        block_of_row: Block of each row, shape `(n_rows,)`.
        ptr: Start of each block in `rows`, shape `(n_blocks + 1,)`.
        rows: Rows of block 0, then of block 1, ..., ascending within a block, shape `(n_rows,)`.
        level: Level of each block, not decreasing, shape `(n_blocks,)`. A block only needs blocks of lower levels.
    """

    block_of_row: IntArray
    ptr: IntArray
    rows: IntArray
    level: IntArray

    def __len__(self) -> int:
        return len(self.ptr) - 1

    def block(self, b: int) -> IntArray:
        """Rows of block `b`, ascending."""
        return self.rows[self.ptr[b] : self.ptr[b + 1]]

    @property
    def sizes(self) -> IntArray:
        """Number of rows of each block, shape `(n_blocks,)`."""
        return np.diff(self.ptr)

    @property
    def n_levels(self) -> int:
        """Number of levels."""
        return int(self.level[-1]) + 1 if len(self.level) else 0


def block_lower_triangular(g: Incidence, column_of_row: IntArray) -> Blocks:
    """Sort rows, each solved for its matched column, in blocks such that a block only needs earlier ones.

    Args:
        g: Incidence.
        column_of_row: Matching in which every row has a column, shape `(n_rows,)`. Columns matched to no row count as
            known.

    Raises:
        ValueError: If a row is unmatched.

    >>> g = Incidence.from_rows([[0, 1], [1, 2], [1, 2], [2, 3]], n_cols=4)
    >>> blocks = block_lower_triangular(g, np.array([0, 1, 2, 3]))
    >>> [blocks.block(b).tolist() for b in range(len(blocks))], blocks.level.tolist()
    ([[1, 2], [0], [3]], [0, 1, 1])
    """
    unmatched = np.flatnonzero(column_of_row < 0)
    if unmatched.size:
        raise ValueError(f"{unmatched.size} rows are not matched, the first is row {unmatched[0]}.")
    m = g.n_rows
    if m == 0:
        empty = np.zeros(0, dtype=np.int64)
        return Blocks(empty, np.zeros(1, dtype=np.int64), empty, empty)
    needs = row_of_column(column_of_row, g.n_columns)[g.indices]
    source = g.edge_rows()
    proper = np.flatnonzero((needs >= 0) & (needs != source))
    source, needs = source[proper], needs[proper]
    graph = Incidence.from_coo(source, needs, m, m)
    n_blocks, label = csgraph.connected_components(graph.to_scipy(), directed=True, connection="strong")
    # Number the components by their lowest row, to depend on nothing but the input.
    first = np.full(n_blocks, m, dtype=np.int64)
    np.minimum.at(first, label, np.arange(m))
    rank = np.empty(n_blocks, dtype=np.int64)
    rank[np.argsort(first)] = np.arange(n_blocks)
    component = rank[label]
    before, after = component[needs], component[source]
    across = np.flatnonzero(before != after)
    level = levels(Incidence.from_coo(before[across], after[across], n_blocks, n_blocks))
    order = np.argsort(level, kind="stable")
    position = np.empty(n_blocks, dtype=np.int64)
    position[order] = np.arange(n_blocks)
    block_of_row = position[component]
    ptr = np.concatenate((np.zeros(1, dtype=np.int64), np.cumsum(np.bincount(block_of_row, minlength=n_blocks))))
    return Blocks(block_of_row, ptr, np.argsort(block_of_row, kind="stable"), level[order])


def levels(successors: Incidence) -> IntArray:
    """Length of the longest path to each node of an acyclic digraph.

    Args:
        successors: Row `i` holds the nodes that wait for node `i`.

    Raises:
        ValueError: If the graph has a cycle.

    >>> levels(Incidence.from_rows([[1, 2], [2], [], []], n_cols=4)).tolist()
    [0, 1, 2, 0]
    """
    n = successors.n_rows
    waiting = np.bincount(successors.indices, minlength=n)
    level = np.zeros(n, dtype=np.int64)
    front = np.flatnonzero(waiting == 0)
    current, done = 0, 0
    while front.size:
        if current and current % _ROUNDS == 0 and done < current * _WIDE:
            return _levels_one_by_one(successors, level, waiting, front, current)
        level[front] = current
        done += len(front)
        edges, _ = gather_ranges(successors.indptr, front)
        touched, counts = np.unique(successors.indices[edges], return_counts=True)
        waiting[touched] -= counts
        front = touched[waiting[touched] == 0]
        current += 1
    if done < n:
        raise ValueError("The graph has a cycle.")
    return level


def _levels_one_by_one(
    successors: Incidence, level: IntArray, waiting: IntArray, front: IntArray, current: int
) -> IntArray:
    """Go on level by level in plain Python: cheaper than numpy when the levels are narrow."""
    indptr, indices = successors.indptr.tolist(), successors.indices.tolist()
    wait, result = waiting.tolist(), level.tolist()
    this: list[int] = front.tolist()
    while this:
        following: list[int] = []
        for node in this:
            result[node] = current
            for k in range(indptr[node], indptr[node + 1]):
                target = indices[k]
                wait[target] -= 1
                if wait[target] == 0:
                    following.append(target)
        this = following
        current += 1
    if any(wait):
        raise ValueError("The graph has a cycle.")
    return np.array(result, dtype=np.int64)
