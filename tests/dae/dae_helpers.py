"""Small random systems and slow references for the structural algorithms."""

import numpy as np
from hypothesis import strategies as st

from acausal.dae.incidence import Incidence


@st.composite
def incidences(draw: st.DrawFn, max_rows: int = 7, max_columns: int = 7) -> Incidence:
    """A small random incidence, empty rows and columns included."""
    m, n = draw(st.integers(0, max_rows)), draw(st.integers(0, max_columns))
    row = st.lists(st.integers(0, n - 1), max_size=3) if n else st.just([])
    return Incidence.from_rows(draw(st.lists(row, min_size=m, max_size=m)), n)


def adjacency(g: Incidence) -> list[list[int]]:
    """Columns of each row as lists."""
    return [g.row(i).tolist() for i in range(g.n_rows)]


def slow_matching(rows: list[list[int]], columns: list[int] | None = None) -> dict[int, int]:
    """Row of each matched column, by recursive augmentation."""
    owner: dict[int, int] = {}
    allowed = None if columns is None else list(columns)

    def augment(i: int, seen: list[int]) -> bool:
        for j in rows[i]:
            if j in seen or (allowed is not None and j not in allowed):
                continue
            seen.append(j)
            if j not in owner or augment(owner[j], seen):
                owner[j] = i
                return True
        return False

    for i in range(len(rows)):
        augment(i, [])
    return owner


def chain(n: int) -> Incidence:
    """Row k touches columns k - 1, k and k + 1."""
    k = np.arange(n)
    rows, cols = np.concatenate((k[1:], k, k[:-1])), np.concatenate((k[1:] - 1, k, k[:-1] + 1))
    return Incidence.from_coo(rows, cols, n, n)
