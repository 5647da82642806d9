"""Blocks of equations whose Jacobian with respect to their highest derivatives is singular for all values.

Judged by numbers: a Jacobian that is singular at several points in general position is singular everywhere.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import splu

from ..language.flat_model import Bools, Family
from ..language.template import Floats, Ints
from ..symbolic.expr import Expr
from ..symbolic.gradient import Sampler
from .combine import Point, scaled
from .structure import Blocks, IndexReduced

Parameters = Callable[[np.random.Generator], Floats]
"""Parameter values in general position, from a random generator."""

POINTS = 6
"""Sample points; a Jacobian that is singular at all of them is singular for all values, with probability one."""
DENSE = 400
"""Blocks up to this size are judged by their singular values, larger ones by a sparse factorisation."""
SINGULAR = 1e-10
"""Smallest singular value relative to the largest, after scaling, below which a matrix may be singular."""


def point_nearby(index: IndexReduced, parameters: Parameters, random: np.random.Generator) -> Point:
    """Values in general position near the defaults."""
    flat, n = index.flat, len(index.unknown)
    more = (0, n - len(flat.start))
    start = np.pad(np.nan_to_num(flat.start), more)
    nominal = np.pad(flat.nominal, more, constant_values=np.nan)
    nominal = np.where(np.isnan(nominal), np.maximum(np.abs(start), 1.0), nominal)
    noise = random.uniform(0.01, 0.1, (2, n))
    return start * (1 + noise[0]) + nominal * noise[1], parameters(random), float(random.uniform(0.1, 1.0))


def always_singular(
    index: IndexReduced, blocks: Blocks, alive: Bools, parameters: Parameters, random: np.random.Generator
) -> Bools:
    """Which of the blocks `alive` have a singular Jacobian at each of several points.

    Args:
        index: the equations.
        blocks: their blocks.
        alive: mask of the blocks to be judged, (blocks,).
        parameters: draws parameter values.
        random: draws the points.

    Returns:
        mask (blocks,).
    """
    seen = np.zeros_like(alive)
    for k in range(POINTS):
        if not alive.any():
            break
        found, finite = _singular_at(index, blocks, alive, point_nearby(index, parameters, random), k, random)
        alive = alive & (found | ~finite)
        seen |= found
    return alive & seen


def _singular_at(
    index: IndexReduced, blocks: Blocks, alive: Bools, point: Point, k: int, random: np.random.Generator
) -> tuple[Bools, Bools]:
    """Which of the blocks `alive` have a singular Jacobian at a point, and which have a finite one."""
    values, parameters, time = point
    of_row = blocks.block_of_row
    position = np.full(len(index.rows), -1, np.int64)
    position[blocks.rows] = np.arange(len(blocks.rows))
    column = np.full(len(index.unknown), -1, np.int64)
    column[blocks.columns] = np.arange(len(blocks.columns))
    i_all: list[Ints] = [np.zeros(0, np.int64)]
    j_all: list[Ints] = [np.zeros(0, np.int64)]
    v_all: list[Floats] = [np.zeros(0)]
    family_of = index.rows.family_of[blocks.rows]
    take = alive[of_row]
    for f in np.unique(family_of[take]):
        family = index.families[int(f)]
        rows = blocks.rows[take & (family_of == f)]
        local = rows - index.rows.offset[f]

        def leaf(node: Expr, family: Family = family, local: Ints = local) -> Any:
            if node.op == "time":
                return time
            if node.op == "par":
                return parameters[family.par_rows[local, node.value]]
            return values[family.var_rows[local, node.value]]

        branch = (lambda: True, lambda: False, lambda: bool(random.integers(2)))[min(k, 2)]
        sampler = Sampler(leaf, branch, lambda: float(random.uniform(0.5, 1.5)))
        for node, slope in sampler.gradient(family.residual).items():
            if node.op != "var":
                continue
            j = column[family.var_rows[local, node.value]]
            i = position[rows]
            same = (j >= 0) & (of_row[i] == of_row[j])
            i_all.append(i[same])
            j_all.append(j[same])
            v_all.append(np.broadcast_to(slope, i.shape)[same])
    i, j, v = np.concatenate(i_all), np.concatenate(j_all), np.concatenate(v_all)
    return _judge(blocks, alive, of_row, i, j, v)


def _judge(blocks: Blocks, alive: Bools, of_row: Ints, i: Ints, j: Ints, v: Floats) -> tuple[Bools, Bools]:
    n, size = len(alive), np.diff(blocks.ptr)
    finite = np.ones(n, bool)
    finite[of_row[i[~np.isfinite(v)]]] = False
    singular = np.zeros(n, bool)
    ok = alive & finite
    for m in np.unique(size[ok]).tolist():
        chosen = np.flatnonzero(ok & (size == m))
        if m > DENSE:
            for b in chosen:
                mine = of_row[i] == b
                start = blocks.ptr[b]
                matrix = sparse.coo_array((v[mine], (i[mine] - start, j[mine] - start)), (m, m))
                singular[b] = _sparse_singular(matrix.tocsc())
            continue
        rank = np.full(n, -1, np.int64)
        rank[chosen] = np.arange(len(chosen))
        mine = rank[of_row[i]] >= 0
        dense = np.zeros((len(chosen), m, m))
        b = of_row[i[mine]]
        np.add.at(dense, (rank[b], i[mine] - blocks.ptr[b], j[mine] - blocks.ptr[b]), v[mine])
        if m == 1:
            singular[chosen] = dense[:, 0, 0] == 0
            continue
        sigma = np.linalg.svd(scaled(dense), compute_uv=False)
        singular[chosen] = sigma[:, -1] <= SINGULAR * sigma[:, 0]
    return singular, finite


def _sparse_singular(matrix: sparse.csc_array) -> bool:
    for axis in (1, 0):
        size = np.asarray(abs(matrix).max(axis=axis).todense()).ravel()
        factor = sparse.diags_array(1 / np.where(size > 0, size, 1.0))
        matrix = sparse.csc_array(factor @ matrix if axis == 1 else matrix @ factor)
    try:
        pivots = np.abs(splu(matrix).U.diagonal())
    except RuntimeError:
        return True
    return bool(pivots.min() <= SINGULAR * 1e-3 * pivots.max())
