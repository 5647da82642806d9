"""Coulomb friction that sticks: slides, brakes, masses between hard stops."""

from __future__ import annotations

from collections.abc import Sequence

import acausal as ac
from acausal import Discrete, Equations, Expr, Input, Parameter, Variable, der, reinit, when, where

from .. import blocks, thermal
from ..friction import StickSlip, not_continued_below_zero, table_columns
from .interfaces import PartialRigid, PartialTwoFlangesAndSupport


class PartialFriction(StickSlip, partial=True):
    """State machine of dry friction: sliding forward, sliding backward, stuck, or free.

    While stuck the unknown `sa` is the friction force that holds; it lets go above ``f0_max``. While sliding it is
    the acceleration, shifted so that the characteristic has no jump. Subclasses give `v_relfric`, `a_relfric`, `f0`,
    `f0_max`, `free` and the sliding force.

    Source: Modelica.Mechanics.Translational.Interfaces.PartialFriction; Otter, Elmqvist and Mattsson, Hybrid modeling
    in Modelica based on the synchronous data flow principle, CACSD 1999.
    """

    v_small: Parameter = Parameter(1e-3, unit="m/s", doc="speed near 0, needed where an impulse stops the motion")
    unitAcceleration: Parameter = Parameter(1.0, unit="m/s2", doc="scale of sa as an acceleration")
    unitForce: Parameter = Parameter(1.0, unit="N", doc="scale of sa as a force")
    v_relfric: Variable = Variable(unit="m/s", doc="relative velocity between the frictional surfaces")
    a_relfric: Variable = Variable(unit="m/s2", doc="relative acceleration between the frictional surfaces")
    f0: Variable = Variable(unit="N", doc="friction force for v = 0 and forward sliding")
    f0_max: Variable = Variable(unit="N", doc="largest friction force for v = 0 and locked")
    holds: Variable = Variable(unit="N", doc="friction force while stuck")

    def equations(self) -> Equations:
        yield from super().equations()
        peak, units = self.f0_max / self.unitForce, (self.unitAcceleration, self.unitForce)
        yield from self.stick_slip(self.v_relfric, self.a_relfric, peak, self.v_small, units)


class SupportFriction(thermal.PartialConditionalHeatPort, PartialFriction, PartialTwoFlangesAndSupport):
    """Coulomb friction in a slide, of the force `f_pos` (speed, force) while sliding, `peak` times more at rest.

    ``flange_a.f + flange_b.f = f``; see `PartialFriction`.

    >>> model = assemble("mass.flange_b - slide.flange_a", slide=SupportFriction(f_pos=[[0, 2], [1, 2]]),
    ...                  mass=Mass(m=4.0, s=start(0.0, fixed=True), v=start(0.25, fixed=True)))
    >>> slow = run(model, at=[0.25, 0.5, 1.0])
    >>> close(slow["mass.v"], [0.125, 0.0, 0.0]) and slow["slide.mode"][-1] == 0.0
    True

    Source: Modelica.Mechanics.Translational.Components.SupportFriction.
    """

    f_pos: Sequence[Sequence[float]] = ((0.0, 1.0),)
    peak: Parameter = Parameter(1.0, unit="1", min=1.0, doc="largest force at rest over the force for v = 0")
    s: Variable = Variable(unit="m", doc="position of the slide relative to the support")
    f: Variable = Variable(unit="N", doc="friction force")
    v: Variable = Variable(unit="m/s", doc="velocity of the slide relative to the support")
    a: Variable = Variable(unit="m/s2", doc="acceleration of the slide relative to the support")
    speed: Variable = Variable(doc="speed in the direction of sliding")

    def equations(self) -> Equations:
        yield from super().equations()
        speeds, forces = table_columns(self, "f_pos", self.f_pos, "force")
        yield self.f0 == self.unitForce * blocks.interpolate(0.0 * self.speed, speeds, forces)
        yield self.f0_max == self.peak * self.f0
        yield self.free == 0.0
        yield self.s == self.s_a
        yield self.flange_b.s == self.flange_a.s
        yield self.v == der(self.s)
        yield self.a == der(self.v)
        yield self.v_relfric == self.v
        yield self.a_relfric == self.a
        yield self.flange_a.f + self.flange_b.f - self.f == 0
        yield self.speed == self.direction() * self.v
        force = blocks.interpolate(self.speed, speeds, forces)
        yield self.f == self.friction(self.direction() * self.unitForce * force)
        yield from not_continued_below_zero("f_pos", forces, force)
        yield self.lossPower == self.f * self.v_relfric


