"""Sensors."""

from __future__ import annotations

from typing import ClassVar

from acausal import Equations, Output, Variable, Vector, branch, cross, der, dot, norm

from .forces import PartialResolved
from .frames import ZEROS, Frame, equal, resolve1, resolve2
from .parts import PartialTwoFrames


class PartialAbsoluteSensor(PartialResolved, partial=True):
    """Measures at frame_a, without force and torque; resolved in frame_a by default.

    Source: Modelica.Mechanics.MultiBody.Sensors.Internal.PartialAbsoluteSensor.
    """

    _must_connect: ClassVar[tuple[str, ...]] = ("frame_a",)
    resolveInFrame: str = "frame_a"
    frame_a: Frame = Frame()

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.frame_a.f == ZEROS
        yield self.frame_a.t == ZEROS


class AbsolutePosition(PartialAbsoluteSensor):
    """Position of frame_a, resolved in frame_a (or as `resolveInFrame` says).

    >>> model = assemble("arm.frame_b - sensor.frame_a", "world.frame_b - arm.frame_a", world=ac.inner(World()),
    ...                  arm=FixedTranslation(r=(1.0, 2.0, 3.0)), sensor=AbsolutePosition())
    >>> run(model)["sensor.r[2]"][-1]
    2.0

    Source: Modelica.Mechanics.MultiBody.Sensors.AbsolutePosition.
    """

    r: Vector = Vector(Output(unit="m", doc="position"))

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.r == self.from_world(self.frame_a.r_0)


class AbsoluteVelocity(PartialAbsoluteSensor):
    """Velocity of frame_a, resolved in frame_a (or as `resolveInFrame` says).

    >>> model = assemble("stone.frame_a - sensor.frame_a", world=ac.inner(World(g=10.0)), sensor=AbsoluteVelocity(),
    ...                  stone=Body(m=2.0))
    >>> close(run(model, at=[1.0])["sensor.v[2]"], [-10.0])
    True

    Source: Modelica.Mechanics.MultiBody.Sensors.AbsoluteVelocity.
    """

    v: Vector = Vector(Output(unit="m/s", doc="velocity"))

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v == self.from_world(der(self.frame_a.r_0))


class AbsoluteAngularVelocity(PartialAbsoluteSensor):
    """Angular velocity of frame_a, resolved in frame_a (or as `resolveInFrame` says).

    >>> body = Body(w_0_fixed=True, w_0_start=(1.0, 0.0, 0.0))
    >>> model = assemble("body.frame_a - sensor.frame_a", world=ac.inner(World()), body=body,
    ...                  sensor=AbsoluteAngularVelocity())
    >>> close(run(model)["sensor.w[1]"], [1.0, 1.0])
    True

    Source: Modelica.Mechanics.MultiBody.Sensors.AbsoluteAngularVelocity.
    """

    w: Vector = Vector(Output(unit="rad/s", doc="angular velocity"))

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.w == self.from_world(resolve1(self.frame_a.R, self.frame_a.R.w))


class PartialRelativeSensor(PartialTwoFrames, PartialResolved, partial=True):
    """Measures between frame_a and frame_b, without forces and torques; resolved in frame_a by default.

    Source: Modelica.Mechanics.MultiBody.Sensors.Internal.PartialRelativeSensor.
    """

    resolveInFrame: str = "frame_a"

    def equations(self) -> Equations:
        yield from super().equations()
        for frame in (self.frame_a, self.frame_b):
            yield frame.f == ZEROS
            yield frame.t == ZEROS


