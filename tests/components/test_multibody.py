"""3-D mechanics without loops: against closed solutions, conservation laws, and equations written by hand."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import ellipk

import acausal as ac
from acausal import Array, Component, Equations, Solution, System, connect, inner, start
from acausal.components import multibody as mb
from acausal.components import planar, thermal
from acausal.components.examples import assemble

G = 9.81
DOWN_Z = mb.World(g=G, n=(0.0, 0.0, -1.0))
ORIGIN = (0.0, 0.0, 0.0)
OF_A_BODY = ("m", "r_CM[1]", "r_CM[2]", "r_CM[3]", "I_11", "I_22", "I_33", "I_21", "I_31", "I_32")


def simulated(model: Component, t1: float, **options: Any) -> tuple[System, Solution]:
    system = ac.compile(model)
    return system, system.simulate(t1=t1, **{"rtol": 1e-9, **options})


def rows(solution: Solution, name: str) -> np.ndarray:
    """Values of a vector (n_t, 3) or a matrix (n_t, 3, 3)."""
    values = np.asarray(solution[name])
    return values.reshape(len(values), 3, 3) if values.shape[1] == 9 else values


class Swing(Component):
    """A point mass on a massless rod, on a hinge about a slanted axis."""

    world: mb.World = inner(mb.World(g=G))
    hinge: mb.Revolute = mb.Revolute(n=(0.0, 0.0, 1.0), phi=start(0.0, fixed=True), w=start(0.0, fixed=True))
    bob: mb.Body = mb.Body(m=2.0, r_CM=(1.5, 0.0, 0.0), I_11=0.0, I_22=0.0, I_33=0.0)

    def equations(self) -> Equations:
        yield connect(self.world.frame_b, self.hinge.frame_a)
        yield connect(self.hinge.frame_b, self.bob.frame_a)


def test_pendulum_has_the_period_of_the_elliptic_integral() -> None:
    amplitude = 2.0  # from the lowest point
    start_angle = -np.pi / 2 + amplitude
    period = 4 * np.sqrt(1.5 / G) * ellipk(np.sin(amplitude / 2) ** 2)
    model = Swing(hinge=mb.Revolute(phi=start(start_angle, fixed=True)))
    system, solution = simulated(model, period, saveat=[0.0, period / 4, period / 2, period], rtol=1e-10)
    assert system.states == ("hinge.phi", "hinge.w")
    wanted = [start_angle, -np.pi / 2, -np.pi / 2 - amplitude, start_angle]
    assert np.allclose(solution["hinge.phi"], wanted, atol=1e-6)


class Tumbling(Component):
    """A free body that turns about its axis of intermediate inertia, which is unstable."""

    world: mb.World = inner(mb.World(gravityType="NoGravity"))
    body: mb.Body = mb.Body(
        m=2.0, r_CM=(0.1, -0.2, 0.3), I_11=1.0, I_22=2.0, I_33=3.0, I_21=0.1, w_0_fixed=True,
        w_0_start=(0.01, 3.0, 0.02), angles_fixed=True, angles_start=(0.3, -0.5, 0.7),
        r_0=start(ORIGIN, fixed=True), v_0=start((1.0, 2.0, 3.0), fixed=True),
    )  # fmt: skip


def inertia(prefix: str, p: dict[str, float]) -> np.ndarray:
    def element(i: int, j: int) -> float:
        return p[f"{prefix}.I_{max(i, j)}{min(i, j)}"]

    return np.array([[element(i, j) for j in (1, 2, 3)] for i in (1, 2, 3)])


def motion_of(solution: Solution, body: str, p: dict[str, float]) -> tuple[np.ndarray, ...]:
    """Position and velocity of the centre of mass, angular momentum about it (world), rotational energy."""
    T, w = rows(solution, f"{body}.frame_a.R.T"), rows(solution, f"{body}.frame_a.R.w")
    r_CM = np.array([p[f"{body}.r_CM[{k}]"] for k in (1, 2, 3)])
    position = rows(solution, f"{body}.r_0") + np.einsum("tij,i->tj", T, r_CM)
    velocity = rows(solution, f"{body}.v_0") + np.einsum("tij,ti->tj", T, np.cross(w, r_CM))
    spin = w @ inertia(body, p)
    return position, velocity, np.einsum("tij,ti->tj", T, spin), 0.5 * np.einsum("ti,ti->t", w, spin)


def test_free_body_conserves_energy_and_angular_momentum_through_many_turns() -> None:
    system, solution = simulated(Tumbling(), 30.0, rtol=1e-10)
    _, velocity, momentum, energy = motion_of(solution, "body", system.parameters)
    assert np.ptp(energy) < 1e-6 * energy[0]
    assert np.abs(momentum - momentum[0]).max() < 1e-6 * np.abs(momentum[0]).max()
    assert np.abs(velocity - velocity[0]).max() < 1e-6
    T = rows(solution, "body.frame_a.R.T")
    assert np.abs(np.einsum("tij,tkj->tik", T, T) - np.eye(3)).max() < 1e-12
    assert T[:, 1, 1].min() < -0.9  # it turned over


def test_free_body_obeys_euler_equations() -> None:
    system, solution = simulated(Tumbling(), 10.0, rtol=1e-10)
    J = inertia("body", system.parameters)
    w = rows(solution, "body.frame_a.R.w")
    exact = solve_ivp(
        lambda _, w: np.linalg.solve(J, -np.cross(w, J @ w)), (0, 10), w[0], t_eval=solution.t, rtol=1e-11, atol=1e-12
    )
    assert np.allclose(w, exact.y.T, atol=1e-5)


def test_the_start_of_a_free_body_is_what_was_asked_for() -> None:
    system = ac.compile(Tumbling())
    solution = system.simulate(t1=0.1)
    T, w = rows(solution, "body.frame_a.R.T")[0], rows(solution, "body.frame_a.R.w")[0]
    assert np.allclose(T.T @ w, [0.01, 3.0, 0.02])
    a, b, c = 0.3, -0.5, 0.7

    def about(axis: int, angle: float) -> np.ndarray:
        i, j = [(1, 2), (2, 0), (0, 1)][axis]
        R = np.eye(3)
        R[i, i] = R[j, j] = np.cos(angle)
        R[i, j], R[j, i] = np.sin(angle), -np.sin(angle)
        return R

    assert np.allclose(T, about(2, c) @ about(1, b) @ about(0, a))
    assert np.allclose(np.linalg.norm(solution["body.Q"][0]), 1.0)


class Top(Component):
    """A symmetric top on a ball joint."""

    world: mb.World = inner(DOWN_Z)
    tip: mb.Spherical = mb.Spherical()
    body: mb.Body = mb.Body(
        m=0.5, r_CM=(0.0, 0.0, 0.2), I_11=0.002, I_22=0.002, I_33=0.004, w_0_fixed=True, angles_fixed=True,
        angles_start=(0.4, 0.0, 0.0),
    )  # fmt: skip

    def equations(self) -> Equations:
        yield connect(self.world.frame_b, self.tip.frame_a)
        yield connect(self.tip.frame_b, self.body.frame_a)


def test_heavy_top_precesses_regularly_at_the_right_spin() -> None:
    tilt, spin = 0.4, 150.0
    across, along, m, h = 0.002 + 0.5 * 0.2**2, 0.004, 0.5, 0.2
    # across cos(tilt) W^2 - along spin W + m g h = 0 for the slow precession W; spin is all that turns about the axis
    a, b, c = across * np.cos(tilt), -along * spin, m * G * h
    W = (-b - np.sqrt(b * b - 4 * a * c)) / (2 * a)
    axis = np.array([0.0, -np.sin(tilt), np.cos(tilt)])  # of the body, in the world frame
    w_across = W * (np.array([0.0, 0.0, 1.0]) - axis * np.cos(tilt))
    w_0 = w_across + spin * axis
    model = Top(body=mb.Body(w_0_start=tuple(w_0.tolist())))
    _, solution = simulated(model, 1.0)
    axes = rows(solution, "body.frame_a.R.T")[:, 2]
    assert np.allclose(axes[:, 2], np.cos(tilt), atol=1e-5)
    turned = np.unwrap(np.arctan2(axes[:, 1], axes[:, 0]))
    assert np.allclose(turned - turned[0], W * solution.t, atol=1e-4)


def test_spherical_pendulum_goes_over_the_top() -> None:
    """In a slanted vertical plane it is a plane pendulum, with more than a turn."""
    direction = np.array([np.cos(0.7), np.sin(0.7), 0.0])
    length, speed = 0.8, 6.5
    w_0 = speed / length * np.cross(np.array([0.0, 0.0, -1.0]), direction)
    bob = mb.Body(m=1.0, r_CM=(0.0, 0.0, -length), I_11=0.0, I_22=0.0, I_33=0.01, angles_start=ORIGIN)
    model = ac.modify(Top(body=bob), {"body.w_0_start": w_0.tolist()})
    system, solution = simulated(model, 3.0)
    rates = {f"body.frame_a.R.w[{k}]" for k in (1, 2, 3)}
    assert set(system.states) == rates | {f"body.Q[{k}]" for k in (1, 2, 3, 4)}
    exact = solve_ivp(
        lambda _, y: [y[1], -G / length * np.sin(y[0])], (0, 3), [0, speed / length], t_eval=solution.t, rtol=1e-11,
        atol=1e-12,
    ).y[0]  # fmt: skip
    assert exact.max() > 2 * np.pi
    position, *_ = motion_of(solution, "body", system.parameters)
    assert np.allclose(position[:, 2], -length * np.cos(exact), atol=1e-5)
    assert np.allclose(position @ direction, length * np.sin(exact), atol=1e-5)


def test_states_in_a_spherical_joint() -> None:
    model = Top(tip=mb.Spherical(enforceStates=True))
    system, solution = simulated(model, 1.0)
    assert "tip.Q[1]" in system.states and "body.Q[1]" not in system.states
    _, reference = simulated(Top(), 1.0)
    assert np.allclose(solution["body.frame_a.R.T"], reference["body.frame_a.R.T"], atol=1e-6)


class DoublePendulum(Component):
    """Two point masses on massless rods."""

    world: mb.World = inner(mb.World(g=G))
    first: mb.Revolute = mb.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True))
    rod: mb.FixedTranslation = mb.FixedTranslation(r=(1.0, 0.0, 0.0))
    upper: mb.PointMass = mb.PointMass(m=2.0)
    second: mb.Revolute = mb.Revolute(phi=start(0.5, fixed=True), w=start(0.0, fixed=True))
    lower: mb.Body = mb.Body(m=1.0, r_CM=(0.7, 0.0, 0.0), I_33=0.0)

    def equations(self) -> Equations:
        yield connect(self.world.frame_b, self.first.frame_a)
        yield connect(self.first.frame_b, self.rod.frame_a)
        yield connect(self.rod.frame_b, self.upper.frame_a, self.second.frame_a)
        yield connect(self.second.frame_b, self.lower.frame_a)


def double_pendulum(_: float, y: np.ndarray) -> np.ndarray:
    """Lagrange's equations in the absolute angles from the horizontal."""
    a, b, da, db = y
    m1, m2, l1, l2 = 2.0, 1.0, 1.0, 0.7
    c, s = np.cos(a - b), np.sin(a - b)
    mass = np.array([[(m1 + m2) * l1**2, m2 * l1 * l2 * c], [m2 * l1 * l2 * c, m2 * l2**2]])
    turning = m2 * l1 * l2 * s
    force = [-turning * db**2 - (m1 + m2) * G * l1 * np.cos(a), turning * da**2 - m2 * G * l2 * np.cos(b)]
    return np.concatenate([[da, db], np.linalg.solve(mass, force)])


