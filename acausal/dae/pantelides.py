"""How often each equation must be differentiated: Pantelides' algorithm.

C. C. Pantelides, *The consistent initialization of differential-algebraic systems*, SIAM J. Sci. Stat. Comput. 9
(1988) 213-231, Algorithm 4.1. A maximum matching of all rows with the highest derivatives comes first, so that the
augmentation runs for the exposed rows only; each search touches (and marks) only what it reaches. The number of
differentiations is the smallest possible and does not depend on the matching: it is the canonical dual solution of J.
D. Pryce, *A simple structural analysis method for DAEs*, BIT 41 (2001) 364-394, from which the structural index is
taken.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from acausal.dae.incidence import Incidence, IntArray
from acausal.dae.matching import maximum_matching, row_of_column


class StructurallySingular(ValueError):
    """The rows cannot be matched to variables even when a variable and its derivatives count as one.

    Attributes:
        unmatched_rows: Rows left over by a maximum matching, ascending.
        collapsed: Incidence of the rows with base variables (derivatives moved to the column of their variable).
        column_of_row: The maximum matching of `collapsed`.
    """

    def __init__(self, unmatched_rows: IntArray, collapsed: Incidence, column_of_row: IntArray) -> None:
        self.unmatched_rows = unmatched_rows
        self.collapsed = collapsed
        self.column_of_row = column_of_row
        super().__init__(
            f"{len(unmatched_rows)} of {collapsed.n_rows} rows cannot be matched to a variable of their own, "
            f"the first is row {unmatched_rows[0]}."
        )


@dataclass(frozen=True, eq=False)
class PantelidesResult:
    """The system with the differentiated rows and the new derivative columns appended.

    Attributes:
        equation_order: How often each row given is differentiated, shape `(n_rows,)`.
        variable_order: Highest derivative of each base variable among all columns, shape `(n_columns,)`; -1 for columns
            that are derivatives themselves.
        incidence: Extended incidence. A differentiated row has its parent's columns and their derivatives.
        derivative_of: Column of the derivative of each column, or -1, shape `(incidence.n_columns,)`.
        row_derivative_of: Row that differentiates each row, or -1, shape `(incidence.n_rows,)`.
        new_columns: Parent of each appended column, in creation order.
        new_rows: Parent of each appended row, in creation order.
        assignment: Highest-derivative column of each row that is not differentiated (any further), -1 for the others,
            shape `(incidence.n_rows,)`.
    """

    equation_order: IntArray
    variable_order: IntArray
    incidence: Incidence
    derivative_of: IntArray
    row_derivative_of: IntArray
    new_columns: IntArray
    new_rows: IntArray
    assignment: IntArray

    @property
    def structural_index(self) -> int:
        """Pryce's structural index of the system given."""
        return signature_index(self.equation_order, self.variable_order)


def base_and_order(derivative_of: IntArray) -> tuple[IntArray, IntArray]:
    """Base variable and derivative order of each column.

    Args:
        derivative_of: Column of the derivative of each column, or -1, shape `(n_columns,)`.

    Raises:
        ValueError: If two columns have the same derivative, or a column is a derivative of itself.

    >>> [x.tolist() for x in base_and_order(np.array([2, -1, 3, -1]))]  # 0 -> 2 -> 3
    [[0, 1, 0, 0], [0, 0, 1, 2]]
    """
    n = len(derivative_of)
    parents = np.flatnonzero(derivative_of >= 0)
    if parents.size and int(np.bincount(derivative_of[parents]).max()) > 1:
        raise ValueError("Two columns have the same derivative.")
    base = np.arange(n, dtype=np.int64)
    order = np.zeros(n, dtype=np.int64)
    # Walk all chains at once, one derivative per round.
    is_derivative = np.zeros(n, dtype=np.bool_)
    is_derivative[derivative_of[parents]] = True
    front = np.flatnonzero(~is_derivative)
    done = len(front)
    while front.size:
        front = front[derivative_of[front] >= 0]
        child = derivative_of[front]
        base[child], order[child] = base[front], order[front] + 1
        front = child
        done += len(front)
    if done < n:
        raise ValueError("A column is a derivative of itself.")
    return base, order