class PartialNormalForce(PartialFriction, partial=True):
    """Friction ``f = cgeo mu(|v|) fn`` under the normal force ``fn = fn_max f_normalized``.

    Source: Modelica.Mechanics.Translational.Components.Brake.
    """

    mu_pos: Sequence[Sequence[float]] = ((0.0, 0.5),)
    peak: Parameter = Parameter(1.0, unit="1", min=1.0, doc="largest friction at rest over the friction for v = 0")
    cgeo: Parameter = Parameter(1.0, unit="1", min=0.0, doc="geometry constant: force over friction force")
    fn_max: Parameter = Parameter(1.0, unit="N", min=0.0, doc="largest normal force")
    f_normalized: Input = Input(unit="1", doc="normal force over its maximum, 0 to 1; free where not positive")
    fn: Variable = Variable(unit="N", doc="normal force")
    mu0: Variable = Variable(unit="1", doc="friction coefficient at rest, without `peak`")
    mu: Variable = Variable(unit="1", doc="friction coefficient, with the sign of the motion")
    speed: Variable = Variable(doc="speed in the direction of sliding")
    f: Variable = Variable(unit="N", doc="friction force")

    def equations(self) -> Equations:
        yield from super().equations()
        speeds, coefficients = table_columns(self, "mu_pos", self.mu_pos, "friction coefficient")
        yield self.fn == self.fn_max * self.f_normalized
        yield self.free == where(self.fn <= 0, 1.0, 0.0)
        yield self.mu0 == blocks.interpolate(0.0 * self.speed, speeds, coefficients)
        yield self.f0 == self.mu0 * self.cgeo * self.fn
        yield self.f0_max == self.peak * self.f0
        yield self.speed == self.direction() * self.v_relfric
        coefficient = blocks.interpolate(self.speed, speeds, coefficients)
        yield self.mu == self.direction() * coefficient
        yield self.f == self.friction(self.mu * self.cgeo * self.fn)
        yield from not_continued_below_zero("mu_pos", coefficients, coefficient, self.fn <= 0)


class Brake(thermal.PartialConditionalHeatPort, PartialNormalForce, PartialTwoFlangesAndSupport):
    """Brake: Coulomb friction between the slide and the support, ``f = cgeo mu fn``; see `PartialFriction`.

    >>> model = assemble("press.y - brake.f_normalized", "mass.flange_b - brake.flange_a", brake=Brake(fn_max=8.0),
    ...                  press=blocks.Step(startTime=0.25),
    ...                  mass=Mass(m=4.0, s=start(0.0, fixed=True), v=start(0.5, fixed=True)))
    >>> slow = run(model, at=[0.2, 0.5, 1.0])
    >>> close(slow["mass.v"], [0.5, 0.25, 0.0]) and slow["brake.mode"] == [2.0, 1.0, 0.0]
    True

    Source: Modelica.Mechanics.Translational.Components.Brake.
    """

    s: Variable = Variable(unit="m", doc="position of the slide relative to the support")
    v: Variable = Variable(unit="m/s", doc="velocity of the slide relative to the support")
    a: Variable = Variable(unit="m/s2", doc="acceleration of the slide relative to the support")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.s == self.s_a
        yield self.flange_b.s == self.flange_a.s
        yield self.v == der(self.s)
        yield self.a == der(self.v)
        yield self.v_relfric == self.v
        yield self.a_relfric == self.a
        yield self.flange_a.f + self.flange_b.f - self.f == 0
        yield self.lossPower == self.f * self.v_relfric