@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_double_pendulum_against_lagrange(engine: str) -> None:
    system, solution = simulated(DoublePendulum(), 3.0, engine=engine)
    assert system.states == ("first.phi", "first.w", "second.phi", "second.w")
    exact = solve_ivp(double_pendulum, (0, 3), [0, 0.5, 0, 0], t_eval=solution.t, rtol=1e-11, atol=1e-12).y
    assert np.allclose(solution["first.phi"], exact[0], atol=1e-5)
    assert np.allclose(solution["second.phi"], exact[1] - exact[0], atol=1e-5)


class Arm(Component):
    """Six hinges with links between them, as a robot has them."""

    world: mb.World = inner(DOWN_Z)
    a1: mb.Revolute = mb.Revolute(n=(0.0, 0.0, 1.0), phi=start(0.3, fixed=True), w=start(0.5, fixed=True))
    a2: mb.Revolute = mb.Revolute(n=(0.0, 1.0, 0.0), phi=start(0.2, fixed=True), w=start(-0.4, fixed=True))
    a3: mb.Revolute = mb.Revolute(n=(0.0, 1.0, 0.0), phi=start(-0.4, fixed=True), w=start(0.3, fixed=True))
    a4: mb.Revolute = mb.Revolute(n=(1.0, 0.0, 0.0), phi=start(0.5, fixed=True), w=start(0.2, fixed=True))
    a5: mb.Revolute = mb.Revolute(n=(0.0, 1.0, 0.0), phi=start(0.6, fixed=True), w=start(-0.1, fixed=True))
    a6: mb.Revolute = mb.Revolute(n=(1.0, 0.0, 0.0), phi=start(-0.7, fixed=True), w=start(0.4, fixed=True))
    l1: mb.BodyShape = mb.BodyShape(r=(0.0, 0.0, 0.4), r_CM=(0.0, 0.0, 0.2), m=8.0, I_11=0.2, I_22=0.2, I_33=0.1)
    l2: mb.BodyShape = mb.BodyShape(r=(0.5, 0.0, 0.0), r_CM=(0.25, 0.0, 0.0), m=5.0, I_11=0.02, I_22=0.1, I_33=0.1)
    l3: mb.BodyShape = mb.BodyShape(r=(0.4, 0.0, 0.1), r_CM=(0.2, 0.0, 0.05), m=3.0, I_11=0.01, I_22=0.05, I_33=0.05)
    l4: mb.BodyShape = mb.BodyShape(r=(0.2, 0.0, 0.0), r_CM=(0.1, 0.0, 0.0), m=1.0, I_11=0.01, I_22=0.01, I_33=0.01)
    l5: mb.BodyShape = mb.BodyShape(r=(0.1, 0.0, 0.0), r_CM=(0.05, 0.0, 0.0), m=0.5)
    l6: mb.BodyShape = mb.BodyShape(r=(0.1, 0.0, 0.0), r_CM=(0.05, 0.02, 0.0), m=0.3)

    def equations(self) -> Equations:
        before = self.world.frame_b
        for joint, link in zip(
            (self.a1, self.a2, self.a3, self.a4, self.a5, self.a6),
            (self.l1, self.l2, self.l3, self.l4, self.l5, self.l6), strict=True,
        ):  # fmt: skip
            yield connect(before, joint.frame_a)
            yield connect(joint.frame_b, link.frame_a)
            before = link.frame_b


