import itertools
import time

import numpy as np
import pytest
from dae_helpers import adjacency, chain, incidences, slow_matching
from hypothesis import given
from hypothesis import strategies as st

from acausal.dae.incidence import Incidence
from acausal.dae.matching import check_matching, maximum_matching, transversal_basis


@given(incidences())
def test_maximum(g: Incidence) -> None:
    m = maximum_matching(g)
    check_matching(g, m)
    assert int((m >= 0).sum()) == len(slow_matching(adjacency(g)))


@given(incidences(), st.data())
def test_maximum_with_allowed_edges_and_initial(g: Incidence, data: st.DataObject) -> None:
    allowed = np.array(data.draw(st.lists(st.booleans(), min_size=g.n_edges, max_size=g.n_edges)), dtype=bool)
    kept = g.keep_edges(allowed)
    m = maximum_matching(g, allowed=allowed)
    check_matching(kept, m)
    assert int((m >= 0).sum()) == len(slow_matching(adjacency(kept)))
    dropped = np.array(data.draw(st.lists(st.booleans(), min_size=g.n_rows, max_size=g.n_rows)), dtype=bool)
    start = np.where(dropped, -1, m)
    again = maximum_matching(g, allowed=allowed, initial=start)
    check_matching(kept, again)
    assert int((again >= 0).sum()) == int((m >= 0).sum())
    assert sorted(start[start >= 0].tolist()) == [j for j in sorted(start.tolist()) if j >= 0 and j in again]


@given(incidences(5, 6), st.randoms())
def test_transversal_basis_is_lexicographically_best(g: Incidence, random) -> None:
    order = list(range(g.n_columns))
    random.shuffle(order)
    order = order[: random.randint(0, len(order))]
    m = transversal_basis(g, np.array(order, dtype=np.int64))
    check_matching(g, m)
    rows = adjacency(g)
    size = len(slow_matching(rows, order))
    best = next(s for s in itertools.combinations(range(len(order)), size) if _independent(rows, [order[k] for k in s]))
    assert sorted(order.index(j) for j in m.tolist() if j >= 0) == list(best)


def _independent(rows: list[list[int]], columns: list[int]) -> bool:
    return len(slow_matching(rows, columns)) == len(columns)


def test_wrong_initial_is_refused() -> None:
    g = Incidence.from_rows([[0], [0, 1]], 2)
    with pytest.raises(ValueError, match="matched to two rows"):
        maximum_matching(g, initial=np.array([0, 0]))
    with pytest.raises(ValueError, match="does not touch"):
        maximum_matching(g, initial=np.array([1, -1]))


def test_scale() -> None:
    n = 100_000
    g = chain(n)
    began = time.process_time()
    assert (maximum_matching(g) >= 0).all()
    broken = np.arange(n)
    broken[7] = -1
    assert (maximum_matching(g, initial=broken) >= 0).all()
    wide = g.select(np.arange(0, n, 2))  # twice as many columns as rows: every column is a matter of choice
    assert (transversal_basis(wide, np.arange(n)) >= 0).all()
    assert time.process_time() - began < 10
