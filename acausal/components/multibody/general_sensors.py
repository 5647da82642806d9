"""Sensors of angles, sensors that give what is asked for, and changes of the frame that a vector is resolved in."""

from __future__ import annotations

from typing import ClassVar

from acausal import Equations, Input, Output, Parameter, Variable, Vector, der

from .frames import ZEROS, Frame, relative_rotation, resolve1, rotation_angles
from .sensors import PartialAbsoluteSensor, PartialRelativeSensor


class AbsoluteAngles(PartialAbsoluteSensor):
    """Angles about the axes numbered in `sequence`, one after the other, that turn the world frame into frame_a.

    Of both solutions, the one whose first angle is nearer to `guessAngle1`.

    >>> model = assemble("world.frame_b - bend.frame_a", "bend.frame_b - sensor.frame_a", world=ac.inner(World()),
    ...     bend=FixedRotation(rotationType="PlanarRotationSequence", sequence=(3, 1, 2), angles=(20.0, -30.0, 40.0)),
    ...     sensor=AbsoluteAngles(sequence=(3, 1, 2)))
    >>> solution = run(model)
    >>> close([np.rad2deg(solution[f"sensor.angles[{k}]"][-1]) for k in (1, 2, 3)], [20.0, -30.0, 40.0])
    True

    Source: Modelica.Mechanics.MultiBody.Sensors.AbsoluteAngles.
    """

    sequence: tuple[float, ...] = (1.0, 2.0, 3.0)
    guessAngle1: Parameter = Parameter(0.0, unit="rad", doc="the first angle is the solution nearer to this")
    angles: Vector = Vector(Output(unit="rad", doc="angles from the world frame to frame_a"))

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.angles == rotation_angles(self.frame_a.R.T, self.sequence, self.guessAngle1)


class RelativeAngles(PartialRelativeSensor):
    """Angles about the axes numbered in `sequence`, one after the other, that turn frame_a into frame_b.

    Of both solutions, the one whose first angle is nearer to `guessAngle1`.

    >>> model = assemble("world.frame_b - bend.frame_a - sensor.frame_a", "bend.frame_b - sensor.frame_b",
    ...     world=ac.inner(World()), bend=FixedRotation(n=(0.0, 1.0, 0.0), angle=25.0), sensor=RelativeAngles())
    >>> close(np.rad2deg(run(model)["sensor.angles[2]"]), [25.0, 25.0])
    True

    Source: Modelica.Mechanics.MultiBody.Sensors.RelativeAngles.
    """

    sequence: tuple[float, ...] = (1.0, 2.0, 3.0)
    guessAngle1: Parameter = Parameter(0.0, unit="rad", doc="the first angle is the solution nearer to this")
    angles: Vector = Vector(Output(unit="rad", doc="angles from frame_a to frame_b"))

    def equations(self) -> Equations:
        yield from super().equations()
        T = relative_rotation(self.frame_a.R, self.frame_b.R).T
        yield self.angles == rotation_angles(T, self.sequence, self.guessAngle1)


