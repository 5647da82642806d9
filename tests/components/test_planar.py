"""Planar mechanics against closed solutions, hand-written equations of motion, and conservation laws."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import jax
import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp
from scipy.special import ellipj, ellipk

import acausal as ac
from acausal import Component, Equations, Parameter, Variable, connect, inner, start
from acausal.components import hydraulic, planar, rotational, translational
from acausal.components.examples import assemble

G = 9.81


def simulate(model: Component, t: np.ndarray, rtol: float = 1e-10) -> ac.Solution:
    return ac.compile(model).simulate(t1=float(t[-1]), saveat=t, rtol=rtol)


def integrated(rate: Callable[[float, np.ndarray], list[float]], begin: list[float], t: np.ndarray) -> np.ndarray:
    """The hand-written equations of motion, by an independent solver."""
    result = solve_ivp(rate, (0.0, float(t[-1])), begin, method="DOP853", t_eval=t, rtol=1e-11, atol=1e-12)
    return np.asarray(result.y)


def energy(solution: ac.Solution, **bodies: tuple[float, float]) -> np.ndarray:
    """Kinetic and potential energy of bodies, each given by mass and moment of inertia."""
    total = np.zeros(len(solution.t))
    for name, (m, inertia) in bodies.items():
        speed = np.asarray(solution[f"{name}.v[1]"]) ** 2 + np.asarray(solution[f"{name}.v[2]"]) ** 2
        total += 0.5 * m * speed + 0.5 * inertia * np.asarray(solution[f"{name}.w"]) ** 2
        total += m * G * np.asarray(solution[f"{name}.r[2]"])
    return total


def test_pendulum_swings_as_the_elliptic_functions_say() -> None:
    amplitude, m, length, inertia = 2.5, 2.0, 1.3, 0.7
    model = assemble(
        "wall.frame - hinge.frame_a", "hinge.frame_b - rod.frame_a", "rod.frame_b - bob.frame_a",
        planarWorld=inner(planar.PlanarWorld()), wall=planar.Fixed(r=(3.0, 0.0)),
        rod=planar.FixedTranslation(r=(length, 0.0)),
        hinge=planar.Revolute(phi=start(amplitude - np.pi / 2, fixed=True), w=start(0.0, fixed=True)),
        bob=planar.Body(m=m, I=inertia),
    )  # fmt: skip
    t = np.linspace(0.0, 10.0, 101)
    solution = simulate(model, t)
    frequency = np.sqrt(m * G * length / (inertia + m * length**2))
    k = np.sin(amplitude / 2)
    angle = 2 * np.arcsin(k * ellipj(ellipk(k**2) - frequency * t, k**2)[0])
    assert len(solution.system.states) == 2
    assert_allclose(solution["hinge.phi"] + np.pi / 2, angle, atol=1e-7)
    assert_allclose(solution["bob.r[1]"], 3.0 + length * np.sin(angle), atol=1e-7)


def test_double_pendulum() -> None:
    m1, m2, l1, l2 = 1.0, 2.0, 1.0, 0.7
    model = assemble(
        "wall.frame - one.frame_a", "one.frame_b - upper.frame_a", "upper.frame_b - first.frame_a - two.frame_a",
        "two.frame_b - lower.frame_a", "lower.frame_b - second.frame_a", planarWorld=inner(planar.PlanarWorld()),
        wall=planar.Fixed(), one=planar.Revolute(phi=start(0.3, fixed=True), w=start(0.0, fixed=True)),
        two=planar.Revolute(phi=start(0.5, fixed=True), w=start(1.0, fixed=True)),
        upper=planar.FixedTranslation(r=(l1, 0.0)), lower=planar.FixedTranslation(r=(l2, 0.0)),
        first=planar.PointMass(m=m1), second=planar.PointMass(m=m2),
    )  # fmt: skip

    def rate(_: float, z: np.ndarray) -> list[float]:
        """Angles p, q of both rods against the horizontal, from Lagrange's equations."""
        p, q, u, v = z
        matrix = np.array(
            [[(m1 + m2) * l1**2, m2 * l1 * l2 * np.cos(p - q)], [m2 * l1 * l2 * np.cos(p - q), m2 * l2**2]]
        )
        right = [
            -m2 * l1 * l2 * np.sin(p - q) * v**2 - (m1 + m2) * G * l1 * np.cos(p),
            m2 * l1 * l2 * np.sin(p - q) * u**2 - m2 * G * l2 * np.cos(q),
        ]
        return [u, v, *np.linalg.solve(matrix, right)]

    t = np.linspace(0.0, 3.0, 61)
    solution = simulate(model, t)
    p, q, _, _ = integrated(rate, [0.3, 0.8, 0.0, 1.0], t)
    assert len(solution.system.states) == 4
    assert_allclose(solution["one.phi"], p, atol=1e-6)
    assert_allclose(solution["one.phi"] + solution["two.phi"], q, atol=1e-6)


