"""The hand-causalised solution against the published curves."""

from __future__ import annotations

from dataclasses import asdict

import numpy as np
import pytest

from models.kbc import PARAMETERS, SIGNALS

from .reference import COLUMNS, SYMBOLS, Parameters, solve, spread
from .support import VARIANTS, read_curve


@pytest.mark.parametrize("variant", VARIANTS, ids="-".join)
def test_sine_agrees_with_the_published_curves(variant: tuple[str, str]) -> None:
    t, published = read_curve(*variant)
    curve = solve(*variant, "sine", t, rtol=1e-10)
    for name, column in published.items():
        assert np.max(np.abs(curve.columns[name] - column)) <= 1e-6 * spread(column), name


def test_tables_are_complete() -> None:
    assert set(PARAMETERS) == set(SYMBOLS) == set(asdict(Parameters()))
    assert set(SIGNALS) == set(COLUMNS["extended", "compliant"])
