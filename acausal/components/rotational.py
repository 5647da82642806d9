"""One-dimensional rotational mechanics (Modelica Standard Library 4.0, `Modelica.Mechanics.Rotational`).

A flange has an angle `phi`, the same for all that is connected, and a torque `tau`, positive when it acts on the
component in the direction of increasing `phi`. Components with `use_support` take their reaction to the flange
`support`; without it they stand on the fixed housing.
"""

from __future__ import annotations

from acausal import Component, Connector, Equations, Expr, Flow, Input, Output, Parameter, Potential, Variable, der

from . import translational


class Flange(Connector):
    """One-dimensional rotational flange.

    Source: Modelica.Mechanics.Rotational.Interfaces.Flange_a.
    """

    phi: Potential = Potential(unit="rad", doc="absolute angle")
    tau: Flow = Flow(unit="N*m", doc="cut torque acting on the component")


class PartialCompliant(Component, partial=True):
    """Two flanges, no inertia: ``phi_rel = flange_b.phi - flange_a.phi``, ``tau = flange_b.tau = -flange_a.tau``.

    Source: Modelica.Mechanics.Rotational.Interfaces.PartialCompliant.
    """

    flange_a: Flange = Flange()
    flange_b: Flange = Flange()
    phi_rel: Variable = Variable(unit="rad", doc="relative angle, flange_b.phi - flange_a.phi")
    tau: Variable = Variable(unit="N*m", doc="torque between the flanges")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.phi_rel == self.flange_b.phi - self.flange_a.phi
        yield self.flange_b.tau == self.tau
        yield self.flange_a.tau == -self.tau


class PartialCompliantWithVelocity(PartialCompliant, partial=True):
    """Compliant element that needs the relative velocity, ``w_rel = d(flange_b.phi)/dt - d(flange_a.phi)/dt``.

    Source: Modelica.Mechanics.Rotational.Interfaces.PartialCompliantWithRelativeStates, with the derivatives taken at
    the flanges, where they are derivatives of the states of the inertias.
    """

    w_rel: Variable = Variable(unit="rad/s", doc="relative angular velocity")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.w_rel == der(self.flange_b.phi) - der(self.flange_a.phi)


class PartialSupported(Component, partial=True):
    """A flange `support` for the reaction torque, or the fixed housing.

    Subclasses call ``supported(tau)`` with the torque that the support takes.

    Source: Modelica.Mechanics.Rotational.Interfaces.PartialElementaryOneFlangeAndSupport2.
    """

    use_support: bool = False
    support: Flange = Flange()

    def supported(self, reaction: Expr) -> Equations:
        """Equations of the support, whose torque is `reaction`."""
        if self.use_support:
            yield self.support.tau == reaction
        else:
            yield self.support.phi == 0


class Inertia(Component):
    """Rotating inertia, ``w = dphi/dt``, ``a = dw/dt``, ``J a = flange_a.tau + flange_b.tau``.

    Source: Modelica.Mechanics.Rotational.Components.Inertia.
    """

    flange_a: Flange = Flange()
    flange_b: Flange = Flange()
    J: Parameter = Parameter(1.0, unit="kg*m2", min=0.0, doc="moment of inertia")
    phi: Variable = Variable(unit="rad", doc="absolute angle")
    w: Variable = Variable(unit="rad/s", doc="absolute angular velocity")
    a: Variable = Variable(unit="rad/s2", doc="absolute angular acceleration")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.phi == self.flange_a.phi
        yield self.phi == self.flange_b.phi
        yield self.w == der(self.phi)
        yield self.a == der(self.w)
        yield self.J * self.a == self.flange_a.tau + self.flange_b.tau


class Fixed(Component):
    """Flange fixed in the housing at `phi0`, ``flange.phi = phi0``.

    Source: Modelica.Mechanics.Rotational.Components.Fixed.
    """

    flange: Flange = Flange()
    phi0: Parameter = Parameter(0.0, unit="rad", doc="angle")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange.phi == self.phi0


class Spring(PartialCompliant):
    """Linear torsion spring, ``tau = c (phi_rel - phi_rel0)``.

    Source: Modelica.Mechanics.Rotational.Components.Spring.
    """

    c: Parameter = Parameter(1e5, unit="N*m/rad", min=0.0, doc="spring constant")
    phi_rel0: Parameter = Parameter(0.0, unit="rad", doc="unstretched angle")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.tau == self.c * (self.phi_rel - self.phi_rel0)


class Damper(PartialCompliantWithVelocity):
    """Linear rotational damper, ``tau = d w_rel``; the power ``tau w_rel`` is lost.

    Source: Modelica.Mechanics.Rotational.Components.Damper.
    """

    d: Parameter = Parameter(1.0, unit="N*m*s/rad", min=0.0, doc="damping constant")
    lossPower: Variable = Variable(unit="W", doc="power lost")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.tau == self.d * self.w_rel
        yield self.lossPower == self.tau * self.w_rel


