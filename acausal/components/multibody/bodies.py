"""Rigid bodies."""

from __future__ import annotations

from acausal import (
    Equations,
    Expr,
    Matrix,
    Parameter,
    Variable,
    Vector,
    assert_,
    choose,
    cross,
    defining,
    der,
    dot,
    is_root,
    matrix,
    max,
    potential_root,
    root,
    structural,
)

from .frames import (
    IDENTITY,
    ZEROS,
    Frame,
    axes_rotations,
    from_quaternion,
    quaternion_rate,
    resolve1,
    resolve2,
    rotation_between,
)
from .world import Grounded

NEGATIVE = 1e-9
"""A moment of inertia may be below zero by this part of the largest one: numbers are given with so many digits."""
ROUNDED = 1e-14
"""Rounding error of the determinant of an inertia tensor, relative to the cube of its largest moment."""


def positive_semidefinite(I: Matrix) -> Expr:  # noqa: E741 (its symbol)
    """Whether no eigenvalue of a symmetric matrix (3, 3) is negative, to rounding: no principal minor is."""
    (a, _, _), (d, b, _), (e, f, c) = I.rows()
    largest = max(a, b, c)
    x, y, z = (moment + NEGATIVE * largest for moment in (a, b, c))
    determinant = x * (y * z - f**2) - d * (d * z - f * e) + e * (d * f - y * e)
    moments = (x >= 0.0) & (y >= 0.0) & (z >= 0.0)
    pairs = (x * y >= d**2) & (y * z >= f**2) & (x * z >= e**2)
    return moments & pairs & (determinant >= -ROUNDED * largest**3)


class Body(Grounded):
    """Rigid body with one frame; its mass, centre of mass and inertia tensor.

    Newton's and Euler's equations, resolved in `frame_a`, with ``z = dw/dt``:
    ``f = m (T (a_0 - g_0) + z x r_CM + w x (w x r_CM))`` and ``t = I z + w x I w + r_CM x f``, where `a_0` is the
    acceleration of `frame_a` and `g_0` gravity at the centre of mass.

    A body that no chain of joints ties to a fixed frame is the root of its tree. Its orientation then is a quaternion
    `Q` (scalar part last), integrated by ``dQ/dt = G(Q)' w/2``; it needs no length of one, so nothing is singular and
    nothing drifts apart, however often the body turns. Without `useQuaternions` it is the angles `phi` about the axes
    of `sequence_angleStates`, which are singular where the second one lays the third axis along the first.

    The inertia tensor must not have a negative principal moment.

    >>> body = Body(I_11=1.0, I_22=2.0, I_33=3.0, w_0_fixed=True, w_0_start=(0.0, 0.5, 0.0))
    >>> model = assemble(world=ac.inner(World(gravityType="NoGravity")), body=body)
    >>> solution = run(model, at=[2 * ac.PI.value])  # half a turn about y
    >>> close(solution["body.frame_a.R.T[1,1]"], [-1.0]), close(solution["body.frame_a.R.T[2,2]"], [1.0])
    (True, True)

    Source: Modelica.Mechanics.MultiBody.Parts.Body.
    """

    frame_a: Frame = Frame()
    angles_fixed: bool = False
    w_0_fixed: bool = False
    z_0_fixed: bool = False
    enforceStates: bool = False
    useQuaternions: bool = True
    sequence_start: tuple[float, ...] = (1.0, 2.0, 3.0)
    sequence_angleStates: tuple[float, ...] = (1.0, 2.0, 3.0)
    r_CM: Vector = Vector(Parameter(unit="m", doc="from frame_a to the centre of mass, resolved in frame_a"), ZEROS)
    m: Parameter = Parameter(1.0, unit="kg", min=0.0, doc="mass")
    I_11: Parameter = Parameter(0.001, unit="kg*m2", min=0.0, doc="element 1,1 of the inertia tensor at the centre")
    I_22: Parameter = Parameter(0.001, unit="kg*m2", min=0.0, doc="element 2,2 of the inertia tensor")
    I_33: Parameter = Parameter(0.001, unit="kg*m2", min=0.0, doc="element 3,3 of the inertia tensor")
    I_21: Parameter = Parameter(0.0, unit="kg*m2", doc="element 2,1 of the inertia tensor")
    I_31: Parameter = Parameter(0.0, unit="kg*m2", doc="element 3,1 of the inertia tensor")
    I_32: Parameter = Parameter(0.0, unit="kg*m2", doc="element 3,2 of the inertia tensor")
    angles_start: Vector = Vector(
        Parameter(unit="rad", doc="angles about the axes of sequence_start, from the world to frame_a, at the start"),
        ZEROS,
    )
    w_0_start: Vector = Vector(
        Parameter(unit="rad/s", doc="angular velocity at the start, resolved in the world frame"), ZEROS
    )
    z_0_start: Vector = Vector(
        Parameter(unit="rad/s2", doc="angular acceleration at the start, resolved in the world frame"), ZEROS
    )
    r_0: Vector = Vector(Variable(unit="m", state_select="avoid", doc="position of frame_a in the world frame"))
    v_0: Vector = Vector(Variable(unit="m/s", state_select="avoid", doc="velocity of frame_a, in the world frame"))
    a_0: Vector = Vector(Variable(unit="m/s2", doc="acceleration of frame_a, in the world frame"))
    w_a: Vector = Vector(Variable(unit="rad/s", doc="angular velocity, resolved in frame_a"))
    z_a: Vector = Vector(Variable(unit="rad/s2", doc="angular acceleration, resolved in frame_a"))
    g_0: Vector = Vector(Variable(unit="m/s2", doc="gravity at the centre of mass, in the world frame"))
    Q: Vector = Vector(
        Variable(unit="1", doc="orientation as a quaternion, scalar part last, where the body is a root"),
        (0.0, 0.0, 0.0, 1.0), size=4,
    )  # fmt: skip
    phi: Vector = Vector(Variable(unit="rad", state_select="prefer", doc="angles, where they are the orientation"))
    phi_d: Vector = Vector(Variable(unit="rad/s", state_select="prefer", doc="their derivatives"))

    def equations(self) -> Equations:
        yield from super().equations()
        R, r_CM = self.frame_a.R, self.r_CM
        yield root(R) if self.enforceStates else potential_root(R)
        yield from self.orientation()
        yield self.r_0 == self.frame_a.r_0
        yield self.v_0 == der(self.frame_a.r_0)
        yield self.a_0 == der(self.v_0)
        yield self.w_a == R.w
        yield self.z_a == der(R.w)
        yield self.g_0 == self.world.gravity(self.frame_a.r_0 + resolve1(R, r_CM))
        w, z = self.w_a, self.z_a
        yield self.frame_a.f == (resolve2(R, self.a_0 - self.g_0) + cross(z, r_CM) + cross(w, cross(w, r_CM))) * self.m
        inertia = self.inertia()
        yield self.frame_a.t == inertia @ z + cross(w, inertia @ w) + cross(r_CM, self.frame_a.f)
        yield assert_(positive_semidefinite(inertia), "a principal moment of the inertia tensor is negative")

    def orientation(self) -> Equations:
        """The orientation of a root."""
        R, Q, phi, phi_d = self.frame_a.R, self.Q, self.phi, self.phi_d
        if self.useQuaternions:
            by_states = [defining(R.T == from_quaternion(Q)), der(Q) == quaternion_rate(Q, self.w_a)]
            yield choose(is_root(R), by_states, [Q == (0.0, 0.0, 0.0, 1.0)])
            yield phi == ZEROS
            yield phi_d == ZEROS
            return
        turned = axes_rotations(self.sequence_angleStates, phi, phi_d)
        by_states = [defining(R.T == turned.T), R.w == turned.w, phi_d == der(phi)]
        yield choose(is_root(R), by_states, [phi == ZEROS, phi_d == ZEROS])
        yield Q == (0.0, 0.0, 0.0, 1.0)

    def inertia(self) -> Matrix:
        """Inertia tensor about the centre of mass."""
        return matrix(
            (self.I_11, self.I_21, self.I_31), (self.I_21, self.I_22, self.I_32), (self.I_31, self.I_32, self.I_33)
        )

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        R = self.frame_a.R
        if self.useQuaternions:
            yield choose(is_root(R), [dot(self.Q, self.Q) == 1])
        if self.angles_fixed:
            yield rotation_between(R.T, axes_rotations(self.sequence_start, self.angles_start).T) == ZEROS
        if self.w_0_fixed:
            yield resolve1(R, R.w) == self.w_0_start
        if self.z_0_fixed:
            yield resolve1(R, self.z_a) == self.z_0_start


