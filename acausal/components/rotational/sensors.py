"""Ideal measurement of angles, speeds, accelerations, torques and power."""

from __future__ import annotations

from acausal import Equations, Output, Variable, der

from .interfaces import PartialAbsoluteSensor, PartialRelativeSensor, PartialTwoFlanges


class AngleSensor(PartialAbsoluteSensor):
    """Angle of a flange, ``phi = flange.phi``; takes no torque.

    >>> model = assemble("wall.flange - meter.flange", wall=Fixed(phi0=0.5), meter=AngleSensor())
    >>> run(model)["meter.phi"][-1]
    0.5

    Source: Modelica.Mechanics.Rotational.Sensors.AngleSensor.
    """

    phi: Output = Output(unit="rad", doc="angle of the flange")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.phi == self.flange.phi


class SpeedSensor(PartialAbsoluteSensor):
    """Angular velocity of a flange, ``w = d(flange.phi)/dt``; takes no torque.

    >>> model = assemble("lead.flange - meter.flange", lead=ConstantSpeed(w_fixed=2.0), meter=SpeedSensor())
    >>> run(model)["meter.w"][-1]
    2.0

    Source: Modelica.Mechanics.Rotational.Sensors.SpeedSensor.
    """

    w: Output = Output(unit="rad/s", doc="angular velocity of the flange")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.w == der(self.flange.phi)


class AccSensor(PartialAbsoluteSensor):
    """Angular acceleration of a flange, ``a = d2(flange.phi)/dt2``; takes no torque.

    >>> model = assemble("drive.flange - rotor.flange_a", "rotor.flange_b - meter.flange", meter=AccSensor(),
    ...                  drive=ConstantTorque(tau_constant=4.0), rotor=Inertia(J=2.0))
    >>> run(model)["meter.a"][-1]
    2.0

    Source: Modelica.Mechanics.Rotational.Sensors.AccSensor.
    """

    w: Variable = Variable(unit="rad/s", doc="angular velocity of the flange")
    a: Output = Output(unit="rad/s2", doc="angular acceleration of the flange")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.w == der(self.flange.phi)
        yield self.a == der(self.w)


class RelAngleSensor(PartialRelativeSensor):
    """Relative angle, ``phi_rel = flange_b.phi - flange_a.phi``; takes no torque.

    >>> model = assemble("one.flange - meter.flange_a", "two.flange - meter.flange_b", one=Fixed(phi0=0.5),
    ...                  two=Fixed(phi0=2.0), meter=RelAngleSensor())
    >>> run(model)["meter.phi_rel"][-1]
    1.5

    Source: Modelica.Mechanics.Rotational.Sensors.RelAngleSensor.
    """


class RelSpeedSensor(PartialRelativeSensor):
    """Relative angular velocity, ``w_rel = d(flange_b.phi - flange_a.phi)/dt``; takes no torque.

    >>> model = assemble("one.flange - meter.flange_a", "two.flange - meter.flange_b", meter=RelSpeedSensor(),
    ...                  one=ConstantSpeed(w_fixed=2.0), two=ConstantSpeed(w_fixed=5.0))
    >>> run(model)["meter.w_rel"][-1]
    3.0

    Source: Modelica.Mechanics.Rotational.Sensors.RelSpeedSensor.
    """

    w_rel: Output = Output(unit="rad/s", doc="relative angular velocity")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.w_rel == der(self.phi_rel)


class RelAccSensor(PartialRelativeSensor):
    """Relative angular acceleration, ``a_rel = d2(flange_b.phi - flange_a.phi)/dt2``; takes no torque.

    >>> model = assemble("drive.flange - rotor.flange_a", "rotor.flange_b - meter.flange_b",
    ...                  "wall.flange - meter.flange_a", drive=ConstantTorque(tau_constant=4.0),
    ...                  rotor=Inertia(J=2.0), wall=Fixed(), meter=RelAccSensor())
    >>> run(model)["meter.a_rel"][-1]
    2.0

    Source: Modelica.Mechanics.Rotational.Sensors.RelAccSensor.
    """

    w_rel: Variable = Variable(unit="rad/s", doc="relative angular velocity")
    a_rel: Output = Output(unit="rad/s2", doc="relative angular acceleration")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.w_rel == der(self.phi_rel)
        yield self.a_rel == der(self.w_rel)


class TorqueSensor(PartialTwoFlanges):
    """Torque between two flanges that turn together, ``tau = flange_a.tau``.

    >>> model = assemble("drive.flange - meter.flange_a", "meter.flange_b - rotor.flange_a", meter=TorqueSensor(),
    ...                  drive=ConstantTorque(tau_constant=4.0), rotor=Inertia(J=2.0))
    >>> run(model)["meter.tau"][-1]
    4.0

    Source: Modelica.Mechanics.Rotational.Sensors.TorqueSensor.
    """

    tau: Output = Output(unit="N*m", doc="torque through the sensor, flange_a.tau")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange_a.phi == self.flange_b.phi
        yield self.flange_a.tau + self.flange_b.tau == 0
        yield self.tau == self.flange_a.tau


class PowerSensor(PartialTwoFlanges):
    """Power between two flanges that turn together, ``power = flange_a.tau d(flange_a.phi)/dt``.

    >>> model = assemble("drive.flange - meter.flange_a", "meter.flange_b - rotor.flange_a", meter=PowerSensor(),
    ...                  drive=ConstantTorque(tau_constant=4.0), rotor=Inertia(J=2.0, w=start(0.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["meter.power"], [4.0, 8.0])
    True

    Source: Modelica.Mechanics.Rotational.Sensors.PowerSensor.
    """

    power: Output = Output(unit="W", doc="power from flange a to flange b")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange_a.phi == self.flange_b.phi
        yield self.flange_a.tau + self.flange_b.tau == 0
        yield self.power == self.flange_a.tau * der(self.flange_a.phi)


class MultiSensor(PartialTwoFlanges):
    """Speed, torque and power between two flanges that turn together, ``power = tau w``.

    >>> model = assemble("drive.flange - meter.flange_a", "meter.flange_b - rotor.flange_a", meter=MultiSensor(),
    ...                  drive=ConstantTorque(tau_constant=4.0), rotor=Inertia(J=2.0, w=start(0.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["meter.power"], [4.0, 8.0])
    True

    Source: Modelica.Mechanics.Rotational.Sensors.MultiSensor.
    """

    w: Output = Output(unit="rad/s", doc="angular velocity")
    tau: Output = Output(unit="N*m", doc="torque through the sensor, flange_a.tau")
    power: Output = Output(unit="W", doc="power from flange a to flange b")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange_a.phi == self.flange_b.phi
        yield self.flange_a.tau + self.flange_b.tau == 0
        yield self.w == der(self.flange_a.phi)
        yield self.tau == self.flange_a.tau
        yield self.power == self.tau * self.w
