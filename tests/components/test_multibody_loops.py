"""3-D mechanics with closed kinematic loops that nobody cuts."""

from __future__ import annotations

import functools
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Array, Component, Equations, Solution, System, conditional, connect, inner, start
from acausal.components import multibody as mb
from acausal.components import rotational, translational

from .msl_multibody import Fourbar1

G = 9.80665


def rows(solution: Solution, name: str) -> np.ndarray:
    """Values of a vector (n_t, 3) or a matrix (n_t, 3, 3)."""
    values = np.asarray(solution[name])
    return values.reshape(len(values), 3, 3) if values.shape[1] == 9 else values


@functools.cache
def fourbar() -> tuple[System, Solution]:
    system = ac.compile(Fourbar1())
    return system, system.simulate(t1=2.0, rtol=1e-9)


def about(axis: int, angle: np.ndarray) -> np.ndarray:
    """Matrices that turn vectors by `angle` about a coordinate axis, (n_t, 3, 3)."""
    i, j = [(1, 2), (2, 0), (0, 1)][axis]
    R = np.tile(np.eye(3), (len(angle), 1, 1))
    R[:, i, i] = R[:, j, j] = np.cos(angle)
    R[:, j, i], R[:, i, j] = np.sin(angle), -np.sin(angle)
    return R


def test_the_loop_stays_closed_to_rounding() -> None:
    """Both ways around the loop, written out by hand, from the joint coordinates alone."""
    _, s = fourbar()
    x, y, _ = np.eye(3)
    R1 = about(0, s["j1.phi"])
    left = np.einsum("tij,j->ti", R1, np.array([0.0, 0.5, 0.1]))
    R_left = R1 @ about(0, s["j3.phi"]) @ about(1, s["j4.phi"]) @ about(2, s["j5.phi"])
    R2 = about(1, s["rev.phi"]) @ about(2, s["rev1.phi"])
    right = 1.2 * x + np.outer(s["j2.s"], x) + 0.2 * y + np.einsum("tij,j->ti", R2, np.array([-1.0, 0.3, 0.1]))
    assert np.abs(left - right).max() < 1e-9
    assert np.abs(R_left - R2).max() < 1e-9


def energy(system: System, solution: Solution, bodies: list[str]) -> np.ndarray:
    """Kinetic energy and potential energy in gravity along -y; mass properties from the parameters of the run."""
    flat, p = system.stages.flat, np.asarray(system.program.default)

    def value(name: str) -> float:
        return float(p[flat.names.find(name, parameter=True)[0]])

    total = np.zeros(len(solution.t))
    for body in bodies:
        T, w = rows(solution, f"{body}.frame_a.R.T"), rows(solution, f"{body}.frame_a.R.w")
        r_CM = np.array([value(f"{body}.r_CM[{k}]") for k in (1, 2, 3)])
        J = np.array([[value(f"{body}.I_{max(i, j)}{min(i, j)}") for j in (1, 2, 3)] for i in (1, 2, 3)])
        place = rows(solution, f"{body}.r_0") + np.einsum("tij,i->tj", T, r_CM)
        v = rows(solution, f"{body}.v_0") + np.einsum("tij,ti->tj", T, np.cross(w, r_CM))
        total += 0.5 * np.einsum("ti,ij,tj->t", w, J, w)
        total += value(f"{body}.m") * (0.5 * (v**2).sum(axis=1) + G * place[:, 1])
    return total


def test_the_fourbar_conserves_energy() -> None:
    system, solution = fourbar()
    total = energy(system, solution, ["b1.body", "b2.body", "b3.body"])
    assert np.ptp(total) < 1e-6 * np.abs(total).max()


def test_one_degree_of_freedom_is_left() -> None:
    system, _ = fourbar()
    assert len(system.states) - len(system.stages.schedule.invariants) == 2
    assert {"j1.phi", "j1.w"} <= set(system.states)