def test_six_axis_arm_has_its_joints_as_states_and_conserves_energy() -> None:
    system, solution = simulated(Arm(), 1.0)
    joints = [f"a{k}" for k in range(1, 7)]
    assert system.states == tuple(f"{joint}.{q}" for joint in joints for q in ("phi", "w"))
    p = system.parameters
    p |= {f"l{k}.body.{n}": p[f"l{k}.{n}"] for k in range(1, 7) for n in OF_A_BODY}
    energy = np.zeros(len(solution.t))
    momentum = np.zeros(len(solution.t))
    for k in range(1, 7):
        position, velocity, spin, rotational = motion_of(solution, f"l{k}.body", p)
        m = p[f"l{k}.m"]
        energy += rotational + 0.5 * m * (velocity**2).sum(axis=1) + m * G * position[:, 2]
        momentum += spin[:, 2] + m * np.cross(position, velocity)[:, 2]
    assert np.ptp(energy) < 1e-6 * np.abs(energy).max()
    assert np.ptp(momentum) < 1e-6 * np.abs(momentum).max()  # about the vertical axis of the first hinge


class Chain(Component):
    """Many equal links: an array of components."""

    n: int = 20
    world: mb.World = inner(mb.World(g=G))
    joints: Array[mb.Revolute] = Array(mb.Revolute(phi=start(0.05, fixed=True), w=start(0.0, fixed=True)), "n")
    links: Array[mb.BodyShape] = Array(mb.BodyShape(r=(0.5, 0.0, 0.0), r_CM=(0.25, 0.0, 0.0), I_33=0.02), "n")

    def equations(self) -> Equations:
        yield connect(self.world.frame_b, self.joints[0].frame_a)
        yield connect(self.joints[:].frame_b, self.links[:].frame_a)
        yield connect(self.links[:-1].frame_b, self.joints[1:].frame_a)


