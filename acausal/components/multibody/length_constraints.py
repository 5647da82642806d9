"""Joints whose coordinate follows, in closed form, from the length of a rod that hangs on them."""

from __future__ import annotations

from acausal import (
    Equations,
    Expr,
    Input,
    Parameter,
    Variable,
    Vector,
    atan2,
    branch,
    cross,
    der,
    dot,
    noevent,
    sqrt,
    where,
)

from .. import rotational, translational
from .frames import ZEROS, equal, planar_rotation, resolve1, unit_vector
from .parts import DEGREE, PartialTwoFrames, turned

DEAD_CENTRE = 1e-7
"""Share of the squares at which both ways to close a loop count as one: within 0.02 degrees."""


def open_root(difference: Expr, size: Expr) -> Expr:
    """Root of a `difference` of squares of this `size`; not a number where it is none, or the loop at a dead centre.

    There both ways to close the loop meet, and the velocity of the joint no longer follows from those outside: these
    vanish. To rest there would be a solution, which no mechanism follows.
    """
    return sqrt(noevent(where(difference > DEAD_CENTRE * size, difference, -1.0)))


class PartialLengthConstraint(PartialTwoFrames, partial=True):
    """One coordinate, for which ``|r_a - r_b(coordinate)| = length`` has two roots.

    `position_a` is one end of the rod, resolved in frame_a; `position_b` the other, resolved in frame_b. Which root it
    is, the start decides: the one that is nearer to the guess. It then stays on this branch.

    Source: the common part of Modelica.Mechanics.MultiBody.Joints.Internal.RevoluteWithLengthConstraint and
    PrismaticWithLengthConstraint.
    """

    position_a: Vector = Vector(Input(unit="m", doc="end of the rod at the side of frame_a, resolved in frame_a"))
    position_b: Vector = Vector(Input(unit="m", doc="end of the rod at the side of frame_b, resolved in frame_b"))
    length: Variable = Input(unit="m", doc="length of the rod")
    positiveBranch: Variable = Variable(unit="1", start=1.0, doc="which root it is: 1 or -1; constant")

    def root(self, sign: Expr | float) -> Expr:
        """The coordinate on the branch of the given sign."""
        raise NotImplementedError

    def coordinate(self) -> tuple[Expr, Expr]:
        """What the root is that of, and its guess."""
        raise NotImplementedError

    def equations(self) -> Equations:
        yield from super().equations()
        yield branch(self.frame_a.R, self.frame_b.R)
        yield der(self.positiveBranch) == 0
        yield self.coordinate()[0] == self.root(self.positiveBranch)

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        first, second = (abs(self.root(sign) - self.coordinate()[1]) for sign in (1.0, -1.0))
        yield self.positiveBranch == noevent(where(first <= second, 1.0, -1.0))