class PlanarFourbar(Component):
    """Four hinges with parallel axes, on a base that is inclined."""

    world: mb.World = inner(mb.World())
    base: mb.FixedRotation = mb.FixedRotation(n=(1.0, 2.0, 0.0), angle=37.0)
    a: mb.Revolute = mb.Revolute(phi=start(0.5, fixed=True), w=start(1.0, fixed=True))
    b: mb.Revolute = mb.Revolute()
    c: mb.Revolute = mb.Revolute()
    d: mb.PartialTwoFrames = mb.RevolutePlanarLoopConstraint()
    left: mb.BodyShape = mb.BodyShape(r=(0.0, 1.0, 0.0), r_CM=(0.0, 0.5, 0.0), m=2.0)
    ground: mb.FixedTranslation = mb.FixedTranslation(r=(2.0, 0.0, 0.0))
    right: mb.BodyShape = mb.BodyShape(r=(0.0, 1.2, 0.0), r_CM=(0.0, 0.6, 0.0), m=1.0)
    rod: mb.BodyShape = mb.BodyShape(r=(2.0, 0.0, 0.0), r_CM=(1.0, 0.0, 0.0), m=3.0)
    bend: mb.FixedRotation = mb.FixedRotation(n=(0.0, 1.0, 0.0))

    def equations(self) -> Equations:
        yield connect(self.world.frame_b, self.base.frame_a)
        yield connect(self.base.frame_b, self.a.frame_a, self.ground.frame_a)
        yield connect(self.a.frame_b, self.left.frame_a)
        yield connect(self.left.frame_b, self.b.frame_a)
        yield connect(self.b.frame_b, self.rod.frame_a)
        yield connect(self.rod.frame_b, self.d.frame_a)
        yield connect(self.d.frame_b, self.bend.frame_b)
        yield connect(self.bend.frame_a, self.right.frame_b)
        yield connect(self.right.frame_a, self.c.frame_b)
        yield connect(self.c.frame_a, self.ground.frame_b)


def test_planar_loop_with_a_planar_constraint_conserves_energy() -> None:
    system = ac.compile(PlanarFourbar())
    solution = system.simulate(t1=1.0, rtol=1e-9)
    total = energy(system, solution, ["left.body", "right.body", "rod.body"])
    assert np.ptp(total) < 1e-6 * np.abs(total).max() + 1e-6
    distance = rows(solution, "right.frame_b.r_0") - rows(solution, "rod.frame_b.r_0")
    assert np.abs(distance).max() < 1e-9


def test_planar_loop_of_plain_hinges_is_explained() -> None:
    with pytest.raises(ac.StructureError) as error:
        ac.compile(PlanarFourbar(d=mb.Revolute()))
    text = str(error.value)
    assert "The model has closed loops, at the connections of" in text and "test_multibody_loops.py:" in text
    assert "replace one `Revolute` of each planar loop by `RevolutePlanarLoopConstraint`" in text
    assert "Any other loop needs joints with seven freedoms in all to move" in text


