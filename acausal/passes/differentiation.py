"""The structural index: how often equations have to be differentiated for an ordinary differential equation in all
variables.

An equation differentiated c times gives the highest derivatives. An algebraic variable has a derivative only if the
equations that it follows from are differentiated once more; Pryce's index (2001, section 2), ``max c + 1`` wherever
there is an algebraic variable, takes all equations for such, and so counts one too many where no algebraic variable
follows from those with the largest c. Here they are told apart by the graph of the highest derivatives.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import breadth_first_order

from ..language.flat_model import Bools
from ..language.template import Ints
from .aliases import Reduced

if TYPE_CHECKING:
    from .structure import IndexReduced


def structural_index(reduced: Reduced, index: IndexReduced) -> int:
    """The largest number of differentiations of an equation, for derivatives of all variables.

    A variable that is but a name for a highest derivative (v in ``x = sin(t)``, ``v = x'``, or in ``v = x'``,
    ``v^3 + v = x``) is algebraic, though alias elimination has removed it.
    """
    top = np.flatnonzero(index.top_assignment >= 0)
    if not len(top):
        return 0
    column = index.top_assignment[top]
    count = differentiations(index, top)
    named = np.zeros(len(index.unknown), bool)
    declared = np.arange(reduced.flat.n_var)
    stands_for = reduced.representative[declared]
    named[stands_for[(stands_for != declared) & (reduced.sign[declared] != 0)]] = True
    deeper = _leads_to(index, top, (index.parent[column] < 0) | named[column])
    return int((count + deeper).max())


def differentiations(index: IndexReduced, top: Ints) -> Ints:
    """How often each of the rows `top` has been differentiated, that which went into combinations included."""
    row, before = top.copy(), index.row_integral
    count = np.zeros(len(top), np.int64)
    while True:
        more = before[row] >= 0
        if not more.any():
            break
        row = np.where(more, before[row], row)
        count += more
    if index.consumed:
        for i, r in enumerate(row.tolist()):
            family, k = index.rows.locate(r)
            count[i] += index.consumed.get((int(family.source[k]), int(family.ordinal[k])), 0)
    return count


def _leads_to(index: IndexReduced, top: Ints, wanted: Bools) -> Bools:
    """Which of the rows `top` the unknowns of the rows `wanted` follow from."""
    n = len(top)
    solved_by = np.full(len(index.unknown), -1, np.int64)
    solved_by[index.top_assignment[top]] = np.arange(n)
    graph = index.rows.incidence(len(index.unknown), solved_by >= 0).select(rows=top)
    starts = np.flatnonzero(wanted)
    from_ = np.concatenate([graph.edge_rows(), np.full(len(starts), n, np.int64)])
    to = np.concatenate([solved_by[graph.indices], starts])
    reached, _ = breadth_first_order(coo_matrix((np.ones(len(to)), (from_, to)), shape=(n + 1, n + 1)).tocsr(), n)
    out = np.zeros(n + 1, bool)
    out[np.asarray(reached)] = True
    return out[:n]
