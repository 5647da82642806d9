"""Relative position and orientation as scalars, to be given at the start or to be wanted as states."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from acausal import (
    Equations,
    Output,
    Parameter,
    Variable,
    Vector,
    branch,
    der,
    dot,
    structural,
    vector,
)
from acausal.language.declarations import Start

from .frames import (
    ZEROS,
    Rotation,
    axes_quaternion,
    axes_rotations,
    from_quaternion,
    nearest_angles,
    quaternion_rate,
    resolve1,
    resolve2,
)
from .parts import PartialTwoFrames, oriented


class FreeMotionScalarInit(PartialTwoFrames):
    """No constraint and no force: scalars of the motion of frame_b against frame_a, with starts and state selection.

    With `use_r`: ``r_rel_a = T_a (r_b - r_a)``, with `use_v` and `use_a` its derivatives. With `use_angle`: the angles
    about the axes of `sequence_start` that turn frame_a into frame_b, with `use_angle_d` and `use_angle_dd` their
    derivatives. With `use_w`: angular velocity, resolved in frame_b, with `use_z` its derivative. What is not used is
    zero.

    With `use_angle` there is a branch between the frames: one of both orientations follows from the other and from a
    quaternion `Q`, a state that is nowhere singular. The angles are computed from it, within half a turn of their
    starts, and are not determined where the second one lays the third axis along the first. Only where the
    `stateSelect` of an angle or of its derivative is "prefer" or "always", angles are the states: they then count whole
    turns, and the motion must not go through these positions.

    >>> model = assemble("world.frame_b - arm.frame_a", "arm.frame_b - rod.frame_a", "rod.frame_b - tip.frame_b",
    ...                  "world.frame_b - tip.frame_a", world=ac.inner(World()), arm=Revolute(phi=start(0.4)),
    ...                  tip=FreeMotionScalarInit(use_r=True, r_rel_a_2=start(0.6, fixed=True)),
    ...                  rod=BodyShape(r=(1.0, 0.0, 0.0)))
    >>> close(run(model, at=[0.0])["arm.phi"], [np.arcsin(0.6)])  # it starts where the tip is to be
    True

    Source: Modelica.Mechanics.MultiBody.Joints.FreeMotionScalarInit.
    """

    use_r: bool = False
    use_v: bool = False
    use_a: bool = False
    use_angle: bool = False
    use_angle_d: bool = False
    use_angle_dd: bool = False
    use_w: bool = False
    use_z: bool = False
    sequence_start: tuple[float, ...] = (1.0, 2.0, 3.0)
    r_rel_a_1_stateSelect: str = "never"
    r_rel_a_2_stateSelect: str = "never"
    r_rel_a_3_stateSelect: str = "never"
    v_rel_a_1_stateSelect: str = "never"
    v_rel_a_2_stateSelect: str = "never"
    v_rel_a_3_stateSelect: str = "never"
    angle_1_stateSelect: str = "never"
    angle_2_stateSelect: str = "never"
    angle_3_stateSelect: str = "never"
    angle_d_1_stateSelect: str = "never"
    angle_d_2_stateSelect: str = "never"
    angle_d_3_stateSelect: str = "never"
    w_rel_b_1_stateSelect: str = "never"
    w_rel_b_2_stateSelect: str = "never"
    w_rel_b_3_stateSelect: str = "never"
    r_rel_a_1: Variable = Output(
        unit="m", state_select=structural("r_rel_a_1_stateSelect"), doc="from frame_a to frame_b, in frame_a, element 1"
    )  # fmt: skip
    r_rel_a_2: Variable = Output(
        unit="m", state_select=structural("r_rel_a_2_stateSelect"), doc="from frame_a to frame_b, in frame_a, element 2"
    )  # fmt: skip
    r_rel_a_3: Variable = Output(
        unit="m", state_select=structural("r_rel_a_3_stateSelect"), doc="from frame_a to frame_b, in frame_a, element 3"
    )  # fmt: skip
    v_rel_a_1: Variable = Output(
        unit="m/s", state_select=structural("v_rel_a_1_stateSelect"), doc="its derivative, element 1"
    )  # fmt: skip
    v_rel_a_2: Variable = Output(
        unit="m/s", state_select=structural("v_rel_a_2_stateSelect"), doc="its derivative, element 2"
    )  # fmt: skip
    v_rel_a_3: Variable = Output(
        unit="m/s", state_select=structural("v_rel_a_3_stateSelect"), doc="its derivative, element 3"
    )  # fmt: skip
    a_rel_a_1: Variable = Output(unit="m/s2", doc="the derivative of v_rel_a, element 1")
    a_rel_a_2: Variable = Output(unit="m/s2", doc="the derivative of v_rel_a, element 2")
    a_rel_a_3: Variable = Output(unit="m/s2", doc="the derivative of v_rel_a, element 3")
    angle_1: Variable = Output(
        unit="rad", state_select=structural("angle_1_stateSelect"), doc="angle of sequence_start, element 1"
    )  # fmt: skip
    angle_2: Variable = Output(
        unit="rad", state_select=structural("angle_2_stateSelect"), doc="angle of sequence_start, element 2"
    )  # fmt: skip
    angle_3: Variable = Output(
        unit="rad", state_select=structural("angle_3_stateSelect"), doc="angle of sequence_start, element 3"
    )  # fmt: skip
    angle_d_1: Variable = Output(
        unit="rad/s", state_select=structural("angle_d_1_stateSelect"), doc="its derivative, element 1"
    )  # fmt: skip
    angle_d_2: Variable = Output(
        unit="rad/s", state_select=structural("angle_d_2_stateSelect"), doc="its derivative, element 2"
    )  # fmt: skip
    angle_d_3: Variable = Output(
        unit="rad/s", state_select=structural("angle_d_3_stateSelect"), doc="its derivative, element 3"
    )  # fmt: skip
    angle_dd_1: Variable = Output(unit="rad/s2", doc="the derivative of angle_d, element 1")
    angle_dd_2: Variable = Output(unit="rad/s2", doc="the derivative of angle_d, element 2")
    angle_dd_3: Variable = Output(unit="rad/s2", doc="the derivative of angle_d, element 3")
    w_rel_b_1: Variable = Output(
        unit="rad/s", state_select=structural("w_rel_b_1_stateSelect"), doc="angular velocity, in frame_b, element 1"
    )  # fmt: skip
    w_rel_b_2: Variable = Output(
        unit="rad/s", state_select=structural("w_rel_b_2_stateSelect"), doc="angular velocity, in frame_b, element 2"
    )  # fmt: skip
    w_rel_b_3: Variable = Output(
        unit="rad/s", state_select=structural("w_rel_b_3_stateSelect"), doc="angular velocity, in frame_b, element 3"
    )  # fmt: skip
    z_rel_b_1: Variable = Output(unit="rad/s2", doc="its derivative, element 1")
    z_rel_b_2: Variable = Output(unit="rad/s2", doc="its derivative, element 2")
    z_rel_b_3: Variable = Output(unit="rad/s2", doc="its derivative, element 3")

    guess: Vector = Vector(
        Parameter(unit="rad", doc="angles that those given by Q are nearest to; by default the starts of the angles"),
        ZEROS,
    )
    Q: Vector = Vector(
        Variable(unit="1", state_select="prefer", doc="orientation as a quaternion, scalar part last, if a state"),
        (0.0, 0.0, 0.0, 1.0), size=4,
    )  # fmt: skip
    w_rel: Vector = Vector(
        Variable(unit="rad/s", state_select="prefer", doc="angular velocity, in frame_b, where Q is a state")
    )

    @classmethod
    def _implied(cls, modifications: Mapping[str, Any]) -> dict[str, Any]:
        """Guesses of the quaternion and of the solution for the angles, from the starts of the angles."""
        given = [modifications.get(f"angle_{k}") for k in (1, 2, 3)]
        values: list[Any] = [angle.value if isinstance(angle, Start) else angle for angle in given]
        guess = [0.0 if value is None or isinstance(value, (list, tuple)) else value for value in values]
        implied = {f"guess[{k + 1}]": value for k, value in enumerate(guess)}
        if all(isinstance(value, (int, float)) for value in guess):
            Q = axes_quaternion(modifications.get("sequence_start", (1, 2, 3)), guess)
            implied |= {f"Q[{k + 1}]": Start(value) for k, value in enumerate(Q)}
        return implied

    def equations(self) -> Equations:
        yield from super().equations()
        for frame in (self.frame_a, self.frame_b):
            yield frame.f == ZEROS
        yield from self.positions()
        yield from self.angles()
        yield from self.velocities()

    def positions(self) -> Equations:
        """Relative position and its derivatives."""
        a, b = self.frame_a, self.frame_b
        r = vector(self.r_rel_a_1, self.r_rel_a_2, self.r_rel_a_3)
        v = vector(self.v_rel_a_1, self.v_rel_a_2, self.v_rel_a_3)
        acceleration = vector(self.a_rel_a_1, self.a_rel_a_2, self.a_rel_a_3)
        with_v = self.use_r and self.use_v
        if self.use_r:
            yield b.r_0 == a.r_0 + resolve1(a.R, r)
        else:
            yield r == ZEROS
        yield v == (der(r) if with_v else ZEROS)
        yield acceleration == (der(v) if with_v and self.use_a else ZEROS)

    @property
    def states_are_angles(self) -> bool:
        """Whether the orientation is given by the angles, because one of them is wanted as a state."""
        angles = (self.angle_1_stateSelect, self.angle_2_stateSelect, self.angle_3_stateSelect)
        rates = (self.angle_d_1_stateSelect, self.angle_d_2_stateSelect, self.angle_d_3_stateSelect)
        return self.use_angle and not {"prefer", "always"}.isdisjoint(angles + rates)

    @property
    def states_are_quaternions(self) -> bool:
        """Whether the orientation is given by `Q`."""
        return self.use_angle and not self.states_are_angles

    def angles(self) -> Equations:
        """The orientation and its angles with their derivatives; no torques."""
        a, b, Q = self.frame_a, self.frame_b, self.Q
        angle = vector(self.angle_1, self.angle_2, self.angle_3)
        rate = vector(self.angle_d_1, self.angle_d_2, self.angle_d_3)
        second = vector(self.angle_dd_1, self.angle_dd_2, self.angle_dd_3)
        with_rate = self.use_angle and self.use_angle_d
        if self.use_angle:
            by_angles = axes_rotations(self.sequence_start, angle, der(angle))
            by_Q = Rotation(from_quaternion(Q), self.w_rel)
            yield branch(a.R, b.R)
            yield oriented(a, b, by_angles if self.states_are_angles else by_Q)
        if self.states_are_quaternions:
            yield der(Q) == quaternion_rate(Q, self.w_rel)
            yield angle == nearest_angles(from_quaternion(Q), self.sequence_start, self.guess)
        else:
            yield Q == (0.0, 0.0, 0.0, 1.0)
            yield self.w_rel == ZEROS
        if not self.use_angle:
            yield angle == ZEROS
        yield a.t == ZEROS
        yield b.t == ZEROS
        yield rate == (der(angle) if with_rate else ZEROS)
        yield second == (der(rate) if with_rate and self.use_angle_dd else ZEROS)

    def velocities(self) -> Equations:
        """Relative angular velocity and its derivative."""
        a, b = self.frame_a, self.frame_b
        w = vector(self.w_rel_b_1, self.w_rel_b_2, self.w_rel_b_3)
        z = vector(self.z_rel_b_1, self.z_rel_b_2, self.z_rel_b_3)
        relative = self.w_rel if self.states_are_quaternions else b.R.w - resolve2(b.R, resolve1(a.R, a.R.w))
        yield w == (relative if self.use_w else ZEROS)
        yield z == (der(w) if self.use_w and self.use_z else ZEROS)

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        if self.states_are_quaternions:
            yield dot(self.Q, self.Q) == 1