def signature_index(c: IntArray, d: IntArray) -> int:
    """Structural index `max c`, plus one if a variable is algebraic (some `d` is 0), after Pryce (2001), section 2.

    Args:
        c: How often each equation is differentiated.
        d: Highest derivative of each variable after that; entries of -1 are ignored.

    >>> signature_index(np.array([0, 0, 2]), np.array([2, 2, 0]))  # the pendulum in x, y and its tension
    3
    >>> signature_index(np.array([0, 0]), np.array([1, 1]))  # an explicit differential equation
    0
    """
    return (int(np.max(c)) if len(c) else 0) + int(bool(np.any(np.asarray(d) == 0)))


def pantelides(g: Incidence, derivative_of: IntArray, extra: Incidence | None = None) -> PantelidesResult:
    """Differentiate rows until the rows not differentiated further can be matched to highest derivatives.

    Args:
        g: Incidence of the rows with columns for variables and for the derivatives that occur.
        derivative_of: Column of the derivative of each column, or -1, shape `(n_columns,)`.
        extra: Columns that the derivative of each row has besides, from variables that are no unknowns here.

    Raises:
        StructurallySingular: If no number of differentiations helps.
        ValueError: If `derivative_of` is not a set of chains.

    The pendulum `x'' = -T x, y'' = -T y - g, x^2 + y^2 = L^2` with columns `x, y, T, x', y', x'', y''`:

    >>> g = Incidence.from_rows([[0, 2, 5], [1, 2, 6], [0, 1]], n_cols=7)
    >>> r = pantelides(g, np.array([3, 4, -1, 5, 6, -1, -1]))
    >>> r.equation_order.tolist(), r.variable_order.tolist()
    ([0, 0, 2], [2, 2, 0, -1, -1, -1, -1])
    >>> r.new_rows.tolist(), r.new_columns.tolist(), r.structural_index
    ([2, 3], [], 3)
    """
    derivative_of = np.asarray(derivative_of, dtype=np.int64)
    base, _ = base_and_order(derivative_of)
    _check_regular(g, base, extra)
    first = maximum_matching(g, allowed=(derivative_of < 0)[g.indices])
    work = _Augmentation(g, derivative_of, first, extra)
    for row in np.flatnonzero(first < 0).tolist():
        work.match(row)
    return work.result()


def _check_regular(g: Incidence, base: IntArray, extra: Incidence | None) -> None:
    rows, columns = g.edge_rows(), g.indices
    if extra is not None:
        rows, columns = np.concatenate((rows, extra.edge_rows())), np.concatenate((columns, extra.indices))
    collapsed = Incidence.from_coo(rows, base[columns], g.n_rows, g.n_columns)
    column_of_row = maximum_matching(collapsed)
    unmatched = np.flatnonzero(column_of_row < 0)
    if unmatched.size:
        raise StructurallySingular(unmatched, collapsed, column_of_row)


