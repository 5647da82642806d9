"""Flange and the bases of rotational components."""

from __future__ import annotations

from acausal import (
    Component,
    Connector,
    Equations,
    Expr,
    Flow,
    Output,
    Parameter,
    Potential,
    Variable,
    conditional,
    der,
    structural,
)


class Flange(Connector):
    """One-dimensional rotational flange.

    Source: Modelica.Mechanics.Rotational.Interfaces.Flange_a.
    """

    phi: Potential = Potential(unit="rad", doc="absolute angle")
    tau: Flow = Flow(unit="N*m", doc="cut torque acting on the component")


class PartialTwoFlanges(Component, partial=True):
    """Two flanges, a and b.

    Source: Modelica.Mechanics.Rotational.Interfaces.PartialTwoFlanges.
    """

    flange_a: Flange = Flange()
    flange_b: Flange = Flange()


class PartialCompliant(PartialTwoFlanges, partial=True):
    """Two flanges, no inertia: ``phi_rel = flange_b.phi - flange_a.phi``, ``tau = flange_b.tau = -flange_a.tau``.

    Source: Modelica.Mechanics.Rotational.Interfaces.PartialCompliant.
    """

    phi_rel: Variable = Variable(unit="rad", doc="relative angle, flange_b.phi - flange_a.phi")
    tau: Variable = Variable(unit="N*m", doc="torque between the flanges")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.phi_rel == self.flange_b.phi - self.flange_a.phi
        yield self.flange_b.tau == self.tau
        yield self.flange_a.tau == -self.tau


class PartialCompliantWithVelocity(PartialCompliant, partial=True):
    """Compliant element that needs the relative velocity, ``w_rel = d(flange_b.phi)/dt - d(flange_a.phi)/dt``.

    The derivatives are taken at the flanges, where they are states of what is connected.

    Source: Modelica.Mechanics.Rotational.Interfaces.PartialCompliant, with the velocity.
    """

    w_rel: Variable = Variable(unit="rad/s", start=0.0, doc="relative angular velocity")

    def equations(self) -> Equations:
        yield from super().equations()
        yield from self.velocity()

    def velocity(self) -> Equations:
        """What gives `w_rel`."""
        yield self.w_rel == der(self.flange_b.phi) - der(self.flange_a.phi)


class PartialCompliantWithRelativeStates(PartialCompliantWithVelocity, partial=True):
    """Compliant element whose relative angle and velocity ``w_rel = dphi_rel/dt`` are wanted as states.

    They have the size `phi_nominal`, which the error control of long shafts and stiff springs needs. Where an impulse
    resets one side, the states keep the relative velocity, and the other side moves along. `stateSelect="default"`
    leaves the choice to the compiler.

    Source: Modelica.Mechanics.Rotational.Interfaces.PartialCompliantWithRelativeStates.
    """

    stateSelect: str = "prefer"
    phi_nominal: Parameter = Parameter(1e-4, unit="rad", evaluate=True, doc="typical size of phi_rel")
    phi_rel: Variable = Variable(
        unit="rad", start=0.0, state_select=structural("stateSelect"), nominal=phi_nominal,
        doc="relative angle, flange_b.phi - flange_a.phi",
    )  # fmt: skip
    w_rel: Variable = Variable(
        unit="rad/s", start=0.0, state_select=structural("stateSelect"), doc="relative angular velocity"
    )

    def velocity(self) -> Equations:
        yield self.w_rel == der(self.phi_rel)


class PartialSupport(Component, partial=True):
    """A flange `support` for the reaction torque with `useSupport`, otherwise the fixed housing.

    Subclasses measure angles against `phi_support` and yield ``supported(tau)`` with the torque of the support.

    Source: Modelica.Mechanics.Rotational.Interfaces.PartialElementaryOneFlangeAndSupport2.
    """

    useSupport: bool = False
    support: Flange = conditional(Flange(), "useSupport")

    @property
    def phi_support(self) -> Expr | float:
        """Angle of the support [rad]."""
        return self.support.phi if self.useSupport else 0.0

    def supported(self, reaction: Expr) -> Equations:
        """Equations of the support, whose torque is `reaction`."""
        if self.useSupport:
            yield self.support.tau == reaction


class PartialOneFlangeAndSupport(PartialSupport, partial=True):
    """One flange and a support, ``phi = flange.phi - support.phi``, ``support.tau = -flange.tau``.

    Source: Modelica.Mechanics.Rotational.Interfaces.PartialElementaryOneFlangeAndSupport2.
    """

    flange: Flange = Flange()
    phi: Variable = Variable(unit="rad", doc="angle of the flange relative to the support")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.phi == self.flange.phi - self.phi_support
        yield from self.supported(-self.flange.tau)


class PartialTwoFlangesAndSupport(PartialSupport, PartialTwoFlanges, partial=True):
    """Two flanges and a support that takes the sum of their torques.

    Source: Modelica.Mechanics.Rotational.Interfaces.PartialElementaryTwoFlangesAndSupport2.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield from self.supported(-self.flange_a.tau - self.flange_b.tau)


class PartialAbsoluteSensor(Component, partial=True):
    """Measurement at one flange; takes no torque.

    Source: Modelica.Mechanics.Rotational.Interfaces.PartialAbsoluteSensor.
    """

    flange: Flange = Flange()

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange.tau == 0


class PartialRelativeSensor(PartialTwoFlanges, partial=True):
    """Measurement between two flanges; takes no torque.

    Source: Modelica.Mechanics.Rotational.Interfaces.PartialRelativeSensor.
    """

    phi_rel: Output = Output(unit="rad", doc="relative angle, flange_b.phi - flange_a.phi")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.phi_rel == self.flange_b.phi - self.flange_a.phi
        yield self.flange_a.tau == 0
        yield self.flange_b.tau == 0
