import time

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import sparse

from acausal.dae.coloring import color_columns


@given(st.integers(0, 6), st.integers(0, 8), st.randoms())
def test_no_row_has_a_colour_twice(m: int, n: int, random) -> None:
    dense = np.array([[random.random() < 0.3 for _ in range(n)] for _ in range(m)], dtype=bool).reshape(m, n)
    colors = color_columns(sparse.csr_array(dense))
    assert colors.shape == (n,)
    for row in dense:
        used = colors[row].tolist()
        assert len(used) == len(np.unique(used))
    assert sorted(np.unique(colors).tolist()) == list(range(int(colors.max(initial=-1)) + 1))


@given(st.integers(0, 3), st.integers(0, 3), st.integers(1, 30))
def test_banded_patterns_need_the_bandwidth(below: int, above: int, n: int) -> None:
    dense = np.triu(np.tril(np.ones((n, n), dtype=bool), above), -below)
    assert int(color_columns(dense).max()) + 1 == int(dense.sum(axis=1).max())


@pytest.mark.parametrize("n", [200_000])
def test_scale(n: int) -> None:
    one = np.ones(n, dtype=bool)
    band = sparse.diags_array([one[1:], one, one[1:]], offsets=[-1, 0, 1], dtype=bool)
    began = time.process_time()
    assert int(color_columns(band.tocsr()).max()) == 2
    assert time.process_time() - began < 6
