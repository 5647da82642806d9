"""Joints."""

from __future__ import annotations

from acausal import Equations, Parameter, Variable, Vector, branch, choose, conditional, der, dot, rooted

from .. import rotational
from .frames import absolute_rotation, equal, inverse_rotation, planar_rotation, resolve1, unit_vector
from .parts import PartialTwoFrames


class Revolute(PartialTwoFrames):
    """Hinge: frame b turns by `phi` about the axis `n` fixed in both frames, driven at `axis` where there is one.

    ``T_b = R(n, phi) T_a``; the torque about the axis is ``tau = -n.t_b``, zero without `axis`. `phi` and ``w =
    dphi/dt`` are preferred as states.

    >>> joint = Revolute(n=(0.0, 0.0, 1.0), phi=start(-1.5, fixed=True), w=start(0.0, fixed=True))
    >>> model = assemble("world.frame_b - joint.frame_a", "joint.frame_b - bob.frame_a", joint=joint,
    ...                  world=ac.inner(World(g=10.0)), bob=Body(m=2.0, r_CM=(1.0, 0.0, 0.0), I_33=0.0))
    >>> solution = run(model, at=[0.0])
    >>> close(solution["joint.a"], [-10.0 * np.cos(-1.5)])  # a pendulum of length 1 m
    True

    Source: Modelica.Mechanics.MultiBody.Joints.Revolute.
    """

    useAxisFlange: bool = False
    axis: rotational.Flange = conditional(rotational.Flange(), "useAxisFlange")
    support: rotational.Flange = conditional(rotational.Flange(), "useAxisFlange")
    n: Vector = Vector(
        Parameter(unit="1", evaluate=True, doc="axis of rotation, resolved in frame_a (and in frame_b)"),
        (0.0, 0.0, 1.0),
    )
    phi: Variable = Variable(unit="rad", state_select="prefer", doc="angle of frame_b against frame_a")
    w: Variable = Variable(unit="rad/s", state_select="prefer", doc="angular velocity, dphi/dt")
    a: Variable = Variable(unit="rad/s2", doc="angular acceleration, dw/dt")
    tau: Variable = Variable(unit="N*m", doc="driving torque about the axis")

    def equations(self) -> Equations:
        yield from super().equations()
        a, b = self.frame_a, self.frame_b
        e = unit_vector(self.n)
        R_rel = planar_rotation(e, self.phi, self.w)
        back = inverse_rotation(R_rel)
        yield branch(a.R, b.R)
        yield self.w == der(self.phi)
        yield self.a == der(self.w)
        yield b.r_0 == a.r_0
        yield choose(
            rooted(a.R),
            [*equal(b.R, absolute_rotation(a.R, R_rel)), a.f == -resolve1(R_rel, b.f), a.t == -resolve1(R_rel, b.t)],
            [*equal(a.R, absolute_rotation(b.R, back)), b.f == -resolve1(back, a.f), b.t == -resolve1(back, a.t)],
        )
        yield self.tau == -dot(b.t, e)
        if self.useAxisFlange:
            yield self.axis.phi == self.phi
            yield self.axis.tau == self.tau
            yield self.support.phi == 0
        else:
            yield self.tau == 0
