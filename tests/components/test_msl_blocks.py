"""Modelica.Blocks.Examples, and the test models of the same library, against its official trajectories.

Each file has about a hundred points of the signals that the library's own regression tests compare, away from events.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

import acausal as ac

from . import msl_blocks
from .tube import assert_within

MODELS: dict[str, Callable[[], ac.Component]] = {
    "BlocksFilter": msl_blocks.filter_of_all_kinds,
    "BlocksFilterWithDifferentiation": msl_blocks.filter_with_differentiation,
    "BlocksFilterWithRiseTime": msl_blocks.filter_with_rise_time,
    "BlocksSlewRateLimiter": msl_blocks.slew_rate_limiter, "BlocksInverseModel": msl_blocks.inverse_model,
    "BlocksShowLogicalSources": msl_blocks.ShowLogicalSources, "BlocksLogicalNetwork1": msl_blocks.logical_network1,
    "BlocksRealNetwork1": msl_blocks.real_network1, "BlocksIntegerNetwork1": msl_blocks.integer_network1,
    "BlocksBooleanNetwork1": msl_blocks.boolean_network1, "BlocksInteraction1": msl_blocks.interaction1,
    "BlocksBusUsage": msl_blocks.BusUsage, "BlocksTotalHarmonicDistortion": msl_blocks.total_harmonic_distortion,
    "BlocksModulation": msl_blocks.modulation, "BlocksCompareSincExpSine": msl_blocks.compare_sinc_exp_sine,
}  # fmt: skip


@pytest.mark.parametrize("engine", ["native", pytest.param("diffrax", marks=pytest.mark.slow)])
@pytest.mark.parametrize("name", MODELS)
def test_within_the_tube(name: str, engine: Any) -> None:
    assert_within(name, MODELS[name](), engine, still=1.0)
