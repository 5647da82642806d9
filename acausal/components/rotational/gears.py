"""Gears without inertia, and the conversion into translation."""

from __future__ import annotations

from acausal import Component, Equations, Parameter, Variable, conditional

from ..translational.interfaces import Flange as TranslationalFlange
from .interfaces import Flange, PartialTwoFlangesAndSupport


class IdealGear(PartialTwoFlangesAndSupport):
    """Gear without inertia or losses, ``phi_a = ratio phi_b`` against the support, ``0 = ratio flange_a.tau +
    flange_b.tau``.

    >>> model = assemble("drive.flange - gear.flange_a", "gear.flange_b - load.flange_a", gear=IdealGear(ratio=3.0),
    ...                  drive=ConstantTorque(tau_constant=2.0),
    ...                  load=Inertia(J=4.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["load.w"], [0.75, 1.5])
    True

    Source: Modelica.Mechanics.Rotational.Components.IdealGear.
    """

    ratio: Parameter = Parameter(1.0, unit="1", doc="transmission ratio flange_a.phi / flange_b.phi")
    phi_a: Variable = Variable(unit="rad", doc="angle between flange a and the support")
    phi_b: Variable = Variable(unit="rad", doc="angle between flange b and the support")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.phi_a == self.flange_a.phi - self.phi_support
        yield self.phi_b == self.flange_b.phi - self.phi_support
        yield self.phi_a == self.ratio * self.phi_b
        yield self.ratio * self.flange_a.tau + self.flange_b.tau == 0


class IdealPlanetary(Component):
    """Planetary gear without inertia or losses, ``(1 + ratio) carrier.phi = sun.phi + ratio ring.phi``.

    ``ring.tau = ratio sun.tau``, ``carrier.tau = -(1 + ratio) sun.tau``; `ratio` is teeth of the ring over teeth of the
    sun.

    >>> model = assemble("drive.flange - gear.sun", "gear.ring - wall.flange", "gear.carrier - load.flange_a",
    ...                  gear=IdealPlanetary(ratio=2.0), wall=Fixed(), drive=ConstantTorque(tau_constant=2.0),
    ...                  load=Inertia(J=4.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["load.w"], [0.75, 1.5])
    True

    Source: Modelica.Mechanics.Rotational.Components.IdealPlanetary.
    """

    sun: Flange = Flange()
    carrier: Flange = Flange()
    ring: Flange = Flange()
    ratio: Parameter = Parameter(2.0, unit="1", doc="number of teeth of the ring over that of the sun")

    def equations(self) -> Equations:
        yield from super().equations()
        yield (1 + self.ratio) * self.carrier.phi == self.sun.phi + self.ratio * self.ring.phi
        yield self.ring.tau == self.ratio * self.sun.tau
        yield self.carrier.tau == -(1 + self.ratio) * self.sun.tau


class PartialRotationalToTranslational(Component, partial=True):
    """A rotational and a translational flange, each with a support or on the fixed housing.

    Source: Modelica.Mechanics.Rotational.Interfaces.PartialElementaryRotationalToTranslational.
    """

    useSupportR: bool = False
    useSupportT: bool = False
    flangeR: Flange = Flange()
    flangeT: TranslationalFlange = TranslationalFlange()
    supportR: Flange = conditional(Flange(), "useSupportR")
    supportT: TranslationalFlange = conditional(TranslationalFlange(), "useSupportT")
    phi: Variable = Variable(unit="rad", doc="angle of flangeR relative to its support")
    s: Variable = Variable(unit="m", doc="position of flangeT relative to its support")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.phi == self.flangeR.phi - (self.supportR.phi if self.useSupportR else 0.0)
        yield self.s == self.flangeT.s - (self.supportT.s if self.useSupportT else 0.0)
        if self.useSupportR:
            yield self.supportR.tau == -self.flangeR.tau
        if self.useSupportT:
            yield self.supportT.f == -self.flangeT.f


class IdealGearR2T(PartialRotationalToTranslational):
    """Rack and pinion, ``phi = ratio s``, ``0 = ratio flangeR.tau + flangeT.f``.

    >>> model = assemble("drive.flange - rack.flangeR", "rack.flangeT - mass.flange_a", rack=IdealGearR2T(ratio=5.0),
    ...                  drive=ConstantTorque(tau_constant=2.0),
    ...                  mass=translational.Mass(m=4.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["mass.v"], [1.25, 2.5])
    True

    Source: Modelica.Mechanics.Rotational.Components.IdealGearR2T.
    """

    ratio: Parameter = Parameter(1.0, unit="rad/m", doc="transmission ratio flangeR.phi / flangeT.s")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.phi == self.ratio * self.s
        yield self.ratio * self.flangeR.tau + self.flangeT.f == 0


class IdealRollingWheel(PartialRotationalToTranslational):
    """Wheel that rolls without slip, ``s = radius phi``, ``0 = radius flangeT.f + flangeR.tau``.

    >>> model = assemble("drive.flange - wheel.flangeR", "wheel.flangeT - mass.flange_a",
    ...                  wheel=IdealRollingWheel(radius=0.5), drive=ConstantTorque(tau_constant=2.0),
    ...                  mass=translational.Mass(m=4.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["mass.v"], [0.5, 1.0])
    True

    Source: Modelica.Mechanics.Rotational.Components.IdealRollingWheel.
    """

    radius: Parameter = Parameter(0.3, unit="m/rad", doc="radius of the wheel, the way per angle")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.s == self.radius * self.phi
        yield self.radius * self.flangeT.f + self.flangeR.tau == 0
