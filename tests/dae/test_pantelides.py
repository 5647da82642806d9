import time

import numpy as np
import pytest
from dae_helpers import adjacency
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import linear_sum_assignment

from acausal.dae.incidence import Incidence
from acausal.dae.matching import check_matching
from acausal.dae.pantelides import StructurallySingular, base_and_order, pantelides

_ABSENT = -1000


def _system(sigma: np.ndarray) -> tuple[Incidence, np.ndarray]:
    """Incidence and derivative chains of a signature matrix (entry: highest derivative of variable j in row i)."""
    m, n = sigma.shape
    first, derivative_of, column = [], [], {}
    for j in range(n):
        top = max(int(sigma[:, j].max(initial=0)), 0)
        first.append(len(derivative_of))
        for order in range(top + 1):
            column[j, order] = len(derivative_of)
            derivative_of.append(len(derivative_of) + 1 if order < top else -1)
    rows = [[column[j, int(sigma[i, j])] for j in range(n) if sigma[i, j] >= 0] for i in range(m)]
    return Incidence.from_rows(rows, len(derivative_of)), np.array(derivative_of)


def _pryce(sigma: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
    """Smallest dual solution by fixed-point iteration (Pryce 2001, Algorithm 3.1), None if singular."""
    rows, cols = linear_sum_assignment(sigma, maximize=True)
    if len(rows) and sigma[rows, cols].min() < 0:
        return None
    c = np.zeros(len(sigma), dtype=int)
    while True:
        d = (sigma + c[:, None]).max(axis=0, initial=_ABSENT)
        new = d[cols] - sigma[rows, cols]
        if (new == c).all():
            return c, d
        c = new


@given(st.integers(1, 6).flatmap(lambda n: st.lists(
    st.lists(st.sampled_from([_ABSENT, _ABSENT, _ABSENT, 0, 0, 1, 2]), min_size=n, max_size=n),
    min_size=n, max_size=n)))  # fmt: skip
def test_smallest_dual_solution(entries: list[list[int]]) -> None:
    sigma = np.array(entries)
    g, derivative_of = _system(sigma)
    expected = _pryce(sigma)
    if expected is None:
        with pytest.raises(StructurallySingular) as caught:
            pantelides(g, derivative_of)
        assert len(caught.value.unmatched_rows) > 0
        return
    r = pantelides(g, derivative_of)
    c, d = expected
    assert r.equation_order.tolist() == c.tolist()
    assert r.variable_order[r.variable_order >= 0].tolist() == np.maximum(d, 0).tolist()
    _check_result(g, r)


def _check_result(g: Incidence, r) -> None:
    check_matching(r.incidence, r.assignment)
    last = r.row_derivative_of < 0
    assert (r.assignment[last] >= 0).all() and (r.assignment[~last] == -1).all()
    assert (r.derivative_of[r.assignment[last]] == -1).all()
    rows = adjacency(r.incidence)
    assert rows[: g.n_rows] == adjacency(g)
    for k, parent in enumerate(r.new_rows.tolist()):
        assert r.row_derivative_of[parent] == g.n_rows + k
        assert rows[g.n_rows + k] == sorted({*rows[parent], *(int(r.derivative_of[j]) for j in rows[parent])})
    for k, parent in enumerate(r.new_columns.tolist()):
        assert r.derivative_of[parent] == g.n_columns + k


@given(st.lists(st.lists(st.sampled_from([_ABSENT, 0, 1]), min_size=5, max_size=5), min_size=0, max_size=4))
def test_fewer_rows_than_variables(entries: list[list[int]]) -> None:
    sigma = np.array(entries, dtype=int).reshape(-1, 5)
    g, derivative_of = _system(sigma)
    try:
        r = pantelides(g, derivative_of)
    except StructurallySingular:
        return
    _check_result(g, r)
    shuffled = pantelides(g.select(np.arange(g.n_rows)[::-1]), derivative_of)
    assert shuffled.equation_order[::-1].tolist() == r.equation_order.tolist()


def test_first_order_pendulum() -> None:
    # columns x, y, u, v, T, x', y', u', v'
    g = Incidence.from_rows([[2, 5], [3, 6], [0, 4, 7], [1, 4, 8], [0, 1]], 9)
    r = pantelides(g, np.array([5, 6, 7, 8, -1, -1, -1, -1, -1]))
    assert r.equation_order.tolist() == [1, 1, 0, 0, 2]
    assert r.variable_order.tolist() == [2, 2, 1, 1, 0, -1, -1, -1, -1]
    assert r.structural_index == 3


def test_chains_must_be_chains() -> None:
    with pytest.raises(ValueError, match="same derivative"):
        base_and_order(np.array([2, 2, -1]))
    with pytest.raises(ValueError, match="derivative of itself"):
        base_and_order(np.array([1, 0]))


def rigid_pairs(n: int) -> tuple[Incidence, np.ndarray]:
    """n pairs of masses with equal positions: columns s1, v1, s2, v2, f, s1', v1', s2', v2' of each pair."""
    pair = np.array([(0, 1), (0, 5), (1, 6), (1, 4), (2, 3), (2, 7), (3, 8), (3, 4), (4, 0), (4, 2)])
    k = np.arange(n)[:, None]
    g = Incidence.from_coo((5 * k + pair[:, 0]).ravel(), (9 * k + pair[:, 1]).ravel(), 5 * n, 9 * n)
    return g, (np.array([5, 6, 7, 8, -n * 9, -n * 9, -n * 9, -n * 9, -n * 9]) + 9 * k).clip(-1).ravel()


def test_scale() -> None:
    g, derivative_of = rigid_pairs(10_000)
    began = time.process_time()
    r = pantelides(g, derivative_of)
    assert time.process_time() - began < 6
    assert r.structural_index == 3
    assert r.equation_order.tolist() == [1, 0, 1, 0, 2] * 10_000
