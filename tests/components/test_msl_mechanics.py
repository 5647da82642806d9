"""Examples of Modelica.Mechanics against its official trajectories, in the tube of 2e-3 (see `test_msl_official`).

PointGravity is compared up to 3.5 s: the official trajectory loses 5e-4 of its energy where the second body passes the
centre.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import acausal as ac

from . import msl_gravity, msl_robot, msl_signals, msl_slides
from .tube import assert_within

MODELS: dict[str, Callable[[], ac.Component]] = {
    "TranslationalHeatLosses": msl_slides.heat_losses,
    "RotationalGenerationOfFMUs": msl_signals.rotational_signals,
    "TranslationalGenerationOfFMUs": msl_signals.translational_signals,
    "TranslationalEddyCurrentBrake": msl_slides.eddy_current_brake,
    "PointGravity": msl_gravity.point_gravity,
    "PointGravityWithPointMasses2": msl_gravity.point_gravity_with_point_masses2,
    "OneAxis": msl_robot.one_axis,
}

SLOW = {"PointGravityWithPointMasses2"}


# The stop strikes both through dampers whose relative velocities are states, in the official trajectory, too.
@pytest.mark.filterwarnings("ignore:.*`reinit` of .* changes `(mass3|brake).v`, too:UserWarning")
@pytest.mark.slow_case("diffrax", *SLOW)
@pytest.mark.parametrize("engine", ["native", "diffrax"])
@pytest.mark.parametrize("name", MODELS)
def test_within_the_tube(name: str, engine: Any) -> None:
    assert_within(name, MODELS[name](), engine)


@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_spring_constant_of_a_pendulum_at_rest(engine: Any) -> None:
    """Half the weight hangs on 0.1 m of the spring; the official trajectory is zero throughout."""
    solution = ac.compile(msl_gravity.init_spring_constant()).simulate(1.01, engine=engine)
    np.testing.assert_allclose(solution["spring.c"], 0.5 * 9.80665 / 0.1, rtol=1e-9)
    np.testing.assert_allclose(solution["rev.phi"], 0.0, atol=1e-9)