class Shafts(Component):
    """Two shafts at an angle of 0.4 in fixed bearings, with a universal joint where their axes meet."""

    across: bool = False
    world: mb.World = inner(mb.World(gravityType="NoGravity"))
    drive: mb.Revolute = mb.Revolute(n=(1.0, 0.0, 0.0), phi=start(0.0, fixed=True), w=start(2.0, fixed=True))
    one: mb.BodyShape = mb.BodyShape(r=(1.0, 0.0, 0.0), m=1.0)
    joint: mb.Universal = mb.Universal(n_a=(0.0, 1.0, 0.0), n_b=(0.0, 0.0, 1.0), phi_b=start(0.4))
    two: mb.BodyShape = mb.BodyShape(r=(1.0, 0.0, 0.0), m=1.0)
    bearing: mb.Cylindrical = mb.Cylindrical(n=(1.0, 0.0, 0.0))
    place: mb.FixedTranslation = mb.FixedTranslation(r=(1.0 + np.cos(0.4), np.sin(0.4), 0.0))
    turned: mb.FixedRotation = mb.FixedRotation(n=(0.0, 0.0, 1.0), angle=float(np.rad2deg(0.4)))
    y: mb.Prismatic = conditional(mb.Prismatic(n=(0.0, 1.0, 0.0)), "across")
    z: mb.Prismatic = conditional(mb.Prismatic(n=(0.0, 0.0, 1.0)), "across")

    def equations(self) -> Equations:
        yield connect(self.world.frame_b, self.drive.frame_a, self.place.frame_a)
        yield connect(self.drive.frame_b, self.one.frame_a)
        yield connect(self.one.frame_b, self.joint.frame_a)
        yield connect(self.joint.frame_b, self.two.frame_a)
        yield connect(self.two.frame_b, self.bearing.frame_b)
        yield connect(self.place.frame_b, self.turned.frame_a)
        if self.across:
            yield connect(self.turned.frame_b, self.y.frame_a)
            yield connect(self.y.frame_b, self.z.frame_a)
            yield connect(self.z.frame_b, self.bearing.frame_a)
        else:
            yield connect(self.turned.frame_b, self.bearing.frame_a)


def test_shafts_with_a_universal_joint_are_explained() -> None:
    """The advice works: the shaft turns as a universal joint makes it."""
    with pytest.raises(ac.StructureError, match=r"axes of a loop meet in one point .*two of them across the shaft"):
        ac.compile(Shafts())
    run = ac.compile(Shafts(across=True)).simulate(t1=1.0, saveat=11, rtol=1e-8)
    np.testing.assert_allclose(np.tan(run["bearing.phi"]), np.tan(run["drive.phi"]) / np.cos(0.4), rtol=1e-6, atol=1e-9)
    assert max(np.abs(run[f"{name}.s"]).max() for name in ("y", "z", "bearing")) < 1e-8


@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_a_loop_that_is_not_planar_is_an_error(engine: Any) -> None:
    where = r"At t = 0 s the assertion of d \(.*free_joints.py:\d+ .*"
    field = r"(.|\n)*Written in:\n    d: mb.PartialTwoFrames = .*test_multibody_loops.py:\d+"
    moved = PlanarFourbar(ground=mb.FixedTranslation(r=(2.0, 0.0, 1e-6)))
    with pytest.raises(ac.SimulationError, match=f"{where}frame_b is not in the plane of frame_a across n{field}"):
        ac.compile(moved).simulate(t1=1.0, engine=engine)
    skew = PlanarFourbar(bend=mb.FixedRotation(n=(0.0, 1.0, 0.0), angle=1e-4))
    with pytest.raises(ac.SimulationError, match=f"{where}n has another direction in frame_b than in frame_a{field}"):
        ac.compile(skew).simulate(t1=1.0, engine=engine)


class Slider(Component):
    """Crank, rod with ball joints, slider; driven through the hinge's flange."""

    world: mb.World = inner(mb.World(gravityType="NoGravity"))
    crank: mb.Revolute = mb.Revolute(useAxisFlange=True)
    wheel: rotational.Inertia = rotational.Inertia(
        J=0.5, phi=start(0.3, fixed=True, state_select="always"), w=start(2.0, fixed=True, state_select="always")
    )
    arm: mb.FixedTranslation = mb.FixedTranslation(r=(0.5, 0.0, 0.2))
    rod: mb.SphericalSpherical = mb.SphericalSpherical(rodLength=1.5)
    rail: mb.Prismatic = mb.Prismatic(s=start(1.9))
    load: mb.Body = mb.Body(m=1.0)

    def equations(self) -> Equations:
        yield connect(self.world.frame_b, self.crank.frame_a, self.rail.frame_a)
        yield connect(self.wheel.flange_b, self.crank.axis)
        yield connect(self.crank.frame_b, self.arm.frame_a)
        yield connect(self.arm.frame_b, self.rod.frame_a)
        yield connect(self.rod.frame_b, self.rail.frame_b, self.load.frame_a)


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_slider_crank_with_a_rod_of_constant_length(engine: str) -> None:
    solution = ac.compile(Slider()).simulate(t1=2.0, rtol=1e-8, engine=engine)  # type: ignore[arg-type]
    phi, w, v = solution["crank.phi"], solution["crank.w"], solution["rail.v"]
    place = 0.5 * np.cos(phi) + np.sqrt(1.5**2 - 0.2**2 - (0.5 * np.sin(phi)) ** 2)
    assert np.allclose(solution["rail.s"], place, atol=1e-8)
    total = 0.25 * w**2 + 0.5 * v**2
    assert np.ptp(total) < 1e-5 * total[0]


