"""Sensors; what they measure is resolved in the world frame."""

from __future__ import annotations

from acausal import Equations, Output, Variable, Vector, der, dot, norm

from .interfaces import PartialAbsoluteSensor, PartialRelativeSensor, PartialTwoFrames, between


class AbsolutePosition(PartialAbsoluteSensor):
    """Position and angle of a frame, ``r = (x, y, phi)``.

    >>> model = assemble("wall.frame - rod.frame_a", "rod.frame_b - meter.frame_a", wall=Fixed(r=(1.0, 0.0), phi=0.5),
    ...                  rod=FixedTranslation(r=(2.0, 0.0)), meter=AbsolutePosition())
    >>> close(run(model)["meter.r[1]"][-1], 1.0 + 2.0 * np.cos(0.5))
    True

    Source: PlanarMechanics.Sensors.AbsolutePosition.
    """

    r: Vector = Vector(Output(doc="positions x and y [m], and angle [rad]"))

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.r == (self.frame_a.x, self.frame_a.y, self.frame_a.phi)


class AbsoluteVelocity(PartialAbsoluteSensor):
    """Velocity and angular velocity of a frame, ``v = (dx/dt, dy/dt, dphi/dt)``.

    >>> model = assemble("wall.frame - hinge.frame_a", "hinge.frame_b - rod.frame_a", "rod.frame_b - bob.frame_a",
    ...                  "rod.frame_b - meter.frame_a", wall=Fixed(), rod=FixedTranslation(r=(2.0, 0.0)),
    ...                  hinge=Revolute(phi=start(0.0, fixed=True), w=start(3.0, fixed=True)),
    ...                  meter=AbsoluteVelocity(), bob=Body(),
    ...                  planarWorld=ac.inner(PlanarWorld(constantGravity=(0.0, 0.0))))
    >>> close(run(model)["meter.v[2]"], [6.0, 6.0 * np.cos(3.0)])
    True

    Source: PlanarMechanics.Sensors.AbsoluteVelocity.
    """

    v: Vector = Vector(Output(doc="velocities in x and y [m/s], and angular velocity [rad/s]"))

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v == (der(self.frame_a.x), der(self.frame_a.y), der(self.frame_a.phi))


class RelativePosition(PartialRelativeSensor):
    """Position and angle of frame b against frame a, `r_rel`, resolved in the world frame.

    >>> model = assemble("one.frame - meter.frame_a", "two.frame - meter.frame_b", one=Fixed(r=(1.0, 0.0), phi=0.5),
    ...                  two=Fixed(r=(4.0, 0.0), phi=0.75), meter=RelativePosition())
    >>> [run(model)[f"meter.r_rel[{i}]"][-1] for i in (1, 3)]
    [3.0, 0.25]

    Source: PlanarMechanics.Sensors.RelativePosition, resolved in the world frame.
    """

    r_rel: Vector = Vector(Output(doc="relative positions in x and y [m], and angle [rad]"))

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.r_rel == (*between(self.frame_a, self.frame_b), self.frame_b.phi - self.frame_a.phi)


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


class CutForceAndTorque(PartialTwoFrames):
    """Force and torque that frame a passes on to frame b, which is joined to it rigidly.

    >>> model = assemble("wall.frame - rod.frame_a", "rod.frame_b - meter.frame_a", "meter.frame_b - load.frame_a",
    ...                  wall=Fixed(), rod=FixedTranslation(), meter=CutForceAndTorque(), load=Body(m=3.0),
    ...                  planarWorld=ac.inner(PlanarWorld(constantGravity=(0.0, -10.0))))
    >>> run(model)["meter.force[2]"][-1]
    30.0

    Source: PlanarMechanics.Sensors.CutForceAndTorque, resolved in the world frame.
    """

    force: Vector = Vector(Output(unit="N", doc="force"), size=2)
    torque: Output = Output(unit="N*m", doc="torque")
    power: Variable = Variable(unit="W", doc="power that goes from frame a to frame b")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.frame_a.phi == self.frame_b.phi
        yield from self.held_together()
        frame = self.frame_a
        yield self.force == (frame.fx, frame.fy)
        yield self.torque == frame.t
        yield self.power == dot(self.force, (der(frame.x), der(frame.y))) + self.torque * der(frame.phi)
