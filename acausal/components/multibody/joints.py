"""Joints with axes: what they let move are their states, where the tree of the mechanism leads through them."""

from __future__ import annotations

from acausal import Equations, Parameter, Variable, Vector, branch, conditional, connect, cross, der, dot, structural

from .. import rotational, translational
from .frames import ZEROS, equal, planar_rotation, resolve1, unit_vector
from .parts import PartialTwoFrames, turned


class Revolute(PartialTwoFrames):
    """Hinge: frame b turns by `phi` about the axis `n` fixed in both frames, driven at `axis` where there is one.

    ``T_b = R(n, phi) T_a``; the torque about the axis is ``tau = -n.t_b``, zero without `axis`. `phi` and ``w =
    dphi/dt`` are wanted as states as `stateSelect` says.

    >>> joint = Revolute(n=(0.0, 0.0, 1.0), phi=start(-1.5, fixed=True), w=start(0.0, fixed=True))
    >>> model = assemble("world.frame_b - joint.frame_a", "joint.frame_b - bob.frame_a", joint=joint,
    ...                  world=ac.inner(World(g=10.0)), bob=Body(m=2.0, r_CM=(1.0, 0.0, 0.0), I_33=0.0))
    >>> solution = run(model, at=[0.0])
    >>> close(solution["joint.a"], [-10.0 * np.cos(-1.5)])  # a pendulum of length 1 m
    True

    Source: Modelica.Mechanics.MultiBody.Joints.Revolute.
    """

    useAxisFlange: bool = False
    stateSelect: str = "prefer"
    axis: rotational.Flange = conditional(rotational.Flange(), "useAxisFlange")
    support: rotational.Flange = conditional(rotational.Flange(), "useAxisFlange")
    n: Vector = Vector(
        Parameter(unit="1", evaluate=True, doc="axis of rotation, resolved in frame_a (and in frame_b)"),
        (0.0, 0.0, 1.0),
    )
    phi: Variable = Variable(
        unit="rad", state_select=structural("stateSelect"), doc="angle of frame_b against frame_a"
    )
    w: Variable = Variable(unit="rad/s", state_select=structural("stateSelect"), doc="angular velocity, dphi/dt")
    a: Variable = Variable(unit="rad/s2", doc="angular acceleration, dw/dt")
    tau: Variable = Variable(unit="N*m", doc="driving torque about the axis")
    angle: Variable = Variable(unit="rad", doc="phi")

    def equations(self) -> Equations:
        yield from super().equations()
        a, b = self.frame_a, self.frame_b
        e = unit_vector(self.n)
        yield branch(a.R, b.R)
        yield self.angle == self.phi
        yield self.w == der(self.phi)
        yield self.a == der(self.w)
        yield b.r_0 == a.r_0
        yield turned(a, b, planar_rotation(e, self.phi, self.w))
        yield self.tau == -dot(b.t, e)
        if self.useAxisFlange:
            yield self.axis.phi == self.phi
            yield self.axis.tau == self.tau
            yield self.support.phi == 0
        else:
            yield self.tau == 0


class Prismatic(PartialTwoFrames):
    """Slider: frame b moves by `s` along the axis `n` fixed in both frames, driven at `axis` where there is one.

    ``r_b = r_a + T' n s``; the force along the axis is ``f = -n.f_b``, zero without `axis`. `s` and ``v = ds/dt`` are
    wanted as states as `stateSelect` says.

    >>> joint = Prismatic(n=(0.0, 1.0, 0.0), s=start(5.0, fixed=True), v=start(0.0, fixed=True))
    >>> model = assemble("world.frame_b - joint.frame_a", "joint.frame_b - load.frame_a", joint=joint,
    ...                  world=ac.inner(World(g=10.0)), load=Body(m=2.0))
    >>> close(run(model, at=[0.5, 1.0])["joint.s"], [3.75, 0.0])
    True

    Source: Modelica.Mechanics.MultiBody.Joints.Prismatic.
    """

    useAxisFlange: bool = False
    stateSelect: str = "prefer"
    axis: translational.Flange = conditional(translational.Flange(), "useAxisFlange")
    support: translational.Flange = conditional(translational.Flange(), "useAxisFlange")
    n: Vector = Vector(
        Parameter(unit="1", evaluate=True, doc="axis of translation, resolved in frame_a (and in frame_b)"),
        (1.0, 0.0, 0.0),
    )
    s: Variable = Variable(unit="m", state_select=structural("stateSelect"), doc="distance of frame_b from frame_a")
    v: Variable = Variable(unit="m/s", state_select=structural("stateSelect"), doc="velocity, ds/dt")
    a: Variable = Variable(unit="m/s2", doc="acceleration, dv/dt")
    f: Variable = Variable(unit="N", doc="driving force along the axis")

    def equations(self) -> Equations:
        yield from super().equations()
        a, b = self.frame_a, self.frame_b
        e = unit_vector(self.n)
        yield branch(a.R, b.R)
        yield self.v == der(self.s)
        yield self.a == der(self.v)
        yield b.r_0 == a.r_0 + resolve1(a.R, e) * self.s
        yield from equal(b.R, a.R)
        yield a.f + b.f == ZEROS
        yield a.t + b.t + cross(e, b.f) * self.s == ZEROS
        yield self.f == -dot(b.f, e)
        if self.useAxisFlange:
            yield self.axis.s == self.s
            yield self.axis.f == self.f
            yield self.support.s == 0
        else:
            yield self.f == 0


