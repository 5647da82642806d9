"""What is degenerate in 3-D mechanics is an error that names it."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import acausal as ac
from acausal import Array, Component, Equations, connect, inner, start
from acausal.asserted import check_given
from acausal.components import multibody as mb
from acausal.components import planar
from acausal.components.examples import assemble

ZERO = (0.0, 0.0, 0.0)


def pendulum(joint: Component, body: Component | None = None) -> Component:
    return assemble(
        "world.frame_b - joint.frame_a", "joint.frame_b - body.frame_a", world=inner(mb.World(g=10.0)), joint=joint,
        body=body or mb.Body(m=1.0, r_CM=(1.0, 0.0, 0.0)),
    )  # fmt: skip


@pytest.mark.parametrize("joint", [
    mb.Revolute(n=ZERO), mb.Prismatic(n=ZERO), mb.Cylindrical(n=ZERO), mb.Universal(n_a=ZERO), mb.Planar(n=ZERO),
    mb.Planar(n_x=(0.0, 0.0, 2.0)), mb.FixedRotation(n=ZERO, angle=30.0), mb.RevolutePlanarLoopConstraint(n=ZERO),
    mb.constraints.Revolute(n=ZERO), mb.constraints.Universal(n_b=ZERO),
    mb.FixedRotation(rotationType="TwoAxesVectors", n_x=ZERO),
], ids=lambda j: type(j).__name__)  # fmt: skip
def test_an_axis_without_length(joint: Component) -> None:
    """Also where it follows from two directions that are parallel."""
    with pytest.raises(ac.DeclarationError, match=r"with the values joint\.\S+ = 0, .* divides by zero"):
        ac.compile(pendulum(joint))


@pytest.mark.parametrize("rod", [
    mb.UniversalSpherical(n1_a=(1.0, 0.0, 0.0), rRod_ia=(2.0, 0.0, 0.0)),
    mb.JointUPS(n1_a=(0.0, 3.0, 0.0), nAxis_ia=(0.0, -1.0, 0.0)),
], ids=lambda r: type(r).__name__)  # fmt: skip
def test_a_rod_along_the_first_axis_of_its_universal_joint(rod: Component) -> None:
    model = pendulum(rod, mb.PointMass(r_0=start((1.0, 0.0, 0.0))))
    with pytest.raises(ac.DeclarationError, match=r"`joint.slant` .*= 0 lies outside.* must not be parallel"):
        ac.compile(model).simulate(1.0)


def test_a_rod_without_length() -> None:
    with pytest.raises(ac.DeclarationError, match=r"`SphericalSpherical.rodLength` = 0.0 lies outside its bounds"):
        mb.SphericalSpherical(rodLength=0.0)
    model = pendulum(mb.UniversalSpherical(rRod_ia=ZERO), mb.PointMass(r_0=start((1.0, 0.0, 0.0))))
    with pytest.raises(ac.InitializationError, match=r"`joint.slant` .*angle between n1_a and rRod_ia"):
        ac.compile(model).simulate(1.0)


@pytest.mark.parametrize("body", [
    mb.BodyCylinder(r=ZERO), mb.BodyBox(r=ZERO), mb.BodyBox(lengthDirection=ZERO)
], ids=lambda b: type(b).__name__)  # fmt: skip
def test_a_shape_without_direction(body: Component) -> None:
    with pytest.raises(ac.InitializationError, match=r"no value \(or NaN\).*\n.*`body\."):
        ac.compile(pendulum(mb.Revolute(), body)).simulate(1.0)


def test_gravity_without_direction() -> None:
    model = assemble(world=inner(mb.World(n=ZERO)), body=mb.Body())
    with pytest.raises(ac.InitializationError, match=r"`world\.direction\[1\]` .*n must not be zero"):
        ac.compile(model).simulate(1.0)


@pytest.mark.parametrize(("model", "named"), [
    (pendulum(mb.Revolute(), mb.Body(m=0.0, I_11=0.0, I_22=0.0, I_33=0.0)), r"The values 0 of .*`body\.m`"),
    (assemble(world=inner(mb.World()), body=mb.Body(m=0.0)), r"The value 0 of `body\.m`"),
], ids=["pendulum", "free body"])  # fmt: skip
def test_what_moves_without_mass(model: Component, named: str) -> None:
    with pytest.raises(ac.StructureError, match=named):
        ac.compile(model)


def tensor(moments: tuple[float, float, float], shares: float = 1.0) -> dict[str, float]:
    """An inertia tensor with these principal moments, in a frame that is turned."""
    turned = Rotation.from_euler("xyz", [0.4, -0.7, 1.1]).as_matrix()
    I = turned @ np.diag(moments) @ turned.T * shares  # noqa: E741
    return {f"I_{i}{j}": float(I[i - 1, j - 1]) for i, j in ((1, 1), (2, 2), (3, 3), (2, 1), (3, 1), (3, 2))}


@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_a_negative_principal_moment(engine: Any) -> None:
    system = ac.compile(pendulum(mb.Revolute(), mb.Body(r_CM=(1.0, 0.0, 0.0), I_11=1.0, I_22=1.0, I_33=1.0, I_21=1.1)))
    text = (
        r"At t = 0 s the assertion of body \(.*bodies.py:\d+ \(Body\)\) does not hold: a principal moment of the "
        r"inertia tensor is negative\nwith .*body.I_11 = 1, .*body.I_21 = 1.1"
    )
    with pytest.raises(ac.SimulationError, match=text):
        system.simulate(1.0, engine=engine)
    system.simulate(0.1, parameters={"body.I_21": 1.0}, engine=engine)


@pytest.mark.parametrize("size", [1e-9, 1.0, 1e6])
@pytest.mark.parametrize(("moments", "sound"), [
    ((1.0, 2.0, 3.0), True), ((0.0, 2.0, 2.0), True), ((0.0, 0.0, 1.0), True), ((0.0, 0.0, 0.0), True),
    ((-1e-12, 1.0, 1.0), True),  # as rounding leaves them
    ((1.0, 1.0, 9.0), True),  # of no body, but Modelica has it too, where moments are left at their defaults
    ((-1e-6, 1.0, 1.0), False), ((-1e-6, 0.0, 1.0), False), ((-1e-6, -1e-6, 1.0), False), ((-1.0, -1.0, 1.0), False),
])  # fmt: skip
def test_which_inertia_tensors_are_sound(moments: tuple[float, float, float], sound: bool, size: float) -> None:
    system = ac.compile(assemble(world=inner(mb.World()), body=mb.Body()))
    p = system.program.evaluate({f"body.{k}": v for k, v in tensor(moments, size).items()}, np)
    if sound:
        check_given(system, 0.0, p)
        return
    with pytest.raises(ac.SimulationError, match="a principal moment of the inertia tensor is negative"):
        check_given(system, 0.0, p)


@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_at_the_centre_of_gravity(engine: Any) -> None:
    model = assemble(world=inner(mb.World(gravityType="PointGravity")), body=mb.Body())
    with pytest.raises(ac.SimulationError, match=r"der\(body\.v_0\[1\]\)"):
        ac.compile(model).simulate(1.0, engine=engine)


def test_sequences_of_axes() -> None:
    bend = mb.FixedRotation(rotationType="PlanarRotationSequence", sequence=(1.0, 5.0, 2.0), angles=(1.0, 2.0, 3.0))
    with pytest.raises(ac.DeclarationError, match=r"three axes, each 1, 2 or 3, not \(1.0, 5.0, 2.0\)"):
        ac.compile(pendulum(bend))
    turned = mb.Body(useQuaternions=False, sequence_angleStates=(3.0, 3.0, 1.0))
    with pytest.raises(ac.DeclarationError, match=r"\(3, 3, 1\) does not give all orientations"):
        ac.compile(assemble(world=inner(mb.World()), body=turned))


class Forgotten(Component):
    """A pendulum that is not hung up."""

    world: mb.World = inner(mb.World())
    hinge: mb.Revolute = mb.Revolute()
    bob: mb.Body = mb.Body()

    def equations(self) -> Equations:
        yield connect(self.hinge.frame_b, self.bob.frame_a)


class Chain(Component):
    """Of the connections between the links of a chain, the last one is forgotten."""

    world: mb.World = inner(mb.World())
    hinges: Array[mb.Revolute] = Array(mb.Revolute(), 3)
    links: Array[mb.BodyShape] = Array(mb.BodyShape(r=(1.0, 0.0, 0.0)), 3)

    def equations(self) -> Equations:
        yield connect(self.world.frame_b, self.hinges[0].frame_a)
        yield connect(self.hinges.frame_b, self.links.frame_a)
        yield connect(self.links[:-2].frame_b, self.hinges[1:-1].frame_a)


class Seen(Component):
    """A planar body that is measured against nothing."""

    planarWorld: planar.PlanarWorld = inner(planar.PlanarWorld())
    body: planar.Body = planar.Body(m=1.0, I=1.0)
    distance: planar.Distance = planar.Distance()

    def equations(self) -> Equations:
        yield connect(self.body.frame_a, self.distance.frame_b)


def test_a_connection_that_was_forgotten() -> None:
    """The message is short: what is loose, where it was written, what to connect."""
    with pytest.raises(ac.ConnectError) as error:
        ac.compile(Forgotten())
    first, why, written, field, advice = str(error.value).splitlines()
    assert first == "nothing is connected to `hinge.frame_a`"
    assert why == "    a `Revolute` acts on what is connected to `frame_a` and `frame_b`"
    assert written == "Written in:"
    assert "    hinge: mb.Revolute = mb.Revolute()    " in field and "test_multibody_errors.py:" in field
    also = "nothing is connected to `world.frame_b` either"
    assert advice == f"Try: connect(self.hinge.frame_a, ...) in `equations`; {also}"


@pytest.mark.parametrize(("model", "loose"), [
    (Chain(), r"`hinges\[2\].frame_a`\n    a `Revolute` acts"), (Seen(), "`distance.frame_a`\n    a `Distance` acts"),
    (assemble("body.frame_a - spring.frame_b", world=inner(mb.World()), body=mb.Body(), spring=mb.Spring(c=1.0)),
     "`spring.frame_a`\n    a `Spring` acts"),  # it would pull at nothing
    (assemble(world=inner(mb.World()), sensor=mb.AbsoluteAngles()), "`sensor.frame_a`\n    a `AbsoluteAngles` acts"),
], ids=lambda case: type(case).__name__)  # fmt: skip
def test_loose_ends(model: Component, loose: str) -> None:
    with pytest.raises(ac.ConnectError, match=f"nothing is connected to {loose}"):
        ac.compile(model)


def test_a_loop_that_cannot_be_closed() -> None:
    """The rod is too short."""
    model = assemble(
        "world.frame_b - crank.frame_a", "crank.frame_b - arm.frame_a", "arm.frame_b - loop.frame_a",
        "world.frame_b - base.frame_a", "base.frame_b - loop.frame_b", world=inner(mb.World()),
        crank=mb.Revolute(phi=start(0.5, fixed=True), w=start(1.0, fixed=True)), body=mb.Body(),
        arm=mb.BodyShape(r=(0.0, 1.0, 0.0)), base=mb.FixedTranslation(r=(9.0, 0.0, 0.0)),
        loop=mb.JointRRR(rRod1_ia=(2.0, 0.0, 0.0), rRod2_ib=(0.0, 1.0, 0.0)),
    )  # fmt: skip
    with pytest.raises(ac.AcausalError, match=r"loop\.jointUSR\.revolute"):
        ac.compile(model).simulate(1.0)


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_a_loop_that_reaches_its_dead_centre(engine: Any) -> None:
    """A slider, pushed away until crank and rod are in line: there it would stay at rest, which no mechanism does."""
    model = assemble(
        "world.frame_b - slider.frame_a", "slider.frame_b - loop.frame_a", "world.frame_b - loop.frame_b",
        "loop.frame_im - bob.frame_a", world=inner(mb.World(gravityType="NoGravity")), bob=mb.Body(m=1.0),
        slider=mb.Prismatic(s=start(1.0, fixed=True), v=start(1.0, fixed=True)),
        loop=mb.JointUSR(rRod1_ia=(-1.0, 0.0, 0.0), rRod2_ib=(1.0, 0.0, 0.0), n1_a=(0.0, 1.0, 0.0)),
    )  # fmt: skip
    message = r"(?s)is nan (there|just beyond this point)\..*loop\.revolute\.angle = atan2"
    with pytest.raises(ac.SimulationError, match=message):
        ac.compile(model).simulate(3.0, engine=engine, max_steps=10_000)


@pytest.mark.parametrize("sequence", [(1, 2, 3), (3, 2, 1), (3, 1, 3), (2, 3, 1), (1, 2, 1)])
def test_angles_that_are_measured_are_those_that_were_given(sequence: tuple[int, ...]) -> None:
    """The sensor inverts a sequence of rotations, Cardan's and Euler's."""
    given = np.array([0.4, 0.7, -0.3])
    bend = mb.FixedRotation(
        rotationType="PlanarRotationSequence", sequence=sequence, angles=tuple(np.rad2deg(given).tolist())
    )
    model = assemble(
        "world.frame_b - bend.frame_a", "bend.frame_b - sensor.frame_a", world=inner(mb.World()), bend=bend,
        sensor=mb.AbsoluteAngles(sequence=sequence),
    )  # fmt: skip
    np.testing.assert_allclose(ac.compile(model).simulate(1.0, saveat=[1.0])["sensor.angles"][0], given, atol=1e-12)


def six_joints(phi: tuple[float, float, float]) -> Component:
    """A chain of three slides and three hinges to a fixed place, with guesses of the angles of the hinges."""
    axes = [tuple(row) for row in np.eye(3)]
    slides = {f"s{k}": mb.Prismatic(n=n) for k, n in enumerate(axes)}
    hinges = {f"h{k}": mb.Revolute(n=n, phi=start(at)) for k, (n, at) in enumerate(zip(axes, phi, strict=True))}
    return assemble(
        "world.frame_b - s0.frame_a", "s0.frame_b - s1.frame_a", "s1.frame_b - s2.frame_a", "s2.frame_b - h0.frame_a",
        "h0.frame_b - h1.frame_a", "h1.frame_b - h2.frame_a", "h2.frame_b - load.frame_a - arm.frame_b",
        "world.frame_b - arm.frame_a", **slides, **hinges, world=inner(mb.World()), load=mb.Body(m=1.0),
        arm=mb.FixedRotation(r=(1.0, 0.2, 0.3), n=(0.0, 0.0, 1.0), angle=40.0),
    )  # fmt: skip


HALF_A_TURN = "orientations that are to be the same are half a turn apart: the start values of the angles are too far"


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
@pytest.mark.parametrize("phi", [(3.1, 0.0, 0.7), (0.0, 0.0, -2.4), (0.1, 3.0, 0.5)])
def test_a_loop_that_closes_half_a_turn_off(engine: Any, phi: tuple[float, float, float]) -> None:
    """The three residuals of its closure are zero there, too."""
    system = ac.compile(six_joints(phi))
    with pytest.raises(ac.SimulationError, match=rf"`\S+frame_.\.R` and `\S+frame_.\.R`: two {HALF_A_TURN}"):
        system.simulate(0.1, engine=engine)
    right = ac.compile(six_joints((0.3, -0.2, 0.1))).simulate(0.1, engine=engine)
    assert [float(right[f"h{k}.phi"][-1]) for k in range(3)] == pytest.approx([0.0, 0.0, np.deg2rad(40.0)], abs=1e-9)


@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_a_constraint_half_a_turn_off(engine: Any) -> None:
    quaternion = start((1.0, 0.0, 0.0, 0.0))
    model = assemble(
        "world.frame_b - rail.frame_a", "rail.frame_b - load.frame_a", world=inner(mb.World()),
        rail=mb.constraints.Prismatic(y_locked=False), load=mb.Body(m=2.0, Q=quaternion),
    )  # fmt: skip
    with pytest.raises(ac.SimulationError, match=f"At t = 0 s the assertion of rail .*: two {HALF_A_TURN}"):
        ac.compile(model).simulate(0.1, engine=engine)