class SpringDamper(PartialCompliantWithVelocity):
    """Linear torsion spring and damper in parallel, ``tau = c (phi_rel - phi_rel0) + d w_rel``.

    Source: Modelica.Mechanics.Rotational.Components.SpringDamper.
    """

    c: Parameter = Parameter(1e5, unit="N*m/rad", min=0.0, doc="spring constant")
    d: Parameter = Parameter(1.0, unit="N*m*s/rad", min=0.0, doc="damping constant")
    phi_rel0: Parameter = Parameter(0.0, unit="rad", doc="unstretched angle")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.tau == self.c * (self.phi_rel - self.phi_rel0) + self.d * self.w_rel


class IdealGear(PartialSupported):
    """Gear without inertia or losses, ``phi_a = ratio phi_b`` against the support, ``0 = ratio flange_a.tau +
    flange_b.tau``.

    Source: Modelica.Mechanics.Rotational.Components.IdealGear.
    """

    flange_a: Flange = Flange()
    flange_b: Flange = Flange()
    ratio: Parameter = Parameter(1.0, unit="1", doc="transmission ratio flange_a.phi / flange_b.phi")
    phi_a: Variable = Variable(unit="rad", doc="angle between flange a and the support")
    phi_b: Variable = Variable(unit="rad", doc="angle between flange b and the support")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.phi_a == self.flange_a.phi - self.support.phi
        yield self.phi_b == self.flange_b.phi - self.support.phi
        yield self.phi_a == self.ratio * self.phi_b
        yield self.ratio * self.flange_a.tau + self.flange_b.tau == 0
        yield from self.supported(-self.flange_a.tau - self.flange_b.tau)


class IdealGearR2T(Component):
    """Rack and pinion on the fixed housing, ``phi = ratio s``, ``0 = ratio flange_r.tau + flange_t.f``.

    Source: Modelica.Mechanics.Rotational.Components.IdealGearR2T without supports.
    """

    flange_r: Flange = Flange()
    flange_t: translational.Flange = translational.Flange()
    ratio: Parameter = Parameter(1.0, unit="rad/m", doc="transmission ratio flange_r.phi / flange_t.s")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange_r.phi == self.ratio * self.flange_t.s
        yield self.ratio * self.flange_r.tau + self.flange_t.f == 0


class Torque(PartialSupported):
    """External torque given by a signal, in the direction of increasing phi: ``flange.tau = -tau``.

    Source: Modelica.Mechanics.Rotational.Sources.Torque.
    """

    flange: Flange = Flange()
    tau: Input = Input(doc="driving torque [N m]")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange.tau == -self.tau
        yield from self.supported(self.tau)


class Torque2(Component):
    """Torque between two flanges given by a signal: ``flange_a.tau = tau``, ``flange_b.tau = -tau``.

    Source: Modelica.Mechanics.Rotational.Sources.Torque2.
    """

    flange_a: Flange = Flange()
    flange_b: Flange = Flange()
    tau: Input = Input(doc="torque that drives b forward and a back [N m]")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange_a.tau == self.tau
        yield self.flange_b.tau == -self.tau


class ConstantTorque(Component):
    """Constant external torque, ``flange.tau = -tau_constant``.

    Source: Modelica.Mechanics.Rotational.Sources.ConstantTorque.
    """

    flange: Flange = Flange()
    tau_constant: Parameter = Parameter(1.0, unit="N*m", doc="driving torque")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange.tau == -self.tau_constant


class Position(Component):
    """Motion along a reference angle, ``flange.phi = phi_ref``; it must be differentiable where an inertia follows.

    Source: Modelica.Mechanics.Rotational.Sources.Position with exact = true.
    """

    flange: Flange = Flange()
    phi_ref: Input = Input(doc="reference angle [rad]")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange.phi == self.phi_ref


class Speed(Component):
    """Motion with a reference angular velocity, ``dphi/dt = w_ref``.

    Source: Modelica.Mechanics.Rotational.Sources.Speed with exact = true.
    """

    flange: Flange = Flange()
    w_ref: Input = Input(doc="reference angular velocity [rad/s]")
    phi: Variable = Variable(unit="rad", start=0.0, doc="angle of the flange")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.phi == self.flange.phi
        yield der(self.phi) == self.w_ref


class AngleSensor(Component):
    """Angle of a flange, ``phi = flange.phi``; takes no torque.

    Source: Modelica.Mechanics.Rotational.Sensors.AngleSensor.
    """

    flange: Flange = Flange()
    phi: Output = Output(unit="rad", doc="angle of the flange")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange.tau == 0
        yield self.phi == self.flange.phi


class SpeedSensor(Component):
    """Angular velocity of a flange, ``w = d(flange.phi)/dt``; takes no torque.

    Source: Modelica.Mechanics.Rotational.Sensors.SpeedSensor.
    """

    flange: Flange = Flange()
    w: Output = Output(unit="rad/s", doc="angular velocity of the flange")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange.tau == 0
        yield self.w == der(self.flange.phi)


class TorqueSensor(Component):
    """Torque between two flanges that turn together, ``tau = flange_a.tau``.

    Source: Modelica.Mechanics.Rotational.Sensors.TorqueSensor.
    """

    flange_a: Flange = Flange()
    flange_b: Flange = Flange()
    tau: Output = Output(unit="N*m", doc="torque through the sensor, flange_a.tau")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange_a.phi == self.flange_b.phi
        yield self.flange_a.tau + self.flange_b.tau == 0
        yield self.tau == self.flange_a.tau
