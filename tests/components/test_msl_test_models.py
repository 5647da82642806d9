"""Models of ModelicaTest, the library that tests the Modelica Standard Library, against official trajectories.

Each file has about 40 points of the signals that the library's own regression tests compare, away from events, in the
tube of 2e-3. Official trajectories, computed with a tolerance of 1e-6, lose the phase of undamped oscillations; such
models are compared as long as theirs is right to 1e-3. Those of `JointUSR` and `JointUSP` bounce at a dead centre. The
loop of four equal rods (`RevolutePlanarLoopConstraint`) is compared until all are in one line: two ways meet there.
"""

from __future__ import annotations

from collections.abc import Callable

import pytest

import acausal as ac

from . import msl_force_tests, msl_joint_tests, msl_part_tests, msl_shaft_tests
from .tube import assert_within

MODELS: dict[str, Callable[[], ac.Component]] = {
    "RotationalTestDirections2": msl_shaft_tests.directions2,
    "RotationalTestInertiaInitialization": msl_shaft_tests.initialized_inertias,
    "RotationalTestSpringDamperInitialization": msl_shaft_tests.initialized_spring_dampers,
    "RotationalTestSpeed": msl_shaft_tests.prescribed_speeds,
    "RotationalTestAllComponents": msl_shaft_tests.all_rotational,
    "RotationalTestBearingConversion": msl_shaft_tests.bearings, "RotationalTestFriction": msl_shaft_tests.frictions,
    "RotationalTestBraking": msl_shaft_tests.rotational_braking,
    "TranslationalTestAllComponents": msl_shaft_tests.all_translational,
    "TranslationalTestBraking": msl_shaft_tests.translational_braking,
    "TranslationalTestVehicles": msl_shaft_tests.vehicles,
    "MultiBodyTestDamper": msl_force_tests.damper, "MultiBodyTestDamper2": msl_force_tests.damper2,
    "MultiBodyTestSpring": msl_force_tests.spring, "MultiBodyTestSpring2": msl_force_tests.spring2,
    "MultiBodyTestSpringDamperParallel": msl_force_tests.spring_damper_parallel,
    "MultiBodyTestSpringDamperSeries": msl_force_tests.spring_damper_series,
    "MultiBodyTestDifferentiationOfForces": msl_force_tests.differentiation_of_forces,
    "MultiBodyTestForce2": msl_force_tests.force2,
    "MultiBodyTestForceWithTwoMasses2": msl_force_tests.force_with_two_masses2,
    "MultiBodyTestFrameForces2": msl_force_tests.frame_forces2,
    "MultiBodyTestFrameForcesAndTorques2": msl_force_tests.frame_forces_and_torques2,
    "MultiBodyTestFrameForcesAndTorques3": msl_force_tests.frame_forces_and_torques3,
    "MultiBodyTestLineForceWithMass": msl_force_tests.line_force_with_mass,
    "MultiBodyTestLineForceWithTwoMasses": msl_force_tests.line_force_with_two_masses,
    "MultiBodyTestTorque3": msl_force_tests.torque3, "MultiBodyTestWorldForces": msl_force_tests.world_forces,
    "MultiBodyTestWorldForceAndTorque": msl_force_tests.world_force_and_torque,
    "MultiBodyTestWorldTorques": msl_force_tests.world_torques,
    "MultiBodyTestEngineGasForce": msl_force_tests.engine_gas_force,
    "MultiBodyTestCheckConstaintTorqueUniversalJoint": msl_joint_tests.check_constaint_torque_universal_joint,
    "MultiBodyTestFreeMotion2": msl_joint_tests.free_motion2,
    "MultiBodyTestFreeMotionScalarInit5": msl_joint_tests.free_motion_scalar_init5,
    "MultiBodyTestJointGearConstraint": msl_joint_tests.gear_constraint,
    "MultiBodyTestJointUPS2": msl_joint_tests.joint_ups2, "MultiBodyTestRevolute2": msl_joint_tests.revolute2,
    "MultiBodyTestRevolutePlanarLoopConstraint": msl_joint_tests.revolute_planar_loop_constraint,
    "MultiBodyTestUniversalSpherical": msl_joint_tests.universal_spherical,
    "MultiBodyTestUniversal": msl_joint_tests.universal, "MultiBodyTestJointUSP2": msl_joint_tests.joint_usp2,
    "MultiBodyTestSphericalAndUniversalFourbar": msl_joint_tests.fourbar_spherical_and_universal,
    "MultiBodyTestSphericalSphericalFourbar": msl_joint_tests.fourbar_spherical_spherical,
    "MultiBodyTestUniversalSphericalFourbar": msl_joint_tests.fourbar_universal_spherical,
    "MultiBodyTestJointSSRFourbar": msl_joint_tests.fourbar_joint_ssr,
    "MultiBodyTestJointUSPFourbar": msl_joint_tests.fourbar_joint_usp,
    "MultiBodyTestJointUSRFourbar": msl_joint_tests.fourbar_joint_usr,
    "MultiBodyTestBodyShape": msl_part_tests.body_shape, "MultiBodyTestPointMass": msl_part_tests.point_mass,
    "MultiBodyTestRotor1D_2": msl_part_tests.rotor1d_2, "MultiBodyTestRotor1D_3": msl_part_tests.rotor1d_3,
    "MultiBodyTestBevel1D": msl_part_tests.bevel1d, "MultiBodyTestGearConstraint2": msl_part_tests.gear_constraint2,
    "MultiBodyTestGearConstraint4": msl_part_tests.gear_constraint4, "MultiBodyTestRotor1D_1": msl_part_tests.rotor1d_1,
    "MultiBodyTestGearConstraint3": msl_part_tests.gear_constraint3,
    "MultiBodyTestRotor1DInitialization": msl_part_tests.initialized_rotors,
    "MultiBodyTestAbsoluteSensor": msl_part_tests.absolute_sensor, "MultiBodyTestDistance": msl_part_tests.distance,
    "MultiBodyTestDistance2": msl_part_tests.distance2, "MultiBodyTestAngularVelocity": msl_part_tests.angular_velocity,
    "MultiBodyTestSphericalDoublePendulum": msl_part_tests.spherical_double_pendulum,
}  # fmt: skip
QUICK = {"RotationalTestDirections2", "MultiBodyTestSpring", "TranslationalTestBraking"}
DIFFRAX = [
    "RotationalTestSpeed", "RotationalTestFriction", "RotationalTestSpringDamperInitialization",
    "TranslationalTestVehicles", "MultiBodyTestSpring", "MultiBodyTestSpringDamperParallel",
    "MultiBodyTestFrameForcesAndTorques3", "MultiBodyTestFreeMotion2", "MultiBodyTestJointGearConstraint",
    "MultiBodyTestSphericalSphericalFourbar", "MultiBodyTestRotor1D_1", "MultiBodyTestAngularVelocity",
]  # fmt: skip
"""One of each kind: compilation takes its time."""


@pytest.mark.parametrize(
    "name", [name if name in QUICK else pytest.param(name, marks=pytest.mark.slow) for name in MODELS]
)
def test_within_the_tube(name: str) -> None:
    assert_within(name, MODELS[name](), "native")


@pytest.mark.slow
@pytest.mark.parametrize("name", DIFFRAX)
def test_within_the_tube_on_diffrax(name: str) -> None:
    assert_within(name, MODELS[name](), "diffrax")