class Cylindrical(PartialTwoFrames):
    """Frame b moves along the axis `n` and turns about it: `prismatic` and `revolute` one after the other.

    >>> model = assemble("world.frame_b - joint.frame_a", "joint.frame_b - load.frame_a", load=Body(m=2.0),
    ...                  world=ac.inner(World(g=10.0)),
    ...                  joint=Cylindrical(n=(0.0, 1.0, 0.0), w=start(3.0, fixed=True), s=start(0.0, fixed=True)))
    >>> solution = run(model, at=[1.0])
    >>> close(solution["joint.s"], [-5.0]), close(solution["joint.phi"], [3.0])
    (True, True)

    Source: Modelica.Mechanics.MultiBody.Joints.Cylindrical.
    """

    stateSelect: str = "prefer"
    n: Vector = Vector(Parameter(unit="1", evaluate=True, doc="axis, resolved in frame_a"), (1.0, 0.0, 0.0))
    prismatic: Prismatic = Prismatic(n=n, stateSelect=structural("stateSelect"))
    revolute: Revolute = Revolute(n=n, stateSelect=structural("stateSelect"))
    s: Variable = Variable(unit="m", doc="distance of frame_b from frame_a along the axis")
    phi: Variable = Variable(unit="rad", doc="angle of frame_b against frame_a")
    v: Variable = Variable(unit="m/s", doc="velocity, ds/dt")
    w: Variable = Variable(unit="rad/s", doc="angular velocity, dphi/dt")
    a: Variable = Variable(unit="m/s2", doc="acceleration, dv/dt")
    wd: Variable = Variable(unit="rad/s2", doc="angular acceleration, dw/dt")

    def equations(self) -> Equations:
        yield from super().equations()
        p, r = self.prismatic, self.revolute
        yield connect(self.frame_a, p.frame_a)
        yield connect(p.frame_b, r.frame_a)
        yield connect(r.frame_b, self.frame_b)
        yield from (self.s == p.s, self.v == p.v, self.a == p.a)
        yield from (self.phi == r.phi, self.w == r.w, self.wd == r.a)


