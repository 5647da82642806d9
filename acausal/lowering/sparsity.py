"""Which state and algebraic unknown each derivative and residual depends on, through the whole schedule."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy import sparse

from ..language.flat_model import Family
from ..language.template import Ints
from ..passes.schedule import Group, needs

if TYPE_CHECKING:
    from .lowered import Lowered

NO_IDS = np.zeros(0, np.int64)


def jacobian_pattern(lowered: Lowered, groups: list[int]) -> Any:
    """Pattern of d(dx, r)/d(x, w), a boolean CSR matrix (n_x + n_w, n_x + n_w)."""
    found = Dependence(lowered, [lowered.schedule.groups[k] for k in groups])
    return _stack([found.of_values(lowered.dx_ids), found.of_residuals()])


def condition_groups(lowered: Lowered, ids: Ints, families: Sequence[Family]) -> list[int]:
    """Numbers of the groups that residuals, invariants, variables `ids` and residuals of `families` need."""
    extra = [*lowered.schedule.invariants, *families]
    return lowered.closure(np.concatenate([ids, *(f.var_rows.ravel() for f in extra)]), residuals=True)


def condition_pattern(
    lowered: Lowered, ids: Ints = NO_IDS, families: Sequence[Family] = (), groups: Iterable[Group] | None = None,
    held: Ints = NO_IDS,
) -> Any:  # fmt: skip
    """Pattern of d(r, invariants, variables `ids`, residuals of `families`)/d(x, w), a boolean CSR matrix.

    Of the `groups` of the schedule, all that are needed by default; with the variables `held` given.
    """
    if groups is None:
        groups = [lowered.schedule.groups[k] for k in condition_groups(lowered, ids, families)]
    found = Dependence(lowered, groups, held)
    invariants, extra = ([found.of_rows(f.var_rows) for f in of] for of in (lowered.schedule.invariants, families))
    return _stack([found.of_residuals(), *invariants, found.of_values(ids), *extra])


class Dependence:
    """Which elements of (x, w) every variable depends on, and the residuals of the iterated equations.

    Dependence is propagated in evaluation order: what a block computes depends on what any of its inputs does. Where
    variables are `held`, what is computed from them does not depend on what they would be.
    """

    def __init__(self, lowered: Lowered, groups: Iterable[Group], held: Ints = NO_IDS) -> None:
        states, tears = lowered.schedule.states, lowered.schedule.tears
        known = np.concatenate([states, tears])
        self.n_z = len(known)
        self.tear_position = lowered.tear_position
        # sets of columns, one behind the other, and where those of each variable and of each residual are
        self.columns = np.arange(max(self.n_z, 1))
        self.used = self.n_z
        self.begin, self.count = np.zeros((2, lowered.n_ids), np.int64)
        self.begin[known], self.count[known] = np.arange(self.n_z), 1
        self.seen = np.ones(lowered.n_ids, bool)
        self.seen[held] = False
        self.seen[known] = True
        self.residual_begin, self.residual_count = np.zeros((2, len(tears)), np.int64)
        for group in groups:
            self._group(group)

    def of_values(self, ids: Ints) -> Any:
        """Pattern of the variables `ids` as they are computed."""
        return self._matrix(self.begin[ids], self.count[ids])

    def of_residuals(self) -> Any:
        """Pattern of the residuals, in the order of the algebraic unknowns."""
        return self._matrix(self.residual_begin, self.residual_count)

    def of_rows(self, var_rows: Ints) -> Any:
        """Pattern of equations between these variables, (n, any)."""
        return self._matrix(*self._union(var_rows))

    def _group(self, group: Group) -> None:
        iterated = group.unknowns[:, group.kernel.tears if group.kernel.iterates else ()]
        begin, count = self._union(np.concatenate([needs(group), iterated], axis=1))
        position = self.tear_position[iterated]
        self.residual_begin[position], self.residual_count[position] = begin[:, None], count[:, None]
        explicit = np.ones(group.kernel.size, bool)
        if group.kernel.iterates:
            explicit[list(group.kernel.tears)] = False
        ids = group.unknowns[:, explicit]
        self.begin[ids], self.count[ids] = begin[:, None], count[:, None]

    def _union(self, ids: Ints) -> tuple[Ints, Ints]:
        """Where the unions of the sets of the variables in each row are; they are appended."""
        n, width = ids.shape
        count = np.where(self.seen[ids], self.count[ids], 0).ravel()
        place = np.repeat(self.begin[ids].ravel() - np.cumsum(count) + count, count) + np.arange(count.sum())
        row = np.repeat(np.repeat(np.arange(n), width), count)
        keys = np.unique(row * max(self.n_z, 1) + self.columns[place])
        row, columns = np.divmod(keys, max(self.n_z, 1))
        while self.used + len(columns) > len(self.columns):
            self.columns = np.concatenate([self.columns, np.zeros_like(self.columns)])
        self.columns[self.used : self.used + len(columns)] = columns
        counts = np.bincount(row, minlength=n)
        begin = self.used + np.cumsum(counts) - counts
        self.used += len(columns)
        return begin, counts

    def _matrix(self, begin: Ints, count: Ints) -> Any:
        ends = np.cumsum(count)
        place = np.repeat(begin - ends + count, count) + np.arange(count.sum())
        shape = len(begin), self.n_z
        return sparse.csr_matrix((np.ones(len(place), bool), self.columns[place], np.r_[0, ends]), shape=shape)


def _stack(rows: list[Any]) -> Any:
    return sparse.vstack(rows, format="csr").astype(bool)