class RelativePosition(PartialRelativeSensor):
    """Vector from frame_a to frame_b (resolved as `resolveInFrame` says).

    >>> model = assemble("world.frame_b - sensor.frame_a", "fixed.frame_b - sensor.frame_b", world=ac.inner(World()),
    ...                  fixed=Fixed(r=(1.0, 2.0, 3.0)), sensor=RelativePosition())
    >>> run(model)["sensor.r_rel[3]"][-1]
    3.0

    Source: Modelica.Mechanics.MultiBody.Sensors.RelativePosition.
    """

    r_rel: Vector = Vector(Output(unit="m", doc="from frame_a to frame_b"))

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.r_rel == self.from_world(self.frame_b.r_0 - self.frame_a.r_0)


class RelativeVelocity(PartialRelativeSensor):
    """Velocity of frame_b as seen from frame_a, ``d(T_a (r_b - r_a))/dt`` (resolved as `resolveInFrame` says).

    >>> model = assemble("world.frame_b - sensor.frame_a", "stone.frame_a - sensor.frame_b", stone=Body(),
    ...                  world=ac.inner(World(g=10.0)), sensor=RelativeVelocity())
    >>> close(run(model, at=[1.0])["sensor.v_rel[2]"], [-10.0])
    True

    Source: Modelica.Mechanics.MultiBody.Sensors.RelativeVelocity.
    """

    v_rel: Vector = Vector(Output(unit="m/s", doc="velocity of frame_b against frame_a"))

    def equations(self) -> Equations:
        yield from super().equations()
        a, b = self.frame_a, self.frame_b
        turning = cross(resolve1(a.R, a.R.w), b.r_0 - a.r_0)
        yield self.v_rel == self.from_world(der(b.r_0) - der(a.r_0) - turning)


class RelativeAngularVelocity(PartialRelativeSensor):
    """Angular velocity of frame_b against frame_a (resolved as `resolveInFrame` says).

    >>> body = Body(w_0_fixed=True, w_0_start=(1.0, 0.0, 0.0))
    >>> model = assemble("world.frame_b - sensor.frame_a", "body.frame_a - sensor.frame_b", body=body,
    ...                  world=ac.inner(World()), sensor=RelativeAngularVelocity())
    >>> close(run(model)["sensor.w_rel[1]"], [1.0, 1.0])
    True

    Source: Modelica.Mechanics.MultiBody.Sensors.RelativeAngularVelocity.
    """

    w_rel: Vector = Vector(Output(unit="rad/s", doc="angular velocity of frame_b against frame_a"))

    def equations(self) -> Equations:
        yield from super().equations()
        a, b = self.frame_a, self.frame_b
        yield self.w_rel == self.from_world(resolve1(b.R, b.R.w) - resolve1(a.R, a.R.w))


class Distance(PartialTwoFrames):
    """Distance of frame_b from frame_a.

    >>> model = assemble("world.frame_b - sensor.frame_a", "fixed.frame_b - sensor.frame_b", world=ac.inner(World()),
    ...                  fixed=Fixed(r=(2.0, 3.0, 6.0)), sensor=Distance())
    >>> run(model)["sensor.distance"][-1]
    7.0

    Source: Modelica.Mechanics.MultiBody.Sensors.Distance.
    """

    distance: Variable = Output(unit="m", doc="distance of the origins")

    def equations(self) -> Equations:
        yield from super().equations()
        for frame in (self.frame_a, self.frame_b):
            yield frame.f == ZEROS
            yield frame.t == ZEROS
        yield self.distance == norm(self.frame_b.r_0 - self.frame_a.r_0)


class PartialCutSensor(PartialTwoFrames, PartialResolved, partial=True):
    """Between two parts that are joined rigidly; resolved in frame_a by default.

    Source: Modelica.Mechanics.MultiBody.Sensors.Internal.PartialCutForceSensor.
    """

    resolveInFrame: str = "frame_a"
    positiveSign: bool = True

    def equations(self) -> Equations:
        yield from super().equations()
        yield from _rigid(self)

    def signed(self, v: Vector) -> Vector:
        """A cut vector, resolved in frame_a, as the sensor gives it."""
        measured = v if self.resolveInFrame == "frame_a" else self.from_world(resolve1(self.frame_a.R, v))
        return measured if self.positiveSign else -measured