def test_pendulum_on_a_cart() -> None:
    cart, bob, length, c, rest = 3.0, 1.0, 0.8, 40.0, 1.5
    model = assemble(
        "wall.frame - rail.frame_a - spring.frame_a", "rail.frame_b - cart.frame_a - hinge.frame_a - spring.frame_b",
        "hinge.frame_b - rod.frame_a", "rod.frame_b - bob.frame_a", planarWorld=inner(planar.PlanarWorld()),
        wall=planar.Fixed(), rail=planar.Prismatic(s=start(1.2, fixed=True), v=start(0.0, fixed=True)),
        spring=planar.Spring(c=c, s_unstretched=rest), cart=planar.PointMass(m=cart), bob=planar.PointMass(m=bob),
        hinge=planar.Revolute(phi=start(-1.0, fixed=True), w=start(0.0, fixed=True)),
        rod=planar.FixedTranslation(r=(length, 0.0)),
    )  # fmt: skip

    def rate(_: float, z: np.ndarray) -> list[float]:
        s, p, v, w = z
        matrix = [[cart + bob, -bob * length * np.sin(p)], [-np.sin(p), length]]
        right = [bob * length * np.cos(p) * w**2 - c * (s - rest), -G * np.cos(p)]
        return [v, w, *np.linalg.solve(matrix, right)]

    t = np.linspace(0.0, 4.0, 81)
    solution = simulate(model, t)
    s, p, _, _ = integrated(rate, [1.2, -1.0, 0.0, 0.0], t)
    assert_allclose(solution["rail.s"], s, atol=1e-7)
    assert_allclose(solution["hinge.phi"], p, atol=1e-7)


def slider_crank(**parts: Component) -> Component:
    """Crank of 0.3 m, rod of 1 m, piston of 2 kg in a guide along x: a closed loop."""
    parts = {"crank_joint": planar.Revolute(phi=start(0.3, fixed=True), w=start(5.0, fixed=True)), **parts}
    extra = ["drive.flange - crank_joint.flange_a"] if "drive" in parts else []
    return assemble(
        "wall.frame - crank_joint.frame_a - guide.frame_a", "crank_joint.frame_b - crank.frame_a - wheel.frame_a",
        "crank.frame_b - pin.frame_a", "pin.frame_b - rod.frame_a", "rod.frame_b - wrist.frame_a",
        "wrist.frame_b - guide.frame_b - piston.frame_a", *extra, planarWorld=inner(planar.PlanarWorld()),
        wall=planar.Fixed(), crank=planar.FixedTranslation(r=(0.3, 0.0)), wheel=planar.Body(m=0.0, I=1.0),
        rod=planar.FixedTranslation(r=(1.0, 0.0)), pin=planar.Revolute(), wrist=planar.Revolute(),
        guide=planar.Prismatic(s=start(1.2)), piston=planar.Body(m=2.0, I=0.2), **parts,
    )  # fmt: skip


def stroke(phi: np.ndarray) -> np.ndarray:
    return 0.3 * np.cos(phi) + np.sqrt(1.0 - (0.3 * np.sin(phi)) ** 2)


