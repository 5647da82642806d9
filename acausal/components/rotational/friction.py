"""Coulomb friction that sticks: bearings, brakes, clutches."""

from __future__ import annotations

from collections.abc import Sequence

import acausal as ac
from acausal import Discrete, Equations, Input, Parameter, Variable, der, pre, where

from .. import blocks, thermal
from ..friction import StickSlip, not_continued_below_zero, table_columns, yielding
from .interfaces import PartialCompliantWithRelativeStates, PartialTwoFlangesAndSupport

BACKWARDS = 1e-3
"""Relative speed [rad/s] below which a freewheel is not just locked to the tolerance of a run."""


class PartialFriction(StickSlip, partial=True):
    """State machine of dry friction: sliding forward, sliding backward, stuck, or free.

    While stuck the unknown `sa` is the friction torque that holds; it lets go above ``tau0_max``. While sliding it is
    the acceleration, shifted so that the characteristic has no jump. Subclasses give `w_relfric`, `a_relfric`, `tau0`,
    `tau0_max`, `free` and the sliding torque.

    Source: Modelica.Mechanics.Rotational.Interfaces.PartialFriction; Otter, Elmqvist and Mattsson, Hybrid modeling in
    Modelica based on the synchronous data flow principle, CACSD 1999.
    """

    w_small: Parameter = Parameter(1e10, unit="rad/s", doc="speed near 0, needed where an impulse stops the motion")
    unitAngularAcceleration: Parameter = Parameter(1.0, unit="rad/s2", doc="scale of sa as an acceleration")
    unitTorque: Parameter = Parameter(1.0, unit="N*m", doc="scale of sa as a torque")
    w_relfric: Variable = Variable(unit="rad/s", doc="relative angular velocity between the frictional surfaces")
    a_relfric: Variable = Variable(unit="rad/s2", doc="relative angular acceleration between the frictional surfaces")
    tau0: Variable = Variable(unit="N*m", doc="friction torque for w = 0 and forward sliding")
    tau0_max: Variable = Variable(unit="N*m", doc="largest friction torque for w = 0 and locked")
    holds: Variable = Variable(unit="N*m", doc="friction torque while stuck")

    def equations(self) -> Equations:
        yield from super().equations()
        peak, units = self.tau0_max / self.unitTorque, (self.unitAngularAcceleration, self.unitTorque)
        yield from self.stick_slip(self.w_relfric, self.a_relfric, peak, self.w_small, units)


class BearingFriction(thermal.PartialConditionalHeatPort, PartialFriction, PartialTwoFlangesAndSupport):
    """Coulomb friction in a bearing, of the torque `tau_pos` (speed, torque) while sliding, `peak` times more at rest.

    ``flange_a.tau + flange_b.tau = tau``; see `PartialFriction`.

    >>> model = assemble("rotor.flange_b - bearing.flange_a", bearing=BearingFriction(tau_pos=[[0, 2], [1, 2]]),
    ...                  rotor=Inertia(J=4.0, phi=start(0.0, fixed=True), w=start(0.25, fixed=True)))
    >>> slow = run(model, at=[0.25, 0.5, 1.0])
    >>> close(slow["rotor.w"], [0.125, 0.0, 0.0]) and slow["bearing.mode"][-1] == 0.0
    True

    Source: Modelica.Mechanics.Rotational.Components.BearingFriction.
    """

    tau_pos: Sequence[Sequence[float]] = ((0.0, 1.0),)
    peak: Parameter = Parameter(1.0, unit="1", min=1.0, doc="largest torque at rest over the torque for w = 0")
    phi: Variable = Variable(unit="rad", doc="angle between the shaft and the support")
    tau: Variable = Variable(unit="N*m", doc="friction torque")
    w: Variable = Variable(unit="rad/s", doc="angular velocity of the shaft relative to the support")
    a: Variable = Variable(unit="rad/s2", doc="angular acceleration of the shaft relative to the support")
    speed: Variable = Variable(doc="speed in the direction of sliding")

    def equations(self) -> Equations:
        yield from super().equations()
        speeds, torques = table_columns(self, "tau_pos", self.tau_pos, "torque")
        yield self.tau0 == self.unitTorque * blocks.interpolate(0.0 * self.speed, speeds, torques)
        yield self.tau0_max == self.peak * self.tau0
        yield self.free == 0.0
        yield self.phi == self.flange_a.phi - self.phi_support
        yield self.flange_b.phi == self.flange_a.phi
        yield self.w == der(self.phi)
        yield self.a == der(self.w)
        yield self.w_relfric == self.w
        yield self.a_relfric == self.a
        yield self.flange_a.tau + self.flange_b.tau - self.tau == 0
        yield self.speed == self.direction() * self.w
        torque = blocks.interpolate(self.speed, speeds, torques)
        yield self.tau == self.friction(self.direction() * self.unitTorque * torque)
        yield from not_continued_below_zero("tau_pos", torques, torque)
        yield self.lossPower == self.tau * self.w_relfric


