"""Joints whose rotation has three degrees of freedom, and joints that only constrain."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from acausal import Equations, Parameter, Variable, Vector, assert_, branch, der, dot, noevent

from .frames import (
    TINY,
    ZEROS,
    Rotation,
    axes_rotations,
    from_quaternion,
    planar_basis,
    quaternion_rate,
    relative_rotation,
    resolve1,
    resolve2,
    resolve_relative,
    rotation_between,
    unit_vector,
)  # fmt: skip
from .parts import PartialTwoFrames, turned
from .world import Grounded


class PartialRelativeRotation(PartialTwoFrames, partial=True):
    """Orientation of frame b against frame a, with its start; a state where `enforceStates`.

    The state is a quaternion `Q`, or with `useQuaternions` false the angles `phi` about the axes of
    `sequence_angleStates`, which are singular where the second one lays the third axis along the first.

    Source: the common part of Modelica.Mechanics.MultiBody.Joints.Spherical and FreeMotion.
    """

    enforceStates: bool = False
    angles_fixed: bool = False
    w_rel_a_fixed: bool = False
    z_rel_a_fixed: bool = False
    useQuaternions: bool = True
    sequence_start: tuple[float, ...] = (1.0, 2.0, 3.0)
    sequence_angleStates: tuple[float, ...] = (1.0, 2.0, 3.0)
    angles_start: Vector = Vector(
        Parameter(unit="rad", doc="angles about the axes of sequence_start, frame_a to frame_b, at the start"), ZEROS
    )
    w_rel_a_start: Vector = Vector(
        Parameter(unit="rad/s", doc="angular velocity of frame_b against frame_a at the start, resolved in frame_a"),
        ZEROS,
    )
    z_rel_a_start: Vector = Vector(
        Parameter(unit="rad/s2", doc="angular acceleration of frame_b against frame_a at the start, in frame_a"), ZEROS
    )
    Q: Vector = Vector(
        Variable(unit="1", state_select="prefer", doc="orientation as a quaternion, scalar part last, if a state"),
        (0.0, 0.0, 0.0, 1.0), size=4,
    )  # fmt: skip
    w_rel: Vector = Vector(
        Variable(unit="rad/s", state_select="prefer", doc="angular velocity against frame_a, resolved in frame_b")
    )

    phi: Vector = Vector(Variable(unit="rad", state_select="prefer", doc="angles, if they are states"))
    phi_d: Vector = Vector(Variable(unit="rad/s", state_select="prefer", doc="their derivatives"))

    def rotation(self) -> Rotation:
        """The rotation from frame_a to frame_b as states give it."""
        if self.useQuaternions:
            return Rotation(from_quaternion(self.Q), self.w_rel)
        return axes_rotations(self.sequence_angleStates, self.phi, self.phi_d)

    def equations(self) -> Equations:
        yield from super().equations()
        a, b = self.frame_a, self.frame_b
        with_Q = self.enforceStates and self.useQuaternions
        with_phi = self.enforceStates and not self.useQuaternions
        if self.enforceStates:
            yield branch(a.R, b.R)
        yield der(self.Q) == quaternion_rate(self.Q, self.w_rel) if with_Q else self.Q == (0.0, 0.0, 0.0, 1.0)
        yield self.phi_d == der(self.phi) if with_phi else self.phi == ZEROS
        if not with_phi:
            yield self.phi_d == ZEROS
        if not with_Q:
            yield self.w_rel == (self.rotation().w if with_phi else relative_rotation(a.R, b.R).w)

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        a, b = self.frame_a, self.frame_b
        if self.enforceStates and self.useQuaternions:
            yield dot(self.Q, self.Q) == 1
        T = axes_rotations(self.sequence_start, self.angles_start).T
        if self.angles_fixed:
            yield rotation_between(relative_rotation(a.R, b.R).T, T) == ZEROS
        if self.w_rel_a_fixed:
            yield resolve_relative(self.w_rel, b.R, a.R) == self.w_rel_a_start
        if self.z_rel_a_fixed:
            yield resolve_relative(der(self.w_rel), b.R, a.R) == self.z_rel_a_start


class Spherical(PartialRelativeRotation):
    """Ball joint: both frames have one origin, and no torque is carried.

    By default it has no states: what it holds is a tree (or the rest of a loop) of its own, whose orientation is a
    state of one of its bodies. With `enforceStates` the orientation of frame b against frame a is a state here.

    >>> bob = Body(r_CM=(0.0, -1.0, 0.0), I_11=0.0, I_33=0.0, w_0_fixed=True, w_0_start=(0.0, 0.0, 0.0),
    ...            angles_fixed=True, angles_start=(0.2, 0.0, 0.0))
    >>> model = assemble("world.frame_b - joint.frame_a", "joint.frame_b - bob.frame_a", bob=bob, joint=Spherical(),
    ...                  world=ac.inner(World(g=10.0)))
    >>> close(run(model, at=[0.0])["bob.z_a[1]"], [-10.0 * np.sin(0.2)])
    True

    Source: Modelica.Mechanics.MultiBody.Joints.Spherical.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        a, b = self.frame_a, self.frame_b
        yield b.r_0 == a.r_0
        if self.enforceStates:
            yield from turned_without_torque(self, self.rotation())
        else:
            yield a.f + resolve_relative(b.f, b.R, a.R) == ZEROS
            yield a.t == ZEROS
            yield b.t == ZEROS


