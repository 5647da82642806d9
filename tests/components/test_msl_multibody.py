"""Examples of Modelica.Mechanics.MultiBody 4.0 against their official trajectories, in the tube of 2e-3, both engines.

Each file has about a hundred points of the signals that the library's own regression tests compare. Chaotic motions
are compared as long as the official trajectories, which were computed with a tolerance of 1e-6, hold.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

import acausal as ac

from . import msl_constraints, msl_drives_3d, msl_elementary, msl_engines, msl_loops
from .tube import assert_within

MODELS: dict[str, Callable[[], ac.Component]] = {
    "ForceAndTorque": msl_elementary.force_and_torque,
    "PendulumWithSpringDamper": msl_elementary.pendulum_with_spring_damper,
    "SpringDamperSystem": msl_elementary.spring_damper_system, "SpringWithMass": msl_elementary.spring_with_mass,
    "PointGravityWithPointMasses": msl_elementary.point_gravity_with_point_masses,
    "MultiBodyHeatLosses": msl_elementary.heat_losses,
    "LineForceWithTwoMasses": msl_elementary.line_force_with_two_masses,
    "DoublePendulumInitTip": msl_elementary.double_pendulum_init_tip,
    "UserDefinedGravityField": msl_elementary.user_defined_gravity_field,
    "RollingWheel": msl_elementary.rolling_wheel, "RollingWheelSetDriving": msl_elementary.rolling_wheel_set_driving,
    "RollingWheelSetPulling": msl_elementary.rolling_wheel_set_pulling,
    "Fourbar2": msl_loops.fourbar2, "Fourbar_analytic": msl_loops.fourbar_analytic,
    "PlanarFourbar": msl_loops.planar_fourbar, "PlanarLoops_analytic": msl_loops.planar_loops_analytic,
    "Engine1b_analytic": msl_loops.engine1b_analytic,
    "PrismaticConstraint": msl_constraints.prismatic_constraint,
    "RevoluteConstraint": msl_constraints.revolute_constraint,
    "SphericalConstraint": msl_constraints.spherical_constraint,
    "UniversalConstraint": msl_constraints.universal_constraint,
    "ActuatedDrive": msl_drives_3d.actuated_drive, "BevelGear1D": msl_drives_3d.bevel_gear1_d,
    "GearConstraint": msl_drives_3d.gear_constraint, "GyroscopicEffects": msl_drives_3d.gyroscopic_effects,
    "MovingActuatedDrive": msl_drives_3d.moving_actuated_drive,
    "EngineV6": msl_engines.engine_v6, "EngineV6_analytic": msl_engines.engine_v6_analytic,
}  # fmt: skip
SLOW = {
    "EngineV6", "EngineV6_analytic", "Engine1b_analytic", "LineForceWithTwoMasses", "GyroscopicEffects",
    "PlanarLoops_analytic", "RollingWheelSetPulling",
}  # fmt: skip
"""The C compiler takes its time over these."""


@pytest.mark.slow_case("diffrax", *SLOW)
@pytest.mark.parametrize("engine", ["native", "diffrax"])
@pytest.mark.parametrize("name", MODELS)
def test_within_the_tube(name: str, engine: Any) -> None:
    assert_within(name, MODELS[name](), engine)
