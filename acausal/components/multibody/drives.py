"""One-dimensional drives on moving parts."""

from __future__ import annotations

from typing import ClassVar

from acausal import Equations, Parameter, Variable, Vector, connect, cross, der, dot, structural

from .. import rotational
from .frames import ZEROS, Frame, unit_vector
from .joints import Revolute
from .parts import FixedTranslation, PartialTwoFrames
from .world import Grounded


class PartialMounted(Grounded, partial=True):
    """Something one-dimensional on a part at frame_a, on which it acts with a torque alone.

    Source: the model Housing in Modelica.Mechanics.MultiBody.Parts.Mounting1D and BevelGear1D.
    """

    frame_a: Frame = Frame()

    def torque(self) -> Vector:
        """The cut torque at frame_a, where drive trains act on their parts."""
        raise NotImplementedError

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.frame_a.f == ZEROS
        yield self.frame_a.t == (self.torque() if self.world.driveTrainMechanics3D else ZEROS)


class Mounting1D(PartialMounted):
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

    flange_b: rotational.Flange = rotational.Flange()
    phi0: Parameter = Parameter(0.0, unit="rad", doc="angle of the support")
    n: Vector = Vector(Parameter(unit="1", evaluate=True, doc="axis, resolved in frame_a"), (1.0, 0.0, 0.0))

    def torque(self) -> Vector:
        return -unit_vector(self.n) * self.flange_b.tau

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange_b.phi == self.phi0


class Rotor1D(PartialMounted):
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
    flange_a: rotational.Flange = rotational.Flange()
    flange_b: rotational.Flange = rotational.Flange()
    J: Parameter = Parameter(1.0, unit="kg*m2", min=0.0, doc="moment of inertia about the axis")
    n: Vector = Vector(Parameter(unit="1", evaluate=True, doc="axis, resolved in frame_a"), (1.0, 0.0, 0.0))
    phi: Variable = Variable(unit="rad", state_select=structural("stateSelect"), doc="angle against frame_a")
    w: Variable = Variable(unit="rad/s", state_select=structural("stateSelect"), doc="angular velocity, dphi/dt")
    a: Variable = Variable(unit="rad/s2", doc="angular acceleration, dw/dt")

    def torque(self) -> Vector:
        e, w_a = unit_vector(self.n), self.frame_a.R.w
        return cross(w_a, e) * (self.J * self.w) - e * (self.J * dot(e, der(w_a)))

    def equations(self) -> Equations:
        yield from super().equations()
        carried = self.exact and self.world.driveTrainMechanics3D
        along = self.J * dot(unit_vector(self.n), der(self.frame_a.R.w)) if carried else 0.0
        yield self.phi == self.flange_a.phi
        yield self.phi == self.flange_b.phi
        yield self.w == der(self.phi)
        yield self.a == der(self.w)
        yield self.J * self.a + along == self.flange_a.tau + self.flange_b.tau


class BevelGear1D(PartialMounted):
    """Gearbox between shafts in the directions `n_a` and `n_b`, on a part that takes up what is left of the torques.

    ``phi_a = ratio phi_b``, ``0 = ratio tau_a + tau_b``; ``t_a = -n_a tau_a - n_b tau_b``, resolved in frame_a.

    >>> model = assemble("motor.flange - gear.flange_a", "gear.flange_b - rotor.flange_a",
    ...                  "gear.frame_a - ship.frame_a", world=ac.inner(World(gravityType="NoGravity")),
    ...                  rotor=Inertia(J=2.0),
    ...                  motor=ConstantTorque(tau_constant=3.0), ship=Body(I_11=3.0, I_22=6.0),
    ...                  gear=BevelGear1D(ratio=4.0, n_a=(1.0, 0.0, 0.0), n_b=(0.0, 1.0, 0.0)))
    >>> solution = run(model, at=[0.0])
    >>> close(solution["rotor.a"], [6.0]), close(solution["ship.z_a[1]"], [1.0]), close(solution["ship.z_a[2]"], [-2.0])
    (True, True, True)

    Source: Modelica.Mechanics.MultiBody.Parts.BevelGear1D.
    """

    flange_a: rotational.Flange = rotational.Flange()
    flange_b: rotational.Flange = rotational.Flange()
    ratio: Parameter = Parameter(1.0, unit="1", doc="speed of flange_a over that of flange_b")
    n_a: Vector = Vector(
        Parameter(unit="1", evaluate=True, doc="axis of the shaft at flange_a, resolved in frame_a"), (1.0, 0.0, 0.0)
    )
    n_b: Vector = Vector(
        Parameter(unit="1", evaluate=True, doc="axis of the shaft at flange_b, resolved in frame_a"), (1.0, 0.0, 0.0)
    )

    def torque(self) -> Vector:
        return -unit_vector(self.n_a) * self.flange_a.tau - unit_vector(self.n_b) * self.flange_b.tau

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange_a.phi == self.ratio * self.flange_b.phi
        yield self.ratio * self.flange_a.tau + self.flange_b.tau == 0


