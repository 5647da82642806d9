"""Modelica.Blocks.Examples, and the test models of the same library, against its official trajectories.

Each file has about a hundred points of the signals that the library's own regression tests compare, away from events.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

import acausal as ac

from . import msl_block_tests, msl_blocks
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
    "BlocksTestContinuous": msl_block_tests.continuous,
    "BlocksTestContinuousSteadyState": lambda: msl_block_tests.continuous("SteadyState"),
    "BlocksTestContinuousInitialState": lambda: msl_block_tests.continuous("InitialState"),
    "BlocksTestContinuousInitialOutput": lambda: msl_block_tests.continuous("InitialOutput"),
    "BlocksTestLogical": msl_block_tests.logical, "BlocksTestDiscrete": msl_block_tests.sampled,
    "BlocksTestFirstOrderHold": msl_block_tests.first_order_hold, "BlocksTestMean": msl_block_tests.mean,
    "BlocksTestRootMeanSquare": msl_block_tests.root_mean_square,
    "BlocksTestKinematicPTP": msl_block_tests.kinematic_ptp, "BlocksTestLimPID": msl_block_tests.lim_pid,
    "BlocksTestLimiters": msl_block_tests.limiters, "BlocksTestStrictLimiters": msl_block_tests.strict_limiters,
    "BlocksTestSelfResettingIntegrator": msl_block_tests.self_resetting_integrator,
    "BlocksTestResetHoldIntegrator": msl_block_tests.reset_hold_integrator,
    "BlocksTestLimResetIntegrator": msl_block_tests.lim_reset_integrator,
    "BlocksTestPadeDelay1": msl_block_tests.pade_delay1, "BlocksTestPadeDelay2": msl_block_tests.pade_delay2,
    "BlocksTestMuxDemux": msl_block_tests.mux_demux, "BlocksTestIntegerTable": msl_block_tests.integer_table,
    "BlocksTestBooleanTable": msl_block_tests.boolean_table, "BlocksTestHysteresis": msl_block_tests.hysteresis,
    "BlocksTestFilters": msl_block_tests.filters,
}  # fmt: skip

SLOW = {"BlocksTestPadeDelay1"}


NATIVE_ONLY = {"BlocksTestStrictLimiters"}
"""With `strict`, an integrator stops without an event: at 1e-8 the diffrax engine's steps do not get past that jump."""


@pytest.mark.slow_case("diffrax", *SLOW)
@pytest.mark.parametrize("engine", ["native", "diffrax"])
@pytest.mark.parametrize("name", MODELS)
def test_within_the_tube(name: str, engine: Any) -> None:
    if engine == "diffrax" and name in NATIVE_ONLY:
        pytest.skip("a jump without an event")
    assert_within(name, MODELS[name](), engine, still=1.0)
