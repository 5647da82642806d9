"""Sensors; what they measure is resolved in the world frame."""

from __future__ import annotations

from acausal import Equations, Output, Variable, der, sqrt

from .interfaces import PartialAbsoluteSensor, PartialRelativeSensor, PartialTwoFrames


class AbsolutePosition(PartialAbsoluteSensor):
    """Position and angle of a frame.

    >>> model = assemble("wall.frame - rod.frame_a", "rod.frame_b - meter.frame_a", wall=Fixed(r_x=1.0, phi=0.5),
    ...                  rod=FixedTranslation(r_x=2.0), meter=AbsolutePosition())
    >>> close(run(model)["meter.x"][-1], 1.0 + 2.0 * np.cos(0.5))
    True

    Source: PlanarMechanics.Sensors.AbsolutePosition.
    """

    x: Output = Output(unit="m", doc="x position")
    y: Output = Output(unit="m", doc="y position")
    phi: Output = Output(unit="rad", doc="angle")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.x == self.frame_a.x
        yield self.y == self.frame_a.y
        yield self.phi == self.frame_a.phi


class AbsoluteVelocity(PartialAbsoluteSensor):
    """Velocity and angular velocity of a frame.

    >>> model = assemble("wall.frame - hinge.frame_a", "hinge.frame_b - rod.frame_a", "rod.frame_b - bob.frame_a",
    ...                  "rod.frame_b - meter.frame_a", wall=Fixed(), rod=FixedTranslation(r_x=2.0), bob=Body(),
    ...                  hinge=Revolute(phi=start(0.0, fixed=True), w=start(3.0, fixed=True)),
    ...                  meter=AbsoluteVelocity(), planarWorld=ac.inner(PlanarWorld(g_y=0.0)))
    >>> close(run(model)["meter.v_y"], [6.0, 6.0 * np.cos(3.0)])
    True

    Source: PlanarMechanics.Sensors.AbsoluteVelocity.
    """

    v_x: Output = Output(unit="m/s", doc="velocity in x")
    v_y: Output = Output(unit="m/s", doc="velocity in y")
    w: Output = Output(unit="rad/s", doc="angular velocity")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v_x == der(self.frame_a.x)
        yield self.v_y == der(self.frame_a.y)
        yield self.w == der(self.frame_a.phi)


class RelativePosition(PartialRelativeSensor):
    """Position and angle of frame b against frame a, resolved in the world frame.

    >>> model = assemble("one.frame - meter.frame_a", "two.frame - meter.frame_b", one=Fixed(r_x=1.0, phi=0.5),
    ...                  two=Fixed(r_x=4.0, phi=0.75), meter=RelativePosition())
    >>> [run(model)[f"meter.{n}"][-1] for n in ("r_x", "phi")]
    [3.0, 0.25]

    Source: PlanarMechanics.Sensors.RelativePosition, resolved in the world frame.
    """

    r_x: Output = Output(unit="m", doc="relative position in x")
    r_y: Output = Output(unit="m", doc="relative position in y")
    phi: Output = Output(unit="rad", doc="relative angle")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.r_x == self.frame_b.x - self.frame_a.x
        yield self.r_y == self.frame_b.y - self.frame_a.y
        yield self.phi == self.frame_b.phi - self.frame_a.phi


class Distance(PartialRelativeSensor):
    """Distance of the origins of two frames.

    >>> model = assemble("one.frame - meter.frame_a", "two.frame - meter.frame_b", one=Fixed(r_x=1.0),
    ...                  two=Fixed(r_x=4.0, r_y=4.0), meter=Distance())
    >>> run(model)["meter.distance"][-1]
    5.0

    Source: PlanarMechanics.Sensors.Distance.
    """

    distance: Output = Output(unit="m", doc="distance")

    def equations(self) -> Equations:
        yield from super().equations()
        r_x, r_y = self.frame_b.x - self.frame_a.x, self.frame_b.y - self.frame_a.y
        yield self.distance == sqrt(r_x**2 + r_y**2)


class CutForceAndTorque(PartialTwoFrames):
    """Force and torque that frame a passes on to frame b, which is joined to it rigidly.

    >>> model = assemble("wall.frame - rod.frame_a", "rod.frame_b - meter.frame_a", "meter.frame_b - load.frame_a",
    ...                  wall=Fixed(), rod=FixedTranslation(), meter=CutForceAndTorque(), load=Body(m=3.0),
    ...                  planarWorld=ac.inner(PlanarWorld(g_y=-10.0)))
    >>> run(model)["meter.force_y"][-1]
    30.0

    Source: PlanarMechanics.Sensors.CutForceAndTorque, resolved in the world frame.
    """

    force_x: Output = Output(unit="N", doc="force in x")
    force_y: Output = Output(unit="N", doc="force in y")
    torque: Output = Output(unit="N*m", doc="torque")
    power: Variable = Variable(unit="W", doc="power that goes from frame a to frame b")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.frame_a.phi == self.frame_b.phi
        yield from self.held_together()
        yield self.force_x == self.frame_a.fx
        yield self.force_y == self.frame_a.fy
        yield self.torque == self.frame_a.t
        velocity = (der(self.frame_a.x), der(self.frame_a.y), der(self.frame_a.phi))
        yield self.power == self.force_x * velocity[0] + self.force_y * velocity[1] + self.torque * velocity[2]