class GearConstraint(PartialTwoFrames):
    """Gearbox of two shafts in a housing that moves in space: hinges about `n_a` and `n_b`, and a gear between them.

    frame_a turns against `bearing` about `n_a` at `r_a`, frame_b about `n_b` at `r_b` (all resolved in `bearing`);
    ``phi_a = ratio phi_b``. The housing takes up what is left of the torques.

    >>> model = assemble("world.frame_b - gear.bearing", "gear.frame_a - first.frame_a",
    ...                  "gear.frame_b - second.frame_a", world=ac.inner(World(gravityType="NoGravity")),
    ...                  second=Body(I_11=5.0), first=Body(I_11=0.5),
    ...                  gear=GearConstraint(ratio=2.0, phi_b=start(0.0, fixed=True), w_b=start(3.0, fixed=True)))
    >>> solution = run(model, at=[1.0])
    >>> close(solution["gear.phi_b"], [3.0]), close(solution["first.w_a[1]"], [6.0])
    (True, True)

    Source: Modelica.Mechanics.MultiBody.Joints.GearConstraint.
    """

    _must_connect: ClassVar[tuple[str, ...]] = ("frame_a", "frame_b", "bearing")
    stateSelect: str = "default"
    bearing: Frame = Frame()
    ratio: Parameter = Parameter(2.0, unit="1", doc="speed of the shaft at frame_a over that at frame_b")
    n_a: Vector = Vector(
        Parameter(unit="1", evaluate=True, doc="axis at frame_a, resolved in bearing and frame_a"), (1.0, 0.0, 0.0)
    )
    n_b: Vector = Vector(
        Parameter(unit="1", evaluate=True, doc="axis at frame_b, resolved in bearing and frame_b"), (1.0, 0.0, 0.0)
    )
    r_a: Vector = Vector(Parameter(unit="m", doc="from bearing to frame_a, resolved in bearing"), ZEROS)
    r_b: Vector = Vector(Parameter(unit="m", doc="from bearing to frame_b, resolved in bearing"), ZEROS)
    phi_b: Variable = Variable(unit="rad", state_select=structural("stateSelect"), doc="angle of the shaft at frame_b")
    w_b: Variable = Variable(unit="rad/s", state_select=structural("stateSelect"), doc="angular velocity, dphi_b/dt")
    a_b: Variable = Variable(unit="rad/s2", doc="angular acceleration, dw_b/dt")
    actuatedRevolute_a: Revolute = Revolute(n=n_a, useAxisFlange=True, stateSelect="never")
    actuatedRevolute_b: Revolute = Revolute(n=n_b, useAxisFlange=True, stateSelect="avoid")
    fixedTranslation1: FixedTranslation = FixedTranslation(r=r_b)
    fixedTranslation2: FixedTranslation = FixedTranslation(r=r_a)
    idealGear: rotational.IdealGear = rotational.IdealGear(ratio=ratio)

    def equations(self) -> Equations:
        yield from super().equations()
        a, b = self.actuatedRevolute_a, self.actuatedRevolute_b
        yield self.phi_b == b.phi
        yield self.w_b == der(self.phi_b)
        yield self.a_b == der(self.w_b)
        yield connect(a.axis, self.idealGear.flange_a)
        yield connect(b.axis, self.idealGear.flange_b)
        yield connect(self.bearing, self.fixedTranslation1.frame_a, self.fixedTranslation2.frame_a)
        yield connect(self.fixedTranslation2.frame_b, a.frame_a)
        yield connect(self.fixedTranslation1.frame_b, b.frame_a)
        yield connect(a.frame_b, self.frame_a)
        yield connect(b.frame_b, self.frame_b)