def test_a_long_chain_keeps_its_joints_as_states() -> None:
    system = ac.compile(Chain())
    assert len(system.states) == 40 and all(".phi" in name or ".w" in name for name in system.states)
    assert system.stages.schedule.block_sizes.keys() - {1} and len(system.stages.schedule.invariants) == 0


class Bouncing(Component):
    """A point mass on a spring, in a direction that is no axis."""

    world: mb.World = inner(mb.World(gravityType="NoGravity"))
    spring: mb.Spring = mb.Spring(c=50.0, s_unstretched=0.5)
    bob: mb.PointMass = mb.PointMass(m=2.0, r_0=start((0.4, 0.4, 0.2), fixed=True), v_0=start(ORIGIN, fixed=True))

    def equations(self) -> Equations:
        yield connect(self.world.frame_b, self.spring.frame_a)
        yield connect(self.spring.frame_b, self.bob.frame_a)


def test_mass_on_a_spring_oscillates_harmonically() -> None:
    _, solution = simulated(Bouncing(), 3.0)
    assert np.allclose(solution["spring.s"], 0.5 + 0.1 * np.cos(5.0 * solution.t), atol=1e-6)


@pytest.mark.parametrize("engine", ["native", "diffrax"])
@pytest.mark.parametrize("plane", [False, True])
def test_a_spring_without_length_begins_where_both_of_its_ends_meet(plane: bool, engine: Any) -> None:
    """``f = -c r`` is smooth there, though the line has no direction: a body on it oscillates harmonically."""
    if plane:
        model = assemble(
            "wall.frame - spring.frame_a", "spring.frame_b - body.frame_a", wall=planar.Fixed(),
            spring=planar.Spring(c=100.0), planarWorld=inner(planar.PlanarWorld()),
            body=planar.Body(r=start((0.0, 0.0), fixed=True), v=start((0.5, 0.0), fixed=True)),
        )  # fmt: skip
        x, y = "body.r[1]", "body.r[2]"
    else:
        model = assemble(
            "world.frame_b - spring.frame_a", "spring.frame_b - body.frame_a", spring=mb.Spring(c=100.0),
            world=inner(mb.World(g=9.81)),
            body=mb.Body(r_0=start((0.0, 0.0, 0.0), fixed=True), v_0=start((0.5, 0.0, 0.0), fixed=True)),
        )  # fmt: skip
        x, y = "body.r_0[1]", "body.r_0[2]"
    solution = ac.compile(model).simulate(1.0, engine=engine, rtol=1e-9, saveat=21)
    t = np.asarray(solution.t)
    np.testing.assert_allclose(solution[x], 0.05 * np.sin(10.0 * t), atol=1e-7)
    np.testing.assert_allclose(solution[y], 0.0981 * (np.cos(10.0 * t) - 1.0), atol=1e-7)