class PartialNormalForce(PartialFriction, partial=True):
    """Friction ``tau = cgeo mu(|w|) fn`` under the normal force ``fn = fn_max f_normalized``.

    Source: Modelica.Mechanics.Rotational.Components.Clutch.
    """

    mu_pos: Sequence[Sequence[float]] = ((0.0, 0.5),)
    peak: Parameter = Parameter(1.0, unit="1", min=1.0, doc="largest friction at rest over the friction for w = 0")
    cgeo: Parameter = Parameter(1.0, unit="m", min=0.0, doc="geometry constant: torque over friction force")
    fn_max: Parameter = Parameter(1.0, unit="N", min=0.0, doc="largest normal force")
    f_normalized: Input = Input(unit="1", doc="normal force over its maximum, 0 to 1; free where not positive")
    fn: Variable = Variable(unit="N", doc="normal force")
    mu0: Variable = Variable(unit="1", doc="friction coefficient at rest, without `peak`")
    mu: Variable = Variable(unit="1", doc="friction coefficient, with the sign of the motion")
    speed: Variable = Variable(doc="speed in the direction of sliding")
    tau: Variable = Variable(unit="N*m", doc="friction torque")

    def equations(self) -> Equations:
        yield from super().equations()
        speeds, coefficients = table_columns(self, "mu_pos", self.mu_pos, "friction coefficient")
        yield self.fn == self.fn_max * self.f_normalized
        yield self.free == where(self.fn <= 0, 1.0, 0.0)
        yield self.mu0 == blocks.interpolate(0.0 * self.speed, speeds, coefficients)
        yield self.tau0 == self.mu0 * self.cgeo * self.fn
        yield self.tau0_max == self.peak * self.tau0
        yield self.speed == self.direction() * self.w_relfric
        coefficient = blocks.interpolate(self.speed, speeds, coefficients)
        yield self.mu == self.direction() * coefficient
        yield self.tau == self.friction(self.mu * self.cgeo * self.fn)
        yield from not_continued_below_zero("mu_pos", coefficients, coefficient, self.fn <= 0)


class Brake(thermal.PartialConditionalHeatPort, PartialNormalForce, PartialTwoFlangesAndSupport):
    """Brake: Coulomb friction between the shaft and the support, ``tau = cgeo mu fn``; see `PartialFriction`.

    >>> model = assemble("press.y - brake.f_normalized", "rotor.flange_b - brake.flange_a", brake=Brake(fn_max=8.0),
    ...                  press=blocks.Step(startTime=0.25),
    ...                  rotor=Inertia(J=4.0, phi=start(0.0, fixed=True), w=start(0.5, fixed=True)))
    >>> slow = run(model, at=[0.2, 0.5, 1.0])
    >>> close(slow["rotor.w"], [0.5, 0.25, 0.0]) and slow["brake.mode"] == [2.0, 1.0, 0.0]
    True

    Source: Modelica.Mechanics.Rotational.Components.Brake.
    """

    phi: Variable = Variable(unit="rad", doc="angle between the shaft and the support")
    w: Variable = Variable(unit="rad/s", doc="angular velocity of the shaft relative to the support")
    a: Variable = Variable(unit="rad/s2", doc="angular acceleration of the shaft relative to the support")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.phi == self.flange_a.phi - self.phi_support
        yield self.flange_b.phi == self.flange_a.phi
        yield self.w == der(self.phi)
        yield self.a == der(self.w)
        yield self.w_relfric == self.w
        yield self.a_relfric == self.a
        yield self.flange_a.tau + self.flange_b.tau - self.tau == 0
        yield self.lossPower == self.tau * self.w_relfric


