"""Planar wheels, gears and sensors: hand-written equations, gears of one dimension, and the 3-D library."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

import acausal as ac
from acausal import Component, Equations, Parameter, Variable, connect, inner, start
from acausal.components import blocks, multibody, planar, rotational
from acausal.components.examples import assemble

WEIGHTLESS = planar.PlanarWorld(constantGravity=(0.0, 0.0))


def friction(slip: np.ndarray | float, adhesion: float, slide: float, most: float, sliding: float) -> Any:
    """The curve by its definition: cubic from (-adhesion, -most) to (adhesion, most), another to (slide, sliding)."""
    size = np.abs(slip)
    middle = (slide + adhesion) / 2
    x = np.clip((size - middle) * 2 / (slide - adhesion), -1.0, 1.0)
    outer = (1.5 * x - 0.5 * x**3) * (sliding - most) / 2 + (most + sliding) / 2
    y = np.minimum(size / adhesion, 1.0)
    return np.sign(slip) * np.where(size > adhesion, outer, (1.5 * y - 0.5 * y**3) * most)


def test_slip_curve() -> None:
    class Curve(Component):
        adhesion: Parameter = Parameter(0.1, unit="m/s")
        slide: Parameter = Parameter(0.3, unit="m/s")
        most: Parameter = Parameter(0.8, unit="1")
        sliding: Parameter = Parameter(0.4, unit="1")
        v: Variable = Variable(unit="m/s")
        mu: Variable = Variable(unit="1")

        def equations(self) -> Equations:
            yield self.v == 0.5 * (ac.time - 1.0)
            yield self.mu == planar.slip_curve(self.v, self.adhesion, self.slide, self.most, self.sliding)

    t = np.linspace(0.0, 2.0, 201)
    solution = ac.compile(Curve()).simulate(2.0, saveat=t)
    assert_allclose(solution["mu"], friction(0.5 * (t - 1.0), 0.1, 0.3, 0.8, 0.4), atol=1e-9)


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_wheel_spins_up_and_skids_sideways(engine: Any) -> None:
    """A car on one wheel, driven too hard and thrown sideways, against its equations of motion by SciPy."""
    m, inertia, J, R, N, tau = 10.0, 2.0, 0.5, 0.3, 100.0, 40.0
    model = assemble(
        "none.y - wheel.dynamicLoad", "drive.flange - rim.flange_a", "rim.flange_b - wheel.flange_a",
        "car.frame_a - wheel.frame_a", planarWorld=inner(WEIGHTLESS), none=blocks.Constant(k=0.0),
        drive=rotational.ConstantTorque(tau_constant=tau), wheel=planar.SlipBasedWheelJoint(radius=R, N=N),
        rim=rotational.Inertia(J=J, phi=start(0.0, fixed=True), w=start(20.0, fixed=True)),
        car=planar.Body(m=m, I=inertia, r=start((0.0, 0.0), fixed=True), v=start((5.0, 3.0), fixed=True),
            phi=start(0.2, fixed=True), w=start(0.7, fixed=True)),
    )  # fmt: skip
    t = np.linspace(0.0, 2.0, 41)
    solution = ac.compile(model).simulate(2.0, saveat=t, rtol=1e-9, engine=engine)

    def rate(t: float, z: np.ndarray) -> list[float]:
        vx, vy, phi, w = z[0], z[1], 0.2 + 0.7 * t, z[2]
        e = np.array([np.cos(phi), np.sin(phi)])
        long, lat = vx * e[0] + vy * e[1] - R * w, vy * e[0] - vx * e[1]
        slip = np.sqrt(long**2 + lat**2 + 1e-8)
        rim = abs(R * w)
        f = N * friction(slip, max(0.04 * rim, 0.05), max(0.12 * rim, 0.15), 0.8, 0.4)
        f_long, f_lat = f * long / slip, f * lat / slip
        force = -f_long * e - f_lat * np.array([-e[1], e[0]])
        return [force[0] / m, force[1] / m, (tau + R * f_long) / J]

    z = solve_ivp(rate, (0.0, 2.0), [5.0, 3.0, 20.0], method="LSODA", t_eval=t, rtol=1e-10, atol=1e-12).y
    assert_allclose(solution["car.v[1]"], z[0], atol=1e-5)
    assert_allclose(solution["car.v[2]"], z[1], atol=1e-5)
    assert_allclose(solution["rim.w"], z[2], atol=1e-4)
    kinetic = m / 2 * (z[0] ** 2 + z[1] ** 2) + J / 2 * z[2] ** 2
    driven = tau * np.asarray(solution["rim.phi"])
    lost = np.asarray(solution["wheel.lossPower"])
    assert (lost >= 0).all() and (kinetic - kinetic[0] <= driven + 1e-9).all()


def test_skidding_wheel_comes_to_roll() -> None:
    """A disc thrown without spin slides at ``mu_S g`` until it rolls, at two thirds of its speed."""
    model = assemble(
        "wheel.frame_a - disc.frame_a", planarWorld=inner(planar.PlanarWorld(constantGravity=(0.0, -10.0))),
        wheel=planar.DryFrictionBasedRolling(R=0.5, vAdhesion=1e-3, vSlide=2e-3, mu_A=0.3, mu_S=0.3),
        disc=planar.Body(m=2.0, I=0.25, r=start((0.0, 0.5), fixed=True), v=start((3.0, 0.0)),
            phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
    )  # fmt: skip
    solution = ac.compile(model).simulate(1.0, saveat=[0.0, 0.1, 0.3, 0.5, 1.0], rtol=1e-8)
    assert_allclose(solution["disc.v[1]"], [3.0, 2.7, 2.1, 2.0, 2.0], atol=2e-3)
    assert_allclose(solution["disc.w"][-1], -4.0, atol=5e-3)


def test_planetary_gear_of_gears_in_the_plane() -> None:
    """A sun, a planet on a carrier, and a ring that is held: the gear of one dimension."""
    r_sun, r_planet = 1.0, 0.5
    r_ring = r_sun + 2 * r_planet
    arm = r_sun + r_planet
    plane = assemble(
        "wall.frame - sun_joint.frame_a - carrier_joint.frame_a", "sun_joint.frame_b - sun.frame_a - inside.frame_a",
        "carrier_joint.frame_b - carrier.frame_a", "carrier.frame_b - planet_joint.frame_a",
        "planet_joint.frame_b - planet.frame_a - inside.frame_b - outside.frame_a", "wall.frame - outside.frame_b",
        "drive.flange - sun_joint.flange_a", drive=rotational.ConstantTorque(tau_constant=3.0),
        planarWorld=inner(WEIGHTLESS), wall=planar.Fixed(),
        sun_joint=planar.Revolute(useFlange=True, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        carrier_joint=planar.Revolute(phi=start(0.0)), carrier=planar.FixedTranslation(r=(arm, 0.0)),
        planet_joint=planar.Revolute(), sun=planar.Body(m=1.0, I=2.0), planet=planar.Body(m=4.0, I=0.5),
        inside=planar.RigidNoLossExternal(r_a=r_sun, r_b=r_planet),
        outside=planar.RigidNoLossInternal(r_a=r_planet, r_b=r_ring),
    )  # fmt: skip
    t = np.linspace(0.0, 4.0, 9)
    solution = ac.compile(plane).simulate(4.0, saveat=t, rtol=1e-9)
    share = r_sun / (r_sun + r_ring)  # of the carrier's speed: (1 + r_ring/r_sun) w_carrier = w_sun
    planet = -share * r_ring / r_planet + share  # the planet rolls in the ring
    inertia = 2.0 + 4.0 * (arm * share) ** 2 + 0.5 * planet**2
    assert_allclose(solution["sun.w"], 3.0 * t / inertia, atol=1e-6)
    assert_allclose(solution["carrier_joint.w"], share * 3.0 * t / inertia, atol=1e-6)
    assert_allclose(solution["planet.w"], planet * 3.0 * t / inertia, atol=1e-6)


class Turning(Component):
    """Two arms on two hinges, in the plane and in space, with all sensors at both ends of the second."""

    resolve: str = "frame_a"
    planarWorld: planar.PlanarWorld = inner(planar.PlanarWorld(constantGravity=(0.0, -9.81)))
    world: multibody.World = inner(multibody.World(g=9.81))
    wall: planar.Fixed = planar.Fixed()
    one: planar.Revolute = planar.Revolute(phi=start(0.3, fixed=True), w=start(1.0, fixed=True))
    arm: planar.FixedTranslation = planar.FixedTranslation(r=(1.0, 0.2))
    body: planar.Body = planar.Body(m=2.0, I=0.3)
    two: planar.Revolute = planar.Revolute(phi=start(-0.5, fixed=True), w=start(-2.0, fixed=True))
    rod: planar.FixedTranslation = planar.FixedTranslation(r=(0.7, 0.0))
    bob: planar.Body = planar.Body(m=1.0, I=0.1)
    absolute: planar.AbsoluteVelocity = planar.AbsoluteVelocity(resolveInFrame=ac.structural("resolve"))
    absolute2: planar.AbsoluteAcceleration = planar.AbsoluteAcceleration(resolveInFrame=ac.structural("resolve"))
    relative: planar.RelativePosition = planar.RelativePosition(resolveInFrame=ac.structural("resolve"))
    relative1: planar.RelativeVelocity = planar.RelativeVelocity(resolveInFrame=ac.structural("resolve"))
    relative2: planar.RelativeAcceleration = planar.RelativeAcceleration(resolveInFrame=ac.structural("resolve"))
    hinge1: multibody.Revolute = multibody.Revolute(phi=start(0.3, fixed=True), w=start(1.0, fixed=True))
    arm3: multibody.FixedTranslation = multibody.FixedTranslation(r=(1.0, 0.2, 0.0))
    body3: multibody.Body = multibody.Body(m=2.0, r_CM=(0.0, 0.0, 0.0), I_33=0.3)
    hinge2: multibody.Revolute = multibody.Revolute(phi=start(-0.5, fixed=True), w=start(-2.0, fixed=True))
    rod3: multibody.FixedTranslation = multibody.FixedTranslation(r=(0.7, 0.0, 0.0))
    bob3: multibody.Body = multibody.Body(m=1.0, r_CM=(0.0, 0.0, 0.0), I_33=0.1)
    absolute3: multibody.AbsoluteSensor = multibody.AbsoluteSensor(
        get_v=True, get_a=True, get_w=True, get_z=True, resolveInFrame=ac.structural("resolve")
    )
    relative3: multibody.RelativeSensor = multibody.RelativeSensor(
        get_r_rel=True, resolveInFrame=ac.structural("resolve")
    )
    seen3: multibody.RelativeVelocity = multibody.RelativeVelocity(resolveInFrame=ac.structural("resolve"))

    def equations(self) -> Equations:
        yield connect(self.wall.frame, self.one.frame_a)
        yield connect(self.one.frame_b, self.arm.frame_a)
        yield connect(self.arm.frame_b, self.body.frame_a, self.two.frame_a)
        yield connect(self.two.frame_b, self.rod.frame_a)
        yield connect(self.rod.frame_b, self.bob.frame_a, self.absolute.frame_a, self.absolute2.frame_a)
        for sensor in (self.relative, self.relative1, self.relative2):
            yield connect(self.arm.frame_b, sensor.frame_a)
            yield connect(self.rod.frame_b, sensor.frame_b)
        yield connect(self.world.frame_b, self.hinge1.frame_a)
        yield connect(self.hinge1.frame_b, self.arm3.frame_a)
        yield connect(self.arm3.frame_b, self.body3.frame_a, self.hinge2.frame_a)
        yield connect(self.hinge2.frame_b, self.rod3.frame_a)
        yield connect(self.rod3.frame_b, self.bob3.frame_a, self.absolute3.frame_a)
        for sensor in (self.relative3, self.seen3):
            yield connect(self.arm3.frame_b, sensor.frame_a)
            yield connect(self.rod3.frame_b, sensor.frame_b)


@pytest.mark.parametrize("resolve", ["frame_a", "world"])
def test_sensors_are_those_of_space(resolve: str) -> None:
    t = np.linspace(0.0, 1.0, 11)
    solution = ac.compile(Turning(resolve=resolve)).simulate(1.0, saveat=t, rtol=1e-10)
    for mine, theirs in (
        ("absolute.v", "absolute3.v"), ("absolute2.a", "absolute3.a"), ("relative.r_rel", "relative3.r_rel"),
        ("relative1.v_rel", "seen3.v_rel"),
    ):  # fmt: skip
        for k in (1, 2):
            assert_allclose(solution[f"{mine}[{k}]"], solution[f"{theirs}[{k}]"], atol=1e-6, err_msg=f"{mine}[{k}]")
    assert_allclose(solution["absolute.v[3]"], solution["absolute3.w[3]"], atol=1e-7)
    assert_allclose(solution["absolute2.a[3]"], solution["absolute3.z[3]"], atol=1e-6)
    assert_allclose(solution["relative.r_rel[3]"], solution["two.phi"], atol=1e-12)
    w, z = np.asarray(solution["two.w"]), np.asarray(solution["two.z"])
    assert_allclose(solution["relative2.a_rel[3]"], z, atol=1e-7)
    size = np.hypot(solution["relative2.a_rel[1]"], solution["relative2.a_rel[2]"])
    assert_allclose(size, 0.7 * np.hypot(w**2, z), atol=1e-6)


def test_vectors_are_resolved_in_a_frame_of_its_own() -> None:
    model = assemble(
        "wall.frame - rod.frame_a", "rod.frame_b - push.frame_b", "compass.frame - push.frame_resolve",
        "compass.frame - meter.frame_resolve", "wall.frame - meter.frame_a", "rod.frame_b - meter.frame_b",
        "x.y - push.force[0]", "none.y - push.force[1] - push.force[2]", wall=planar.Fixed(),
        compass=planar.Fixed(phi=np.pi / 2), rod=planar.FixedTranslation(r=(2.0, 0.0)),
        x=blocks.Constant(k=5.0), none=blocks.Constant(k=0.0),
        push=planar.WorldForce(resolveInFrame="frame_resolve"),
        meter=planar.RelativePosition(resolveInFrame="frame_resolve"),
    )  # fmt: skip
    solution = ac.compile(model).simulate(1.0, saveat=[1.0])
    assert_allclose([solution["wall.frame.t"][0], solution["meter.r_rel[2]"][0]], [10.0, -2.0], atol=1e-12)


def test_unknown_frame() -> None:
    with pytest.raises(ac.DeclarationError, match=r"AbsoluteVelocity: .*one of world, frame_a, frame_resolve, not"):
        ac.compile(planar.AbsoluteVelocity(resolveInFrame="b"))


def test_body_without_weight() -> None:
    stone = planar.Body(
        enableGravity=False, r=start((0.0, 0.0), fixed=True), v=start((1.0, 2.0), fixed=True),
        phi=start(0.0, fixed=True), w=start(0.0, fixed=True),
    )  # fmt: skip
    model = assemble(planarWorld=inner(planar.PlanarWorld()), stone=stone)
    assert_allclose(ac.compile(model).simulate(1.0, saveat=[1.0])["stone.r[2]"], 2.0, rtol=1e-9)


@pytest.mark.parametrize(("out", "wanted"), [("", [1.0, 2.0]), ("frame_a", [2.0, -1.0])])
def test_transformed_vector(out: str, wanted: list[float]) -> None:
    """By default it stays in its frame."""
    turn = planar.TransformAbsoluteVector(frame_r_in="world", frame_r_out=out)
    model = assemble(
        "wall.frame - turn.frame_a", "x.y - turn.r_in[0]", "y.y - turn.r_in[1]", "z.y - turn.r_in[2]", turn=turn,
        wall=planar.Fixed(phi=np.pi / 2), x=blocks.Constant(k=1.0), y=blocks.Constant(k=2.0), z=blocks.Constant(k=3.0),
    )  # fmt: skip
    solution = ac.compile(model).simulate(1.0, saveat=[1.0])
    assert_allclose([solution[f"turn.r_out[{k}]"][0] for k in (1, 2, 3)], [*wanted, 3.0], atol=1e-12)


def test_pendulum_in_space_on_a_cart_in_the_plane() -> None:
    """What hangs on the cart swings in all directions: energy and momentum along x stay, the plane carries the rest."""
    model = assemble(
        "wall.frame - guide.frame_a", "guide.frame_b - cart.frame_a - lift.frame_a", "lift.frame_b - ball.frame_a",
        "ball.frame_b - bob.frame_a", planarWorld=inner(planar.PlanarWorld()), world=inner(multibody.World(g=9.81)),
        wall=planar.Fixed(), cart=planar.Body(m=2.0), lift=planar.PlanarToMultiBody(zPosition=0.5),
        guide=planar.Prismatic(s=start(0.0, fixed=True), v=start(0.3, fixed=True)), ball=multibody.Spherical(),
        bob=multibody.Body(m=1.5, r_CM=(0.0, -0.8, 0.0), I_11=0.01, I_22=0.01, I_33=0.01, angles_fixed=True,
            angles_start=(0.7, 0.0, 0.4), w_0_fixed=True, w_0_start=(0.5, 0.0, 1.0)),
    )  # fmt: skip
    t = np.linspace(0.0, 3.0, 31)
    solution = ac.compile(model).simulate(3.0, saveat=t, rtol=1e-9)
    T = np.array([[solution[f"bob.frame_a.R.T[{i},{j}]"] for j in (1, 2, 3)] for i in (1, 2, 3)])
    w = np.array([solution[f"bob.frame_a.R.w[{i}]"] for i in (1, 2, 3)])
    arm = np.array([0.0, -0.8, 0.0])
    swing = np.einsum("jit,jt->it", T, np.cross(w, arm[:, None], axis=0))  # in the world frame
    v = swing + np.array([solution["cart.v[1]"], solution["cart.v[2]"], 0.0 * t])
    height = np.einsum("jit,j->it", T, arm)[1]
    energy = 0.75 * (v**2).sum(axis=0) + 0.005 * (w**2).sum(axis=0) + 1.5 * 9.81 * height
    energy += np.asarray(solution["cart.v[1]"]) ** 2
    assert_allclose(energy, energy[0], atol=1e-6)
    momentum = 2.0 * np.asarray(solution["cart.v[1]"]) + 1.5 * v[0]
    assert_allclose(momentum, momentum[0], atol=1e-7)
    assert np.ptp(v[2]) > 0.5 and np.ptp(solution["lift.fz"]) > 1.0
    assert_allclose(solution["bob.frame_a.r_0[3]"], 0.5, atol=1e-12)


def test_a_slide_without_direction_is_an_error() -> None:
    model = assemble(
        "wall.frame - slide.frame_a", "slide.frame_b - load.frame_a", wall=planar.Fixed(), load=planar.Body(),
        slide=planar.Prismatic(r=(0.0, 0.0)), planarWorld=inner(planar.PlanarWorld()),
    )  # fmt: skip
    with pytest.raises(ac.SimulationError, match=r"assertion of slide .* the direction `r` of sliding has no length"):
        ac.compile(model).simulate(1.0)