class Springs(Component):
    """A rigid body between two springs, one with a mass of its own, that meet the world."""

    world: mb.World = inner(DOWN_Z)
    left: mb.Spring = mb.Spring(c=20.0, s_unstretched=0.1, m=0.3, lengthFraction=0.4)
    right: mb.Spring = mb.Spring(c=30.0)
    place: mb.FixedTranslation = mb.FixedTranslation(r=(0.8, 0.0, 0.0))
    body: mb.BodyShape = mb.BodyShape(
        r=(0.4, 0.0, 0.0), r_CM=(0.2, 0.0, 0.0), m=1.0, I_11=1.0, I_22=1.0, I_33=1.0, angles_fixed=True, w_0_fixed=True,
        angles_start=(0.2, 0.2, 0.2), r_0=start((0.2, -0.5, 0.1), fixed=True), v_0=start(ORIGIN, fixed=True),
    )  # fmt: skip

    def equations(self) -> Equations:
        yield connect(self.world.frame_b, self.left.frame_a, self.place.frame_a)
        yield connect(self.left.frame_b, self.body.frame_a)
        yield connect(self.place.frame_b, self.right.frame_a)
        yield connect(self.right.frame_b, self.body.frame_b)


def test_springs_with_mass_conserve_energy() -> None:
    system, solution = simulated(Springs(), 5.0)
    p = system.parameters
    p |= {f"body.body.{n}": p[f"body.{n}"] for n in OF_A_BODY}
    position, velocity, _, energy = motion_of(solution, "body.body", p)
    energy = energy + 0.5 * (velocity**2).sum(axis=1) + G * position[:, 2]
    place, moving = rows(solution, "left.r_CM_0"), rows(solution, "left.v_CM_0")
    energy += 0.3 * (0.5 * (moving**2).sum(axis=1) + G * place[:, 2])
    energy += 0.5 * 20.0 * (solution["left.s"] - 0.1) ** 2 + 0.5 * 30.0 * solution["right.s"] ** 2
    assert np.ptp(energy) < 1e-6 * np.abs(energy).max()


