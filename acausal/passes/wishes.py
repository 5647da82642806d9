"""Variables that are wanted as states although no equation holds their derivative.

A spring and damper computes ``v_rel == der(s_rel)``, and prefers both as states; that counts "also if the variable does
not appear differentiated" (Modelica Language Specification 3.6, section 4.8.7.1). So such a variable gets a derivative,
and the model is analysed again, where it follows from other states by linear relations with constant coefficients:
kinematics. What follows from forces, signals or switches is left alone: its derivative may not exist, and would make
the index higher. Long chains keep their absolute coordinates: those would be sums of all the relative ones before them,
one after the other, with dense Jacobians where start values are given for them.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import breadth_first_order, connected_components

from ..language.declarations import STATE_SELECT
from ..language.flat_model import Bools, Family, FlatModel
from ..language.template import Ints
from ..symbolic.differentiate import partial
from ..symbolic.expr import var
from ..symbolic.traverse import leaves
from .aliases import Reduced
from .structure import IndexReduced, extended

PREFER = STATE_SELECT.index("prefer")
MOST = 50
"""More wishes than this that are related to each other are a long chain."""


def wished_states(reduced: Reduced, index: IndexReduced) -> Ints:
    """Declared variables that are wanted as states and have no derivative, but may have one."""
    flat, n = reduced.flat, len(index.unknown)
    wanted = np.flatnonzero(flat.select[: flat.n_var] >= PREFER)
    wanted = wanted[(reduced.sign[wanted] != 0) & (index.derivative_of[reduced.representative[wanted]] < 0)]
    if not len(wanted):
        return wanted
    top = np.flatnonzero(index.top_assignment >= 0)
    solved_by = np.full(n, -1, np.int64)
    solved_by[index.top_assignment[top]] = np.arange(len(top))
    graph = index.rows.incidence(n, solved_by >= 0).select(rows=top)
    from_, to = graph.edge_rows(), solved_by[graph.indices]
    first = solved_by[reduced.representative[wanted]]
    reached = _reached(len(top), first, from_, to)
    others = np.flatnonzero(reached)[~_kinematic(index, top[reached])]
    possible = ~_reached(len(top), others, to, from_)[first]
    wanted, first = wanted[possible], first[possible]
    return wanted[~_chained(index, top[first])]


def with_derivatives(written: FlatModel, variables: Ints) -> FlatModel:
    """A copy of `written` in which these variables have derivatives, which are in no equation."""
    derivative_of = np.concatenate([written.derivative_of, np.full(len(variables), -1, np.int64)])
    derivative_of[variables] = written.n_total + np.arange(len(variables))
    return extended(written, derivative_of, np.concatenate([written.parent, variables]))


def _reached(n: int, starts: Ints, from_: Ints, to: Ints) -> Bools:
    """Nodes that edges lead to from `starts`, these included."""
    begin = np.concatenate([from_, np.full(len(starts), n, np.int64)])
    end = np.concatenate([to, starts])
    graph = coo_matrix((np.ones(len(end)), (begin, end)), shape=(n + 1, n + 1)).tocsr()
    order, _ = breadth_first_order(graph, n)
    out = np.zeros(n + 1, bool)
    out[np.asarray(order)] = True
    return out[:n]


def _chained(index: IndexReduced, wishes: Ints) -> Bools:
    """Which of the rows `wishes` are related to more than `MOST` of them by variables that equations share."""
    if len(wishes) <= MOST:
        return np.zeros(len(wishes), bool)
    m, n = len(index.rows), len(index.unknown)
    graph = index.rows.incidence(n, np.ones(n, bool))
    shared = coo_matrix((np.ones(len(graph.indices)), (graph.edge_rows(), m + graph.indices)), shape=(m + n, m + n))
    _, label = connected_components(shared, directed=False)
    return np.bincount(label[wishes], minlength=m + n)[label[wishes]] > MOST


def _kinematic(index: IndexReduced, rows: Ints) -> Bools:
    """Which of the rows are linear in all their variables, with numbers and tunable parameters as coefficients."""
    table = index.rows
    out = np.zeros(len(rows), bool)
    family_of = table.family_of[rows]
    for k in np.unique(family_of):
        family = table.families[int(k)]
        mine = np.flatnonzero(family_of == k)
        if _linear(family):
            out[mine] = (family.par_rows[rows[mine] - table.offset[k]] < index.flat.n_par).all(axis=1)
    return out


def _linear(family: Family) -> bool:
    """Whether the residual is linear in its variables, with coefficients of parameters, and independent of time."""
    slopes = [partial(family.residual, var(k)) for k in range(family.var_rows.shape[1])]
    return all(leaf.op == "par" for leaf in leaves(*slopes)) and not leaves(family.residual, op="time")
