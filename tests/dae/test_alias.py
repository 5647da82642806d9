import time

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from acausal.dae.alias import alias_sets


@st.composite
def alias_problems(draw: st.DrawFn):
    n = draw(st.integers(1, 7))
    v = st.integers(0, n - 1)
    edges = draw(st.lists(st.tuples(v, v, st.sampled_from([1, -1])), max_size=8))
    zero = draw(st.lists(v, max_size=2))
    keep = draw(st.lists(st.booleans(), min_size=n, max_size=n))
    rank = draw(st.lists(st.integers(0, 2), min_size=n, max_size=n))
    return n, edges, zero, keep, rank


def _matrix(n: int, edges: list[tuple[int, int, int]], zero: list[int]) -> np.ndarray:
    m = np.zeros((len(edges) + len(zero), n))
    for k, (a, b, s) in enumerate(edges):
        m[k, a] += 1
        m[k, b] -= s
    for k, v in enumerate(zero):
        m[len(edges) + k, v] = 1
    return m


def _rank(m: np.ndarray) -> int:
    return int(np.linalg.matrix_rank(m)) if m.size else 0


@given(alias_problems())
def test_against_linear_algebra(problem) -> None:
    n, edges, zero, keep_list, rank = problem
    keep = np.array(keep_list)
    columns = np.array(edges, dtype=np.int64).reshape(-1, 3).T
    r = alias_sets(n, columns[0], columns[1], columns[2], np.array(zero, dtype=np.int64), keep, np.array(rank))
    m = _matrix(n, edges, zero)
    full = _rank(m)

    def implied(u: int, s: int, v: int) -> bool:  # does u = s*v follow?
        extra = np.zeros((1, n))
        extra[0, u] += 1
        extra[0, v] -= s
        return _rank(np.vstack((m, extra))) == full

    # The result says neither more nor less than the equations.
    said = [(v, int(r.representative[v]), int(r.sign[v])) for v in np.flatnonzero(r.eliminated).tolist()]
    said += [tuple(p) for p in r.kept_pairs.tolist()]
    rows = np.zeros((len(said), n))
    for k, (v, rep, s) in enumerate(said):
        assert implied(v, s, rep)
        rows[k, v] += 1
        rows[k, rep] -= s
    assert _rank(rows) == len(said) == full
    assert not r.eliminated[keep].any()
    assert r.kept_pairs[:, 0].tolist() == sorted(r.kept_pairs[:, 0].tolist())
    # Representatives are the best of their sets, and no two variables that could be merged stay.
    for v in range(n):
        rep = int(r.representative[v])
        assert r.is_zero[v] == (implied(v, 0, v) and not keep[v])
        if r.is_zero[v]:
            assert r.sign[v] == 0
            continue
        assert not r.eliminated[rep]
        if keep[v]:
            assert rep == v and r.sign[v] == 1
            continue
        mates = [u for u in range(n) if implied(v, 1, u) or implied(v, -1, u)]
        assert rep == min(mates, key=lambda u: (not keep[u], rank[u], u))
    # Redundant equations, in creation order.
    redundant = [k for k in range(len(m)) if _rank(m[: k + 1]) == _rank(m[:k])]
    assert r.redundant_edges.tolist() == redundant


def test_contradiction_makes_the_set_zero() -> None:
    r = alias_sets(3, np.array([0, 0, 1]), np.array([1, 1, 2]), np.array([1, -1, 1]), np.array([], dtype=np.int64))
    assert r.is_zero.all()
    assert r.contradictory_edges.tolist() == [1]
    assert r.redundant_edges.tolist() == []


def test_a_sign_of_zero_is_refused() -> None:
    with pytest.raises(ValueError, match="edge_sign"):
        alias_sets(2, np.array([0]), np.array([1]), np.array([0]), np.array([], dtype=np.int64))


def test_scale() -> None:
    n = 200_000
    k = np.arange(n - 1)
    began = time.process_time()
    r = alias_sets(n, k, k + 1, np.where(k % 2, 1, -1), np.array([], dtype=np.int64), np.arange(n) % 3 == 0)
    assert r.eliminated.sum() + len(r.kept_pairs) == n - 1
    assert time.process_time() - began < 5