def test_the_guess_of_the_slider_decides_on_which_side_it_is() -> None:
    """The compiler iterates on the rod, whose guess follows from that of the slider."""
    solution = ac.compile(Slider(rail=mb.Prismatic(s=start(-0.9)))).simulate(t1=0.1, rtol=1e-8)
    y = 0.5 * np.sin(0.3)
    assert solution["rail.s"][0] == pytest.approx(0.5 * np.cos(0.3) - np.sqrt(1.5**2 - 0.2**2 - y**2), abs=1e-8)


class Fourbar2(Component):
    """The loop of Fourbar1 with a rod on a universal and a ball joint instead of five hinges; it carries a body."""

    world: mb.World = inner(mb.World())
    j1: mb.Revolute = mb.Revolute(
        n=(1.0, 0.0, 0.0), stateSelect="always", phi=start(0.0, fixed=True), w=start(5.235987755982989, fixed=True)
    )
    j2: mb.Prismatic = mb.Prismatic(n=(1.0, 0.0, 0.0), s=start(-0.2))
    b1: mb.BodyCylinder = mb.BodyCylinder(r=(0.0, 0.5, 0.1), diameter=0.05)
    b2: mb.BodyCylinder = mb.BodyCylinder(r=(0.0, 0.2, 0.0), diameter=0.05)
    b3: mb.BodyCylinder = mb.BodyCylinder(r=(-1.0, 0.3, 0.1), diameter=0.05)
    rod: mb.UniversalSpherical = mb.UniversalSpherical(n1_a=(0.0, 1.0, 0.0), rRod_ia=(-1.0, 0.3, 0.1))
    b0: mb.FixedTranslation = mb.FixedTranslation(r=(1.2, 0.0, 0.0))

    def equations(self) -> Equations:
        yield connect(self.world.frame_b, self.j1.frame_a, self.b0.frame_a)
        yield connect(self.j1.frame_b, self.b1.frame_a)
        yield connect(self.b0.frame_b, self.j2.frame_a)
        yield connect(self.j2.frame_b, self.b2.frame_a)
        yield connect(self.b2.frame_b, self.rod.frame_a)
        yield connect(self.rod.frame_ia, self.b3.frame_a)
        yield connect(self.rod.frame_b, self.b1.frame_b)


def test_universal_and_ball_joint_move_as_the_hinges_do() -> None:
    _, hinges = fourbar()
    system = ac.compile(Fourbar2())
    solution = system.simulate(t1=2.0, rtol=1e-9)
    # the rod turns about itself a little differently; its inertia about its own axis is that small
    for name in ("j1.phi", "j1.w", "j2.s"):
        assert np.abs(solution[name] - hinges[name]).max() < 2e-3 * np.ptp(hinges[name])
    total = energy(system, solution, ["b1.body", "b2.body", "b3.body"])
    assert np.ptp(total) < 1e-6 * np.abs(total).max()
    tip = rows(solution, "b3.frame_b.r_0") - rows(solution, "b1.frame_b.r_0")
    assert np.abs(tip).max() < 1e-9


