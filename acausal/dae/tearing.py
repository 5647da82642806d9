"""Tearing: the few unknowns of a block to iterate, so that all others follow one by one.

H. Elmqvist and M. Otter, *Methods for tearing systems of equations in object-oriented modeling*, ESM 1994, 326-332; the
choice of tearing variable follows F. E. Cellier and E. Kofman, *Continuous System Simulation*, Springer 2006, section
7.6. A smallest set is NP-hard to find, so this is a heuristic, improved by trying every single unknown (blocks up to
200), every pair (up to 24), and by giving back variables that turn out not to be needed.
"""

from __future__ import annotations

import heapq
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from acausal.dae.incidence import IntArray

_SINGLES, _PAIRS, _SEVERAL_RULES = 200, 24, 1000  # block sizes up to which the more thorough searches run


@dataclass(frozen=True)
class Tearing:
    """Order in which a block is evaluated, given values of the torn unknowns.

    Attributes:
        tear_columns: Torn unknowns, ascending.
        sequence: Pairs (row, column): solve `row` for `column`; the row's other unknowns are torn or come earlier.
        residual_rows: Rows that are left to determine the torn unknowns, ascending.
    """

    tear_columns: tuple[int, ...]
    sequence: tuple[tuple[int, int], ...]
    residual_rows: tuple[int, ...]


def tear(
    rows: Sequence[Sequence[int]],
    solvable: Sequence[Sequence[bool]],
    n_columns: int | None = None,
    preference: Sequence[float] | None = None,
) -> Tearing:
    """Choose torn unknowns such that every other unknown is the only one left in a row that can be solved for it.

    Args:
        rows: Local unknowns of each row, without repeats.
        solvable: For each of them, whether the row can be solved for it explicitly with a pivot that cannot vanish.
        n_columns: Number of unknowns; the number of rows if omitted.
        preference: How gladly each unknown is torn, shape `(n_columns,)`; decides between otherwise equal choices.

    >>> rows = [[0, 1], [1, 2], [2, 0]]
    >>> tear(rows, [[True, True]] * 3)
    Tearing(tear_columns=(0,), sequence=((0, 1), (1, 2)), residual_rows=(2,))
    """
    block = _Block(rows, solvable, len(rows) if n_columns is None else n_columns)
    n = block.n_columns
    wish = np.zeros(n) if preference is None else np.asarray(preference, dtype=np.float64)
    best = _give_back(block, _greedy(block, wish, by_gain=True))
    if len(best) > 1 and n <= _SEVERAL_RULES:
        best = min(best, _give_back(block, _greedy(block, wish, by_gain=False)), key=len)
    by_wish: list[int] = np.argsort(-wish, kind="stable").tolist()
    for size, limit in ((1, _SINGLES), (2, _PAIRS)):
        if size < len(best) and n <= limit:
            best = next((list(t) for t in combinations(by_wish, size) if block.solves_all(t)), best)
    run = _Run(block)
    for column in best:
        run.know(column)
    run.propagate()
    residual = tuple(i for i in range(len(rows)) if not run.used[i])
    return Tearing(tuple(sorted(best)), tuple(run.sequence), residual)


class _Block:
    """A block and its edges as arrays."""

    def __init__(self, rows: Sequence[Sequence[int]], solvable: Sequence[Sequence[bool]], n_columns: int) -> None:
        self.rows = rows
        self.n_columns = n_columns
        self.rows_of: list[list[int]] = [[] for _ in range(n_columns)]
        for i, row in enumerate(rows):
            for j in row:
                self.rows_of[j].append(i)
        self.solvable: list[dict[int, bool]] = [
            dict(zip(r, s, strict=True)) for r, s in zip(rows, solvable, strict=True)
        ]
        self.edge_row = np.repeat(np.arange(len(rows)), [len(r) for r in rows])
        self.edge_column = np.array([j for r in rows for j in r], dtype=np.int64)
        self.edge_solvable = np.array([bool(s) for r in solvable for s in r], dtype=np.bool_)

    def solves_all(self, torn: Sequence[int]) -> bool:
        run = _Run(self)
        for column in torn:
            run.know(column)
        run.propagate()
        return run.n_known == self.n_columns


class _Run:
    """Propagation of known unknowns through the rows with one unknown left, lowest row first."""

    def __init__(self, block: _Block) -> None:
        self.block = block
        self.known = [False] * block.n_columns
        self.n_known = 0
        self.used = [False] * len(block.rows)
        self.left = [len(r) for r in block.rows]  # unknowns left in each row
        self.sum_left = [sum(r) for r in block.rows]  # their sum: with one left, its number
        self.ready: list[int] = []
        self.sequence: list[tuple[int, int]] = []
        for i in range(len(block.rows)):
            self._look(i)

    def _look(self, i: int) -> None:
        if self.left[i] == 1 and self.block.solvable[i][self.sum_left[i]]:
            heapq.heappush(self.ready, i)

    def know(self, column: int) -> None:
        if self.known[column]:
            return
        self.known[column] = True
        self.n_known += 1
        for i in self.block.rows_of[column]:
            self.left[i] -= 1
            self.sum_left[i] -= column
            self._look(i)

    def propagate(self) -> None:
        while self.ready:
            i = heapq.heappop(self.ready)
            if self.left[i] == 1:  # otherwise another row was first
                self.used[i] = True
                column = self.sum_left[i]
                self.sequence.append((i, column))
                self.know(column)


def _greedy(block: _Block, wish: np.ndarray, *, by_gain: bool) -> list[int]:
    """Tear the best unknown, propagate, and so on until all are known."""
    run, torn = _Run(block), []
    run.propagate()
    while run.n_known < block.n_columns:
        column = _best_column(block, run, wish, by_gain)
        torn.append(column)
        run.know(column)
        run.propagate()
    return torn


def _best_column(block: _Block, run: _Run, wish: np.ndarray, by_gain: bool) -> int:
    """First by never being solvable, then by rows made solvable, rows touched, wish and lowest number."""
    n, m = block.n_columns, len(block.rows)
    known = np.array(run.known)
    active = np.flatnonzero(~known[block.edge_column])
    row, column, solvable = block.edge_row[active], block.edge_column[active], block.edge_solvable[active]
    left = np.bincount(row, minlength=m)
    solvable_left = np.bincount(row, weights=solvable, minlength=m)
    opens = (left[row] == 2) & (solvable_left[row] - solvable > 0)
    gain: IntArray = np.bincount(column, weights=opens, minlength=n).astype(np.int64)
    touched: IntArray = np.bincount(column, minlength=n)
    never = np.bincount(column, weights=solvable, minlength=n) == 0
    first, second = (gain, touched) if by_gain else (touched, gain)
    candidates = np.flatnonzero(~known)
    keys = (candidates, -wish[candidates], -second[candidates], -first[candidates], ~never[candidates])
    return int(candidates[np.lexsort(keys)[0]])


def _give_back(block: _Block, torn: list[int]) -> list[int]:
    """Drop torn unknowns that follow from the others, first torn first."""
    if len(torn) * len(block.edge_column) > 400_000:
        return torn
    for column in list(torn):
        rest = [j for j in torn if j != column]
        if len(torn) > 1 and block.solves_all(rest):
            torn = rest
    return torn
