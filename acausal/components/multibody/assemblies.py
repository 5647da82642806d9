"""Three joints and two rods between them, which close a loop without adding constraints or states.

The loop is solved in closed form: the coordinate of the last joint follows from the length of the first rod. So the
joints outside keep their coordinates as states, one set for the whole motion, as long as the loop can be closed. At a
dead centre, where both ways to close it meet, the run ends with an error; the joints of which an assembly consists, one
by one, go on there.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from acausal import (
    Equations,
    Parameter,
    Variable,
    Vector,
    branch,
    connect,
    cross,
    norm,
    structural,
)

from .. import rotational, translational
from .frames import PARALLEL, TINY, ZEROS, Frame, equal, resolve1, resolve2, resolve_relative, unit_vector
from .free_joints import SphericalSpherical, implied_mass
from .length_constraints import PrismaticWithLengthConstraint, RevoluteWithLengthConstraint
from .parts import FixedTranslation, PartialTwoFrames
from .universal_spherical import PartialUniversalRod, UniversalSpherical


class PartialAssembly(PartialTwoFrames, partial=True):
    """Two rods that meet in a ball joint at frame_im; the second one carries frame_ib at its other end.

    Source: the common part of the joints of Modelica.Mechanics.MultiBody.Joints.Assemblies.
    """

    frame_ib: Frame = Frame()
    frame_im: Frame = Frame()
    rRod2_ib: Vector = Vector(
        Parameter(unit="m", doc="from frame_ib to the ball joint in the middle, resolved in frame_ib"), (-1.0, 0.0, 0.0)
    )
    rod2: FixedTranslation = FixedTranslation(r=rRod2_ib)
    f_rod: Variable = Variable(unit="N", doc="force along the first rod, positive on frame_a when directed to frame_b")

    def first_rod(self) -> UniversalSpherical | SphericalSpherical:
        """The rod from frame_a to the middle."""
        raise NotImplementedError

    def last_joint(self) -> RevoluteWithLengthConstraint | PrismaticWithLengthConstraint:
        """The joint at frame_b."""
        raise NotImplementedError

    def equations(self) -> Equations:
        yield from super().equations()
        rod, joint = self.first_rod(), self.last_joint()
        yield connect(joint.frame_a, self.frame_b)
        yield connect(joint.frame_b, self.rod2.frame_a, self.frame_ib)
        yield connect(self.rod2.frame_b, rod.frame_b, self.frame_im)
        yield connect(rod.frame_a, self.frame_a)
        yield joint.position_a == resolve2(self.frame_b.R, self.frame_a.r_0 - self.frame_b.r_0)
        yield joint.position_b == self.rRod2_ib
        yield joint.length == rod.length
        yield self.f_rod == rod.f_rod


class PartialToRevolute(PartialAssembly, partial=True):
    """The last joint is a hinge about `n_b`.

    Source: the common part of JointUSR and JointSSR of Modelica.Mechanics.MultiBody.Joints.Assemblies.
    """

    axis: rotational.Flange = rotational.Flange()
    bearing: rotational.Flange = rotational.Flange()
    n_b: Vector = Vector(
        Parameter(unit="1", evaluate=True, doc="axis of the hinge, resolved in frame_b (and in frame_ib)"),
        (0.0, 0.0, 1.0),
    )
    phi_offset: Parameter = Parameter(0.0, doc="angle of the hinge = phi + phi_offset [deg]")
    phi_guess: Parameter = Parameter(0.0, doc="of both ways to close the loop, that with phi nearer to this [deg]")
    revolute: RevoluteWithLengthConstraint = RevoluteWithLengthConstraint(
        n=n_b, phi_offset=phi_offset, phi_guess=phi_guess
    )

    def last_joint(self) -> RevoluteWithLengthConstraint:
        return self.revolute

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.revolute.axis, self.axis)
        yield connect(self.revolute.bearing, self.bearing)


class PartialToPrismatic(PartialAssembly, partial=True):
    """The last joint is a slider along `n_b`.

    Source: the common part of JointUSP and JointSSP of Modelica.Mechanics.MultiBody.Joints.Assemblies.
    """

    axis: translational.Flange = translational.Flange()
    bearing: translational.Flange = translational.Flange()
    n_b: Vector = Vector(
        Parameter(unit="1", evaluate=True, doc="axis of the slider, resolved in frame_b (and in frame_ib)"),
        (-1.0, 0.0, 0.0),
    )
    s_offset: Parameter = Parameter(0.0, unit="m", doc="distance of the slider = s + s_offset")
    s_guess: Parameter = Parameter(0.0, unit="m", doc="of both ways to close the loop, that with s nearer to this")
    prismatic: PrismaticWithLengthConstraint = PrismaticWithLengthConstraint(
        n=n_b, s_offset=s_offset, s_guess=s_guess
    )

    def last_joint(self) -> PrismaticWithLengthConstraint:
        return self.prismatic

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.prismatic.axis, self.axis)
        yield connect(self.prismatic.bearing, self.bearing)


class PartialFromUniversal(PartialAssembly, partial=True):
    """The first rod begins at a universal joint and carries frame_ia.

    Source: the common part of JointUSR and JointUSP of Modelica.Mechanics.MultiBody.Joints.Assemblies.
    """

    frame_ia: Frame = Frame()
    n1_a: Vector = Vector(
        Parameter(unit="1", evaluate=True, doc="first axis of the universal joint, resolved in frame_a"),
        (0.0, 0.0, 1.0),
    )
    rRod1_ia: Vector = Vector(
        Parameter(unit="m", doc="from frame_ia to the ball joint in the middle, resolved in frame_ia"), (1.0, 0.0, 0.0)
    )
    rod1: UniversalSpherical = UniversalSpherical(n1_a=n1_a, rRod_ia=rRod1_ia, constrained=False)

    def first_rod(self) -> UniversalSpherical:
        return self.rod1

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.rod1.frame_ia, self.frame_ia)


class PartialFromSpherical(PartialAssembly, partial=True):
    """The first rod begins at a ball joint and may have a point mass in its middle.

    Source: the common part of JointSSR and JointSSP of Modelica.Mechanics.MultiBody.Joints.Assemblies.
    """

    massive: bool = False
    rod1Length: Parameter = Parameter(1.0, unit="m", min=TINY, doc="length of the first rod")
    rod1Mass: Parameter = Parameter(0.0, unit="kg", min=0.0, doc="mass in the middle of the first rod")
    rRod2_ib: Vector = Vector(
        Parameter(unit="m", doc="from frame_ib to the ball joint in the middle, resolved in frame_ib"), (1.0, 0.0, 0.0)
    )
    rod1: SphericalSpherical = SphericalSpherical(
        rodLength=rod1Length, m=rod1Mass, massive=structural("massive"), constrained=False
    )

    @classmethod
    def _implied(cls, modifications: Mapping[str, Any]) -> dict[str, Any]:
        return implied_mass(modifications, "rod1Mass")

    def first_rod(self) -> SphericalSpherical:
        return self.rod1


class JointUSR(PartialFromUniversal, PartialToRevolute):
    """Universal joint, rod, ball joint, rod, hinge.

    The first rod, from the universal joint at frame_a, carries frame_ia; the second one, from the hinge at frame_b,
    carries frame_ib at the hinge and frame_im at the ball joint. `axis` drives the hinge.

    >>> model = assemble("world.frame_b - crank.frame_a", "crank.frame_b - arm.frame_a", "arm.frame_b - loop.frame_a",
    ...     "world.frame_b - base.frame_a", "base.frame_b - loop.frame_b", "loop.frame_ia - rod.frame_a",
    ...     world=ac.inner(World(g=0.0)), crank=Revolute(phi=start(0.5, fixed=True), w=start(1.0, fixed=True)),
    ...     arm=FixedTranslation(r=(0.0, 1.0, 0.0)), base=FixedTranslation(r=(2.0, 0.0, 0.0)),
    ...     loop=JointUSR(rRod1_ia=(2.0, 0.0, 0.0), rRod2_ib=(0.0, 1.0, 0.0), phi_guess=20.0), rod=Body(m=3.0))
    >>> solution = run(model, at=[1.0])  # a parallelogram
    >>> close(solution["crank.phi"], [1.5], 1e-3), close(solution["loop.revolute.phi"], solution["crank.phi"], 1e-4)
    (True, True)

    Source: Modelica.Mechanics.MultiBody.Joints.Assemblies.JointUSR.
    """


class JointUSP(PartialFromUniversal, PartialToPrismatic):
    """Universal joint, rod, ball joint, rod, slider.

    The first rod, from the universal joint at frame_a, carries frame_ia; the second one, on the slider at frame_b,
    carries frame_ib at the slider and frame_im at the ball joint. `axis` drives the slider.

    >>> model = assemble("world.frame_b - crank.frame_a", "crank.frame_b - arm.frame_a", "arm.frame_b - loop.frame_a",
    ...     "world.frame_b - loop.frame_b", "loop.frame_ib - load.frame_a", "crank.frame_b - wheel.frame_a",
    ...     crank=Revolute(phi=start(0.5, fixed=True), w=start(1.0, fixed=True)), load=Body(),
    ...     wheel=Body(I_33=100.0, m=0.0), arm=FixedTranslation(r=(0.3, 0.0, 0.0)), world=ac.inner(World(g=0.0)),
    ...     loop=JointUSP(rRod1_ia=(1.0, 0.0, 0.0), rRod2_ib=(0.0, 0.0, 0.0), n_b=(1.0, 0.0, 0.0), s_guess=1.0))
    >>> solution = run(model, at=[0.0])  # a slider crank
    >>> close(solution["loop.prismatic.s"], [0.3 * np.cos(0.5) + np.sqrt(1.0 - (0.3 * np.sin(0.5)) ** 2)])
    True

    Source: Modelica.Mechanics.MultiBody.Joints.Assemblies.JointUSP.
    """


class JointSSR(PartialFromSpherical, PartialToRevolute):
    """Ball joint, rod, ball joint, rod, hinge.

    The first rod, from the ball joint at frame_a, has the mass `rod1Mass` in its middle; the second one, from the hinge
    at frame_b, carries frame_ib at the hinge and frame_im at the ball joint. `axis` drives the hinge.

    >>> model = assemble("world.frame_b - crank.frame_a", "crank.frame_b - arm.frame_a", "arm.frame_b - loop.frame_a",
    ...     "world.frame_b - base.frame_a", "base.frame_b - loop.frame_b", "arm.frame_b - load.frame_a",
    ...     world=ac.inner(World(g=0.0)), crank=Revolute(phi=start(0.5, fixed=True), w=start(1.0, fixed=True)),
    ...     arm=FixedTranslation(r=(0.0, 1.0, 0.0)), base=FixedTranslation(r=(2.0, 0.0, 0.0)),
    ...     loop=JointSSR(rod1Length=2.0, rRod2_ib=(0.0, 1.0, 0.0), phi_guess=20.0), load=Body(m=3.0))
    >>> solution = run(model, at=[1.0])  # a parallelogram
    >>> close(solution["crank.phi"], [1.5], 1e-3), close(solution["loop.revolute.phi"], solution["crank.phi"], 1e-4)
    (True, True)

    Source: Modelica.Mechanics.MultiBody.Joints.Assemblies.JointSSR.
    """


class JointSSP(PartialFromSpherical, PartialToPrismatic):
    """Ball joint, rod, ball joint, rod, slider.

    The first rod, from the ball joint at frame_a, has the mass `rod1Mass` in its middle; the second one, on the slider
    at frame_b, carries frame_ib at the slider and frame_im at the ball joint. `axis` drives the slider.

    >>> model = assemble("world.frame_b - crank.frame_a", "crank.frame_b - arm.frame_a", "arm.frame_b - loop.frame_a",
    ...     "world.frame_b - loop.frame_b", "loop.frame_ib - load.frame_a", world=ac.inner(World(g=0.0)),
    ...     crank=Revolute(phi=start(0.5, fixed=True), w=start(1.0, fixed=True)), load=Body(),
    ...     arm=FixedTranslation(r=(0.3, 0.0, 0.0)),
    ...     loop=JointSSP(rod1Length=1.0, rRod2_ib=(0.0, 0.0, 0.0), n_b=(1.0, 0.0, 0.0), s_guess=1.0))
    >>> solution = run(model, at=[0.0])  # a slider crank
    >>> close(solution["loop.prismatic.s"], [0.3 * np.cos(0.5) + np.sqrt(1.0 - (0.3 * np.sin(0.5)) ** 2)])
    True

    Source: Modelica.Mechanics.MultiBody.Joints.Assemblies.JointSSP.
    """

    n_b: Vector = Vector(
        Parameter(unit="1", evaluate=True, doc="axis of the slider, resolved in frame_b (and in frame_ib)"),
        (0.0, 0.0, 1.0),
    )


class PartialPlanarAssembly(PartialTwoFrames, partial=True):
    """An assembly whose joints all move in the plane across `n_a`.

    Source: the common part of JointRRR and JointRRP of Modelica.Mechanics.MultiBody.Joints.Assemblies.
    """

    frame_ia: Frame = Frame()
    frame_ib: Frame = Frame()
    frame_im: Frame = Frame()
    n_a: Vector = Vector(
        Parameter(unit="1", evaluate=True, doc="axis of the hinges, resolved in frame_a"), (0.0, 0.0, 1.0)
    )
    rRod1_ia: Vector = Vector(
        Parameter(unit="m", doc="from frame_ia to the hinge in the middle, resolved in frame_ia"), (1.0, 0.0, 0.0)
    )
    rRod2_ib: Vector = Vector(
        Parameter(unit="m", doc="from frame_ib to the hinge in the middle, resolved in frame_ib"), (-1.0, 0.0, 0.0)
    )

    def assembly(self) -> JointUSR | JointUSP:
        """The assembly in space that does the same."""
        raise NotImplementedError

    def equations(self) -> Equations:
        yield from super().equations()
        joint = self.assembly()
        yield connect(joint.frame_a, self.frame_a)
        yield connect(joint.frame_b, self.frame_b)
        yield connect(joint.frame_ia, self.frame_ia)
        yield connect(joint.frame_ib, self.frame_ib)
        yield connect(joint.frame_im, self.frame_im)


class JointRRR(PartialPlanarAssembly):
    """Three hinges with parallel axes and two rods between them.

    Forces across the plane are carried by the first rod's universal joint and the last hinge, so that there is no
    constraint too many, however many planar loops there are. The axes are `n_a` in frame_a and `n_b` in frame_b; `n_b`
    is `n_a` unless it is given (in Modelica it follows from the start).

    >>> model = assemble("world.frame_b - crank.frame_a", "crank.frame_b - arm.frame_a", "arm.frame_b - loop.frame_a",
    ...     "world.frame_b - base.frame_a", "base.frame_b - loop.frame_b", "loop.frame_ia - rod.frame_a",
    ...     world=ac.inner(World(g=0.0)), crank=Revolute(phi=start(0.5, fixed=True), w=start(1.0, fixed=True)),
    ...     arm=FixedTranslation(r=(0.0, 1.0, 0.0)), base=FixedTranslation(r=(2.0, 0.0, 0.0)),
    ...     loop=JointRRR(rRod1_ia=(2.0, 0.0, 0.0), rRod2_ib=(0.0, 1.0, 0.0), phi_guess=20.0), rod=Body(m=3.0))
    >>> solution = run(model, at=[1.0])  # a parallelogram
    >>> close(solution["crank.phi"], [1.5], 1e-3), close(solution["loop.jointUSR.revolute.phi"], [1.5], 1e-3)
    (True, True)

    Source: Modelica.Mechanics.MultiBody.Joints.Assemblies.JointRRR.
    """

    axis: rotational.Flange = rotational.Flange()
    bearing: rotational.Flange = rotational.Flange()
    n_b: Vector = Vector(
        Parameter(unit="1", evaluate=True, doc="axis of the hinges, resolved in frame_b"), PartialPlanarAssembly.n_a
    )
    phi_offset: Parameter = Parameter(0.0, doc="angle of the last hinge = phi + phi_offset [deg]")
    phi_guess: Parameter = Parameter(0.0, doc="of both ways to close the loop, that with phi nearer to this [deg]")
    jointUSR: JointUSR = JointUSR(
        n1_a=PartialPlanarAssembly.n_a, n_b=n_b, rRod1_ia=PartialPlanarAssembly.rRod1_ia,
        rRod2_ib=PartialPlanarAssembly.rRod2_ib, phi_offset=phi_offset, phi_guess=phi_guess,
    )  # fmt: skip

    def assembly(self) -> JointUSR:
        return self.jointUSR

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.jointUSR.axis, self.axis)
        yield connect(self.jointUSR.bearing, self.bearing)


class JointRRP(PartialPlanarAssembly):
    """Two hinges with parallel axes, a slider across them, and two rods.

    Forces across the plane are carried by the first rod's universal joint and the slider, so that there is no
    constraint too many, however many planar loops there are.

    >>> model = assemble("world.frame_b - crank.frame_a", "crank.frame_b - arm.frame_a", "arm.frame_b - loop.frame_a",
    ...     "world.frame_b - loop.frame_b", "loop.frame_ib - load.frame_a", world=ac.inner(World(g=0.0)),
    ...     crank=Revolute(phi=start(0.5, fixed=True), w=start(1.0, fixed=True)), load=Body(),
    ...     arm=FixedTranslation(r=(0.3, 0.0, 0.0)),
    ...     loop=JointRRP(rRod1_ia=(1.0, 0.0, 0.0), rRod2_ib=(0.0, 0.0, 0.0), n_b=(1.0, 0.0, 0.0), s_guess=1.0))
    >>> solution = run(model, at=[0.0])  # a slider crank
    >>> close(solution["loop.jointUSP.prismatic.s"], [0.3 * np.cos(0.5) + np.sqrt(1.0 - (0.3 * np.sin(0.5)) ** 2)])
    True

    Source: Modelica.Mechanics.MultiBody.Joints.Assemblies.JointRRP.
    """

    axis: translational.Flange = translational.Flange()
    bearing: translational.Flange = translational.Flange()
    n_b: Vector = Vector(
        Parameter(unit="1", evaluate=True, doc="axis of the slider, resolved in frame_b (and in frame_ib)"),
        (-1.0, 0.0, 0.0),
    )
    s_offset: Parameter = Parameter(0.0, unit="m", doc="distance of the slider = s + s_offset")
    s_guess: Parameter = Parameter(0.0, unit="m", doc="of both ways to close the loop, that with s nearer to this")
    jointUSP: JointUSP = JointUSP(
        n1_a=PartialPlanarAssembly.n_a, n_b=n_b, rRod1_ia=PartialPlanarAssembly.rRod1_ia,
        rRod2_ib=PartialPlanarAssembly.rRod2_ib, s_offset=s_offset, s_guess=s_guess,
    )  # fmt: skip

    def assembly(self) -> JointUSP:
        return self.jointUSP

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.jointUSP.axis, self.axis)
        yield connect(self.jointUSP.bearing, self.bearing)


class JointUPS(PartialUniversalRod):
    """Universal joint at frame_a, slider, ball joint at frame_b: a strut, of whatever length the frames ask for.

    `nAxis_ia` is the direction from frame_a to frame_b, resolved in frame_ia, which the part of the strut at frame_a
    carries; the part at frame_b carries frame_ib, with the same orientation. ``s = |r_b - r_a| - s_offset``; `axis`
    drives the slider. `n1_a` is the first axis of the universal joint, resolved in frame_a.

    >>> model = assemble("world.frame_b - strut.frame_a", "strut.frame_b - bob.frame_a",
    ...     "strut.bearing - spring.flange_a", "strut.axis - spring.flange_b", world=ac.inner(World(g=10.0)),
    ...     strut=JointUPS(nAxis_ia=(0.0, -1.0, 0.0)), spring=translational.Spring(c=10.0, s_rel0=1.0),
    ...     bob=PointMass(m=2.0, r_0=start((0.0, -2.0, 0.0), fixed=True)))
    >>> solution = run(model, at=[0.0])
    >>> close(solution["bob.a_0[2]"], [-5.0]), close(solution["strut.s"], [2.0])  # 10*(2 - 1)/2 - 10
    (True, True)

    Source: Modelica.Mechanics.MultiBody.Joints.Assemblies.JointUPS.
    """

    frame_ib: Frame = Frame()
    axis: translational.Flange = translational.Flange()
    bearing: translational.Flange = translational.Flange()
    nAxis_ia: Vector = Vector(
        Parameter(unit="m", doc="direction from frame_a to frame_b, resolved in frame_ia"), (1.0, 0.0, 0.0)
    )
    s_offset: Parameter = Parameter(0.0, unit="m", doc="length = s + s_offset")
    eAxis_ia: Vector = Vector(Parameter(unit="1", doc="nAxis_ia with length one"), unit_vector(nAxis_ia))
    slant: Parameter = Parameter(
        norm(cross(PartialUniversalRod.n1_a, nAxis_ia)) / (norm(PartialUniversalRod.n1_a) * norm(nAxis_ia)),
        unit="1", min=PARALLEL, doc="sine of the angle between n1_a and nAxis_ia, which must not be parallel",
    )  # fmt: skip
    s: Variable = Variable(unit="m", state_select="avoid", doc="length, less s_offset")
    f: Variable = Variable(unit="N", doc="driving force along the axis")

    def direction(self) -> Vector:
        return unit_vector(self.nAxis_ia)

    def equations(self) -> Equations:
        yield from super().equations()
        a, b, ia, ib = self.frame_a, self.frame_b, self.frame_ia, self.frame_ib
        yield self.length == norm(self.rRod_0)
        yield self.length == self.s + self.s_offset
        yield branch(ia.R, ib.R)
        yield ib.r_0 == b.r_0
        yield from equal(ib.R, ia.R)
        R_rel, f_b = self.rotation(), self.force_at_end(ia.t + ib.t)
        yield a.f == -resolve1(R_rel, ia.f) - f_b
        yield a.t == -resolve1(R_rel, ia.t + ib.t) - cross(self.eRod_a, f_b) * self.length
        yield b.f == resolve_relative(f_b, a.R, b.R) - resolve_relative(ib.f, ib.R, b.R)
        yield b.t == ZEROS
        yield self.f == self.f_rod
        yield self.axis.s == self.s
        yield self.axis.f == self.f
        yield self.bearing.s == 0
