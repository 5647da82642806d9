"""One-dimensional drives on moving parts."""

from __future__ import annotations

from acausal import Component, Equations, Parameter, Variable, Vector, cross, der, dot, structural

from .. import rotational
from .frames import ZEROS, Frame, unit_vector


class Mounting1D(Component):
    """Support of a rotational drive on a part: the torque of `flange_b` about `n` acts on frame_a.

    ``flange_b.phi = phi0`` (angles of the drive are counted from the part) and ``t_a = -n flange_b.tau``.

    >>> model = assemble("mount.flange_b - motor.support", "motor.flange - rotor.flange_a",
    ...                  "mount.frame_a - ship.frame_a", world=ac.inner(World(gravityType="NoGravity")),
    ...                  mount=Mounting1D(n=(1.0, 0.0, 0.0)),
    ...                  motor=ConstantTorque(tau_constant=6.0, useSupport=True), rotor=Inertia(J=1.0),
    ...                  ship=Body(I_11=3.0))
    >>> close(run(model, at=[1.0])["ship.w_a[1]"], [-2.0])  # the reaction turns the ship
    True

    Source: Modelica.Mechanics.MultiBody.Parts.Mounting1D.
    """

    frame_a: Frame = Frame()
    flange_b: rotational.Flange = rotational.Flange()
    phi0: Parameter = Parameter(0.0, unit="rad", doc="angle of the support")
    n: Vector = Vector(Parameter(unit="1", evaluate=True, doc="axis, resolved in frame_a"), (1.0, 0.0, 0.0))

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange_b.phi == self.phi0
        yield self.frame_a.f == ZEROS
        yield self.frame_a.t == -unit_vector(self.n) * self.flange_b.tau


class Rotor1D(Component):
    """Rotor of a rotational drive on a part that moves in space: its gyroscopic torque acts on frame_a.

    `phi` is the angle against the part, ``w = dphi/dt``. With `w_a`, `z_a` of frame_a: ``J (a + n.z_a) = flange_a.tau +
    flange_b.tau`` (without ``n.z_a`` unless `exact`), and ``t_a = w_a x n J w - n J (n.z_a)``. The part carries the
    rotor's mass, and its inertia at rest.

    >>> model = assemble("world.frame_b - hinge.frame_a", "hinge.frame_b - ship.frame_a",
    ...                  "rotor.frame_a - ship.frame_a", world=ac.inner(World(gravityType="NoGravity")),
    ...                  ship=Body(I_33=2.0),
    ...                  hinge=Revolute(n=(0.0, 0.0, 1.0), w=start(3.0, fixed=True)),
    ...                  rotor=Rotor1D(J=0.5, n=(1.0, 0.0, 0.0), w=start(10.0, fixed=True)))
    >>> close(run(model, at=[0.0])["rotor.frame_a.t[2]"], [15.0])  # 3*0.5*10 about y
    True

    Source: Modelica.Mechanics.MultiBody.Parts.Rotor1D.
    """

    exact: bool = True
    stateSelect: str = "default"
    frame_a: Frame = Frame()
    flange_a: rotational.Flange = rotational.Flange()
    flange_b: rotational.Flange = rotational.Flange()
    J: Parameter = Parameter(1.0, unit="kg*m2", min=0.0, doc="moment of inertia about the axis")
    n: Vector = Vector(Parameter(unit="1", evaluate=True, doc="axis, resolved in frame_a"), (1.0, 0.0, 0.0))
    phi: Variable = Variable(unit="rad", state_select=structural("stateSelect"), doc="angle against frame_a")
    w: Variable = Variable(unit="rad/s", state_select=structural("stateSelect"), doc="angular velocity, dphi/dt")
    a: Variable = Variable(unit="rad/s2", doc="angular acceleration, dw/dt")

    def equations(self) -> Equations:
        yield from super().equations()
        e, w_a = unit_vector(self.n), self.frame_a.R.w
        along = self.J * dot(e, der(w_a))
        yield self.phi == self.flange_a.phi
        yield self.phi == self.flange_b.phi
        yield self.w == der(self.phi)
        yield self.a == der(self.w)
        yield self.J * self.a + (along if self.exact else 0.0) == self.flange_a.tau + self.flange_b.tau
        yield self.frame_a.f == ZEROS
        yield self.frame_a.t == cross(w_a, e) * (self.J * self.w) - e * along