class _Augmentation:
    """The growing system and its matching, as lists that only the touched part is read from."""

    def __init__(
        self, g: Incidence, derivative_of: IntArray, column_of_row: IntArray, extra: Incidence | None
    ) -> None:
        self.g = g
        self.extra = extra
        self.origin = list(range(g.n_rows))  # the given row that each row is a derivative of
        self.derivative_of: list[int] = derivative_of.tolist()
        self.row_derivative_of = [-1] * g.n_rows
        self.column_of_row: list[int] = column_of_row.tolist()
        self.row_of: list[int] = row_of_column(column_of_row, g.n_columns).tolist()
        self.new_columns: list[int] = []
        self.new_rows: list[int] = []
        self.rows: dict[int, list[int]] = {}  # columns of the rows touched and of the rows appended

    def row(self, i: int) -> list[int]:
        """Columns of row `i`, ascending."""
        if i not in self.rows:
            self.rows[i] = self.g.row(i).tolist()
        return self.rows[i]

    def match(self, row: int) -> None:
        """Match `row`, or a derivative of it, differentiating the rows that stand in the way."""
        while True:
            free, reached_from, rows = self.search(row)
            if free >= 0:
                while free >= 0:  # flip the path back to the start
                    i = reached_from[free]
                    self.column_of_row[i], self.row_of[free], free = free, i, self.column_of_row[i]
                return
            self.differentiate(sorted(reached_from), sorted(rows))
            row = self.row_derivative_of[row]

    def search(self, start: int) -> tuple[int, dict[int, int], list[int]]:
        """Shortest alternating path from an exposed row to a free highest derivative.

        Returns:
            The free column or -1; the row from which each column was reached; the rows visited.
        """
        reached_from: dict[int, int] = {}
        rows = [start]
        queue = deque(rows)
        while queue:
            i = queue.popleft()
            for j in self.row(i):
                if self.derivative_of[j] >= 0 or j in reached_from:
                    continue
                reached_from[j] = i
                owner = self.row_of[j]
                if owner < 0:
                    return j, reached_from, rows
                rows.append(owner)
                queue.append(owner)
        return -1, reached_from, rows

    def differentiate(self, columns: list[int], rows: list[int]) -> None:
        """Append the derivatives of columns and rows; matched pairs stay matched, one derivative higher."""
        for j in columns:
            self.derivative_of[j] = len(self.derivative_of)
            self.derivative_of.append(-1)
            self.row_of.append(-1)
            self.new_columns.append(j)
        for i in rows:
            new = len(self.row_derivative_of)
            self.row_derivative_of[i] = new
            self.row_derivative_of.append(-1)
            self.new_rows.append(i)
            base = self.origin[i]
            self.origin.append(base)
            more: list[int] = [] if self.extra is None else self.extra.row(base).tolist()
            self.rows[new] = sorted({*self.row(i), *(self.derivative_of[j] for j in self.row(i)), *more})
            column = self.column_of_row[i]
            self.column_of_row[i] = -1
            self.column_of_row.append(-1)
            if column >= 0:
                higher = self.derivative_of[column]
                self.row_of[column] = -1
                self.row_of[higher], self.column_of_row[new] = new, higher

    def result(self) -> PantelidesResult:
        m, n = self.g.n_rows, self.g.n_columns
        appended = [self.rows[i] for i in range(m, m + len(self.new_rows))]
        lengths = np.cumsum([len(r) for r in appended], dtype=np.int64)
        flat = np.fromiter((j for r in appended for j in r), dtype=np.int64)
        incidence = Incidence(
            np.concatenate((self.g.indptr, self.g.n_edges + lengths)),
            np.concatenate((self.g.indices, flat)),
            n + len(self.new_columns),
        )
        derivative_of = np.array(self.derivative_of, dtype=np.int64)
        row_derivative_of = np.array(self.row_derivative_of, dtype=np.int64)
        return PantelidesResult(
            equation_order=_highest(row_derivative_of)[:m],
            variable_order=_highest(derivative_of)[:n],
            incidence=incidence,
            derivative_of=derivative_of,
            row_derivative_of=row_derivative_of,
            new_columns=np.array(self.new_columns, dtype=np.int64),
            new_rows=np.array(self.new_rows, dtype=np.int64),
            assignment=np.array(self.column_of_row, dtype=np.int64),
        )


def _highest(derivative_of: IntArray | Sequence[int]) -> IntArray:
    """Highest derivative order of each chain at its base, -1 elsewhere."""
    base, order = base_and_order(np.asarray(derivative_of, dtype=np.int64))
    highest = np.full(len(base), -1, dtype=np.int64)
    np.maximum.at(highest, base, order)
    return highest
