"""Which state and algebraic unknown each derivative and residual depends on, through the whole schedule."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from scipy import sparse

from ..language.flat_model import Family
from ..language.template import Ints
from ..passes.schedule import needs

if TYPE_CHECKING:
    from .lowered import Lowered


def jacobian_pattern(lowered: Lowered, groups: list[int]) -> Any:
    """Pattern of d(dx, r)/d(x, w), a boolean CSR matrix (n_x + n_w, n_x + n_w)."""
    depends, residual_rows = dependence(lowered, groups)
    return _stack([depends[lowered.dx_ids], *residual_rows])


def condition_pattern(lowered: Lowered, ids: Ints, families: list[Family]) -> Any:
    """Pattern of d(r, variables `ids`, residuals of `families`)/d(x, w), a boolean CSR matrix."""
    needed = np.concatenate([ids, *(f.var_rows.ravel() for f in families)])
    depends, residual_rows = dependence(lowered, lowered.closure(needed, residuals=True))
    rows = [_ones(f.var_rows, lowered.n_ids) @ depends for f in families]
    return _stack([*residual_rows, depends[ids], *rows])


def dependence(lowered: Lowered, groups: list[int]) -> tuple[Any, list[Any]]:
    """Which elements of (x, w) every variable depends on, (n_ids, n_x + n_w), and the same of the residuals r.

    Dependence is propagated in evaluation order: what a block computes depends on what any of its inputs does.
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
        rows = _ones(needs(group), lowered.n_ids) @ depends
        if group.kernel.iterates:
            own = tear_column[group.unknowns[:, group.kernel.tears]]
            rows = rows + _pattern(np.repeat(np.arange(group.size), own.shape[1]), own.ravel(), group.size, n_z)
            residual_rows.append(rows[np.repeat(np.arange(group.size), own.shape[1])])
        explicit = [u for u in range(group.kernel.size) if not (group.kernel.iterates and u in group.kernel.tears)]
        coo = rows.tocoo()
        for u in explicit:
            depends = depends + _pattern(group.var_rows[coo.row, u], coo.col, lowered.n_ids, n_z)
    return depends, residual_rows


def _stack(rows: list[Any]) -> Any:
    pattern: Any = sparse.vstack(rows, format="csr").astype(bool)
    pattern.sum_duplicates()
    return pattern


def _pattern(rows: Ints, columns: Ints, n: int, m: int) -> Any:
    return sparse.csr_matrix((np.ones(len(rows), bool), (rows, columns)), shape=(n, m))


def _ones(columns: Ints, n_ids: int) -> Any:
    """Row i has ones in `columns[i]`."""
    n, e = columns.shape
    matrix = sparse.csr_matrix((np.ones(n * e, bool), columns.ravel(), np.arange(n + 1) * e), shape=(n, n_ids))
    matrix.sum_duplicates()
    return matrix