def _rigid(sensor: PartialTwoFrames) -> Equations:
    a, b = sensor.frame_a, sensor.frame_b
    yield branch(a.R, b.R)
    yield b.r_0 == a.r_0
    yield from equal(b.R, a.R)
    yield a.f + b.f == ZEROS
    yield a.t + b.t == ZEROS


class CutForce(PartialCutSensor):
    """Force between two parts, ``frame_a.f`` (resolved as `resolveInFrame` says).

    >>> model = assemble("world.frame_b - sensor.frame_a", "sensor.frame_b - load.frame_a", load=Body(m=2.0),
    ...                  world=ac.inner(World(g=10.0)), sensor=CutForce())
    >>> run(model)["sensor.force[2]"][-1]
    20.0

    Source: Modelica.Mechanics.MultiBody.Sensors.CutForce.
    """

    force: Vector = Vector(Output(unit="N", doc="cut force"))

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.force == self.signed(self.frame_a.f)


class CutTorque(PartialCutSensor):
    """Torque between two parts, ``frame_a.t`` (resolved as `resolveInFrame` says).

    >>> model = assemble("world.frame_b - sensor.frame_a", "sensor.frame_b - load.frame_a", sensor=CutTorque(),
    ...                  world=ac.inner(World(g=10.0)), load=Body(m=2.0, r_CM=(0.5, 0.0, 0.0)))
    >>> run(model)["sensor.torque[3]"][-1]
    10.0

    Source: Modelica.Mechanics.MultiBody.Sensors.CutTorque.
    """

    torque: Vector = Vector(Output(unit="N*m", doc="cut torque"))

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.torque == self.signed(self.frame_a.t)


class CutForceAndTorque(PartialCutSensor):
    """Force and torque between two parts, ``frame_a.f`` and ``frame_a.t`` (resolved as `resolveInFrame` says).

    >>> model = assemble("world.frame_b - sensor.frame_a", "sensor.frame_b - load.frame_a", sensor=CutForceAndTorque(),
    ...                  world=ac.inner(World(g=10.0)), load=Body(m=2.0, r_CM=(0.5, 0.0, 0.0)))
    >>> solution = run(model)
    >>> solution["sensor.force[2]"][-1], solution["sensor.torque[3]"][-1]
    (20.0, 10.0)

    Source: Modelica.Mechanics.MultiBody.Sensors.CutForceAndTorque.
    """

    force: Vector = Vector(Output(unit="N", doc="cut force"))
    torque: Vector = Vector(Output(unit="N*m", doc="cut torque"))

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.force == self.signed(self.frame_a.f)
        yield self.torque == self.signed(self.frame_a.t)


class Power(PartialTwoFrames):
    """Power that flows from frame_a to frame_b, ``f_a.v_a + t_a.w_a``.

    >>> bob = PointMass(m=2.0, r_0=start((0.0, -2.0, 0.0), fixed=True), v_0=start((0.0, -1.0, 0.0), fixed=True))
    >>> model = assemble("world.frame_b - spring.frame_a", "spring.frame_b - sensor.frame_a",
    ...                  "sensor.frame_b - bob.frame_a", bob=bob, sensor=Power(),
    ...                  world=ac.inner(World(g=10.0)), spring=Spring(c=10.0, s_unstretched=1.0))
    >>> close(run(model, at=[0.0])["sensor.power"], [-10.0])  # 10 N upward at 1 m/s downward
    True

    Source: Modelica.Mechanics.MultiBody.Sensors.Power.
    """

    power: Variable = Output(unit="W", doc="power from frame_a to frame_b")

    def equations(self) -> Equations:
        yield from super().equations()
        yield from _rigid(self)
        a = self.frame_a
        yield self.power == dot(a.f, resolve2(a.R, der(a.r_0))) + dot(a.t, a.R.w)