def test_slider_crank_turns_freely() -> None:
    """Through both dead centres, where no choice of one coordinate holds; its energy stays."""
    t = np.linspace(0.0, 10.0, 201)
    solution = simulate(slider_crank(), t, rtol=1e-9)
    phi = np.asarray(solution["crank_joint.phi"])
    assert phi[-1] > 6 * np.pi
    assert_allclose(solution["guide.s"], stroke(phi), atol=1e-9)
    assert_allclose(energy(solution, wheel=(0.0, 1.0), piston=(2.0, 0.2)), np.full(201, energy_at_start()), rtol=1e-7)


def energy_at_start() -> float:
    slope = (stroke(np.array(0.3 + 1e-6)) - stroke(np.array(0.3 - 1e-6))) / 2e-6
    return float(0.5 * 1.0 * 5.0**2 + 0.5 * 2.0 * (5.0 * slope) ** 2)


def test_driven_slider_crank() -> None:
    """At constant speed no state is left; the torque of the drive is the power of the piston by that speed."""
    drive = rotational.Speed(exact=True, phi=start(0.3, fixed=True))
    crank = slider_crank(drive=drive, crank_joint=planar.Revolute(useFlange=True))
    model = ac.modify(crank, {"planarWorld.constantGravity[2]": 0.0})

    class Driven(Component):
        mechanism: Component = model

        def equations(self) -> Equations:
            yield self.mechanism.drive.w_ref == 4.0  # type: ignore[attr-defined]

    t = np.linspace(0.0, 2.0, 41)
    solution = simulate(Driven(), t)
    phi = 0.3 + 4.0 * t
    assert_allclose(solution["mechanism.guide.s"], stroke(phi), atol=1e-8)
    h = 1e-4
    acceleration = 16.0 * (stroke(phi + h) - 2 * stroke(phi) + stroke(phi - h)) / h**2
    slope = (stroke(phi + h) - stroke(phi - h)) / (2 * h)
    assert_allclose(solution["mechanism.crank_joint.t"], 2.0 * acceleration * slope, atol=1e-5)


def four_bar(last: Component) -> Component:
    """Links of 1, 2 and 1.5 m, with masses, between points 2 m apart, closed by `last`."""
    return assemble(
        "left.frame - a.frame_a", "a.frame_b - crank.frame_a", "crank.frame_b - b.frame_a - one.frame_a",
        "b.frame_b - coupler.frame_a", "coupler.frame_b - c.frame_a - two.frame_a", "c.frame_b - rocker.frame_a",
        "rocker.frame_b - d.frame_a", "d.frame_b - right.frame", planarWorld=inner(planar.PlanarWorld()),
        left=planar.Fixed(), right=planar.Fixed(r=(2.0, 0.0)), crank=planar.FixedTranslation(r=(1.0, 0.0)),
        coupler=planar.FixedTranslation(r=(2.0, 0.0)), rocker=planar.FixedTranslation(r=(1.5, 0.0)),
        a=planar.Revolute(phi=start(1.0, fixed=True), w=start(0.0, fixed=True)), b=planar.Revolute(phi=start(-1.0)),
        c=planar.Revolute(phi=start(-1.0)), d=last, one=planar.Body(I=0.1), two=planar.Body(I=0.1),
    )  # fmt: skip


@pytest.mark.parametrize("engine", ["native", "diffrax"])
@pytest.mark.slow_case("diffrax")
def test_four_bar_linkage(engine: str) -> None:
    t = np.linspace(0.0, 5.0, 101)
    system = ac.compile(four_bar(planar.Revolute()))
    solution = system.simulate(t1=5.0, saveat=t, rtol=1e-9, engine=engine)  # type: ignore[arg-type]
    kept = energy(solution, one=(1.0, 0.1), two=(1.0, 0.1))
    assert_allclose(kept, kept[0], rtol=1e-7)
    x, y = np.asarray(solution["two.r[1]"]), np.asarray(solution["two.r[2]"])
    assert_allclose((x - 2.0) ** 2 + y**2, 1.5**2, atol=1e-9)
    assert_allclose((x - solution["one.r[1]"]) ** 2 + (y - solution["one.r[2]"]) ** 2, 4.0, atol=1e-9)
    assert np.ptp(solution["a.phi"]) > np.pi


