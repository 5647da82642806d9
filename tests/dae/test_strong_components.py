import time

import numpy as np
import pytest
from dae_helpers import adjacency, incidences
from hypothesis import given

from acausal.dae import strong_components
from acausal.dae.incidence import Incidence
from acausal.dae.matching import maximum_matching, row_of_column
from acausal.dae.strong_components import Blocks, block_lower_triangular, levels


def _reach(needs: list[list[int]]) -> np.ndarray:
    n = len(needs)
    reach = np.eye(n, dtype=bool)
    for i, row in enumerate(needs):
        reach[i, row] = True
    for k in range(n):
        reach |= reach[:, [k]] & reach[[k], :]
    return reach


@given(incidences(8, 8))
def test_blocks(g: Incidence) -> None:
    m = maximum_matching(g)
    g, m = g.select(np.flatnonzero(m >= 0)), m[m >= 0]
    blocks = block_lower_triangular(g, m)
    row_of = row_of_column(m, g.n_columns)
    needs = [[int(row_of[j]) for j in row if row_of[j] >= 0] for row in adjacency(g)]
    reach = _reach(needs)
    for i in range(g.n_rows):
        together = np.flatnonzero(reach[i] & reach[:, i])
        assert blocks.block(int(blocks.block_of_row[i])).tolist() == together.tolist()
    for b in range(len(blocks)):
        rows = blocks.block(b).tolist()
        waits = [int(blocks.block_of_row[k]) for i in rows for k in needs[i] if k not in rows]
        assert all(w < b for w in waits)
        assert blocks.level[b] == max((int(blocks.level[w]) + 1 for w in waits), default=0)
    keys = [(int(blocks.level[b]), int(blocks.block(b)[0])) for b in range(len(blocks))]
    assert keys == sorted(keys)


def test_narrow_levels_take_the_python_path(monkeypatch: pytest.MonkeyPatch) -> None:
    rng = np.random.default_rng(1)
    n = 300
    a, b = rng.integers(0, n, 900), rng.integers(0, n, 900)
    g = Incidence.from_coo(np.minimum(a, b)[a != b], np.maximum(a, b)[a != b], n, n)
    wide = levels(g)
    monkeypatch.setattr(strong_components, "_ROUNDS", 1)
    assert np.array_equal(levels(g), wide)


def test_cycles_and_unmatched_rows_are_refused() -> None:
    with pytest.raises(ValueError, match="cycle"):
        levels(Incidence.from_rows([[1], [0]], 2))
    with pytest.raises(ValueError, match="first is row 1"):
        block_lower_triangular(Incidence.from_rows([[0], [0]], 1), np.array([0, -1]))


def _timed(g: Incidence) -> tuple[Blocks, float]:
    began = time.process_time()
    blocks = block_lower_triangular(g, np.arange(g.n_rows))
    return blocks, time.process_time() - began


def test_scale() -> None:
    k = np.arange(100_000)
    deep, seconds = _timed(Incidence.from_coo(np.r_[k, k[1:]], np.r_[k, k[1:] - 1], len(k), len(k)))
    assert deep.n_levels == len(k) and seconds < 5
    wide, seconds = _timed(Incidence.from_coo(np.r_[k, k], np.r_[k, k // 10], len(k), len(k)))
    assert wide.n_levels == 6 and seconds < 5
