"""Ideal measurement of positions, speeds, accelerations, forces and power."""

from __future__ import annotations

from acausal import Equations, Output, Variable, der

from .interfaces import PartialAbsoluteSensor, PartialRelativeSensor, PartialTwoFlanges


class PositionSensor(PartialAbsoluteSensor):
    """Position of a flange, ``s = flange.s``; takes no force.

    >>> model = assemble("wall.flange - meter.flange", wall=Fixed(s0=0.5), meter=PositionSensor())
    >>> run(model)["meter.s"][-1]
    0.5

    Source: Modelica.Mechanics.Translational.Sensors.PositionSensor.
    """

    s: Output = Output(unit="m", doc="position of the flange")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.s == self.flange.s


class SpeedSensor(PartialAbsoluteSensor):
    """Velocity of a flange, ``v = d(flange.s)/dt``; takes no force.

    >>> model = assemble("lead.flange - meter.flange", lead=ConstantSpeed(v_fixed=2.0), meter=SpeedSensor())
    >>> run(model)["meter.v"][-1]
    2.0

    Source: Modelica.Mechanics.Translational.Sensors.SpeedSensor.
    """

    v: Output = Output(unit="m/s", doc="velocity of the flange")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v == der(self.flange.s)


class AccSensor(PartialAbsoluteSensor):
    """Acceleration of a flange, ``a = d2(flange.s)/dt2``; takes no force.

    >>> model = assemble("drive.flange - mass.flange_a", "mass.flange_b - meter.flange", meter=AccSensor(),
    ...                  drive=ConstantForce(f_constant=4.0), mass=Mass(m=2.0))
    >>> run(model)["meter.a"][-1]
    2.0

    Source: Modelica.Mechanics.Translational.Sensors.AccSensor.
    """

    v: Variable = Variable(unit="m/s", doc="velocity of the flange")
    a: Output = Output(unit="m/s2", doc="acceleration of the flange")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v == der(self.flange.s)
        yield self.a == der(self.v)


class RelPositionSensor(PartialRelativeSensor):
    """Relative position, ``s_rel = flange_b.s - flange_a.s``; takes no force.

    >>> model = assemble("one.flange - meter.flange_a", "two.flange - meter.flange_b", one=Fixed(s0=0.5),
    ...                  two=Fixed(s0=2.0), meter=RelPositionSensor())
    >>> run(model)["meter.s_rel"][-1]
    1.5

    Source: Modelica.Mechanics.Translational.Sensors.RelPositionSensor.
    """


class RelSpeedSensor(PartialRelativeSensor):
    """Relative velocity, ``v_rel = d(flange_b.s - flange_a.s)/dt``; takes no force.

    >>> model = assemble("one.flange - meter.flange_a", "two.flange - meter.flange_b", meter=RelSpeedSensor(),
    ...                  one=ConstantSpeed(v_fixed=2.0), two=ConstantSpeed(v_fixed=5.0))
    >>> run(model)["meter.v_rel"][-1]
    3.0

    Source: Modelica.Mechanics.Translational.Sensors.RelSpeedSensor.
    """

    v_rel: Output = Output(unit="m/s", doc="relative velocity")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v_rel == der(self.s_rel)


class RelAccSensor(PartialRelativeSensor):
    """Relative acceleration, ``a_rel = d2(flange_b.s - flange_a.s)/dt2``; takes no force.

    >>> model = assemble("drive.flange - mass.flange_a", "mass.flange_b - meter.flange_b",
    ...                  "wall.flange - meter.flange_a", drive=ConstantForce(f_constant=4.0),
    ...                  mass=Mass(m=2.0), wall=Fixed(), meter=RelAccSensor())
    >>> run(model)["meter.a_rel"][-1]
    2.0

    Source: Modelica.Mechanics.Translational.Sensors.RelAccSensor.
    """

    v_rel: Variable = Variable(unit="m/s", doc="relative velocity")
    a_rel: Output = Output(unit="m/s2", doc="relative acceleration")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v_rel == der(self.s_rel)
        yield self.a_rel == der(self.v_rel)


class ForceSensor(PartialTwoFlanges):
    """Force between two flanges that move together, ``f = flange_a.f``.

    >>> model = assemble("drive.flange - meter.flange_a", "meter.flange_b - mass.flange_a", meter=ForceSensor(),
    ...                  drive=ConstantForce(f_constant=4.0), mass=Mass(m=2.0))
    >>> run(model)["meter.f"][-1]
    4.0

    Source: Modelica.Mechanics.Translational.Sensors.ForceSensor.
    """

    f: Output = Output(unit="N", doc="force through the sensor, flange_a.f")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange_a.s == self.flange_b.s
        yield self.flange_a.f + self.flange_b.f == 0
        yield self.f == self.flange_a.f


class PowerSensor(PartialTwoFlanges):
    """Power between two flanges that move together, ``power = flange_a.f d(flange_a.s)/dt``.

    >>> model = assemble("drive.flange - meter.flange_a", "meter.flange_b - mass.flange_a", meter=PowerSensor(),
    ...                  drive=ConstantForce(f_constant=4.0), mass=Mass(m=2.0, v=start(0.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["meter.power"], [4.0, 8.0])
    True

    Source: Modelica.Mechanics.Translational.Sensors.PowerSensor.
    """

    power: Output = Output(unit="W", doc="power from flange a to flange b")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange_a.s == self.flange_b.s
        yield self.flange_a.f + self.flange_b.f == 0
        yield self.power == self.flange_a.f * der(self.flange_a.s)


class MultiSensor(PartialTwoFlanges):
    """Speed, force and power between two flanges that move together, ``power = f v``.

    >>> model = assemble("drive.flange - meter.flange_a", "meter.flange_b - mass.flange_a", meter=MultiSensor(),
    ...                  drive=ConstantForce(f_constant=4.0), mass=Mass(m=2.0, v=start(0.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["meter.power"], [4.0, 8.0])
    True

    Source: Modelica.Mechanics.Translational.Sensors.MultiSensor.
    """

    v: Output = Output(unit="m/s", doc="velocity")
    f: Output = Output(unit="N", doc="force through the sensor, flange_a.f")
    power: Output = Output(unit="W", doc="power from flange a to flange b")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange_a.s == self.flange_b.s
        yield self.flange_a.f + self.flange_b.f == 0
        yield self.v == der(self.flange_a.s)
        yield self.f == self.flange_a.f
        yield self.power == self.f * self.v