def test_loop_closed_by_a_constraint() -> None:
    t = np.linspace(0.0, 2.0, 21)
    joint, constraint = (simulate(four_bar(last), t) for last in (planar.Revolute(), planar.RevoluteConstraint()))
    assert_allclose(constraint["a.phi"], joint["a.phi"], atol=1e-7)
    assert_allclose(constraint["right.frame.fx"], joint["right.frame.fx"], atol=1e-6)


def test_gradient_through_a_loop() -> None:
    """Of the crank's angle, by the length of the coupler: through start, constraints and projections."""
    system = ac.compile(four_bar(planar.Revolute()))

    def angle(length: Any) -> Any:
        return system.simulate(2.0, parameters={"coupler.r[1]": length}, saveat=2, rtol=1e-9, engine="native")["a.phi"][
            -1
        ]

    step = 1e-4
    difference = float(angle(2.0 + step) - angle(2.0 - step)) / (2 * step)
    assert_allclose(float(jax.grad(angle)(2.0)), difference, rtol=1e-5)


def test_joints_drive_and_are_driven_through_their_flanges() -> None:
    """Spring and damper of one-dimensional mechanics on a hinge and a guide: two damped oscillators."""
    model = assemble(
        "wall.frame - hinge.frame_a - guide.frame_a", "hinge.frame_b - disc.frame_a", "guide.frame_b - slider.frame_a",
        "hinge.support - torsion.flange_a", "torsion.flange_b - hinge.flange_a", "guide.support - buffer.flange_a",
        "buffer.flange_b - guide.flange_a", planarWorld=inner(planar.PlanarWorld()), wall=planar.Fixed(),
        hinge=planar.Revolute(useFlange=True, phi=start(0.5, fixed=True), w=start(0.0, fixed=True)),
        guide=planar.Prismatic(useFlange=True, s=start(1.3, fixed=True), v=start(0.0, fixed=True)),
        disc=planar.Body(m=1.0, I=0.5), slider=planar.PointMass(m=0.5), torsion=rotational.SpringDamper(c=8.0, d=0.4),
        buffer=translational.SpringDamper(c=8.0, d=0.4, s_rel0=1.0),
    )  # fmt: skip
    t = np.linspace(0.0, 3.0, 31)
    solution = simulate(model, t)
    frequency = np.sqrt(16.0 - 0.4**2)
    wave = np.exp(-0.4 * t) * (np.cos(frequency * t) + 0.4 / frequency * np.sin(frequency * t))
    assert_allclose(solution["hinge.phi"], 0.5 * wave, atol=1e-8)
    assert_allclose(solution["guide.s"], 1.0 + 0.3 * wave, atol=1e-8)


def test_line_force_of_one_dimensional_parts() -> None:
    """A one-dimensional spring and damper between the flanges of a line is a spring and damper in the plane."""

    def hung(element: Component, *more: str, **parts: Component) -> ac.Solution:
        model = assemble(
            "wall.frame - element.frame_a", "element.frame_b - bob.frame_a", *more, element=element,
            planarWorld=inner(planar.PlanarWorld()), wall=planar.Fixed(), bob=planar.Body(
                m=2.0, r=start((0.8, -0.6), fixed=True), v=start((0.0, 1.0), fixed=True),
                phi=start(0.0, fixed=True), w=start(0.0, fixed=True)), **parts,
        )  # fmt: skip
        return simulate(model, np.linspace(0.0, 2.0, 21))

    direct = hung(planar.SpringDamper(c=50.0, d=1.5, s_unstretched=0.9))
    line = hung(
        planar.LineForce(useFlange_a=True), "element.flange_a - damper.flange_a", "damper.flange_b - element.flange_b",
        damper=translational.SpringDamper(c=50.0, d=1.5, s_rel0=0.9),
    )  # fmt: skip
    for name in ("bob.r[1]", "bob.r[2]", "wall.frame.fx", "wall.frame.fy"):
        assert_allclose(line[name], direct[name], atol=1e-7)