class Universal(PartialTwoFrames):
    """Two hinges one after the other, about `n_a` and then about `n_b`.

    >>> model = assemble("world.frame_b - joint.frame_a", "joint.frame_b - bob.frame_a",
    ...                  world=ac.inner(World(g=10.0)), bob=Body(r_CM=(0.0, -1.0, 0.0)),
    ...                  joint=Universal(n_a=(1.0, 0.0, 0.0), n_b=(0.0, 0.0, 1.0), phi_a=start(0.2, fixed=True),
    ...                                  phi_b=start(0.0, fixed=True)))
    >>> solution = run(model, at=[0.0])
    >>> close(solution["joint.a_a"], [-10.0 * np.sin(0.2) / 1.001]), close(solution["joint.a_b"], [0.0])
    (True, True)

    Source: Modelica.Mechanics.MultiBody.Joints.Universal.
    """

    stateSelect: str = "prefer"
    n_a: Vector = Vector(Parameter(unit="1", evaluate=True, doc="first axis, in frame_a"), (1.0, 0.0, 0.0))
    n_b: Vector = Vector(Parameter(unit="1", evaluate=True, doc="second axis, in frame_b"), (0.0, 1.0, 0.0))
    revolute_a: Revolute = Revolute(n=n_a, stateSelect=structural("stateSelect"))
    revolute_b: Revolute = Revolute(n=n_b, stateSelect=structural("stateSelect"))
    phi_a: Variable = Variable(unit="rad", doc="angle about the first axis")
    phi_b: Variable = Variable(unit="rad", doc="angle about the second axis")
    w_a: Variable = Variable(unit="rad/s", doc="angular velocity about the first axis")
    w_b: Variable = Variable(unit="rad/s", doc="angular velocity about the second axis")
    a_a: Variable = Variable(unit="rad/s2", doc="angular acceleration about the first axis")
    a_b: Variable = Variable(unit="rad/s2", doc="angular acceleration about the second axis")

    def equations(self) -> Equations:
        yield from super().equations()
        first, second = self.revolute_a, self.revolute_b
        yield connect(self.frame_a, first.frame_a)
        yield connect(first.frame_b, second.frame_a)
        yield connect(second.frame_b, self.frame_b)
        yield from (self.phi_a == first.phi, self.w_a == first.w, self.a_a == first.a)
        yield from (self.phi_b == second.phi, self.w_b == second.w, self.a_b == second.a)


class Planar(PartialTwoFrames):
    """Frame b moves in the plane across the axis `n` of frame a and turns about it.

    >>> model = assemble("world.frame_b - joint.frame_a", "joint.frame_b - puck.frame_a", puck=Body(m=2.0),
    ...                  world=ac.inner(World(g=10.0)),
    ...                  joint=Planar(s_x=start(0.0, fixed=True), v_x=start(1.0, fixed=True),
    ...                               s_y=start(5.0, fixed=True), w=start(2.0, fixed=True)))
    >>> solution = run(model, at=[1.0])
    >>> close(solution["joint.s_x"], [1.0]), close(solution["joint.s_y"], [0.0]), close(solution["joint.phi"], [2.0])
    (True, True, True)

    Source: Modelica.Mechanics.MultiBody.Joints.Planar.
    """

    stateSelect: str = "prefer"
    n: Vector = Vector(Parameter(unit="1", evaluate=True, doc="axis across the plane, in frame_a"), (0.0, 0.0, 1.0))
    n_x: Vector = Vector(
        Parameter(unit="1", evaluate=True, doc="in the plane, direction of the first translation"), (1.0, 0.0, 0.0)
    )
    prismatic_x: Prismatic = Prismatic(n=cross(cross(n, n_x), n), stateSelect=structural("stateSelect"))
    prismatic_y: Prismatic = Prismatic(n=cross(n, n_x), stateSelect=structural("stateSelect"))
    revolute: Revolute = Revolute(n=n, stateSelect=structural("stateSelect"))
    s_x: Variable = Variable(unit="m", doc="distance along n_x")
    s_y: Variable = Variable(unit="m", doc="distance across n_x")
    phi: Variable = Variable(unit="rad", doc="angle about n")
    v_x: Variable = Variable(unit="m/s", doc="velocity, ds_x/dt")
    v_y: Variable = Variable(unit="m/s", doc="velocity, ds_y/dt")
    w: Variable = Variable(unit="rad/s", doc="angular velocity, dphi/dt")
    a_x: Variable = Variable(unit="m/s2", doc="acceleration, dv_x/dt")
    a_y: Variable = Variable(unit="m/s2", doc="acceleration, dv_y/dt")
    wd: Variable = Variable(unit="rad/s2", doc="angular acceleration, dw/dt")

    def equations(self) -> Equations:
        yield from super().equations()
        x, y, r = self.prismatic_x, self.prismatic_y, self.revolute
        yield connect(self.frame_a, x.frame_a)
        yield connect(x.frame_b, y.frame_a)
        yield connect(y.frame_b, r.frame_a)
        yield connect(r.frame_b, self.frame_b)
        yield from (self.s_x == x.s, self.v_x == x.v, self.a_x == x.a)
        yield from (self.s_y == y.s, self.v_y == y.v, self.a_y == y.a)
        yield from (self.phi == r.phi, self.w == r.w, self.wd == r.a)