def test_the_length_of_a_rod_follows_from_the_start() -> None:
    rod = mb.UniversalSpherical(n1_a=(0.0, 1.0, 0.0), computeRodLength=True)
    model = Fourbar2(rod=rod, j2=mb.Prismatic(n=(1.0, 0.0, 0.0), s=start(-0.2, fixed=True)))
    solution = ac.compile(model).simulate(t1=0.5, rtol=1e-8)
    assert solution["j2.s"][0] == pytest.approx(-0.2, abs=1e-9)
    assert np.allclose(solution["rod.length"], np.sqrt(1.0 + 0.3**2 + 0.1**2), atol=1e-9)


def around(radius: float, degrees: list[float]) -> np.ndarray:
    angles = np.radians(degrees)
    return radius * np.column_stack([np.cos(angles), np.zeros(6), np.sin(angles)])


class Hexapod(Component):
    """A Stewart platform on six elastic legs, thrown out of its rest; subclasses give the legs."""

    world: mb.World = inner(mb.World(g=9.81))
    base: Array[mb.FixedTranslation] = Array(
        mb.FixedTranslation(), 6, r=around(1.0, [5, 115, 125, 235, 245, 355])  # type: ignore[arg-type]
    )
    top: Array[mb.FixedTranslation] = Array(
        mb.FixedTranslation(), 6, r=around(0.6, [55, 65, 175, 185, 295, 305])  # type: ignore[arg-type]
    )
    platform: mb.Body = mb.Body(
        m=20.0, I_11=1.0, I_22=2.0, I_33=1.2, r_0=start((0.05, 1.2, 0.02), fixed=True),
        v_0=start((0.0, 0.0, 0.0), fixed=True), angles_fixed=True, angles_start=(0.05, 0.1, 0.0), w_0_fixed=True,
    )  # fmt: skip

    def equations(self) -> Equations:
        for i in range(6):
            yield connect(self.world.frame_b, self.base[i].frame_a)
            yield connect(self.top[i].frame_a, self.platform.frame_a)


class OnSprings(Hexapod):
    legs: Array[mb.Spring] = Array(mb.Spring(c=4000.0, s_unstretched=1.35), 6)

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.base[:].frame_b, self.legs[:].frame_a)
        yield connect(self.legs[:].frame_b, self.top[:].frame_b)


class OnStruts(Hexapod):
    legs: Array[mb.JointUPS] = Array(mb.JointUPS(nAxis_ia=(0.0, 1.0, 0.0)), 6)
    springs: Array[translational.Spring] = Array(translational.Spring(c=4000.0, s_rel0=1.35), 6)

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.base[:].frame_b, self.legs[:].frame_a)
        yield connect(self.legs[:].frame_b, self.top[:].frame_b)
        yield connect(self.legs[:].bearing, self.springs[:].flange_a)
        yield connect(self.legs[:].axis, self.springs[:].flange_b)


@pytest.mark.slow
def test_a_platform_on_six_legs() -> None:
    """Springs between frames and springs in struts are the same, and both keep the energy."""
    runs = [ac.compile(model).simulate(1.0, rtol=1e-9, saveat=101) for model in (OnSprings(), OnStruts())]
    for name in ("platform.r_0", "platform.frame_a.R.T"):
        assert np.abs(runs[0][name] - runs[1][name]).max() < 1e-7
    v, w = rows(runs[0], "platform.v_0"), rows(runs[0], "platform.w_a")
    lengths = np.column_stack([runs[1][f"legs[{i}].s"] for i in range(6)])
    kinetic = 10.0 * (v**2).sum(axis=1) + 0.5 * w**2 @ np.array([1.0, 2.0, 1.2])
    total = kinetic + 2000.0 * ((lengths - 1.35) ** 2).sum(axis=1) + 20.0 * 9.81 * runs[0]["platform.r_0[2]"]
    assert np.ptp(kinetic) > 1.0
    assert np.ptp(total) < 1e-6 * np.ptp(kinetic)
