"""The tables of ModelicaTest.Tables 4.0 against their official trajectories, in the tube of 2e-3, both engines."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

import acausal as ac

from . import msl_tables
from .tube import assert_within

MODELS: dict[str, Callable[[], ac.Component]] = {
    "TablesTimeTo2_5": msl_tables.time_tables_to_2_5, "TablesTimeTo1": msl_tables.time_tables_to_1,
    "TablesTimeTo3_5": msl_tables.time_tables_to_3_5, "TablesTimeTo15": msl_tables.time_tables_to_15,
    "Tables1DTo1": msl_tables.tables_to_1, "Tables1DTo15": msl_tables.tables_to_15,
    "Tables2DTo60": msl_tables.maps_to_60, "Tables2DTo1": msl_tables.maps_to_1,
}  # fmt: skip


LARGE = {"TablesTimeTo2_5", "TablesTimeTo1", "Tables1DTo1", "TablesTimeTo15", "Tables2DTo60"}


@pytest.mark.slow_case("diffrax", *LARGE)
@pytest.mark.parametrize("engine", ["native", "diffrax"])
@pytest.mark.parametrize("name", MODELS)
def test_within_the_tube(name: str, engine: Any) -> None:
    assert_within(name, MODELS[name](), engine)
