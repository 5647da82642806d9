"""State selection: which variables are integrated, and which constraints stay as invariants.

Static dummy derivatives (Mattsson and Söderlind 1993) where the pivots are constants: every differentiated equation is
solved for a variable that then is no state. Where every choice of pivots can go singular over the motion (a pendulum in
Cartesian coordinates), all candidates stay states and the equation stays as an *invariant* onto which the solution is
projected after every step (Eich 1993, "Convergence results for a coordinate projection method"; Hairer and Wanner 1996,
VII.2): a choice that changes with the motion, without a switch.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..dae.incidence import Incidence
from ..dae.matching import transversal_basis
from ..dae.strong_components import block_lower_triangular
from ..language.flat_model import Bools, Family
from ..language.template import Ints
from ..symbolic.differentiate import partial
from ..symbolic.expr import Expr, var
from ..symbolic.isolate import Solvability, isolate
from ..symbolic.traverse import evaluate
from .structure import IndexReduced


@dataclass(frozen=True, slots=True, eq=False)
class Selected:
    """The outcome of state selection.

    Attributes:
        states: variables that are integrated, ascending.
        invariants: rows that remain as constraints on the states.
        assignment: matched column of every other row (-1 for invariants).
    """

    reduced: IndexReduced
    states: Ints
    invariants: Ints
    assignment: Ints


def select_states(reduced: IndexReduced, parameters: np.ndarray) -> Selected:
    """Choose states; `parameters` are the default values (for the rank of constant pivots)."""
    candidate = reduced.unknown & (reduced.derivative_of >= 0)
    lower = np.flatnonzero(reduced.row_derivative >= 0)
    assignment = reduced.top_assignment.copy()
    assignment[lower] = -1
    invariants = np.zeros(0, np.int64)
    if len(lower):
        solved = _solve_lower(reduced, lower, candidate, parameters)
        assignment[lower] = solved
        invariants = lower[solved < 0]
        candidate[solved[solved >= 0]] = False
    return Selected(reduced, np.flatnonzero(candidate), invariants, assignment)


def _solve_lower(reduced: IndexReduced, lower: Ints, candidate: Bools, parameters: np.ndarray) -> Ints:
    """Variable that each differentiated equation determines, -1 where no pivot is safe."""
    rows, columns, safe = _edges(reduced, lower)
    use = candidate[columns]
    rows, columns, safe = rows[use], columns[use], safe[use]
    ids, position = np.unique(columns, return_inverse=True)
    graph = Incidence.from_coo(rows, position, len(lower), len(ids))
    owner = np.repeat(np.arange(graph.n_rows), np.diff(graph.indptr))
    n = max(len(ids), 1)
    allowed = np.isin(owner * n + graph.indices, rows[safe] * n + position[safe])
    order = np.lexsort(_dislike(reduced, ids))
    column = np.asarray(transversal_basis(graph, order, allowed))
    matched = np.flatnonzero(column >= 0)
    unsafe = _unsafe_blocks(reduced, lower[matched], ids, graph, matched, column, parameters)
    column[matched[unsafe]] = -1
    return np.where(column >= 0, ids[np.maximum(column, 0)] if len(ids) else -1, -1)


def _dislike(reduced: IndexReduced, ids: Ints) -> tuple[Ints, ...]:
    """Sort keys (last is the most important): what should rather not be a state comes first."""
    order = np.zeros(len(ids), np.int64)
    at = ids.copy()
    while (reduced.parent[at] >= 0).any():
        order += reduced.parent[at] >= 0
        at = np.where(reduced.parent[at] >= 0, reduced.parent[at], at)
    flat = reduced.flat
    start_given = ~np.isnan(flat.start[ids])
    return -ids, start_given, flat.fixed[ids] == 1, flat.select[ids].astype(np.int64), -order


def _edges(reduced: IndexReduced, lower: Ints) -> tuple[Ints, Ints, Bools]:
    """(position in `lower`, variable, pivot is a non-zero constant) of every incidence."""
    rows: list[Ints] = []
    columns: list[Ints] = []
    safe: list[Bools] = []
    table = reduced.rows
    family_of = table.family_of[lower]
    for k in np.unique(family_of):
        family = table.families[int(k)]
        mine = np.flatnonzero(family_of == k)
        local = lower[mine] - table.offset[k]
        for slot in range(family.var_rows.shape[1]):
            columns.append(family.var_rows[local, slot])
            rows.append(mine)
            constant = isolate(family.residual, var(slot)).solvability <= Solvability.PARAMETER
            safe.append(np.full(len(mine), constant))
    return np.concatenate(rows), np.concatenate(columns), np.concatenate(safe)


def _unsafe_blocks(
    reduced: IndexReduced, rows: Ints, ids: Ints, graph: Incidence, matched: Ints, column: Ints, parameters: np.ndarray
) -> Bools:
    """Among the matched rows, those whose simultaneous system is not a constant non-singular matrix."""
    if not len(matched):
        return np.zeros(0, bool)
    new = np.full(len(ids), -1, np.int64)
    new[column[matched]] = np.arange(len(matched))
    owner = np.repeat(np.arange(graph.n_rows), np.diff(graph.indptr))
    position = np.full(graph.n_rows, -1, np.int64)
    position[matched] = np.arange(len(matched))
    keep = (position[owner] >= 0) & (new[graph.indices] >= 0)
    square = Incidence.from_coo(position[owner[keep]], new[graph.indices[keep]], len(matched), len(matched))
    blocks = block_lower_triangular(square, np.arange(len(matched)))
    size = np.diff(blocks.ptr)
    unsafe = np.zeros(len(matched), bool)
    for b in np.flatnonzero(size > 1):
        members = blocks.rows[blocks.ptr[b] : blocks.ptr[b + 1]]
        matrix = _constant_matrix(reduced, rows[members], ids[column[matched[members]]], parameters)
        if matrix is None or np.linalg.cond(matrix) > 1e10:
            unsafe[members] = True
    return unsafe


def _constant_matrix(reduced: IndexReduced, rows: Ints, ids: Ints, parameters: np.ndarray) -> np.ndarray | None:
    """Jacobian of `rows` with respect to `ids` if it depends on parameters only."""
    position = {int(v): j for j, v in enumerate(ids)}
    matrix = np.zeros((len(rows), len(ids)))
    for i, row in enumerate(rows):
        family, k = reduced.rows.locate(int(row))
        for slot, v in enumerate(family.var_rows[k].tolist()):
            if v in position:
                slope = partial(family.residual, var(slot))
                value = constant_value(slope, family, k, parameters)
                if value is None:
                    return None
                matrix[i, position[v]] = value
    scale = np.abs(matrix).max(axis=1, keepdims=True)
    return matrix / np.where(scale > 0, scale, 1)


def constant_value(expression: Expr, family: Family, row: int, parameters: np.ndarray) -> float | None:
    """Value of an expression of parameters in one row of a family, None if it depends on variables or time."""

    class _Depends(Exception):
        pass

    def leaf(node: Expr) -> float:
        if node.op != "par":
            raise _Depends
        return float(parameters[family.par_rows[row, node.value]])

    try:
        return float(evaluate((expression,), leaf, np)[0])
    except _Depends:
        return None