class Orbit(Component):
    """A body on an ellipse about a point that attracts it."""

    world: mb.World = inner(mb.World(gravityType="PointGravity", mu=1.0))
    body: mb.PointMass = mb.PointMass(r_0=start((1.0, 0.0, 0.0), fixed=True), v_0=start((0.0, 0.6, 0.8), fixed=True))


def test_point_gravity_closes_a_circle() -> None:
    _, solution = simulated(Orbit(), 2 * np.pi)
    assert np.allclose(solution["body.r_0"][-1], [1.0, 0.0, 0.0], atol=1e-6)
    assert np.allclose(np.linalg.norm(solution["body.r_0"], axis=1), 1.0, atol=1e-6)


def test_names_and_choices_that_do_not_exist() -> None:
    with pytest.raises(ac.DeclarationError, match=r"World\(gravityType='Uniform'\): choose from UniformGravity"):
        ac.compile(Swing(world=mb.World(gravityType="Uniform")))
    with pytest.raises(ac.ConnectError, match=r"nothing gives `rod.frame_a.R`, .*: the connections lead to no root"):
        ac.compile(Loose())


class Loose(Component):
    """A rod that hangs on nothing."""

    world: mb.World = inner(mb.World())
    rod: mb.FixedTranslation = mb.FixedTranslation()


@pytest.mark.parametrize("strut", [
    mb.Damper(d=3.0, useHeatPort=True),
    mb.SpringDamperParallel(c=20.0, s_unstretched=1.0, d=3.0, useHeatPort=True),
    mb.SpringDamperSeries(c=20.0, s_unstretched=1.0, d=3.0, useHeatPort=True, s_damper=start(0.1, fixed=True)),
], ids=lambda s: type(s).__name__)  # fmt: skip
def test_a_strut_heats_what_it_damps(strut: Component) -> None:
    """Energy of a swinging mass, of its spring and of the heat is what it was."""
    model = assemble(
        "world.frame_b - strut.frame_a", "strut.frame_b - bob.frame_a", "strut.heatPort - tank.port", strut=strut,
        world=inner(mb.World(g=9.81)), tank=thermal.HeatCapacitor(C=2.0, T=start(300.0, fixed=True)),
        bob=mb.PointMass(
            m=2.0, r_0=start((0.5, -1.0, 0.2), fixed=True), v_0=start((1.0, -0.5, 0.0), fixed=True)
        ),
    )  # fmt: skip
    solution = ac.compile(model).simulate(0.5, saveat=11, rtol=1e-10)
    speed = sum(np.asarray(solution[f"bob.v_0[{k}]"]) ** 2 for k in (1, 2, 3))
    energy = speed + 2.0 * 9.81 * np.asarray(solution["bob.frame_a.r_0[2]"])
    if not isinstance(strut, mb.Damper):
        given = np.asarray(solution["strut.s_damper"]) if isinstance(strut, mb.SpringDamperSeries) else 0.0
        energy = energy + 10.0 * (np.asarray(solution["strut.s"]) - 1.0 - given) ** 2
    heat = 2.0 * (np.asarray(solution["tank.T"]) - 300.0)
    assert heat[-1] > 0.1
    np.testing.assert_allclose(energy + heat, energy[0], rtol=1e-7)
