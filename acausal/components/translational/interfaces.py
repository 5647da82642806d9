"""Flange and the bases of translational components."""

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
    """One-dimensional translational flange.

    Source: Modelica.Mechanics.Translational.Interfaces.Flange_a.
    """

    s: Potential = Potential(unit="m", doc="absolute position")
    f: Flow = Flow(unit="N", nominal=1e3, doc="cut force acting on the component")


class PartialTwoFlanges(Component, partial=True):
    """Two flanges, a and b.

    Source: Modelica.Mechanics.Translational.Interfaces.PartialTwoFlanges.
    """

    flange_a: Flange = Flange()
    flange_b: Flange = Flange()


class PartialCompliant(PartialTwoFlanges, partial=True):
    """Two flanges, no mass: ``s_rel = flange_b.s - flange_a.s``, ``f = flange_b.f = -flange_a.f``.

    Source: Modelica.Mechanics.Translational.Interfaces.PartialCompliant.
    """

    s_rel: Variable = Variable(unit="m", doc="relative position, flange_b.s - flange_a.s")
    f: Variable = Variable(unit="N", nominal=1e3, doc="force between the flanges, positive in tension")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.s_rel == self.flange_b.s - self.flange_a.s
        yield self.flange_b.f == self.f
        yield self.flange_a.f == -self.f


class PartialCompliantWithVelocity(PartialCompliant, partial=True):
    """Compliant element that needs the relative velocity, ``v_rel = d(flange_b.s)/dt - d(flange_a.s)/dt``.

    The derivatives are taken at the flanges, where they are states of what is connected.

    Source: Modelica.Mechanics.Translational.Interfaces.PartialCompliant, with the velocity.
    """

    v_rel: Variable = Variable(unit="m/s", start=0.0, doc="relative velocity")

    def equations(self) -> Equations:
        yield from super().equations()
        yield from self.velocity()

    def velocity(self) -> Equations:
        """What gives `v_rel`."""
        yield self.v_rel == der(self.flange_b.s) - der(self.flange_a.s)


class PartialCompliantWithRelativeStates(PartialCompliantWithVelocity, partial=True):
    """Compliant element whose relative position and velocity ``v_rel = ds_rel/dt`` are wanted as states.

    They have the size `s_nominal`, which the error control of long shafts and stiff springs needs. Where an impulse
    resets one side, the states keep the relative velocity, and the other side moves along. `stateSelect="default"`
    leaves the choice to the compiler.

    Source: Modelica.Mechanics.Translational.Interfaces.PartialCompliantWithRelativeStates.
    """

    stateSelect: str = "prefer"
    s_nominal: Parameter = Parameter(1e-4, unit="m", evaluate=True, doc="typical size of s_rel")
    s_rel: Variable = Variable(
        unit="m", start=0.0, state_select=structural("stateSelect"), nominal=s_nominal,
        doc="relative position, flange_b.s - flange_a.s",
    )  # fmt: skip
    v_rel: Variable = Variable(
        unit="m/s", start=0.0, state_select=structural("stateSelect"), doc="relative velocity"
    )

    def velocity(self) -> Equations:
        yield self.v_rel == der(self.s_rel)


class PartialRigid(PartialTwoFlanges, partial=True):
    """Two flanges rigidly joined at distance `L`: ``flange_a.s = s - L/2``, ``flange_b.s = s + L/2``.

    Source: Modelica.Mechanics.Translational.Interfaces.PartialRigid.
    """

    L: Parameter = Parameter(0.0, unit="m", doc="length from flange a to flange b")
    s: Variable = Variable(unit="m", doc="position of the centre")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange_a.s == self.s - self.L / 2
        yield self.flange_b.s == self.s + self.L / 2


class PartialSupport(Component, partial=True):
    """A flange `support` for the reaction force with `useSupport`, otherwise the fixed housing.

    Subclasses measure positions against `s_support` and yield ``supported(f)`` with the force of the support.

    Source: Modelica.Mechanics.Translational.Interfaces.PartialElementaryOneFlangeAndSupport2.
    """

    useSupport: bool = False
    support: Flange = conditional(Flange(), "useSupport")

    @property
    def s_support(self) -> Expr | float:
        """Position of the support [m]."""
        return self.support.s if self.useSupport else 0.0

    def supported(self, reaction: Expr) -> Equations:
        """Equations of the support, whose force is `reaction`."""
        if self.useSupport:
            yield self.support.f == reaction


class PartialOneFlangeAndSupport(PartialSupport, partial=True):
    """One flange and a support, ``s = flange.s - support.s``, ``support.f = -flange.f``.

    Source: Modelica.Mechanics.Translational.Interfaces.PartialElementaryOneFlangeAndSupport2.
    """

    flange: Flange = Flange()
    s: Variable = Variable(unit="m", doc="position of the flange relative to the support")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.s == self.flange.s - self.s_support
        yield from self.supported(-self.flange.f)


class PartialTwoFlangesAndSupport(PartialSupport, PartialTwoFlanges, partial=True):
    """Two flanges and a support that takes the sum of their forces, ``s_a = flange_a.s - support.s``, likewise `s_b`.

    Source: Modelica.Mechanics.Translational.Interfaces.PartialElementaryTwoFlangesAndSupport2.
    """

    s_a: Variable = Variable(unit="m", doc="position of flange a relative to the support")
    s_b: Variable = Variable(unit="m", doc="position of flange b relative to the support")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.s_a == self.flange_a.s - self.s_support
        yield self.s_b == self.flange_b.s - self.s_support
        yield from self.supported(-self.flange_a.f - self.flange_b.f)


class PartialAbsoluteSensor(Component, partial=True):
    """Measurement at one flange; takes no force.

    Source: Modelica.Mechanics.Translational.Interfaces.PartialAbsoluteSensor.
    """

    flange: Flange = Flange()

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange.f == 0


class PartialRelativeSensor(PartialTwoFlanges, partial=True):
    """Measurement between two flanges; takes no force.

    Source: Modelica.Mechanics.Translational.Interfaces.PartialRelativeSensor.
    """

    s_rel: Output = Output(unit="m", doc="relative position, flange_b.s - flange_a.s")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.s_rel == self.flange_b.s - self.flange_a.s
        yield self.flange_a.f == 0
        yield self.flange_b.f == 0
