import numpy as np
import pytest
from dae_helpers import adjacency, incidences, slow_matching
from hypothesis import given

from acausal.dae.dulmage_mendelsohn import connected_parts, dulmage_mendelsohn
from acausal.dae.incidence import Incidence
from acausal.dae.matching import maximum_matching


def _size(rows: list[list[int]]) -> int:
    return len(slow_matching(rows))


@given(incidences())
def test_parts_by_definition(g: Incidence) -> None:
    dm = dulmage_mendelsohn(g, maximum_matching(g))
    rows, full = adjacency(g), _size(adjacency(g))
    # A row is over-determined iff some maximum matching does without it, a column under-determined likewise.
    over = [i for i in range(g.n_rows) if _size([r for k, r in enumerate(rows) if k != i]) == full]
    under = [j for j in range(g.n_columns) if _size([[c for c in r if c != j] for r in rows]) == full]
    assert dm.over_rows.tolist() == over
    assert dm.over_columns.tolist() == sorted({j for i in over for j in rows[i]})
    assert dm.under_columns.tolist() == under
    assert dm.under_rows.tolist() == [i for i, r in enumerate(rows) if any(j in under for j in r)]
    assert sorted([*dm.over_rows, *dm.under_rows, *dm.square_rows]) == list(range(g.n_rows))
    assert sorted([*dm.over_columns, *dm.under_columns, *dm.square_columns]) == list(range(g.n_columns))
    assert len(dm.square_rows) == len(dm.square_columns)


@given(incidences())
def test_connected_parts(g: Incidence) -> None:
    parts = connected_parts(g, np.arange(g.n_rows), np.arange(g.n_columns))
    assert sorted(i for r, _ in parts for i in r.tolist()) == list(range(g.n_rows))
    assert sorted(j for _, c in parts for j in c.tolist()) == list(range(g.n_columns))
    firsts = [r[0] for r, _ in parts if len(r)]
    assert firsts == sorted(firsts)
    for r, c in parts:
        for i in r.tolist():
            assert all(j in c for j in g.row(i).tolist())
        grown = [r[0]] if len(r) else []
        columns: list[int] = []
        for _ in range(g.n_rows + 1):
            columns = [j for j in c.tolist() if any(j in g.row(i) for i in grown)]
            grown = [i for i in r.tolist() if i in grown or any(j in columns for j in g.row(i).tolist())]
        assert grown == r.tolist()
        assert len(r) == 0 or columns == c.tolist()


def test_a_matching_that_is_not_maximum_is_refused() -> None:
    with pytest.raises(ValueError, match="not maximum"):
        dulmage_mendelsohn(Incidence.from_rows([[0]], 1), np.array([-1]))
