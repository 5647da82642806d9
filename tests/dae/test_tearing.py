import itertools
import time

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from acausal.dae.tearing import Tearing, tear


@st.composite
def blocks(draw: st.DrawFn, largest: int = 6):
    """A square block with a perfect matching on the diagonal."""
    n = draw(st.integers(1, largest))
    rows = [sorted({i, *draw(st.lists(st.integers(0, n - 1), max_size=3))}) for i in range(n)]
    solvable = [draw(st.lists(st.sampled_from([True, True, False]), min_size=len(r), max_size=len(r))) for r in rows]
    return rows, solvable


def _check(rows: list[list[int]], solvable: list[list[bool]], t: Tearing, n: int) -> None:
    known = list(t.tear_columns)
    for row, column in t.sequence:
        assert solvable[row][rows[row].index(column)]
        assert column not in known
        assert all(j in known for j in rows[row] if j != column)
        known.append(column)
    assert sorted(known) == list(range(n))
    assert sorted([*t.residual_rows, *(row for row, _ in t.sequence)]) == list(range(len(rows)))
    assert len(t.residual_rows) - len(t.tear_columns) == len(rows) - n


def _works(rows: list[list[int]], solvable: list[list[bool]], torn: tuple[int, ...]) -> bool:
    known, used, changed = list(torn), [], True
    while changed:
        changed = False
        for i, row in enumerate(rows):
            left = [j for j in row if j not in known]
            if i not in used and len(left) == 1 and solvable[i][row.index(left[0])]:
                known.append(left[0])
                used.append(i)
                changed = True
    return len(known) == len(rows)


@given(blocks())
def test_valid_and_within_twice_the_smallest(block) -> None:
    rows, solvable = block
    n = len(rows)
    t = tear(rows, solvable)
    _check(rows, solvable, t, n)
    smallest = next(
        k for k in range(n + 1) if any(_works(rows, solvable, s) for s in itertools.combinations(range(n), k))
    )
    assert len(t.tear_columns) <= max(2 * smallest, smallest)
    if smallest <= 2:
        assert len(t.tear_columns) == smallest


@given(blocks(12), st.randoms())
def test_preference_never_costs_validity(block, random) -> None:
    rows, solvable = block
    preference = [random.random() for _ in rows]
    _check(rows, solvable, tear(rows, solvable, preference=preference), len(rows))


def test_preference_decides_between_equals() -> None:
    rows = [[0, 1], [1, 2], [0, 2]]
    assert tear(rows, [[True, True]] * 3, preference=[0, 0, 1]).tear_columns == (2,)


def test_unsolvable_unknown_is_torn() -> None:
    rows = [[0, 1], [0, 1]]
    assert tear(rows, [[True, False], [True, False]]).tear_columns == (1,)


def test_more_unknowns_than_rows() -> None:
    rows = [[0, 1, 2]]
    t = tear(rows, [[True, True, True]], n_columns=3)
    _check(rows, [[True, True, True]], t, 3)


def test_scale() -> None:
    rng = np.random.default_rng(0)
    n = 2000
    rows = [sorted({i, *rng.integers(0, n, 2).tolist()}) for i in range(n)]
    solvable = [[bool(rng.random() < 0.8) for _ in r] for r in rows]
    began = time.process_time()
    t = tear(rows, solvable)
    assert time.process_time() - began < 8
    _check(rows, solvable, t, n)
    assert len(t.tear_columns) < 0.4 * n