class AbsoluteSensor(PartialAbsoluteSensor):
    """Position, velocity, acceleration, angles, angular velocity and acceleration of frame_a, as far as asked for.

    All are absolute quantities and their derivatives in the world frame, resolved as `resolveInFrame` says (in frame_a
    by default). What is not asked for by `get_r`, `get_v`, `get_a`, `get_angles`, `get_w`, `get_z` is zero.

    >>> model = assemble("stone.frame_a - sensor.frame_a", world=ac.inner(World(g=10.0)), stone=Body(m=2.0),
    ...                  sensor=AbsoluteSensor(get_v=True, get_a=True))
    >>> solution = run(model, at=[1.0])
    >>> close(solution["sensor.v[2]"], [-10.0]), close(solution["sensor.a[2]"], [-10.0])
    (True, True)

    Source: Modelica.Mechanics.MultiBody.Sensors.AbsoluteSensor.
    """

    get_r: bool = False
    get_v: bool = False
    get_a: bool = False
    get_angles: bool = False
    get_w: bool = False
    get_z: bool = False
    sequence: tuple[float, ...] = (1.0, 2.0, 3.0)
    guessAngle1: Parameter = Parameter(0.0, unit="rad", doc="the first angle is the solution nearer to this")
    r: Vector = Vector(Output(unit="m", doc="position"))
    v: Vector = Vector(Output(unit="m/s", doc="velocity"))
    a: Vector = Vector(Output(unit="m/s2", doc="acceleration"))
    angles: Vector = Vector(Output(unit="rad", doc="angles from the world frame to frame_a"))
    w: Vector = Vector(Output(unit="rad/s", doc="angular velocity"))
    z: Vector = Vector(Output(unit="rad/s2", doc="angular acceleration"))
    v_0: Vector = Vector(Variable(unit="m/s", state_select="avoid", doc="velocity in the world frame"))

    def equations(self) -> Equations:
        yield from super().equations()
        r_0, R = self.frame_a.r_0, self.frame_a.R
        yield self.v_0 == (der(r_0) if self.get_v or self.get_a else ZEROS)
        yield self.r == (self.from_world(r_0) if self.get_r else ZEROS)
        yield self.v == (self.from_world(self.v_0) if self.get_v else ZEROS)
        yield self.a == (self.from_world(der(self.v_0)) if self.get_a else ZEROS)
        yield self.w == (self.from_world(resolve1(R, R.w)) if self.get_w else ZEROS)
        yield self.z == (self.from_world(resolve1(R, der(R.w))) if self.get_z else ZEROS)
        yield self.angles == (rotation_angles(R.T, self.sequence, self.guessAngle1) if self.get_angles else ZEROS)


class RelativeSensor(PartialRelativeSensor):
    """Position, velocity, acceleration, angles, angular velocity and acceleration of frame_b against frame_a.

    `r_rel` and `w_rel` are resolved as `resolveInFrame` says (in frame_a by default); `v_rel`, `a_rel` and `z_rel` are
    the derivatives of these elements, resolved in the frame that `resolveInFrameAfterDifferentiation` names (the same
    one, unless it is given). What is not asked for by `get_r_rel`, `get_v_rel`, ... is zero.

    >>> model = assemble("world.frame_b - sensor.frame_a", "stone.frame_a - sensor.frame_b", stone=Body(),
    ...                  world=ac.inner(World(g=10.0)), sensor=RelativeSensor(get_v_rel=True, get_a_rel=True))
    >>> solution = run(model, at=[1.0])
    >>> close(solution["sensor.v_rel[2]"], [-10.0]), close(solution["sensor.a_rel[2]"], [-10.0])
    (True, True)

    Source: Modelica.Mechanics.MultiBody.Sensors.RelativeSensor.
    """

    resolveInFrameAfterDifferentiation: str = ""
    get_r_rel: bool = False
    get_v_rel: bool = False
    get_a_rel: bool = False
    get_angles: bool = False
    get_w_rel: bool = False
    get_z_rel: bool = False
    sequence: tuple[float, ...] = (1.0, 2.0, 3.0)
    guessAngle1: Parameter = Parameter(0.0, unit="rad", doc="the first angle is the solution nearer to this")
    r_rel: Vector = Vector(Output(unit="m", doc="from frame_a to frame_b"))
    v_rel: Vector = Vector(Output(unit="m/s", doc="velocity"))
    a_rel: Vector = Vector(Output(unit="m/s2", doc="acceleration"))
    angles: Vector = Vector(Output(unit="rad", doc="angles from frame_a to frame_b"))
    w_rel: Vector = Vector(Output(unit="rad/s", doc="angular velocity"))
    z_rel: Vector = Vector(Output(unit="rad/s2", doc="angular acceleration"))
    rate: Vector = Vector(Variable(unit="m/s", state_select="avoid", doc="derivative of r_rel"))

    @property
    def useFrameResolve(self) -> bool:
        """Whether vectors are resolved in a frame of its own."""
        return "frame_resolve" in (self.resolveInFrame, self.resolveInFrameAfterDifferentiation)

    def differentiated(self, v: Vector) -> Vector:
        """Derivatives of elements in one frame, resolved in the other."""
        name = self.resolveInFrameAfterDifferentiation
        return v if name in ("", self.resolveInFrame) else self.from_world(self.to_world(v), name)

    def equations(self) -> Equations:
        yield from super().equations()
        a, b = self.frame_a, self.frame_b
        r, w = b.r_0 - a.r_0, resolve1(b.R, b.R.w) - resolve1(a.R, a.R.w)
        moving, turning = self.get_v_rel or self.get_a_rel, self.get_w_rel or self.get_z_rel
        yield self.r_rel == (self.from_world(r) if self.get_r_rel or moving else ZEROS)
        yield self.rate == (der(self.r_rel) if moving else ZEROS)
        yield self.v_rel == (self.differentiated(self.rate) if self.get_v_rel else ZEROS)
        yield self.a_rel == (self.differentiated(der(self.rate)) if self.get_a_rel else ZEROS)
        yield self.w_rel == (self.from_world(w) if turning else ZEROS)
        yield self.z_rel == (self.differentiated(der(self.w_rel)) if self.get_z_rel else ZEROS)
        T = relative_rotation(a.R, b.R).T
        yield self.angles == (rotation_angles(T, self.sequence, self.guessAngle1) if self.get_angles else ZEROS)


