"""Sensors. Vectors are resolved as `resolveInFrame` says, in frame_a unless it is given; angles are what they are."""

from __future__ import annotations

from acausal import Equations, Expr, Output, Variable, Vector, der, norm, vector

from .interfaces import PartialAbsoluteSensor, PartialRelativeSensor, between, resolve2


class AbsolutePosition(PartialAbsoluteSensor):
    """Position and angle of a frame, ``r = (x, y, phi)``, against the frame that it is resolved in.

    >>> model = assemble("wall.frame - rod.frame_a", "rod.frame_b - meter.frame_a", wall=Fixed(r=(1.0, 0.0), phi=0.5),
    ...                  rod=FixedTranslation(r=(2.0, 0.0)), meter=AbsolutePosition(resolveInFrame="world"))
    >>> close(run(model)["meter.r[1]"][-1], 1.0 + 2.0 * np.cos(0.5))
    True

    Source: PlanarMechanics.Sensors.AbsolutePosition.
    """

    r: Vector = Vector(Output(doc="positions x and y [m], and angle [rad]"))

    def equations(self) -> Equations:
        yield from super().equations()
        frame, against = self.frame_a, self.frame_of(self.resolveInFrame)
        angle = frame.phi - (0.0 if against is None else against.phi)
        yield self.r == (*self.from_world(vector(frame.x, frame.y)), angle)


class AbsoluteVelocity(PartialAbsoluteSensor):
    """Velocity and angular velocity of a frame, ``v = (dx/dt, dy/dt, dphi/dt)`` in the world frame.

    >>> model = assemble("wall.frame - hinge.frame_a", "hinge.frame_b - rod.frame_a", "rod.frame_b - bob.frame_a",
    ...                  "rod.frame_b - meter.frame_a", wall=Fixed(), rod=FixedTranslation(r=(2.0, 0.0)),
    ...                  hinge=Revolute(phi=start(0.0, fixed=True), w=start(3.0, fixed=True)),
    ...                  meter=AbsoluteVelocity(), bob=Body(),
    ...                  planarWorld=ac.inner(PlanarWorld(constantGravity=(0.0, 0.0))))
    >>> close(run(model)["meter.v[2]"], [6.0, 6.0])
    True

    Source: PlanarMechanics.Sensors.AbsoluteVelocity.
    """

    v: Vector = Vector(Output(doc="velocities in x and y [m/s], and angular velocity [rad/s]"))

    def equations(self) -> Equations:
        yield from super().equations()
        frame = self.frame_a
        yield self.v == (*self.from_world(vector(der(frame.x), der(frame.y))), der(frame.phi))


class AbsoluteAcceleration(PartialAbsoluteSensor):
    """Acceleration and angular acceleration of a frame, ``a = (d2x/dt2, d2y/dt2, d2phi/dt2)`` in the world frame.

    >>> model = assemble("wall.frame - hinge.frame_a", "hinge.frame_b - rod.frame_a", "rod.frame_b - bob.frame_a",
    ...                  "rod.frame_b - meter.frame_a", wall=Fixed(), rod=FixedTranslation(r=(2.0, 0.0)),
    ...                  hinge=Revolute(phi=start(0.0, fixed=True), w=start(3.0, fixed=True)),
    ...                  meter=AbsoluteAcceleration(), bob=Body(),
    ...                  planarWorld=ac.inner(PlanarWorld(constantGravity=(0.0, 0.0))))
    >>> close(run(model)["meter.a[1]"], [-18.0, -18.0])
    True

    Source: PlanarMechanics.Sensors.AbsoluteAcceleration.
    """

    a: Vector = Vector(Output(doc="accelerations in x and y [m/s2], and angular acceleration [rad/s2]"))
    v_0: Vector = Vector(Variable(doc="velocities x and y [m/s], and angular velocity [rad/s] in the world frame"))

    def equations(self) -> Equations:
        yield from super().equations()
        frame = self.frame_a
        yield self.v_0 == (der(frame.x), der(frame.y), der(frame.phi))
        yield self.a == (*self.from_world(vector(der(self.v_0[0]), der(self.v_0[1]))), der(self.v_0[2]))