class PointMass(Grounded):
    """Mass without extension: ``f = m T (a_0 - g_0)``, no torque.

    Where nothing else gives the orientation of its frame, it is that of the world.

    >>> model = assemble(world=ac.inner(World(g=10.0)), stone=PointMass(r_0=start((0.0, 5.0, 0.0), fixed=True)))
    >>> close(run(model, at=[1.0])["stone.r_0[2]"], [0.0])
    True

    Source: Modelica.Mechanics.MultiBody.Parts.PointMass.
    """

    stateSelect: str = "avoid"
    frame_a: Frame = Frame()
    m: Parameter = Parameter(1.0, unit="kg", min=0.0, doc="mass")
    r_0: Vector = Vector(
        Variable(unit="m", state_select=structural("stateSelect"), doc="position in the world frame")
    )
    v_0: Vector = Vector(
        Variable(unit="m/s", state_select=structural("stateSelect"), doc="velocity, in the world frame")
    )
    a_0: Vector = Vector(Variable(unit="m/s2", doc="acceleration, in the world frame"))

    def equations(self) -> Equations:
        yield from super().equations()
        R = self.frame_a.R
        yield potential_root(R, 10000)
        # as a root it is held parallel to the world, and the torque is what that takes
        yield choose(is_root(R), [defining(R.T == IDENTITY), R.w == ZEROS], [self.frame_a.t == ZEROS])
        yield self.r_0 == self.frame_a.r_0
        yield self.v_0 == der(self.frame_a.r_0)
        yield self.a_0 == der(self.v_0)
        yield self.frame_a.f == resolve2(R, self.a_0 - self.world.gravity(self.frame_a.r_0)) * self.m
