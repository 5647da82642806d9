"""Wheels without mass: those that do not slip, and those that slip as the friction of their tyres lets them."""

from __future__ import annotations

from acausal import (
    Component,
    Equations,
    Expr,
    Input,
    Parameter,
    Variable,
    Vector,
    abs,
    clip,
    der,
    dot,
    noevent,
    norm,
    sqrt,
    structural,
)
from acausal import max as maximum

from .. import rotational, thermal
from .interfaces import Frame, resolve1


class PartialRolling(Component, partial=True):
    """A wheel in the plane on the x axis: its hub, the frame, is at ``y = R``.

    Source: the common part of PlanarMechanics.Joints.IdealRolling and DryFrictionBasedRolling.
    """

    stateSelect: str = "default"
    frame_a: Frame = Frame()
    R: Parameter = Parameter(1.0, unit="m", min=1e-30, doc="radius")
    x: Variable = Variable(unit="m", state_select=structural("stateSelect"), doc="position of the hub")
    vx: Variable = Variable(unit="m/s", doc="velocity of the hub")
    phi: Variable = Variable(unit="rad", state_select=structural("stateSelect"), doc="angle of the wheel")
    w: Variable = Variable(unit="rad/s", state_select=structural("stateSelect"), doc="its angular velocity")
    z: Variable = Variable(unit="rad/s2", doc="its angular acceleration")

    def equations(self) -> Equations:
        yield from super().equations()
        frame = self.frame_a
        yield self.x == frame.x
        yield self.phi == frame.phi
        yield self.vx == der(self.x)
        yield self.w == der(self.phi)
        yield self.z == der(self.w)
        yield frame.y == self.R
        yield frame.t == self.R * frame.fx


