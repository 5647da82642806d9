"""Joints, and joints as constraints without coordinates of their own."""

from __future__ import annotations

from acausal import Equations, Parameter, Variable, Vector, assert_, conditional, der, dot, norm, structural, vector

from .. import rotational, translational
from .interfaces import PartialTwoFrames, between, resolve1


class Revolute(PartialTwoFrames):
    """Frame b turns about the origin of frame a: ``phi = frame_b.phi - frame_a.phi``, ``w = dphi/dt``, ``z = dw/dt``.

    `t` is the torque that drives frame b: zero, or that of `flange_a` with `useFlange`; `support` is the housing of
    the drive, which stands still.

    >>> pendulum = assemble("wall.frame - hinge.frame_a", "hinge.frame_b - rod.frame_a", "rod.frame_b - bob.frame_a",
    ...                     planarWorld=ac.inner(PlanarWorld()), wall=Fixed(), bob=PointMass(), rod=FixedTranslation(),
    ...                     hinge=Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)))
    >>> values = run(pendulum, at=[0.0, 0.5])
    >>> close(values["hinge.w"][-1] ** 2, -2 * 9.81 * np.sin(values["hinge.phi"][-1]))
    True

    Source: PlanarMechanics.Joints.Revolute.
    """

    useFlange: bool = False
    stateSelect: str = "prefer"
    flange_a: rotational.Flange = conditional(rotational.Flange(), "useFlange")
    support: rotational.Flange = conditional(rotational.Flange(), "useFlange")
    phi: Variable = Variable(
        unit="rad", state_select=structural("stateSelect"), doc="angle of frame b against frame a"
    )
    w: Variable = Variable(unit="rad/s", state_select=structural("stateSelect"), doc="angular velocity")
    z: Variable = Variable(unit="rad/s2", doc="angular acceleration")
    t: Variable = Variable(unit="N*m", doc="torque that drives frame b")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.w == der(self.phi)
        yield self.z == der(self.w)
        yield self.frame_a.phi + self.phi == self.frame_b.phi
        yield from self.held_together()
        yield self.frame_a.t == self.t
        if self.useFlange:
            yield self.flange_a.phi == self.phi
            yield self.flange_a.tau == self.t
            yield self.support.phi == 0
        else:
            yield self.t == 0


class PartialPrismatic(PartialTwoFrames, partial=True):
    """Frame b slides on a line through frame a in the direction `r` of frame a, turned as frame a.

    Source: PlanarMechanics.Joints.Prismatic.
    """

    r: Vector = Vector(
        Parameter(unit="m", doc="direction of sliding in frame a, of any length but zero"), (1.0, 0.0), size=2
    )

    def equations(self) -> Equations:
        yield from super().equations()
        yield assert_(dot(self.r, self.r) > 0.0, "the direction `r` of sliding has no length")

    def direction(self) -> Vector:
        """Direction of sliding in the world frame, of length 1."""
        return resolve1(self.frame_a, self.r / norm(self.r))


class Prismatic(PartialPrismatic):
    """Frame b slides by `s` in the direction `r` of frame a: ``v = ds/dt``, ``a = dv/dt``.

    `f` is the force that drives frame b: zero, or that of `flange_a` with `useFlange`; `support` is the housing of the
    drive, which stands still.

    >>> model = assemble("wall.frame - slope.frame_a", "slope.frame_b - load.frame_a", wall=Fixed(phi=-np.pi / 6),
    ...                  slope=Prismatic(s=start(0.0, fixed=True), v=start(0.0, fixed=True)), load=PointMass(m=3.0),
    ...                  planarWorld=ac.inner(PlanarWorld(constantGravity=(0.0, -10.0))))
    >>> close(run(model, at=[0.0, 2.0])["slope.s"][-1], 0.5 * 10.0 * 0.5 * 2.0**2)
    True

    Source: PlanarMechanics.Joints.Prismatic.
    """

    useFlange: bool = False
    stateSelect: str = "prefer"
    flange_a: translational.Flange = conditional(translational.Flange(), "useFlange")
    support: translational.Flange = conditional(translational.Flange(), "useFlange")
    e0: Vector = Vector(Variable(unit="1", doc="direction of sliding in the world frame"), size=2)
    r0: Vector = Vector(Variable(unit="m", doc="from frame a to frame b, in the world frame"), size=2)
    s: Variable = Variable(unit="m", state_select=structural("stateSelect"), doc="distance of frame b from frame a")
    v: Variable = Variable(unit="m/s", state_select=structural("stateSelect"), doc="velocity")
    a: Variable = Variable(unit="m/s2", doc="acceleration")
    f: Variable = Variable(unit="N", doc="force that drives frame b")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.e0 == self.direction()
        yield self.r0 == self.e0 * self.s
        yield self.v == der(self.s)
        yield self.a == der(self.v)
        yield self.frame_a.phi == self.frame_b.phi
        yield from self.held_together(self.r0)
        yield dot((self.frame_a.fx, self.frame_a.fy), self.e0) == self.f
        if self.useFlange:
            yield self.flange_a.s == self.s
            yield self.flange_a.f == self.f
            yield self.support.s == 0
        else:
            yield self.f == 0


class RevoluteConstraint(PartialTwoFrames):
    """The origins of both frames stay together, their angles are free; no torque.

    A revolute joint without an angle of its own, for a loop that others' coordinates describe.

    >>> model = assemble("wall.frame - hinge.frame_a", "hinge.frame_b - rod.frame_a", "rod.frame_b - bob.frame_a",
    ...                  planarWorld=ac.inner(PlanarWorld()), wall=Fixed(), hinge=RevoluteConstraint(),
    ...                  rod=FixedTranslation(), bob=Body(phi=start(-np.pi / 2, fixed=True), w=start(2.0, fixed=True)))
    >>> close(run(model)["hinge.frame_a.fy"][0], 9.81 + 2.0**2 * 1.0)  # the weight and the centripetal force
    True

    Source: Modelica.Mechanics.MultiBody.Joints.Constraints.Revolute, in the plane.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield from self.held_together()
        yield self.frame_a.t == 0


class PrismaticConstraint(PartialPrismatic):
    """Frame b stays on a line through frame a, turned as frame a; no force along the line.

    A prismatic joint without a coordinate of its own, for a loop that others' coordinates describe.

    >>> model = assemble("wall.frame - slope.frame_a", "slope.frame_b - load.frame_a", wall=Fixed(phi=-np.pi / 6),
    ...                  slope=PrismaticConstraint(), planarWorld=ac.inner(PlanarWorld(constantGravity=(0.0, -10.0))),
    ...                  load=PointMass(m=3.0, r=start((0.0, 0.0)), v=start((0.0, 0.0))))
    >>> close(run(model, at=[0.0, 2.0])["load.r[1]"][-1], 0.5 * 10.0 * 0.5 * 2.0**2 * np.cos(np.pi / 6))
    True

    Source: Modelica.Mechanics.MultiBody.Joints.Constraints.Prismatic, in the plane.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        e, r = self.direction(), between(self.frame_a, self.frame_b)
        f_a, f_b = vector(self.frame_a.fx, self.frame_a.fy), vector(self.frame_b.fx, self.frame_b.fy)
        yield self.frame_a.phi == self.frame_b.phi
        yield r[0] * e[1] == r[1] * e[0]
        yield f_a + f_b == (0.0, 0.0)
        yield dot(f_a, e) == 0
        yield self.frame_a.t + self.frame_b.t + r[0] * f_b[1] - r[1] * f_b[0] == 0