def test_springs_keep_momentum_and_angular_momentum() -> None:
    """Two bodies in space, joined by a spring and damper between points off their centres."""

    def body(x: float, v: float) -> planar.Body:
        return planar.Body(
            m=2.0, I=0.3, r=start((x, 0.2 * x), fixed=True), v=start((0.1, v), fixed=True),
            phi=start(x, fixed=True), w=start(v, fixed=True),
        )  # fmt: skip

    model = assemble(
        "one.frame_a - left.frame_a", "left.frame_b - spring.frame_a", "two.frame_a - right.frame_a",
        "right.frame_b - spring.frame_b", one=body(0.0, 1.0),
        planarWorld=inner(planar.PlanarWorld(constantGravity=(0.0, 0.0))),
        two=body(2.0, -0.5), left=planar.FixedTranslation(r=(0.2, 0.3)), right=planar.FixedTranslation(r=(-0.4, 0.0)),
        spring=planar.SpringDamper(c=30.0, d=0.5, s_unstretched=1.0),
    )  # fmt: skip
    solution = simulate(model, np.linspace(0.0, 3.0, 31))
    spin = np.zeros(31)
    for name in ("one", "two"):
        r_x, r_y, v_x, v_y, w = (np.asarray(solution[f"{name}.{v}"]) for v in ("r[1]", "r[2]", "v[1]", "v[2]", "w"))
        spin += 2.0 * (r_x * v_y - r_y * v_x) + 0.3 * w
    assert_allclose(solution["one.v[1]"] + solution["two.v[1]"], 0.2, atol=1e-8)
    assert_allclose(solution["one.v[2]"] + solution["two.v[2]"], 0.5, atol=1e-8)
    assert_allclose(spin, spin[0], atol=1e-7)


class Mechanism(Component, partial=True):
    """What the rod of the crane's cylinder lifts, from an angle at which the cylinder is 3.6 m long."""

    phi_start: Parameter = Parameter(float(np.arccos((13.0 - 3.6**2) / 12.0)) - np.pi / 2 + 0.5, unit="rad")
    rod: translational.Flange = translational.Flange()
    phi: Variable = Variable(unit="rad", doc="angle of the boom")


class Formulas(Mechanism):
    """The boom by the formulas of the paper."""

    joint: planar.RigidJoint = planar.RigidJoint()
    boom: planar.Boom = planar.Boom(m=11000.0, r=8.0, I=1.008e6, phi=start(Mechanism.phi_start, fixed=True))

    def equations(self) -> Equations:
        yield connect(self.joint.rod, self.rod)
        yield connect(self.joint.boom, self.boom.flange)
        yield self.phi == self.boom.phi


class Parts(Mechanism):
    """The boom of planar parts, with a line force between the cylinder's foot and eye."""

    planarWorld: planar.PlanarWorld = inner(planar.PlanarWorld())
    wall: planar.Fixed = planar.Fixed()
    hinge: planar.Revolute = planar.Revolute(phi=start(Mechanism.phi_start, fixed=True))
    to_foot: planar.FixedTranslation = planar.FixedTranslation(r=(2.0 * np.sin(0.2), -2.0 * np.cos(0.2)))
    to_eye: planar.FixedTranslation = planar.FixedTranslation(r=(3.0 * np.cos(0.3), -3.0 * np.sin(0.3)))
    to_load: planar.FixedTranslation = planar.FixedTranslation(r=(8.0, 0.0))
    load: planar.Body = planar.Body(m=11000.0, I=1.008e6 - 11000.0 * 8.0**2)
    line: planar.LineForce = planar.LineForce(s0=2.6, s=start(3.6))

    def equations(self) -> Equations:
        yield connect(self.wall.frame, self.hinge.frame_a, self.to_foot.frame_a)
        yield connect(self.hinge.frame_b, self.to_eye.frame_a, self.to_load.frame_a)
        yield connect(self.to_load.frame_b, self.load.frame_a)
        yield connect(self.to_foot.frame_b, self.line.frame_a)
        yield connect(self.to_eye.frame_b, self.line.frame_b)
        yield connect(self.line.flange_b, self.rod)
        yield self.phi == self.hinge.phi


