"""Gear with losses in its teeth and bearings, which may jam."""

from __future__ import annotations

from collections.abc import Sequence

import acausal as ac
from acausal import Discrete, Equations, Expr, Parameter, Variable, der, pre, where

from .. import blocks, thermal
from ..friction import BACKWARD, FORWARD, FREE, STUCK, UNKNOWN, corners, table_columns, yielding
from .interfaces import PartialTwoFlangesAndSupport

ROUNDED = 1e-9
"""What rounding may add to an efficiency of the table, or take from a torque."""


class LossyGear(thermal.PartialConditionalHeatPort, PartialTwoFlangesAndSupport):
    """Gear without inertia, ``phi_a = ratio phi_b``, with mesh efficiency and bearing friction.

    ``flange_b.tau = -ratio (flange_a.tau - tauLoss)``. While flange a drives, ``tauLoss = (1 - eta_mf1) flange_a.tau +
    tau_bf1 sign(w_a)``; while flange b drives, ``tauLoss = (1 - 1/eta_mf2) flange_a.tau + tau_bf2 sign(w_a)``. Flange a
    drives where ``(flange_a.tau - tau_bf_a sign(w_a)) w_a > 0``: its bearing takes ``tau_bf_a = (tau_bf1 -
    tau_bf2)/(eta_mf1 - 1/eta_mf2)``, where both losses are equal. At rest the losses hold the gear, up to these values.
    A row of `lossTable` is ``(|w_a|, eta_mf1, eta_mf2, |tau_bf1|, |tau_bf2|)``.

    >>> table = [[0, 0.5, 0.5, 0, 0]]
    >>> model = assemble("drive.flange - one.flange_a", "one.flange_b - gear.flange_a", "gear.flange_b - two.flange_a",
    ...                  drive=ConstantTorque(tau_constant=5.0), gear=LossyGear(ratio=2.0, lossTable=table),
    ...                  one=Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)), two=Inertia(J=8.0))
    >>> close(run(model, at=[0.5, 1.0])["one.w"], [0.5, 1.0])  # 5/(1 + 8/(0.5 2^2))
    True

    Source: Modelica.Mechanics.Rotational.Components.LossyGear; Pelchen, Schweiger and Otter, Modeling and simulating
    the efficiency of gearboxes and of planetary gearboxes, Modelica Conference 2002.
    """

    ratio: Parameter = Parameter(1.0, unit="1", doc="transmission ratio flange_a.phi / flange_b.phi")
    lossTable: Sequence[Sequence[float]] = ((0.0, 1.0, 1.0, 0.0, 0.0),)
    unitAngularAcceleration: Parameter = Parameter(1.0, unit="rad/s2", doc="scale of sa as an acceleration")
    unitTorque: Parameter = Parameter(1.0, unit="N*m", doc="scale of sa as a torque")
    phi_a: Variable = Variable(unit="rad", doc="angle between flange a and the support")
    phi_b: Variable = Variable(unit="rad", doc="angle between flange b and the support")
    w_a: Variable = Variable(unit="rad/s", doc="angular velocity of flange a relative to the support")
    a_a: Variable = Variable(unit="rad/s2", doc="angular acceleration of flange a relative to the support")
    tau_a: Variable = Variable(unit="N*m", doc="torque at flange a")
    tauLoss: Variable = Variable(unit="N*m", doc="torque lost, in terms of flange a")
    tauLossMax: Variable = Variable(unit="N*m", doc="torque that rolling forward loses")
    tauLossMin: Variable = Variable(unit="N*m", doc="torque that rolling backward loses")
    eta_mf1: Variable = Variable(unit="1", doc="mesh efficiency while flange a drives")
    eta_mf2: Variable = Variable(unit="1", doc="mesh efficiency while flange b drives")
    tau_bf1: Variable = Variable(unit="N*m", doc="bearing friction while flange a drives")
    tau_bf2: Variable = Variable(unit="N*m", doc="bearing friction while flange b drives")
    tau_bf_a: Variable = Variable(unit="N*m", doc="part of the bearing friction on the side of flange a")
    speed: Variable = Variable(doc="speed of flange a")
    sa: Variable = Variable(doc="curve parameter: loss while stuck, shifted acceleration while moving")
    along: Variable = Variable(doc="sa from its corner: what holds while stuck, what accelerates while sliding")
    startForward: Discrete = Discrete(doc="whether forward rolling starts")
    startBackward: Discrete = Discrete(doc="whether backward rolling starts")
    locked: Discrete = Discrete(doc="whether the gear is stuck")
    mode: Discrete = Discrete(start=UNKNOWN, doc="2 free, 1 forward, 0 stuck, -1 backward, 3 unknown")

    @property
    def ideal(self) -> bool:
        """Whether nothing is lost at any speed."""
        return all(tuple(row[1:]) == (1.0, 1.0, 0.0, 0.0) for row in self.lossTable)

    @property
    def columns(self) -> list[list[float]]:
        """The speeds of the table, its two efficiencies, and its two torques of the bearings."""
        return table_columns(
            self, "lossTable", self.lossTable, "eta_mf1", "eta_mf2", "tau_bf1", "tau_bf2", largest=(1.0, 1.0)
        )

    def table(self, speed: Expr) -> tuple[Expr, Expr, Expr, Expr]:
        """Both efficiencies and both torques of the bearings at this speed."""
        at, *columns = self.columns
        eta1, eta2, bearing1, bearing2 = (blocks.interpolate(speed, at, column) for column in columns)
        return eta1, eta2, self.unitTorque * bearing1, self.unitTorque * bearing2

    def bearing_a(self, row: tuple[Expr, Expr, Expr, Expr]) -> Expr:
        """Part of the bearing friction on the side of flange a, for this row of the table."""
        eta1, eta2, bearing1, bearing2 = row
        lost = 1 / eta2 - eta1  # zero where the teeth lose nothing; who drives makes no difference then
        return ac.noevent(where(lost > 0, (bearing2 - bearing1) / ac.max(lost, 1e-12), bearing1 / 2))

    def losses(self, row: tuple[Expr, Expr, Expr, Expr], bearing_a: Expr) -> tuple[Expr, Expr]:
        """Torques lost while rolling forward and backward, for this row of the table."""
        eta1, eta2, bearing1, bearing2 = row
        forth, back = (1 - eta1) * self.tau_a, (1 - 1 / eta2) * self.tau_a
        drives, follows = self.tau_a >= bearing_a, self.tau_a >= -bearing_a
        return where(drives, forth + bearing1, back + bearing2), where(follows, back - bearing2, forth - bearing1)

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.phi_a == self.flange_a.phi - self.phi_support
        yield self.phi_b == self.flange_b.phi - self.phi_support
        yield self.phi_a == self.ratio * self.phi_b
        yield self.w_a == der(self.phi_a)
        yield self.a_a == der(self.w_a)
        yield self.tau_a == self.flange_a.tau
        yield self.flange_b.tau == -self.ratio * (self.tau_a - self.tauLoss)
        yield self.speed == ac.noevent(ac.abs(self.w_a))
        yield self.lossPower == self.tauLoss * self.w_a
        present = (self.eta_mf1, self.eta_mf2, self.tau_bf1, self.tau_bf2)
        for value, entry in zip(present, self.table(self.speed), strict=True):
            yield value == entry
        yield self.tau_bf_a == self.bearing_a(present)
        yield from self._free() if self.ideal else self._rolling()
        yield from self._continued()

    def _continued(self) -> Equations:
        """The assertions that the table is not continued to where the gear would drive.

        They hold until an event: the equations behind it may have no solution.
        """
        at, *columns = self.columns
        for name, column in zip(("eta_mf1", "eta_mf2", "tau_bf1", "tau_bf2"), columns, strict=True):
            efficiency, value = name.startswith("eta"), blocks.interpolate(self.speed, at, column)
            text = f"beyond its last row `lossTable` is continued to {name} {{}}: end it with a row at a higher speed"
            if efficiency and len(at) > 1 and column[-1] > column[-2]:
                yield ac.assert_(value <= 1.0 + ROUNDED, text.format("above 1"))
            elif len(at) > 1 and column[-1] < column[-2]:
                least = ROUNDED if efficiency else -ROUNDED
                yield ac.assert_(value >= least, text.format("below 0"))

    def _free(self) -> Equations:
        """Nothing is lost, and nothing holds the gear."""
        for torque in (self.tauLoss, self.tauLossMax, self.tauLossMin):
            yield torque == 0.0 * self.tau_a
        yield self.a_a == self.unitAngularAcceleration * self.along
        yield self.sa == self.along
        for flag in (self.startForward, self.startBackward, self.locked):
            yield flag == 0.0
        yield self.mode == FREE

    def _rolling(self) -> Equations:
        """State machine: rolling forward, rolling backward, or stuck."""
        along, was = self.along, pre(self.mode)
        forward_most, backward_most = self.tauLossMax, self.tauLossMin
        most = self.losses((self.eta_mf1, self.eta_mf2, self.tau_bf1, self.tau_bf2), self.tau_bf_a)
        yield forward_most == most[0]
        yield backward_most == most[1]
        rest = self.table(0.0 * self.speed)
        highest, lowest = (loss / self.unitTorque for loss in self.losses(rest, self.bearing_a(rest)))
        forward, stuck, backward, held = was == FORWARD, was == STUCK, was == BACKWARD, pre(self.locked) > 0.5
        begins, returns = ac.initial() & (self.w_a > 0), ac.initial() & (self.w_a < 0)
        goes_on, comes_on = pre(self.startForward) > 0.5, pre(self.startBackward) > 0.5
        at, upper, lower = corners(forward | goes_on, backward | comes_on, highest, lowest)
        sa = along + at
        yield self.sa == sa
        yield self.startForward == where((stuck & (held | goes_on) & (along > upper)) | begins, 1.0, 0.0)
        yield self.startBackward == where((stuck & (held | comes_on) & (along < lower)) | returns, 1.0, 0.0)
        going, coming = self.startForward > 0.5, self.startBackward > 0.5
        yield self.locked == where(forward | going | backward | coming, 0.0, 1.0)
        locked, onward = self.locked > 0.5, going | (forward & ~coming)
        rolling = where(onward, forward_most, backward_most)
        yield self.tauLoss == where(locked, sa * self.unitTorque, rolling)
        rolls = along - where(onward, upper, lower)
        yield self.a_a == self.unitAngularAcceleration * where(locked, yielding(sa, 1.0), rolls)
        slides, slips = (forward | going) & (self.w_a > 0), (backward | coming) & (self.w_a < 0)
        yield self.mode == where(slides, FORWARD, where(slips, BACKWARD, STUCK))