class Clutch(thermal.PartialConditionalHeatPort, PartialNormalForce, PartialCompliantWithRelativeStates):
    """Clutch: Coulomb friction between two shafts, ``tau = cgeo mu fn``; see `PartialFriction`.

    >>> model = assemble("press.y - clutch.f_normalized", "one.flange_b - clutch.flange_a",
    ...                  "clutch.flange_b - two.flange_a", clutch=Clutch(fn_max=4.0), press=blocks.Constant(k=1.0),
    ...                  one=Inertia(J=4.0, phi=start(0.0, fixed=True), w=start(1.0, fixed=True)),
    ...                  two=Inertia(J=4.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)))
    >>> shafts = run(model, at=[0.5, 1.0, 1.5])
    >>> close(shafts["one.w"], [0.75, 0.5, 0.5]) and close(shafts["two.w"], [0.25, 0.5, 0.5])
    True

    Source: Modelica.Mechanics.Rotational.Components.Clutch.
    """

    tau: Variable = Variable(unit="N*m", doc="friction torque")
    a_rel: Variable = Variable(unit="rad/s2", doc="relative angular acceleration")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.a_rel == der(self.w_rel)
        yield self.w_relfric == self.w_rel
        yield self.a_relfric == self.a_rel
        yield self.lossPower == self.tau * self.w_relfric


