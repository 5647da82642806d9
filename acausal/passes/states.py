"""State selection: which variables are integrated, and which constraints stay as invariants.

Static dummy derivatives (Mattsson and Söderlind 1993) where the pivots are constants: every differentiated equation is
solved for a variable that then is no state. Where every choice of pivots can go singular over the motion (a pendulum in
Cartesian coordinates, or a loop of links), all candidates stay states and the equation stays as an *invariant* onto
which the solution is projected after every step (Eich 1993, "Convergence results for a coordinate projection method";
Hairer and Wanner 1996, VII.2): a choice that changes with the motion, without a switch.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..dae.dulmage_mendelsohn import dulmage_mendelsohn
from ..dae.incidence import Incidence
from ..dae.matching import maximum_matching, transversal_basis
from ..dae.strong_components import block_lower_triangular
from ..language.declarations import STATE_SELECT
from ..language.flat_model import Bools, Family
from ..language.template import Ints
from ..symbolic.differentiate import partial
from ..symbolic.expr import Expr, var
from ..symbolic.isolate import Isolated, Solvability, isolate
from ..symbolic.traverse import evaluate
from .structure import IndexReduced

SINGULAR = 1e10
"""Condition number from which a matrix of constants is singular."""
DEFAULT, PREFER = STATE_SELECT.index("default"), STATE_SELECT.index("prefer")


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
    """Variable that each differentiated equation determines, -1 where no pivot is safe.

    An equation determines a variable of its own block of the highest-derivative system (Mattsson and Söderlind 1993,
    section 3.1). Where a block leaves no choice, the only variable is taken whatever its pivot: if that one vanishes,
    the model itself is singular there. Where the model says which variables it wants as states (joint coordinates,
    rather than what is computed from them), a variable of another block is taken as well, with a constant pivot.
    """
    rows, columns, kind = _edges(reduced, lower, parameters)
    select = _wishes(reduced, rows, columns)
    row_label, column_label = _top_blocks(reduced)
    use = candidate[columns] & _tight(reduced, lower[rows], columns)
    rows, columns, kind = rows[use], columns[use], kind[use]
    ids, position = np.unique(columns, return_inverse=True)
    graph = Incidence.from_coo(rows, position, len(lower), len(ids))
    owner = graph.edge_rows()
    kinds = np.empty(graph.n_edges, np.int64)
    key = owner * max(len(ids), 1) + graph.indices
    kinds[np.searchsorted(key, rows * max(len(ids), 1) + position)] = kind
    own = row_label[lower[owner]] == column_label[ids[graph.indices]]
    safe = kinds <= Solvability.PARAMETER
    inside = graph.keep_edges(own)
    parts = dulmage_mendelsohn(inside, np.asarray(maximum_matching(inside)))
    forced = np.zeros(len(lower), bool)
    forced[parts.square_rows] = True
    forced = _forced_throughout(reduced, lower, forced)
    wanted = bool((select[ids] > DEFAULT).any())
    elsewhere = ~own & safe & wanted
    allowed = own & (safe | forced[owner]) | elsewhere
    order = np.lexsort(_dislike(reduced, ids, select))
    while True:
        column = np.asarray(transversal_basis(graph, order, allowed))
        column = _avoid_iteration(graph, column, kinds, allowed, order)
        taken = (graph.indices == column[owner]) & ~own
        moved = np.zeros(len(lower), bool)
        moved[owner[taken]] = True
        spoilt = _spoilt(reduced, lower, ids, graph, column, moved, forced, parameters)
        if not spoilt.any():
            break
        allowed &= ~(taken & spoilt[owner])
    matched = np.flatnonzero((column >= 0) & (~forced | moved))
    unsafe = _unsafe_blocks(reduced, lower[matched], ids, graph, matched, column, parameters)
    column[matched[unsafe]] = -1
    return np.where(column >= 0, ids[np.maximum(column, 0)] if len(ids) else -1, -1)


def _forced_throughout(reduced: IndexReduced, lower: Ints, forced: Bools) -> Bools:
    """Rows that leave no choice at their own level nor, differentiated, at a higher one.

    An orientation is differentiated by its angular velocity: a constraint of positions then shows no choice between a
    slider and an angle, that of velocities does, and the slider's pivot may vanish where the model is sound.
    """
    position = np.full(len(reduced.row_derivative), -1, np.int64)
    position[lower] = np.arange(len(lower))
    above = position[reduced.row_derivative[lower]]
    out = forced.copy()
    while True:
        free = out & (above >= 0) & ~out[above]
        if not free.any():
            return out
        out[free] = False


def _avoid_iteration(graph: Incidence, column: Ints, kinds: Ints, allowed: Bools, order: Ints) -> Ints:
    """Where an equation would have to be solved by iteration, let it determine a variable of another block instead."""
    owner = graph.edge_rows()
    bad = (graph.indices == column[owner]) & (kinds == Solvability.NONLINEAR)
    if not bad.any():
        return column
    before = column.copy()
    before[owner[bad]] = -1
    explicit = kinds < Solvability.NONLINEAR
    safe = kinds <= Solvability.PARAMETER
    wider = np.asarray(maximum_matching(graph, allowed=(allowed & explicit) | safe, initial=before))
    if (wider[column >= 0] < 0).any():
        return column
    taken = graph.indices == wider[owner]
    return np.asarray(transversal_basis(graph, order, (allowed & explicit) | taken))


def _top_blocks(reduced: IndexReduced) -> tuple[Ints, Ints]:
    """Block of the highest-derivative system that every row and every column (of any order) belongs to."""
    top_rows = np.flatnonzero(reduced.row_derivative < 0)
    top = reduced.unknown & (reduced.derivative_of < 0)
    graph = reduced.rows.incidence(len(top), top).select(rows=top_rows)
    blocks = block_lower_triangular(graph, reduced.top_assignment[top_rows])
    row_label = np.full(len(reduced.row_derivative), -1, np.int64)
    column_label = np.full(len(top), -2, np.int64)
    row_label[top_rows] = blocks.block_of_row
    column_label[reduced.top_assignment[top_rows]] = blocks.block_of_row
    return _inherit(row_label, reduced.row_derivative), _inherit(column_label, reduced.derivative_of)


def _inherit(label: Ints, derivative: Ints) -> Ints:
    """Labels of the highest derivatives, handed down to what they are derivatives of."""
    while True:
        below = np.flatnonzero((label < 0) & (derivative >= 0))
        ready = below[label[derivative[below]] >= 0]
        if not len(ready):
            return label
        label[ready] = label[derivative[ready]]


def _height(derivative: Ints) -> Ints:
    """How many more derivatives there are above each row or column."""
    height = np.zeros(len(derivative), np.int64)
    at = derivative.copy()
    while (at >= 0).any():
        height += at >= 0
        at = np.where(at >= 0, derivative[at], -1)
    return height


def _tight(reduced: IndexReduced, rows: Ints, columns: Ints) -> Bools:
    """Whether a column is a leading variable of a row: both have as many derivatives above them."""
    return _height(reduced.row_derivative)[rows] == _height(reduced.derivative_of)[columns]


def _wishes(reduced: IndexReduced, rows: Ints, columns: Ints) -> Ints:
    """What the model says of each variable as a state, from the incidences of the differentiated equations.

    A relative coordinate that is preferred is no better a state than what moves, if its other side is prescribed: that
    may be held or extrapolated from outside, and a jump of it would move the masses.
    """
    select = reduced.flat.select.astype(np.int64)
    if not (select[columns] == PREFER).any():
        return select
    given = np.zeros(len(select), bool)
    while True:
        left = np.bincount(rows[~given[columns]], minlength=int(rows.max(initial=-1)) + 1)
        found = columns[(left[rows] == 1) & ~given[columns]]
        if not len(found):
            break
        given[found] = True
    beside = np.zeros(len(left), bool)
    beside[rows[given[columns]]] = True
    beside &= left == 2
    demoted = columns[beside[rows] & ~given[columns]]
    select[demoted] = np.where(select[demoted] == PREFER, DEFAULT, select[demoted])
    return select


def _dislike(reduced: IndexReduced, ids: Ints, select: Ints) -> tuple[Ints, ...]:
    """Sort keys (last is the most important): what should rather not be a state comes first."""
    order = np.zeros(len(ids), np.int64)
    at = ids.copy()
    while (reduced.parent[at] >= 0).any():
        order += reduced.parent[at] >= 0
        at = np.where(reduced.parent[at] >= 0, reduced.parent[at], at)
    flat = reduced.flat
    start_given = ~np.isnan(flat.start[ids])
    return -ids, start_given, flat.fixed[ids] == 1, select[ids], -order


def _kinds(found: Isolated, family: Family, rows: Ints, parameters: np.ndarray) -> Ints:
    """`Solvability` of each row; a coefficient of parameters that is zero at their default values is not safe."""
    kinds = np.full(len(rows), int(found.solvability))
    if found.solvability == Solvability.PARAMETER:
        values = [constant_value(found.coefficient, family, int(row), parameters) for row in rows]
        kinds[[v is not None and v == 0.0 for v in values]] = Solvability.VARIABLE
    return kinds


def _edges(reduced: IndexReduced, lower: Ints, parameters: np.ndarray) -> tuple[Ints, Ints, Ints]:
    """(position in `lower`, variable, `Solvability`) of every incidence."""
    rows: list[Ints] = []
    columns: list[Ints] = []
    kinds: list[Ints] = []
    table = reduced.rows
    family_of = table.family_of[lower]
    for k in np.unique(family_of):
        family = table.families[int(k)]
        mine = np.flatnonzero(family_of == k)
        local = lower[mine] - table.offset[k]
        for slot in range(family.var_rows.shape[1]):
            columns.append(family.var_rows[local, slot])
            rows.append(mine)
            kinds.append(_kinds(isolate(family.residual, var(slot)), family, local, parameters))
    return np.concatenate(rows), np.concatenate(columns), np.concatenate(kinds)


def _unsafe_blocks(
    reduced: IndexReduced, rows: Ints, ids: Ints, graph: Incidence, matched: Ints, column: Ints, parameters: np.ndarray
) -> Bools:
    """Among the matched rows, those whose simultaneous system is not a constant non-singular matrix."""
    unsafe = np.zeros(len(matched), bool)
    for members in _simultaneous(graph, matched, column, len(ids)):
        matrix = _constant_matrix(reduced, rows[members], ids[column[matched[members]]], parameters)
        if matrix is None or np.linalg.cond(matrix) > SINGULAR:
            unsafe[members] = True
    return unsafe


def _spoilt(
    reduced: IndexReduced, lower: Ints, ids: Ints, graph: Incidence, column: Ints, moved: Bools, forced: Bools,
    parameters: np.ndarray,
) -> Bools:  # fmt: skip
    """Rows that determine a variable of another block, and with rows that leave no choice say the same of it.

    Two springs side by side with nothing that moves between them: both relative positions are wanted as states, and the
    places of their two ends would follow from either.
    """
    spoilt = np.zeros(len(lower), bool)
    mixed = moved.any() and (forced & ~moved).any()
    matched = np.flatnonzero(column >= 0) if mixed else np.zeros(0, np.int64)
    for members in _simultaneous(graph, matched, column, len(ids)):
        rows = matched[members]
        if not moved[rows].any() or not (forced & ~moved)[rows].any():
            continue
        matrix = _constant_matrix(reduced, lower[rows], ids[column[rows]], parameters)
        if matrix is not None and np.linalg.cond(matrix) > SINGULAR:
            spoilt[rows] = moved[rows]
    return spoilt


def _simultaneous(graph: Incidence, matched: Ints, column: Ints, n_columns: int) -> list[Ints]:
    """Positions in `matched` of the rows of each block of more than one."""
    if not len(matched):
        return []
    new = np.full(n_columns, -1, np.int64)
    new[column[matched]] = np.arange(len(matched))
    owner = graph.edge_rows()
    position = np.full(graph.n_rows, -1, np.int64)
    position[matched] = np.arange(len(matched))
    keep = (position[owner] >= 0) & (new[graph.indices] >= 0)
    square = Incidence.from_coo(position[owner[keep]], new[graph.indices[keep]], len(matched), len(matched))
    blocks = block_lower_triangular(square, np.arange(len(matched)))
    return [blocks.rows[blocks.ptr[b] : blocks.ptr[b + 1]] for b in np.flatnonzero(np.diff(blocks.ptr) > 1)]


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
