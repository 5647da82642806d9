import numpy as np
import pytest
from dae_helpers import adjacency, incidences
from hypothesis import given
from hypothesis import strategies as st

from acausal.dae.incidence import Incidence


@given(st.lists(st.tuples(st.integers(0, 4), st.integers(0, 5))))
def test_from_coo_sorts_and_removes_repeats(pairs: list[tuple[int, int]]) -> None:
    g = Incidence.from_coo([r for r, _ in pairs], [c for _, c in pairs], 5, 6)
    assert adjacency(g) == [sorted({c for r, c in pairs if r == i}) for i in range(5)]
    assert g.indptr.dtype == g.indices.dtype == np.int64


@given(incidences())
def test_transpose(g: Incidence) -> None:
    t, edges = g.transpose_with_edges()
    assert adjacency(t) == [[i for i in range(g.n_rows) if j in g.row(i)] for j in range(g.n_columns)]
    assert np.array_equal(g.indices[edges], t.edge_rows())
    assert np.array_equal(g.edge_rows()[edges], t.indices)
    assert adjacency(t.transpose()) == adjacency(g)


@given(incidences(), st.data())
def test_select(g: Incidence, data: st.DataObject) -> None:
    rows = data.draw(st.lists(st.integers(0, g.n_rows - 1), max_size=5)) if g.n_rows else []
    mask = data.draw(st.lists(st.booleans(), min_size=g.n_columns, max_size=g.n_columns))
    s = g.select(np.array(rows, dtype=np.int64), np.array(mask, dtype=bool))
    assert adjacency(s) == [[j for j in g.row(i).tolist() if mask[j]] for i in rows]
    assert s.n_columns == g.n_columns


@given(incidences())
def test_to_scipy(g: Incidence) -> None:
    dense = g.to_scipy().toarray()
    assert adjacency(g) == [np.flatnonzero(row).tolist() for row in dense]


def test_pairs_outside_the_shape_are_refused() -> None:
    with pytest.raises(ValueError, match=r"outside the shape \(2, 2\)"):
        Incidence.from_coo([0], [2], 2, 2)