class OneWayClutch(thermal.PartialConditionalHeatPort, PartialCompliantWithRelativeStates):
    """Freewheel and clutch in parallel: flange b may not turn slower than flange a; while faster it is a clutch.

    >>> model = assemble("press.y - clutch.f_normalized", "one.flange_b - clutch.flange_a",
    ...                  "clutch.flange_b - two.flange_a", "drive.flange - one.flange_a",
    ...                  clutch=OneWayClutch(fn_max=4.0), press=blocks.Constant(k=0.0),
    ...                  drive=ConstantTorque(tau_constant=4.0),
    ...                  one=Inertia(J=4.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
    ...                  two=Inertia(J=4.0, phi=start(0.0, fixed=True), w=start(0.5, fixed=True)))
    >>> shafts = run(model, at=[0.5, 1.0])
    >>> close(shafts["one.w"], [0.5, 0.75]) and close(shafts["two.w"], [0.5, 0.75])
    True

    Source: Modelica.Mechanics.Rotational.Components.OneWayClutch.
    """

    mu_pos: Sequence[Sequence[float]] = ((0.0, 0.5),)
    peak: Parameter = Parameter(1.0, unit="1", min=1.0, doc="largest friction at rest over the friction for w = 0")
    cgeo: Parameter = Parameter(1.0, unit="m", min=0.0, doc="geometry constant: torque over friction force")
    fn_max: Parameter = Parameter(1.0, unit="N", min=0.0, doc="largest normal force")
    w_small: Parameter = Parameter(1e10, unit="rad/s", doc="speed near 0, needed where an impulse stops the motion")
    eps0: Parameter = Parameter(1e-4, unit="1", doc="relative hysteresis")
    unitAngularAcceleration: Parameter = Parameter(1.0, unit="rad/s2", doc="scale of sa as an acceleration")
    unitTorque: Parameter = Parameter(1.0, unit="N*m", doc="scale of sa as a torque")
    f_normalized: Input = Input(unit="1", doc="normal force over its maximum, 0 to 1; free where not positive")
    fn: Variable = Variable(unit="N", doc="normal force")
    mu0: Variable = Variable(unit="1", doc="friction coefficient at rest, without `peak`")
    mu: Variable = Variable(unit="1", doc="friction coefficient")
    speed: Variable = Variable(doc="relative angular velocity")
    a_rel: Variable = Variable(unit="rad/s2", doc="relative angular acceleration")
    tau0: Variable = Variable(unit="N*m", doc="friction torque for w = 0 and sliding")
    tau0_max: Variable = Variable(unit="N*m", doc="largest friction torque for w = 0 and locked")
    sa: Variable = Variable(doc="curve parameter of the friction characteristic")
    along: Variable = Variable(doc="sa from its corner: what holds while stuck, what accelerates while sliding")
    startForward: Discrete = Discrete(doc="whether w_rel = 0 and forward sliding starts")
    locked: Discrete = Discrete(doc="whether w_rel = 0 and not sliding")
    stuck: Discrete = Discrete(doc="locked, or about to slide")

    def equations(self) -> Equations:
        yield from super().equations()
        speeds, coefficients = table_columns(self, "mu_pos", self.mu_pos, "friction coefficient")
        rest = self.mu0 * self.cgeo
        free, along = self.f_normalized <= 0, self.along
        low, high = self.tau0 / self.unitTorque, self.tau0_max / self.unitTorque
        yield self.a_rel == der(self.w_rel)
        yield self.speed == self.w_rel / self.unitAngularAcceleration
        yield self.fn == where(free, 0.0, self.fn_max * self.f_normalized)
        yield self.mu0 == blocks.interpolate(0.0 * self.speed, speeds, coefficients)
        yield self.tau0 == rest * self.fn
        yield self.tau0_max == where(free, self.eps0 * rest * self.fn_max, ac.max(self.peak, 1 + self.eps0) * self.tau0)
        held = pre(self.stuck) > 0.5
        was_locked = pre(self.locked) > 0.5
        sa = along + where(was_locked, 0.0, high)
        yield self.sa == sa
        goes_on = (pre(self.startForward) > 0.5) & (along > where(was_locked, low, low - high))
        lets_go = (along > where(was_locked, high, 0.0)) | goes_on | (self.w_rel > self.w_small)
        yield self.startForward == where((held & lets_go) | (ac.initial() & (self.w_rel > 0)), 1.0, 0.0)
        yield self.locked == where(held & ~(self.startForward > 0.5), 1.0, 0.0)
        locked = self.locked > 0.5
        yield self.mu == blocks.interpolate(self.speed, speeds, coefficients)
        yield from not_continued_below_zero("mu_pos", coefficients, self.mu, free)
        most = high + rest * self.fn_max / self.unitTorque
        # Sliding, sa is shifted by what was held, not by tau0 as in the standard library: so a clutch that lets go
        # stays free, whatever inertia it moves. Shifted by less, sa may fall below tau0_max at once.
        moving = along + where(was_locked, -high, 0.0)
        yield self.a_rel == self.unitAngularAcceleration * where(locked, yielding(sa, most), moving)
        yield self.tau == where(locked, sa * self.unitTorque, where(free, 0.0, self.mu * self.cgeo * self.fn))
        yield self.stuck == where(locked | (self.w_rel <= 0), 1.0, 0.0)
        yield self.lossPower == where(self.stuck > 0.5, 0.0, self.tau * self.w_rel)
        # Locked, it keeps its relative speed, which is zero unless it was less from the start or by a `reinit`.
        forward = ac.noevent(self.speed >= -BACKWARDS)
        yield ac.assert_(forward, "flange b turns slower than flange a, which a freewheel does not let it: begin with "
                         "w_rel >= 0 (a joint speed, if both sides are to turn together)")  # fmt: skip