class RelativePosition(PartialRelativeSensor):
    """Position and angle of frame b against frame a, `r_rel`.

    >>> model = assemble("one.frame - meter.frame_a", "two.frame - meter.frame_b", one=Fixed(r=(1.0, 0.0), phi=np.pi),
    ...                  two=Fixed(r=(4.0, 0.0), phi=0.75), meter=RelativePosition())
    >>> close([run(model)[f"meter.r_rel[{i}]"][-1] for i in (1, 3)], [-3.0, 0.75 - np.pi])
    True

    Source: PlanarMechanics.Sensors.RelativePosition.
    """

    r_rel: Vector = Vector(Output(doc="relative positions in x and y [m], and angle [rad]"))

    def equations(self) -> Equations:
        yield from super().equations()
        a, b = self.frame_a, self.frame_b
        yield self.r_rel == (*self.from_world(between(a, b)), b.phi - a.phi)


class PartialRelativeMotion(PartialRelativeSensor, partial=True):
    """Measures how frame b moves as seen from frame a: derivatives of its position resolved there.

    Source: PlanarMechanics.Sensors.RelativeVelocity.
    """

    r_a: Vector = Vector(Variable(unit="m", doc="position of frame b in frame a"), size=2)
    phi_rel: Variable = Variable(unit="rad", doc="angle of frame b against frame a")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.r_a == resolve2(self.frame_a, between(self.frame_a, self.frame_b))
        yield self.phi_rel == self.frame_b.phi - self.frame_a.phi

    def seen(self, v: Vector, angular: Expr) -> tuple[Expr, Expr, Expr]:
        """A vector of frame a, resolved as `resolveInFrame` says, with the part of the angle."""
        resolved = v if self.resolveInFrame == "frame_a" else self.from_world(self.to_world(v, "frame_a"))
        return resolved[0], resolved[1], angular


class RelativeVelocity(PartialRelativeMotion):
    """Velocity and angular velocity of frame b as seen from frame a, the derivative of its position resolved there.

    >>> model = assemble("wall.frame - hinge.frame_a", "hinge.frame_b - disc.frame_a - meter.frame_a",
    ...                  "mark.frame - meter.frame_b", wall=Fixed(), mark=Fixed(r=(2.0, 0.0)), disc=Body(),
    ...                  hinge=Revolute(phi=start(0.0, fixed=True), w=start(3.0, fixed=True)),
    ...                  meter=RelativeVelocity(), planarWorld=ac.inner(PlanarWorld()))
    >>> close(run(model)["meter.v_rel[2]"], [-6.0, -6.0 * np.cos(3.0)])
    True

    Source: PlanarMechanics.Sensors.RelativeVelocity.
    """

    v_rel: Vector = Vector(Output(doc="relative velocities in x and y [m/s], and angular velocity [rad/s]"))

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v_rel == self.seen(der(self.r_a), der(self.phi_rel))


class RelativeAcceleration(PartialRelativeMotion):
    """Acceleration of frame b as seen from frame a, the second derivative of its position resolved there.

    >>> model = assemble("wall.frame - hinge.frame_a", "hinge.frame_b - disc.frame_a - meter.frame_a",
    ...                  "mark.frame - meter.frame_b", wall=Fixed(), mark=Fixed(r=(2.0, 0.0)), disc=Body(),
    ...                  hinge=Revolute(phi=start(0.0, fixed=True), w=start(3.0, fixed=True)),
    ...                  meter=RelativeAcceleration(), planarWorld=ac.inner(PlanarWorld()))
    >>> close(run(model)["meter.a_rel[1]"], [-18.0, -18.0 * np.cos(3.0)])
    True

    Source: PlanarMechanics.Sensors.RelativeAcceleration.
    """

    a_rel: Vector = Vector(Output(doc="relative accelerations in x and y [m/s2], and angular acceleration [rad/s2]"))
    v_a: Vector = Vector(Variable(unit="m/s", doc="relative velocity in frame a"), size=2)
    w_rel: Variable = Variable(unit="rad/s", doc="relative angular velocity")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v_a == der(self.r_a)
        yield self.w_rel == der(self.phi_rel)
        yield self.a_rel == self.seen(der(self.v_a), der(self.w_rel))


class Distance(PartialRelativeSensor):
    """Distance of the origins of two frames.

    >>> model = assemble("one.frame - meter.frame_a", "two.frame - meter.frame_b", one=Fixed(r=(1.0, 0.0)),
    ...                  two=Fixed(r=(4.0, 4.0)), meter=Distance())
    >>> run(model)["meter.distance"][-1]
    5.0

    Source: PlanarMechanics.Sensors.Distance.
    """

    distance: Output = Output(unit="m", doc="distance")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.distance == norm(between(self.frame_a, self.frame_b))
