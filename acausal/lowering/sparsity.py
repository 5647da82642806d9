"""Which state and algebraic unknown each derivative and residual depends on, through the whole schedule."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from scipy import sparse

from ..language.template import Ints
from ..passes.schedule import Group, needs

if TYPE_CHECKING:
    from .lowered import Lowered


def jacobian_pattern(lowered: Lowered, groups: list[int]) -> Any:
    """Pattern of d(dx, r)/d(x, w), a boolean CSR matrix (n_x + n_w, n_x + n_w).

    Dependence is propagated in evaluation order: what a block computes depends on all that any of its inputs depends on.
    """
    schedule = lowered.schedule
    n_z = lowered.n_x + lowered.n_w
    known = np.concatenate([schedule.states, schedule.tears])
    depends = _pattern(known, np.arange(n_z), lowered.n_ids, n_z)
    residual_rows: list[Any] = []
    tear_column = np.full(lowered.n_ids, -1, np.int64)
    tear_column[schedule.tears] = lowered.n_x + np.arange(lowered.n_w)
    for k in groups:
        group = schedule.groups[k]
        rows = _inputs_of(group, lowered.n_ids) @ depends
        if group.kernel.iterates:
            own = tear_column[group.unknowns[:, group.kernel.tears]]
            rows = rows + _pattern(np.repeat(np.arange(group.size), own.shape[1]), own.ravel(), group.size, n_z)
            residual_rows.append(rows[np.repeat(np.arange(group.size), own.shape[1])])
        explicit = [u for u in range(group.kernel.size) if not (group.kernel.iterates and u in group.kernel.tears)]
        coo = rows.tocoo()
        for u in explicit:
            depends = depends + _pattern(group.var_rows[coo.row, u], coo.col, lowered.n_ids, n_z)
    pattern = sparse.vstack([depends[lowered.dx_ids], *residual_rows], format="csr").astype(bool)
    pattern.sum_duplicates()
    return pattern


def _pattern(rows: Ints, columns: Ints, n: int, m: int) -> Any:
    return sparse.csr_matrix((np.ones(len(rows), bool), (rows, columns)), shape=(n, m))


def _inputs_of(group: Group, n_ids: int) -> Any:
    external = needs(group)
    n, e = external.shape
    return sparse.csr_matrix((np.ones(n * e, bool), external.ravel(), np.arange(n + 1) * e), shape=(n, n_ids))
