"""Sensors of what goes through a rigid connection, and changes of the frame that a vector is resolved in."""

from __future__ import annotations

from acausal import Equations, Input, Output, Vector, der, dot, vector

from .interfaces import PartialAbsoluteSensor, PartialRelativeSensor, PartialResolved, PartialTwoFrames


class PartialCutSensor(PartialTwoFrames, PartialResolved, partial=True):
    """Measures what frame a passes on to frame b, which is joined to it rigidly; resolved in frame_a by default.

    Source: PlanarMechanics.Sensors.Internal.PartialCutForceSensor.
    """

    resolveInFrame: str = "frame_a"
    positiveSign: bool = True

    @property
    def sign(self) -> float:
        """Of what is measured: that of frame a with `positiveSign`, else that of frame b."""
        return 1.0 if self.positiveSign else -1.0

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.frame_a.phi == self.frame_b.phi
        yield from self.held_together()


class CutForce(PartialCutSensor):
    """Force ``frame_a.f`` that goes through the connection, or ``frame_b.f`` without `positiveSign`.

    >>> model = assemble("wall.frame - rod.frame_a", "rod.frame_b - meter.frame_a", "meter.frame_b - load.frame_a",
    ...                  wall=Fixed(phi=np.pi / 2), rod=FixedTranslation(), meter=CutForce(), load=Body(m=3.0),
    ...                  planarWorld=ac.inner(PlanarWorld(constantGravity=(0.0, -10.0))))
    >>> run(model)["meter.force[1]"][-1]  # along the rod, which stands upright
    30.0

    Source: PlanarMechanics.Sensors.CutForce.
    """

    force: Vector = Vector(Output(unit="N", doc="force"), size=2)

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.force == self.from_world(vector(self.frame_a.fx, self.frame_a.fy)) * self.sign


class CutTorque(PartialCutSensor):
    """Torque ``frame_a.t`` that goes through the connection, or ``frame_b.t`` without `positiveSign`.

    >>> model = assemble("wall.frame - meter.frame_a", "meter.frame_b - rod.frame_a", "rod.frame_b - load.frame_a",
    ...                  wall=Fixed(), rod=FixedTranslation(r=(2.0, 0.0)), meter=CutTorque(), load=Body(m=3.0),
    ...                  planarWorld=ac.inner(PlanarWorld(constantGravity=(0.0, -10.0))))
    >>> run(model)["meter.torque"][-1]
    60.0

    Source: PlanarMechanics.Sensors.CutTorque.
    """

    torque: Output = Output(unit="N*m", doc="torque")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.torque == self.frame_a.t * self.sign


class CutForceAndTorque(PartialCutSensor):
    """Force and torque that go through the connection, those of frame a, or of frame b without `positiveSign`.

    >>> model = assemble("wall.frame - rod.frame_a", "rod.frame_b - meter.frame_a", "meter.frame_b - load.frame_a",
    ...                  wall=Fixed(), rod=FixedTranslation(), meter=CutForceAndTorque(), load=Body(m=3.0),
    ...                  planarWorld=ac.inner(PlanarWorld(constantGravity=(0.0, -10.0))))
    >>> run(model)["meter.force[2]"][-1]
    30.0

    Source: PlanarMechanics.Sensors.CutForceAndTorque.
    """

    force: Vector = Vector(Output(unit="N", doc="force"), size=2)
    torque: Output = Output(unit="N*m", doc="torque")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.force == self.from_world(vector(self.frame_a.fx, self.frame_a.fy)) * self.sign
        yield self.torque == self.frame_a.t * self.sign


class Power(PartialTwoFrames):
    """Power that flows from frame a to frame b, ``fx dx/dt + fy dy/dt + t dphi/dt``.

    >>> model = assemble("wall.frame - guide.frame_a", "guide.frame_b - meter.frame_a", "meter.frame_b - load.frame_a",
    ...                  "drive.flange - guide.flange_a", drive=translational.ConstantForce(f_constant=6.0),
    ...                  wall=Fixed(), meter=Power(), load=Body(m=3.0), planarWorld=ac.inner(PlanarWorld()),
    ...                  guide=Prismatic(useFlange=True, s=start(0.0, fixed=True), v=start(0.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["meter.power"], [6.0 * 1.0, 6.0 * 2.0])
    True

    Source: PlanarMechanics.Sensors.Power.
    """

    power: Output = Output(unit="W", doc="power that goes from frame a to frame b")

    def equations(self) -> Equations:
        yield from super().equations()
        frame = self.frame_a
        yield self.frame_a.phi == self.frame_b.phi
        yield from self.held_together()
        power = dot((frame.fx, frame.fy), (der(frame.x), der(frame.y)))
        yield self.power == power + frame.t * der(frame.phi)


class PartialTransform(PartialResolved, partial=True):
    """The vector `r_in` of the frame `frame_r_in`, as `r_out` in the frame `frame_r_out` (the same by default).

    Source: PlanarMechanics.Sensors.TransformAbsoluteVector.
    """

    frame_r_in: str = "frame_a"
    frame_r_out: str = ""
    r_in: Vector = Vector(Input(doc="vector in the frame frame_r_in"))
    r_out: Vector = Vector(Output(doc="the same in the frame frame_r_out"))

    @property
    def useFrameResolve(self) -> bool:
        """Whether there is a frame of its own that a vector is resolved in."""
        return "frame_resolve" in (self.frame_r_in, self.frame_r_out)

    def equations(self) -> Equations:
        yield from super().equations()
        given = vector(self.r_in[0], self.r_in[1])
        wanted = self.frame_r_out or self.frame_r_in
        yield self.r_out == (*self.from_world(self.to_world(given, self.frame_r_in), wanted), self.r_in[2])


class TransformAbsoluteVector(PartialTransform, PartialAbsoluteSensor):
    """The vector `r_in`, resolved in the frame `frame_r_in`, as `r_out` in the frame `frame_r_out`.

    The third element belongs to the angle, which is the same in all frames.

    >>> model = assemble("wall.frame - turn.frame_a", "x.y - turn.r_in[0]", "y.y - turn.r_in[1]", "z.y - turn.r_in[2]",
    ...                  wall=Fixed(phi=np.pi / 2), x=blocks.Constant(k=1.0), y=blocks.Constant(k=2.0),
    ...                  z=blocks.Constant(k=3.0), turn=TransformAbsoluteVector(frame_r_out="world"))
    >>> close([run(model)[f"turn.r_out[{k}]"][-1] for k in (1, 2, 3)], [-2.0, 1.0, 3.0])
    True

    Source: PlanarMechanics.Sensors.TransformAbsoluteVector.
    """


class TransformRelativeVector(PartialTransform, PartialRelativeSensor):
    """The vector `r_in`, resolved in the frame `frame_r_in`, as `r_out` in the frame `frame_r_out`.

    As `TransformAbsoluteVector`, with frame b to choose from, too.

    >>> model = assemble("one.frame - turn.frame_a", "two.frame - turn.frame_b", "x.y - turn.r_in[0]",
    ...                  "y.y - turn.r_in[1]", "z.y - turn.r_in[2]", one=Fixed(), two=Fixed(phi=np.pi / 2),
    ...                  x=blocks.Constant(k=1.0), y=blocks.Constant(k=2.0), z=blocks.Constant(k=3.0),
    ...                  turn=TransformRelativeVector(frame_r_out="frame_b"))
    >>> close([run(model)[f"turn.r_out[{k}]"][-1] for k in (1, 2, 3)], [2.0, -1.0, 3.0])
    True

    Source: PlanarMechanics.Sensors.TransformRelativeVector.
    """