class MassWithStopAndFriction(thermal.PartialConditionalHeatPort, PartialFriction, PartialRigid):
    """Sliding mass with Stribeck friction between two hard stops, at which it loses all its speed.

    Sliding forward ``f = F_prop v + F_Coulomb + F_Stribeck exp(-fexp |v|)``; ``m a = flange_a.f + flange_b.f - f``;
    see `PartialFriction`. The ends stay between `smin` and `smax`.

    >>> mass = MassWithStopAndFriction(m=2.0, L=0.0, smax=0.5, smin=-0.5, F_prop=0.0, F_Coulomb=1.0, F_Stribeck=0.0,
    ...                                s=start(0.0, fixed=True), v=start(0.0, fixed=True))
    >>> model = assemble("drive.flange - mass.flange_a", mass=mass, drive=ConstantForce(f_constant=5.0))
    >>> slide = run(model, at=[0.5, 1.0])
    >>> close(slide["mass.s"], [0.25, 0.5]) and close(slide["mass.v"], [1.0, 0.0]) and slide["mass.stopped"][-1] == 1.0
    True

    Source: Modelica.Mechanics.Translational.Components.MassWithStopAndFriction.
    """

    m: Parameter = Parameter(1.0, unit="kg", min=0.0, doc="mass")
    smax: Parameter = Parameter(25.0, unit="m", doc="right stop, for the right end")
    smin: Parameter = Parameter(-25.0, unit="m", doc="left stop, for the left end")
    F_prop: Parameter = Parameter(1.0, unit="N*s/m", min=0.0, doc="friction in proportion to the velocity")
    F_Coulomb: Parameter = Parameter(5.0, unit="N", doc="constant friction")
    F_Stribeck: Parameter = Parameter(10.0, unit="N", doc="additional friction at low speed")
    fexp: Parameter = Parameter(2.0, unit="s/m", min=0.0, doc="exponential decay of F_Stribeck")
    s: Variable = Variable(unit="m", start=0.0, state_select="always", doc="position of the centre")
    v: Variable = Variable(unit="m/s", start=0.0, state_select="always", doc="velocity")
    a: Variable = Variable(unit="m/s2", doc="acceleration")
    f: Variable = Variable(unit="N", doc="friction force")
    stopped: Discrete = Discrete(doc="-1 at the left stop, 1 at the right stop, else 0")

    def ahead(self, condition: Expr) -> Expr:
        """`condition`, where there is room to move forward."""
        return condition & (self.s < self.smax - self.L / 2)

    def behind(self, condition: Expr) -> Expr:
        """`condition`, where there is room to move backward."""
        return condition & (self.s > self.smin + self.L / 2)

    def equations(self) -> Equations:
        yield from super().equations()
        left, right = self.smin + self.L / 2, self.smax - self.L / 2
        decay = ac.exp(-self.fexp * ac.noevent(ac.abs(self.v)))
        rest = self.F_Coulomb + self.F_Stribeck * decay
        yield self.f0 == self.F_Coulomb + self.F_Stribeck
        yield self.f0_max == 1.001 * self.f0
        frictionless = (self.f0 <= 0) & (self.F_prop <= 0)
        yield self.free == where(frictionless & (self.s > left) & (self.s < right), 1.0, 0.0)
        yield self.v == der(self.s)
        yield self.a == der(self.v)
        yield self.v_relfric == self.v
        yield self.a_relfric == self.a
        yield self.m * self.a == self.flange_a.f + self.flange_b.f - self.f
        yield self.f == self.friction(self.F_prop * self.v + self.direction() * rest)
        yield self.lossPower == self.f * self.v_relfric
        yield self.stopped == where(self.s <= left, -1.0, where(self.s >= right, 1.0, 0.0))
        end = where(self.stopped < 0, left, right)
        slack = 1e-6 * (right - left)  # of a start that is found to rounding
        clear_left = (self.s > left) | ((self.s >= left - slack) & (self.v >= 0))
        clear_right = (self.s < right) | ((self.s <= right + slack) & (self.v <= 0))
        message = "the ends of the mass have to start between smin and smax, and at a stop without speed towards it"
        yield ac.assert_(~ac.initial() | (clear_left & clear_right & (left < right)), message)
        yield when(~(self.stopped == 0.0), reinit(self.s, end), reinit(self.v, 0.0))
