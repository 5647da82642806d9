"""Which states the start leaves open: neither fixed starts nor initial equations determine them, so that guesses do."""

from __future__ import annotations

import numpy as np

from ..dae.dulmage_mendelsohn import dulmage_mendelsohn
from ..dae.incidence import Incidence
from ..dae.matching import maximum_matching
from ..language.template import Ints
from .initial import InitialProblem
from .sparsity import condition_pattern


def left_open(problem: InitialProblem) -> tuple[int, Ints]:
    """How many values guesses choose, and among which states, as positions in the state vector.

    By the pattern of the conditions: where some depend on others, as those of a planar loop in space do, more is open
    than is counted.
    """
    low = problem.lowered
    pattern = condition_pattern(low, problem.targets, problem.families).tocoo()
    fixed = np.flatnonzero(problem.fixed)
    rows = np.concatenate([pattern.row, pattern.shape[0] + np.arange(len(fixed))])
    columns = np.concatenate([pattern.col, fixed])
    graph = Incidence.from_coo(rows, columns, pattern.shape[0] + len(fixed), low.n_x + low.n_w)
    matching = np.asarray(maximum_matching(graph))
    open_columns = dulmage_mendelsohn(graph, matching).under_columns
    return graph.n_columns - int((matching >= 0).sum()), open_columns[open_columns < low.n_x]