class RevoluteWithLengthConstraint(PartialLengthConstraint):
    """Hinge whose angle follows from the length of a rod.

    With `e` the axis and ``A = -2 (r_b.r_a - e.r_b e.r_a)``, ``B = 2 r_b.(e x r_a)``, ``C = r_a.r_a + r_b.r_b - L^2 - 2
    e.r_b e.r_a``, the length of the rod is L where ``A cos(angle) + B sin(angle) + C = 0``: ``angle = atan2(-B C -+
    A k, -A C +- B k)`` with ``k = sqrt(A^2 + B^2 - C^2)``. ``angle = phi + phi_offset`` (which is in degrees).

    Source: Modelica.Mechanics.MultiBody.Joints.Internal.RevoluteWithLengthConstraint.
    """

    axis: rotational.Flange = rotational.Flange()
    bearing: rotational.Flange = rotational.Flange()
    n: Vector = Vector(
        Parameter(unit="1", evaluate=True, doc="axis of rotation, resolved in frame_a (and in frame_b)"),
        (0.0, 0.0, 1.0),
    )
    phi_offset: Parameter = Parameter(0.0, doc="angle = phi + phi_offset [deg]")
    phi_guess: Parameter = Parameter(0.0, doc="phi at the start is the root that is nearer to this [deg]")
    phi: Variable = Variable(unit="rad", state_select="avoid", doc="angle, less phi_offset")
    angle: Variable = Variable(unit="rad", state_select="avoid", doc="angle of frame_b against frame_a")
    w: Variable = Variable(unit="rad/s", state_select="avoid", doc="angular velocity, dphi/dt")
    tau: Variable = Variable(unit="N*m", doc="driving torque about the axis")

    def coordinate(self) -> tuple[Expr, Expr]:
        return self.angle, (self.phi_offset + self.phi_guess) * DEGREE

    def root(self, sign: Expr | float) -> Expr:
        e, r_a, r_b = unit_vector(self.n), self.position_a, self.position_b
        along = dot(e, r_b) * dot(e, r_a)
        A, B = (dot(r_b, r_a) - along) * -2, dot(r_b, cross(e, r_a)) * 2
        C = dot(r_a, r_a) + dot(r_b, r_b) - self.length**2 - 2 * along
        k = open_root(A * A + B * B - C * C, A * A + B * B) * sign
        return atan2(-B * C - A * k, -A * C + B * k)

    def equations(self) -> Equations:
        yield from super().equations()
        a, b, e = self.frame_a, self.frame_b, unit_vector(self.n)
        yield self.angle == self.phi + self.phi_offset * DEGREE
        yield self.w == der(self.phi)
        yield b.r_0 == a.r_0
        yield turned(a, b, planar_rotation(e, self.angle, self.w))
        yield self.tau == -dot(b.t, e)
        yield self.axis.phi == self.phi
        yield self.axis.tau == self.tau
        yield self.bearing.phi == 0


class PrismaticWithLengthConstraint(PartialLengthConstraint):
    """Slider whose distance follows from the length of a rod.

    With `e` the axis, ``d = -e.(r_b - r_a) +- sqrt((e.(r_b - r_a))^2 - |r_b - r_a|^2 + L^2)``; ``d = s + s_offset``.

    Source: Modelica.Mechanics.MultiBody.Joints.Internal.PrismaticWithLengthConstraint.
    """

    axis: translational.Flange = translational.Flange()
    bearing: translational.Flange = translational.Flange()
    n: Vector = Vector(
        Parameter(unit="1", evaluate=True, doc="axis of translation, resolved in frame_a (and in frame_b)"),
        (1.0, 0.0, 0.0),
    )
    s_offset: Parameter = Parameter(0.0, unit="m", doc="distance = s + s_offset")
    s_guess: Parameter = Parameter(0.0, unit="m", doc="s at the start is the root that is nearer to this")
    s: Variable = Variable(unit="m", state_select="avoid", doc="distance, less s_offset")
    distance: Variable = Variable(unit="m", state_select="avoid", doc="distance of frame_b from frame_a")
    f: Variable = Variable(unit="N", doc="driving force along the axis")

    def coordinate(self) -> tuple[Expr, Expr]:
        return self.distance, self.s_offset + self.s_guess

    def root(self, sign: Expr | float) -> Expr:
        r = self.position_b - self.position_a
        along = dot(unit_vector(self.n), r)
        return open_root(along * along - dot(r, r) + self.length**2, self.length**2) * sign - along

    def equations(self) -> Equations:
        yield from super().equations()
        a, b, e = self.frame_a, self.frame_b, unit_vector(self.n)
        yield self.distance == self.s + self.s_offset
        yield b.r_0 == a.r_0 + resolve1(a.R, e) * self.distance
        yield from equal(b.R, a.R)
        yield a.f + b.f == ZEROS
        yield a.t + b.t + cross(e, b.f) * self.distance == ZEROS
        yield self.f == -dot(b.f, e)
        yield self.axis.s == self.s
        yield self.axis.f == self.f
        yield self.bearing.s == 0