def turned_without_torque(joint: PartialTwoFrames, R_rel: Rotation) -> Equations:
    """Frame b is frame a turned; forces are carried, torques are zero."""
    a, b = joint.frame_a, joint.frame_b
    yield turned(a, b, R_rel)
    yield b.t == ZEROS


class FreeMotion(PartialRelativeRotation):
    """No constraint: position and orientation of frame b against frame a are states (unless `enforceStates` is False).

    >>> joint = FreeMotion(r_rel_a=start((0.0, 5.0, 0.0), fixed=True), v_rel_a=start((1.0, 0.0, 0.0), fixed=True))
    >>> model = assemble("world.frame_b - joint.frame_a", "joint.frame_b - stone.frame_a", joint=joint,
    ...                  world=ac.inner(World(g=10.0)), stone=Body(m=2.0))
    >>> solution = run(model, at=[1.0])
    >>> close(solution["joint.r_rel_a[1]"], [1.0]), close(solution["joint.r_rel_a[2]"], [0.0])
    (True, True)

    Source: Modelica.Mechanics.MultiBody.Joints.FreeMotion.
    """

    enforceStates: bool = True
    r_rel_a: Vector = Vector(
        Variable(unit="m", state_select="prefer", doc="from frame_a to frame_b, resolved in frame_a")
    )
    v_rel_a: Vector = Vector(Variable(unit="m/s", state_select="prefer", doc="its derivative"))
    a_rel_a: Vector = Vector(Variable(unit="m/s2", doc="the derivative of v_rel_a"))

    def equations(self) -> Equations:
        yield from super().equations()
        a, b = self.frame_a, self.frame_b
        yield self.v_rel_a == der(self.r_rel_a)
        yield self.a_rel_a == der(self.v_rel_a)
        yield b.r_0 == a.r_0 + resolve1(a.R, self.r_rel_a)
        if self.enforceStates:
            yield from turned_without_torque(self, self.rotation())
            yield b.f == ZEROS
        else:
            for frame in (a, b):
                yield frame.f == ZEROS
                yield frame.t == ZEROS


ACROSS = 1e-8
"""What is farther out of a plane [m], or has a larger sine of the angle to its normal, is not in it."""
NOT_PLANAR = (
    "RevolutePlanarLoopConstraint closes planar loops only: use Revolute in its place, or correct the axes of the "
    "joints and the positions of the parts of its loop."
)


class RevolutePlanarLoopConstraint(PartialTwoFrames):
    """Hinge that closes a planar loop: two constraints in the plane across the axis `n`, no others.

    In a loop of hinges with parallel axes the constraints across the plane are there several times, and the forces and
    torques that belong to them are not determined. One hinge of such a loop is replaced by this one, in which they are
    zero. That both frames are in one plane across `n`, and have `n` in common, is checked at the start and at the
    points of the result.

    Source: Modelica.Mechanics.MultiBody.Joints.RevolutePlanarLoopConstraint.

    >>> crank = dict(phi=start(0.5, fixed=True), w=start(1.0, fixed=True))
    >>> # a parallelogram: the rod stays parallel to the ground
    >>> parts = dict(world=ac.inner(World(gravityType="NoGravity")), a=Revolute(**crank), b=Revolute(), c=Revolute(),
    ...     d=RevolutePlanarLoopConstraint(), left=FixedTranslation(r=(0.0, 1.0, 0.0)),
    ...     base=FixedTranslation(r=(2.0, 0.0, 0.0)),
    ...     right=BodyShape(r=(0.0, 1.0, 0.0)), rod=BodyShape(r=(2.0, 0.0, 0.0), m=3.0))
    >>> model = assemble("world.frame_b - a.frame_a", "a.frame_b - left.frame_a", "left.frame_b - b.frame_a",
    ...     "b.frame_b - rod.frame_a", "rod.frame_b - d.frame_a", "d.frame_b - right.frame_b",
    ...     "right.frame_a - c.frame_b", "c.frame_a - base.frame_b", "base.frame_a - world.frame_b", **parts)
    >>> solution = run(model, at=[1.0])
    >>> close(solution["a.phi"], [1.5], 1e-3), close(solution["c.phi"], solution["a.phi"], 1e-4)
    (True, True)
    """

    n: Vector = Vector(
        Parameter(unit="1", evaluate=True, doc="axis of rotation, resolved in frame_a (and in frame_b)"),
        (0.0, 0.0, 1.0),
    )
    f_c: Vector = Vector(Variable(unit="N", doc="constraint forces in the plane"), size=2)

    def equations(self) -> Equations:
        yield from super().equations()
        a, b = self.frame_a, self.frame_b
        e = unit_vector(self.n)
        e_x, e_y = planar_basis(e)
        r_rel_a = resolve2(a.R, b.r_0 - a.r_0)
        yield dot(e_x, r_rel_a) == 0
        yield dot(e_y, r_rel_a) == 0
        yield a.t == ZEROS
        yield b.t == ZEROS
        yield a.f == e_x * self.f_c[0] + e_y * self.f_c[1]
        yield b.f == -resolve_relative(a.f, a.R, b.R)
        in_plane = noevent(abs(dot(e, r_rel_a)) <= ACROSS)
        yield assert_(in_plane, f"frame_b is not in the plane of frame_a across n. {NOT_PLANAR}")
        e_b = resolve_relative(e, b.R, a.R)
        parallel = (abs(dot(e_x, e_b)) <= ACROSS) & (abs(dot(e_y, e_b)) <= ACROSS)
        yield assert_(noevent(parallel), f"the axis n has another direction in frame_b than in frame_a. {NOT_PLANAR}")