class Lift(Component):
    """A cylinder that is filled by a pump and lifts a boom."""

    oil: hydraulic.Oil = inner(hydraulic.Oil())
    mechanism: Mechanism = Formulas()
    cylinder: hydraulic.ExtendedCylinder = hydraulic.ExtendedCylinder(F_start=6e5)
    pump: hydraulic.MeteringPump = hydraulic.MeteringPump()
    tank: hydraulic.Tank = hydraulic.Tank()

    def equations(self) -> Equations:
        yield self.pump.u == 0.8 * ac.sin(0.5 * ac.time)
        yield connect(self.tank.port, self.pump.port_a, self.cylinder.port_b)
        yield connect(self.pump.port_b, self.cylinder.port_a)
        yield connect(self.cylinder.flange, self.mechanism.rod)


def test_boom_of_planar_parts_is_the_boom_of_the_paper() -> None:
    t = np.linspace(0.0, 4.0, 81)
    parts, formulas = (simulate(Lift(mechanism=m), t, rtol=1e-9) for m in (Parts(), Formulas()))
    assert len(parts.system.states) == len(formulas.system.states)
    assert np.ptp(formulas["mechanism.phi"]) > 0.1
    for name in ("mechanism.phi", "cylinder.x", "cylinder.v", "cylinder.p_a", "cylinder.flange.f"):
        assert_allclose(parts[name], formulas[name], rtol=1e-6, atol=1e-6 * np.ptp(formulas[name]), err_msg=name)
    push = np.hypot(np.asarray(parts["mechanism.line.frame_a.fx"]), np.asarray(parts["mechanism.line.frame_a.fy"]))
    assert_allclose(push, np.abs(formulas["cylinder.flange.f"]), rtol=1e-6)


def test_car_turns_in_a_circle() -> None:
    """Two wheels that do not slip, the front one steered: the rear one runs on a circle of radius l/tan(angle).

    The constraints are on velocities alone (nonholonomic); coasting, the car keeps its energy.
    """
    model = assemble(
        "car.frame_a - to_rear.frame_a - to_front.frame_a", "to_rear.frame_b - rear.frame_a",
        "to_front.frame_b - steer.frame_a", "steer.frame_b - front.frame_a",
        planarWorld=inner(planar.PlanarWorld(constantGravity=(0.0, 0.0))),
        to_rear=planar.FixedTranslation(r=(-1.2, 0.0)),
        to_front=planar.FixedTranslation(r=(1.0, 0.0)), steer=planar.FixedRotation(alpha=0.4),
        car=planar.Body(
            m=800.0, I=1000.0, r=start((0.0, 0.0), fixed=True), phi=start(0.3, fixed=True)
        ),
        rear=planar.IdealWheelJoint(radius=0.3, w_roll=start(20.0, fixed=True)),
        front=planar.IdealWheelJoint(radius=0.3),
    )  # fmt: skip
    t = np.linspace(0.0, 10.0, 101)
    solution = simulate(model, t, rtol=1e-9)
    radius = 2.2 / np.tan(0.4)
    turned = 6.0 / radius * t
    assert_allclose(solution["car.phi"], 0.3 + turned, atol=1e-6)
    assert_allclose(solution["rear.w_roll"], 20.0, rtol=1e-7)
    assert_allclose(solution["front.v_long"], 6.0 / np.cos(0.4), rtol=1e-7)
    x = np.asarray(solution["rear.frame_a.x"]) - radius * np.sin(0.3 + turned)
    assert_allclose(x, x[0], atol=1e-6)
    force = np.hypot(np.asarray(solution["rear.frame_a.fx"] + solution["front.frame_a.fx"]),
                     np.asarray(solution["rear.frame_a.fy"] + solution["front.frame_a.fy"]))  # fmt: skip
    assert_allclose(force, 800.0 * (6.0 / radius) ** 2 * np.hypot(radius, 1.2), rtol=1e-6)