class PartialTransform(PartialAbsoluteSensor, partial=True):
    """A vector `r_in`, resolved in the frame `frame_r_in` names, given as `r_out`, resolved in `frame_r_out`.

    Source: the common part of Modelica.Mechanics.MultiBody.Sensors.TransformAbsoluteVector and TransformRelativeVector.
    """

    frame_r_in: str = "frame_a"
    frame_r_out: str = ""
    r_in: Vector = Vector(Input(doc="vector"))
    r_out: Vector = Vector(Output(doc="the same vector"))

    @property
    def useFrameResolve(self) -> bool:
        """Whether a frame of its own is needed."""
        return "frame_resolve" in (self.frame_r_in, self.frame_r_out)

    def equations(self) -> Equations:
        yield from super().equations()
        same = self.frame_r_out in ("", self.frame_r_in)
        into = self.frame_r_in if same else self.frame_r_out
        turned = self.from_world(self.to_world(self.r_in, self.frame_r_in), into)
        yield self.r_out == (self.r_in if same else turned)


class TransformAbsoluteVector(PartialTransform):
    """A vector resolved in the frame `frame_r_in` names (world, frame_a or frame_resolve) resolved in `frame_r_out`.

    >>> model = assemble("world.frame_b - bend.frame_a", "bend.frame_b - into.frame_a", "x.y - into.r_in[0]",
    ...     "y.y - into.r_in[1]", "y.y - into.r_in[2]", world=ac.inner(World()), x=Constant(k=2.0), y=Constant(k=0.0),
    ...     bend=FixedRotation(n=(0.0, 0.0, 1.0), angle=90.0),
    ...     into=TransformAbsoluteVector(frame_r_in="world", frame_r_out="frame_a"))
    >>> close(run(model)["into.r_out[2]"], [-2.0, -2.0])
    True

    Source: Modelica.Mechanics.MultiBody.Sensors.TransformAbsoluteVector.
    """


class TransformRelativeVector(PartialTransform):
    """A vector resolved in `frame_r_in` (world, frame_a, frame_b or frame_resolve) resolved in `frame_r_out`.

    >>> model = assemble("world.frame_b - bend.frame_a - into.frame_a", "bend.frame_b - into.frame_b",
    ...     "x.y - into.r_in[0]", "y.y - into.r_in[1]", "y.y - into.r_in[2]", world=ac.inner(World()),
    ...     x=Constant(k=2.0), y=Constant(k=0.0), bend=FixedRotation(n=(0.0, 0.0, 1.0), angle=90.0),
    ...     into=TransformRelativeVector(frame_r_in="frame_a", frame_r_out="frame_b"))
    >>> close(run(model)["into.r_out[2]"], [-2.0, -2.0])
    True

    Source: Modelica.Mechanics.MultiBody.Sensors.TransformRelativeVector.
    """

    _must_connect: ClassVar[tuple[str, ...]] = ("frame_a", "frame_b")
    frame_b: Frame = Frame()

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.frame_b.f == ZEROS
        yield self.frame_b.t == ZEROS
