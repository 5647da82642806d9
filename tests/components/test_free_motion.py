"""Free motion given by scalars: through positions where the angles are singular, and starts in all quadrants."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import acausal as ac
from acausal import Component, inner, start
from acausal.components import multibody as mb
from acausal.components.examples import assemble

from . import msl_constraints, msl_elementary
from .tube import assert_within

Triple = tuple[float, float, float]
ORIGIN = (0.0, 0.0, 0.0)


def fixed(name: str, values: Triple) -> dict[str, Any]:
    return {f"{name}_{k}": start(value, fixed=True) for k, value in enumerate(values, start=1)}


def free_body(angles: Triple, w: Triple, I_21: float = 0.1, **options: Any) -> Component:
    """A body in empty space that starts at these angles, with this angular velocity in its own frame."""
    options = {"use_angle": True, "use_w": True, **options}
    return assemble(
        "world.frame_b - free.frame_a", "free.frame_b - body.frame_a", world=inner(mb.World(gravityType="NoGravity")),
        free=mb.FreeMotionScalarInit(**fixed("angle", angles), **fixed("w_rel_b", w), **options),
        body=mb.Body(m=2.0, I_11=1.0, I_22=2.0, I_33=3.0, I_21=I_21, r_0=start(ORIGIN, fixed=True),
                     v_0=start(ORIGIN, fixed=True)),
    )  # fmt: skip


def vectors(solution: ac.Solution, name: str) -> np.ndarray:
    return np.stack([np.asarray(solution[f"free.{name}_{k}"]) for k in (1, 2, 3)], axis=1)


def about(axis: int, angle: float) -> np.ndarray:
    """The matrix of a frame that is turned about coordinate axis 1, 2 or 3."""
    i, j = axis % 3, (axis + 1) % 3
    T = np.eye(3)
    T[i, i] = T[j, j] = np.cos(angle)
    T[i, j], T[j, i] = np.sin(angle), -np.sin(angle)
    return T


def turned(angles: Any, sequence: tuple[int, ...] = (1, 2, 3)) -> np.ndarray:
    first, second, third = (about(axis, float(angle)) for axis, angle in zip(sequence, angles, strict=True))
    return third @ second @ first


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
@pytest.mark.parametrize("rtol", [1e-6, 1e-9])
@pytest.mark.parametrize(
    ("angles", "w", "I_21"),
    [((0.0, 0.0, 0.0), (0.0, 1.0, 0.0), 0.0), ((0.2, 1.2, -0.3), (0.05, 2.0, 0.1), 0.1)], ids=["exactly", "near"],
)  # fmt: skip
def test_a_body_tumbles_through_the_singular_angle(
    angles: Triple, w: Triple, I_21: float, rtol: float, engine: Any
) -> None:
    J = np.array([[1.0, I_21, 0.0], [I_21, 2.0, 0.0], [0.0, 0.0, 3.0]])

    def euler(_: float, y: np.ndarray) -> np.ndarray:
        w, T = y[:3], y[3:].reshape(3, 3)
        return np.concatenate([np.linalg.solve(J, -np.cross(w, J @ w)), -np.cross(w, T.T).T.ravel()])

    t = np.linspace(0.0, 4 * np.pi, 97)  # a quarter of a turn is one of them
    begin = np.concatenate([w, turned(angles).ravel()])
    exact = solve_ivp(euler, (0, t[-1]), begin, t_eval=t, method="DOP853", rtol=1e-12, atol=1e-13).y.T
    T = exact[:, 3:].reshape(-1, 3, 3)
    assert np.abs(T[:, 2, 0]).max() > 0.99  # sine of the second angle

    system = ac.compile(free_body(angles, w, I_21, use_angle_d=True))
    solution = system.simulate(t1=float(t[-1]), saveat=t, rtol=rtol, engine=engine)
    tolerance = 1e3 * rtol
    assert np.abs(np.asarray(solution["body.frame_a.R.T"]).reshape(-1, 3, 3) - T).max() < tolerance
    assert np.abs(vectors(solution, "w_rel_b") - exact[:, :3]).max() < tolerance
    found = vectors(solution, "angle")
    assert np.abs(np.stack([turned(row) for row in found]) - T).max() < tolerance
    regular = np.abs(T[:, 2, 0]) < 0.9
    rate, (_, second, third) = vectors(solution, "angle_d"), found.T
    assert np.allclose(  # the angular velocity about the third axis, and along the second
        (rate[:, 2] + rate[:, 0] * np.sin(second))[regular], exact[regular, 2], atol=100 * tolerance
    )
    across = np.cos(third) * exact[:, 1] + np.sin(third) * exact[:, 0]
    assert np.allclose(rate[regular, 1], across[regular], atol=100 * tolerance)


@pytest.mark.parametrize("sequence", [(1, 2, 3), (3, 1, 3)])
@pytest.mark.parametrize("angles", [(0.3, 0.4, -0.5), (2.5, 2.0, -2.8), (4.0, 0.3, -9.0), (-0.2, -1.9, 1.0)])
def test_the_start_has_the_angles_that_are_given(angles: Triple, sequence: tuple[int, ...]) -> None:
    model = free_body(angles, (0.1, 0.2, 0.3), sequence_start=tuple(map(float, sequence)))
    solution = ac.compile(model).simulate(t1=0.1)
    assert np.allclose(vectors(solution, "angle")[0], angles, atol=1e-9)
    T = np.asarray(solution["body.frame_a.R.T"])[0].reshape(3, 3)
    assert np.allclose(T, turned(angles, sequence), atol=1e-9)


def test_a_start_in_the_singular_position() -> None:
    angles = (0.3, np.pi / 2, 0.1)
    solution = ac.compile(free_body(angles, (0.1, 1.0, 0.2))).simulate(t1=1.0, rtol=1e-9)
    assert np.allclose(vectors(solution, "angle")[0], angles)


def test_angles_that_are_measured_in_the_singular_position() -> None:
    degrees = (20.0, 90.0, 40.0)
    model = assemble(
        "world.frame_b - bend.frame_a", "bend.frame_b - sensor.frame_a", world=inner(mb.World()),
        bend=mb.FixedRotation(rotationType="PlanarRotationSequence", angles=degrees),
        sensor=mb.AbsoluteAngles(guessAngle1=np.deg2rad(20.0)),
    )  # fmt: skip
    solution = ac.compile(model).simulate(t1=1.0)
    assert np.allclose(np.rad2deg(np.asarray(solution["sensor.angles"])[0]), degrees)


def test_angles_are_states_only_where_they_are_wanted() -> None:
    quaternion = ac.compile(free_body(ORIGIN, (1.0, 0.0, 0.0)))
    assert {f"free.Q[{k}]" for k in (1, 2, 3, 4)} <= {*quaternion.states}
    assert not any(name.startswith("free.angle") for name in quaternion.states)
    wanted = ac.compile(free_body(ORIGIN, (1.0, 0.0, 0.0), 0.0, angle_1_stateSelect="always"))
    assert {f"free.angle_{k}" for k in (1, 2, 3)} <= {*wanted.states}
    assert not any(name.startswith("free.Q") for name in wanted.states)
    solution = wanted.simulate(t1=20.0, rtol=1e-9)
    assert np.allclose(solution["free.angle_1"][-1], 20.0)  # they count whole turns


USERS = {
    "DoublePendulumInitTip": msl_elementary.double_pendulum_init_tip,
    "PrismaticConstraint": msl_constraints.prismatic_constraint,
    "RevoluteConstraint": msl_constraints.revolute_constraint,
    "SphericalConstraint": msl_constraints.spherical_constraint,
    "UniversalConstraint": msl_constraints.universal_constraint,
}


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
@pytest.mark.parametrize("rtol", [1e-6, 1e-9])
@pytest.mark.parametrize("name", USERS)
def test_official_trajectories_at_other_tolerances(name: str, rtol: float, engine: Any) -> None:
    assert_within(name, USERS[name](), engine, rtol=rtol)


@pytest.mark.parametrize("guess", [
    (1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.0), (0.95, 0.0, 0.0, 0.3), (0.6, 0.7, -0.4, 0.0),
    (0.0, 0.0, 0.0, 1.0), (0.0, 0.0, 0.0, -1.0),
])  # fmt: skip
@pytest.mark.parametrize("kind", ["body", "spherical"])
def test_fixed_angles_do_not_depend_on_guesses(guess: tuple[float, ...], kind: str) -> None:
    """Whatever the quaternion is guessed to be: also half a turn off, about each axis."""
    angles, origin = (0.4, -0.3, 0.2), start(ORIGIN, fixed=True)
    fixed_angles: dict[str, Any] = {"angles_fixed": True, "angles_start": angles}
    world = inner(mb.World(gravityType="NoGravity"))
    body = mb.Body(m=1.0, r_0=origin, v_0=origin, w_0_fixed=True, Q=start(guess), **fixed_angles)
    model: Component = assemble(world=world, body=body)
    if kind == "spherical":
        joint = mb.Spherical(enforceStates=True, w_rel_a_fixed=True, Q=start(guess), **fixed_angles)
        connections = "world.frame_b - joint.frame_a", "joint.frame_b - body.frame_a"
        model = assemble(*connections, world=world, joint=joint, body=mb.Body(m=1.0))
    T = np.asarray(ac.compile(model).simulate(0.1)["body.frame_a.R.T"])[0].reshape(3, 3)
    np.testing.assert_allclose(T, turned(angles), atol=1e-9)