def implied_mass(modifications: Mapping[str, Any], *names: str) -> dict[str, Any]:
    """A mass that is given makes a component `massive`: its acceleration is needed then."""
    given = [modifications.get(name, 0.0) for name in names or ("m",)]
    return {"massive": not all(isinstance(m, (int, float)) and m == 0.0 for m in given)}


class SphericalSpherical(PartialTwoFrames, Grounded):
    """Rod of constant length with a ball joint at each end, and (where `m` is given) a point mass in its middle.

    ``|r_b - r_a| = rodLength``; `f_rod` is the force along the rod, positive on frame_a when directed to frame_b. With
    `computeRodLength`, the length follows from the start. (`constrained` is for the assemblies, which see to the
    length.)

    Source: Modelica.Mechanics.MultiBody.Joints.SphericalSpherical.

    >>> model = assemble("world.frame_b - rod.frame_a", "rod.frame_b - bob.frame_a", world=ac.inner(World(g=10.0)),
    ...     rod=SphericalSpherical(rodLength=2.0), bob=PointMass(m=3.0, r_0=start((0.0, -2.0, 0.0), fixed=True),
    ...                                                          v_0=start((0.1, 0.0, 0.0))))
    >>> close(run(model, at=[0.0])["rod.f_rod"], [-30.0], 1e-2)  # the rod is pulled
    True
    """

    massive: bool = False
    computeRodLength: bool = False
    constrained: bool = True
    rodLength: Parameter = Parameter(1.0, unit="m", min=TINY, doc="distance of frame_b from frame_a")
    m: Parameter = Parameter(0.0, unit="kg", min=0.0, doc="mass in the middle of the rod")
    length: Variable = Variable(unit="m", start=rodLength, doc="length of the rod")
    f_rod: Variable = Variable(unit="N", doc="force along the rod, positive on frame_a when directed to frame_b")
    rRod_0: Vector = Vector(Variable(unit="m", state_select="never", doc="from frame_a to frame_b, in the world frame"))
    eRod_a: Vector = Vector(Variable(unit="1", doc="direction from frame_a to frame_b, resolved in frame_a"))
    r_CM_0: Vector = Vector(Variable(unit="m", doc="position of the mass, in the world frame"))
    v_CM_0: Vector = Vector(Variable(unit="m/s", state_select="avoid", doc="its velocity"))
    f_CM_a: Vector = Vector(Variable(unit="N", doc="inertial and gravity force of the mass, resolved in frame_a"))

    @classmethod
    def _implied(cls, modifications: Mapping[str, Any]) -> dict[str, Any]:
        return implied_mass(modifications)

    def equations(self) -> Equations:
        yield from super().equations()
        a, b = self.frame_a, self.frame_b
        yield (der(self.length) if self.computeRodLength else self.length - self.rodLength) == 0
        yield self.rRod_0 == b.r_0 - a.r_0
        yield self.eRod_a == resolve2(a.R, self.rRod_0) / self.length
        if self.constrained:
            yield dot(self.rRod_0, self.rRod_0) == self.length**2
        yield a.t == ZEROS
        yield b.t == ZEROS
        yield self.r_CM_0 == a.r_0 + self.rRod_0 / 2
        if self.massive:
            yield self.v_CM_0 == der(self.r_CM_0)
            yield self.f_CM_a == resolve2(a.R, der(self.v_CM_0) - self.world.gravity(self.r_CM_0)) * self.m
        else:
            yield self.v_CM_0 == ZEROS
            yield self.f_CM_a == ZEROS
        along = self.eRod_a * dot(self.f_CM_a, self.eRod_a)
        pull = self.eRod_a * self.f_rod
        yield a.f == (self.f_CM_a - along) / 2 + pull
        yield b.f == resolve_relative((self.f_CM_a + along) / 2 - pull, a.R, b.R)