class IdealRolling(PartialRolling):
    """A wheel in the plane rolls on the x axis: its hub, the frame, is at ``y = R``, and ``dx/dt = -R dphi/dt``.

    The ground holds it with whatever force that takes, in x by friction and in y either way.

    >>> model = assemble("wheel.frame_a - disc.frame_a", planarWorld=ac.inner(PlanarWorld(constantGravity=(3.0, 0.0))),
    ...                  wheel=IdealRolling(R=0.5), disc=Body(m=2.0, I=0.25, phi=start(0.0, fixed=True),
    ...                  w=start(0.0, fixed=True), r=start((0.0, 0.5), fixed=True)))
    >>> close(run(model)["disc.r[1]"][-1], 0.5 * 3.0 * 2.0 / (2.0 + 0.25 / 0.5**2))
    True

    Source: PlanarMechanics.Joints.IdealRolling.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.vx == -self.w * self.R


class PartialWheelJoint(Component, partial=True):
    """A wheel seen from above, on a ground that is the plane, whose direction is `r` in its frame.

    `flange_a` turns it, ``flange_a.tau = -radius f_long``. Subclasses say what the forces are.

    Source: PlanarMechanics.VehicleComponents.Wheels.BaseClasses.WheelBase.
    """

    stateSelect: str = "default"
    frame_a: Frame = Frame()
    flange_a: rotational.Flange = rotational.Flange()
    radius: Parameter = Parameter(0.3, unit="m", min=1e-30, doc="radius of the wheel")
    r: Vector = Vector(
        Parameter(unit="m", doc="driving direction in the frame, of any length but zero"), (1.0, 0.0), size=2
    )
    e0: Vector = Vector(Variable(unit="1", doc="driving direction in the world frame"), size=2)
    v: Vector = Vector(Variable(unit="m/s", doc="velocity"), size=2)
    phi_roll: Variable = Variable(unit="rad", doc="angle of rolling")
    w_roll: Variable = Variable(
        unit="rad/s", state_select=structural("stateSelect"), doc="angular velocity of rolling"
    )
    v_long: Variable = Variable(unit="m/s", doc="velocity along the driving direction")
    v_lat: Variable = Variable(unit="m/s", doc="velocity across it, to the left")
    f_long: Variable = Variable(unit="N", doc="force of the frame on the wheel along the driving direction")
    f_lat: Variable = Variable(unit="N", doc="force of the frame on the wheel across it")

    def equations(self) -> Equations:
        yield from super().equations()
        frame = self.frame_a
        e, v = self.e0, self.v
        yield e == resolve1(frame, self.r / norm(self.r))
        yield v == (der(frame.x), der(frame.y))
        yield self.phi_roll == self.flange_a.phi
        yield self.w_roll == der(self.phi_roll)
        yield self.v_long == dot(v, e)
        yield self.v_lat == v[1] * e[0] - v[0] * e[1]
        yield self.f_long == dot((frame.fx, frame.fy), e)
        yield self.f_lat == frame.fy * e[0] - frame.fx * e[1]
        yield frame.t == 0
        yield self.flange_a.tau == -self.radius * self.f_long


class IdealWheelJoint(PartialWheelJoint):
    """A wheel that rolls along its direction and does not slip: ``v_long = radius w_roll``, ``v_lat = 0``.

    >>> model = assemble("drive.flange - wheel.flange_a", "wheel.frame_a - car.frame_a",
    ...                  drive=rotational.ConstantTorque(tau_constant=1.5),
    ...                  wheel=IdealWheelJoint(radius=0.25, w_roll=start(0.0, fixed=True)),
    ...                  planarWorld=ac.inner(PlanarWorld(constantGravity=(0.0, 0.0))),
    ...                  car=Body(m=3.0, I=1.0, r=start((0.0, 0.0), fixed=True), phi=start(0.5, fixed=True),
    ...                           w=start(0.0, fixed=True)))
    >>> close(run(model)["car.r[1]"][-1], 0.5 * 1.5 / 0.25 / 3.0 * np.cos(0.5))
    True

    Source: PlanarMechanics.VehicleComponents.Wheels.IdealWheelJoint.
    """

    a: Variable = Variable(unit="m/s2", doc="acceleration along the driving direction, of v_long")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v_lat == 0
        yield self.v_long == self.radius * self.w_roll
        yield self.a == der(self.v_long)


def slip_curve(v: Expr, v_adhesion: Expr, v_slide: Expr, most: Expr, sliding: Expr) -> Expr:
    """Friction over slip velocity: in an S to `most` at `v_adhesion`, in another to `sliding` at `v_slide`, and odd.

    Source: PlanarMechanics.Utilities.Functions.limitByStriple.
    """
    rising, beyond = clip(v / v_adhesion, -1.0, 1.0), noevent(abs(v)) - v_adhesion
    falling = clip(beyond / (v_slide - v_adhesion), 0.0, 1.0)
    fallen = falling**2 * (3.0 - 2.0 * falling)
    return noevent(rising * (1.5 - 0.5 * rising**2) * most + rising * fallen * (sliding - most))


class PartialSlippingWheel(thermal.PartialConditionalHeatPort, PartialWheelJoint, partial=True):
    """A wheel whose friction is against its slip, ``v_slip_long = v_long - radius w_roll``, ``v_slip_lat = v_lat``.

    The friction `f` follows from the slip velocity `v_slip` by a curve with a peak (`slip_curve`), and is lost as heat.

    Source: PlanarMechanics.VehicleComponents.Wheels.DryFrictionWheelJoint.
    """

    N: Parameter = Parameter(1000.0, unit="N", min=0.0, doc="normal force")
    mu_A: Parameter = Parameter(0.8, unit="1", min=0.0, doc="friction coefficient at adhesion, the largest")
    mu_S: Parameter = Parameter(0.4, unit="1", min=0.0, doc="friction coefficient of sliding")
    v_least: Parameter = Parameter(1e-4, unit="m/s", min=1e-12, doc="slip velocity that gives no slip a direction")
    v_slip_long: Variable = Variable(unit="m/s", doc="slip velocity along the driving direction")
    v_slip_lat: Variable = Variable(unit="m/s", doc="slip velocity across it")
    v_slip: Variable = Variable(unit="m/s", doc="slip velocity")
    f: Variable = Variable(unit="N", doc="friction")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v_slip_long == self.v_long - self.radius * self.w_roll
        yield self.v_slip_lat == self.v_lat
        yield self.v_slip == sqrt(self.v_slip_long**2 + self.v_slip_lat**2 + self.v_least**2)
        yield self.f_long == self.f * self.v_slip_long / self.v_slip
        yield self.f_lat == self.f * self.v_slip_lat / self.v_slip
        yield self.lossPower == self.f_long * self.v_slip_long + self.f_lat * self.v_slip_lat


class DryFrictionWheelJoint(PartialSlippingWheel):
    """A wheel with dry friction: its peak ``mu_A N`` is at the slip velocity `vAdhesion`, ``mu_S N`` from `vSlide` on.

    >>> model = assemble("wheel.frame_a - car.frame_a", "axle.flange - wheel.flange_a", axle=rotational.Fixed(),
    ...                  wheel=DryFrictionWheelJoint(N=30.0, vAdhesion=0.1, vSlide=0.3),
    ...                  planarWorld=ac.inner(PlanarWorld(constantGravity=(0.0, 0.0))),
    ...                  car=Body(m=3.0, r=start((0.0, 0.0), fixed=True), v=start((8.0, 6.0), fixed=True),
    ...                           phi=start(0.0, fixed=True), w=start(0.0, fixed=True)))
    >>> slides = run(model, at=[0.5, 1.0])  # with 0.4 g, against the motion
    >>> close(slides["car.v[1]"], [0.8 * 8.0, 0.8 * 6.0]) and close(slides["car.v[2]"], [0.6 * 8.0, 0.6 * 6.0])
    True

    Source: PlanarMechanics.VehicleComponents.Wheels.DryFrictionWheelJoint.
    """

    vAdhesion: Parameter = Parameter(0.1, unit="m/s", min=1e-12, doc="slip velocity of the largest friction")
    vSlide: Parameter = Parameter(0.3, unit="m/s", min=1e-12, doc="slip velocity from which on it slides")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.f == self.N * slip_curve(self.v_slip, self.vAdhesion, self.vSlide, self.mu_A, self.mu_S)


class SlipBasedWheelJoint(PartialSlippingWheel):
    """A wheel whose friction depends on its slippage, the slip velocity over that of its rim.

    The peak ``mu_A fN`` is at the slippage `sAdhesion`, ``mu_S fN`` from `sSlide` on; at low speed at the slip
    velocities `vAdhesion_min` and `vSlide_min`. The load is ``fN = max(0, N + dynamicLoad)``.

    >>> model = assemble("none.y - wheel.dynamicLoad", "drive.flange - wheel.flange_a", "wheel.frame_a - car.frame_a",
    ...                  "rim.flange_a - wheel.flange_a", rim=rotational.Inertia(J=0.1), none=blocks.Constant(k=0.0),
    ...                  drive=rotational.ConstantTorque(tau_constant=3.0),
    ...                  wheel=SlipBasedWheelJoint(N=100.0, w_roll=start(0.0, fixed=True)),
    ...                  planarWorld=ac.inner(PlanarWorld(constantGravity=(0.0, 0.0))),
    ...                  car=Body(m=10.0, r=start((0.0, 0.0), fixed=True), v=start((0.0, 0.0), fixed=True),
    ...                           phi=start(0.0, fixed=True), w=start(0.0, fixed=True)))
    >>> drives = run(model, at=[0.0, 5.0])  # with little slip: 3 N m/0.3 m on 10 kg + 0.1 kg m2/(0.3 m)^2
    >>> close(drives["car.v[1]"][-1], 5.0 * 10.0 / (10.0 + 0.1 / 0.09), 5e-3)
    True

    Source: PlanarMechanics.VehicleComponents.Wheels.SlipBasedWheelJoint; Zimmer and Otter, Real-time models for wheels
    and tyres in an object-oriented modelling framework, Vehicle System Dynamics 48 (2010).
    """

    vAdhesion_min: Parameter = Parameter(0.05, unit="m/s", min=1e-12, doc="least slip velocity of the peak")
    vSlide_min: Parameter = Parameter(0.15, unit="m/s", min=1e-12, doc="least slip velocity of sliding")
    sAdhesion: Parameter = Parameter(0.04, unit="1", min=0.0, doc="slippage of the largest friction")
    sSlide: Parameter = Parameter(0.12, unit="1", min=0.0, doc="slippage from which on it slides")
    dynamicLoad: Input = Input(unit="N", doc="load besides N")
    fN: Variable = Variable(unit="N", doc="normal force")
    vAdhesion: Variable = Variable(unit="m/s", doc="slip velocity of the largest friction")
    vSlide: Variable = Variable(unit="m/s", doc="slip velocity from which on it slides")

    def equations(self) -> Equations:
        yield from super().equations()
        rim = noevent(abs(self.radius * self.w_roll))
        yield self.vAdhesion == noevent(maximum(self.sAdhesion * rim, self.vAdhesion_min))
        yield self.vSlide == noevent(maximum(self.sSlide * rim, self.vSlide_min))
        yield self.fN == maximum(self.N + self.dynamicLoad, 0.0)
        yield self.f == self.fN * slip_curve(self.v_slip, self.vAdhesion, self.vSlide, self.mu_A, self.mu_S)


class DryFrictionBasedRolling(thermal.PartialConditionalHeatPort, PartialRolling):
    """A wheel in the plane rolls and slips on the x axis: its hub, the frame, is at ``y = R``.

    The friction in x is against the slip ``v_slip = dx/dt + R dphi/dt``, in proportion to the normal force ``N =
    -frame_a.fy``, by the curve `slip_curve`.

    >>> model = assemble("wheel.frame_a - disc.frame_a",
    ...                  planarWorld=ac.inner(PlanarWorld(constantGravity=(0.0, -10.0))),
    ...                  wheel=DryFrictionBasedRolling(R=0.5, vAdhesion=0.01, vSlide=0.02, mu_A=0.5, mu_S=0.3),
    ...                  disc=Body(m=2.0, I=0.25, phi=start(0.0, fixed=True), w=start(0.0, fixed=True),
    ...                            r=start((0.0, 0.5), fixed=True), v=start((3.0, 0.0))))
    >>> close(run(model, at=[0.0, 0.2])["disc.v[1]"][-1], 3.0 - 0.3 * 10.0 * 0.2)  # slides
    True

    Source: PlanarMechanics.Joints.DryFrictionBasedRolling.
    """

    vAdhesion: Parameter = Parameter(0.1, unit="m/s", min=1e-12, doc="slip velocity of the largest friction")
    vSlide: Parameter = Parameter(0.3, unit="m/s", min=1e-12, doc="slip velocity from which on it slides")
    mu_A: Parameter = Parameter(0.8, unit="1", min=0.0, doc="friction coefficient at adhesion, the largest")
    mu_S: Parameter = Parameter(0.4, unit="1", min=0.0, doc="friction coefficient of sliding")
    N: Variable = Variable(unit="N", doc="normal force")
    v_slip: Variable = Variable(unit="m/s", doc="slip velocity")

    def equations(self) -> Equations:
        yield from super().equations()
        frame = self.frame_a
        yield self.v_slip == self.vx + self.w * self.R
        yield self.N == -frame.fy
        yield frame.fx == self.N * slip_curve(self.v_slip, self.vAdhesion, self.vSlide, self.mu_A, self.mu_S)
        yield self.lossPower == frame.fx * self.v_slip
