"""Analog electrical circuits (Modelica Standard Library 4.0, `Modelica.Electrical.Analog`).

Every circuit needs a `Ground`. The current of a pin is positive into the component.
"""

from __future__ import annotations

import acausal as ac
from acausal import (
    PI,
    Component,
    Connector,
    Equations,
    Flow,
    Input,
    Output,
    Parameter,
    Potential,
    Variable,
    der,
    sin,
    where,
)

from . import rotational


class Pin(Connector):
    """Point where current can cross a component's boundary.

    Source: Modelica.Electrical.Analog.Interfaces.Pin.
    """

    v: Potential = Potential(unit="V", doc="potential")
    i: Flow = Flow(unit="A", doc="current into the component")


class TwoPin(Component, partial=True):
    """Two pins and the voltage between them, ``v = p.v - n.v``.

    Source: Modelica.Electrical.Analog.Interfaces.TwoPin.
    """

    p: Pin = Pin()
    n: Pin = Pin()
    v: Variable = Variable(unit="V", doc="voltage from p to n")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v == self.p.v - self.n.v


class OnePort(TwoPin, partial=True):
    """Two pins through which one current flows, ``i = p.i = -n.i``.

    Source: Modelica.Electrical.Analog.Interfaces.OnePort.
    """

    i: Variable = Variable(unit="A", doc="current from p to n through the component")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.i == self.p.i
        yield self.p.i + self.n.i == 0


class Ground(Component):
    """Zero potential, ``p.v = 0``.

    Source: Modelica.Electrical.Analog.Basic.Ground.
    """

    p: Pin = Pin()

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.p.v == 0


class Resistor(OnePort):
    """Ideal linear resistor, ``v = R i``.

    Source: Modelica.Electrical.Analog.Basic.Resistor.
    """

    R: Parameter = Parameter(1.0, unit="ohm", doc="resistance")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v == self.R * self.i


class Conductor(OnePort):
    """Ideal linear conductor, ``i = G v``.

    Source: Modelica.Electrical.Analog.Basic.Conductor.
    """

    G: Parameter = Parameter(1.0, unit="S", doc="conductance")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.i == self.G * self.v


class VariableResistor(OnePort):
    """Resistor whose resistance is a signal, ``v = R i``.

    Source: Modelica.Electrical.Analog.Basic.VariableResistor.
    """

    R: Input = Input(unit="ohm", doc="resistance")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v == self.R * self.i


class Capacitor(OnePort):
    """Ideal linear capacitor, ``i = C dv/dt``.

    Source: Modelica.Electrical.Analog.Basic.Capacitor.
    """

    C: Parameter = Parameter(1.0, unit="F", min=0.0, doc="capacitance")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.C * der(self.v) == self.i


class Inductor(OnePort):
    """Ideal linear inductor, ``v = L di/dt``.

    Source: Modelica.Electrical.Analog.Basic.Inductor.
    """

    L: Parameter = Parameter(1.0, unit="H", min=0.0, doc="inductance")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.L * der(self.i) == self.v


class Diode(OnePort):
    """Shockley diode with a parallel resistance, ``i = Ids (exp(v/Vt) - 1) + v/R``, linear beyond ``v/Vt =
    max_exponent``.

    Source: Modelica.Electrical.Analog.Semiconductors.Diode.
    """

    Ids: Parameter = Parameter(1e-6, unit="A", min=0.0, doc="saturation current")
    Vt: Parameter = Parameter(0.04, unit="V", min=1e-30, doc="voltage equivalent of temperature")
    max_exponent: Parameter = Parameter(15.0, unit="1", doc="exponent from which on the characteristic is linear")
    R: Parameter = Parameter(1e8, unit="ohm", doc="parallel resistance")

    def equations(self) -> Equations:
        yield from super().equations()
        exponent = self.v / self.Vt
        limited = ac.min(exponent, self.max_exponent)
        slope = 1 + ac.max(exponent - self.max_exponent, 0.0)
        yield self.i == self.Ids * (ac.exp(limited) * slope - 1) + self.v / self.R


class IdealTransformer(Component):
    """Ideal transformer, ``v1 = n v2``, ``i2 = -n i1`` (holds at zero frequency too).

    Source: Modelica.Electrical.Analog.Ideal.IdealTransformer without magnetization.
    """

    p1: Pin = Pin()
    n1: Pin = Pin()
    p2: Pin = Pin()
    n2: Pin = Pin()
    n: Parameter = Parameter(1.0, unit="1", doc="turns ratio primary to secondary")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.p1.i + self.n1.i == 0
        yield self.p2.i + self.n2.i == 0
        yield self.p1.v - self.n1.v == self.n * (self.p2.v - self.n2.v)
        yield self.p2.i == -self.n * self.p1.i


class RotationalEMF(OnePort):
    """Electric motor or generator, ``v = k w``, torque on the shaft ``tau = k i``.

    Source: Modelica.Electrical.Analog.Basic.RotationalEMF without support.
    """

    k: Parameter = Parameter(1.0, unit="V*s/rad", doc="transformation coefficient")
    flange: rotational.Flange = rotational.Flange()
    w: Variable = Variable(unit="rad/s", doc="angular velocity of the shaft")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.w == der(self.flange.phi)
        yield self.v == self.k * self.w
        yield self.flange.tau == -self.k * self.i


class VoltageSource(OnePort, partial=True):
    """Voltage source; subclasses say ``v``.

    Source: Modelica.Electrical.Analog.Interfaces.VoltageSource.
    """

    offset: Parameter = Parameter(0.0, unit="V", doc="voltage added to the signal")
    startTime: Parameter = Parameter(0.0, unit="s", doc="time at which the signal begins")


class ConstantVoltage(OnePort):
    """Constant voltage, ``v = V``.

    Source: Modelica.Electrical.Analog.Sources.ConstantVoltage.
    """

    V: Parameter = Parameter(1.0, unit="V", doc="voltage")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v == self.V


class StepVoltage(VoltageSource):
    """Voltage step, ``v = offset``, from `startTime` on ``offset + V``.

    Source: Modelica.Electrical.Analog.Sources.StepVoltage.
    """

    V: Parameter = Parameter(1.0, unit="V", doc="height of the step")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v == self.offset + where(ac.time >= self.startTime, self.V, 0.0)


class SineVoltage(VoltageSource):
    """Sine voltage, ``v = offset + V sin(2 pi f (t - startTime) + phase)``, and `offset` before `startTime`.

    Source: Modelica.Electrical.Analog.Sources.SineVoltage.
    """

    V: Parameter = Parameter(1.0, unit="V", doc="amplitude")
    f: Parameter = Parameter(1.0, unit="Hz", doc="frequency")
    phase: Parameter = Parameter(0.0, unit="rad", doc="phase")

    def equations(self) -> Equations:
        yield from super().equations()
        wave = self.V * sin(2 * PI * self.f * (ac.time - self.startTime) + self.phase)
        yield self.v == self.offset + where(ac.time < self.startTime, 0.0, wave)


class RampVoltage(VoltageSource):
    """Voltage ramp of height `V` that lasts `duration`.

    Source: Modelica.Electrical.Analog.Sources.RampVoltage.
    """

    V: Parameter = Parameter(1.0, unit="V", doc="height of the ramp")
    duration: Parameter = Parameter(2.0, unit="s", min=1e-30, doc="duration of the ramp")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v == self.offset + self.V * ac.clip((ac.time - self.startTime) / self.duration, 0.0, 1.0)


class SignalVoltage(TwoPin):
    """Voltage given by a signal, ``p.v - n.v = v``.

    Source: Modelica.Electrical.Analog.Sources.SignalVoltage.
    """

    u: Input = Input(doc="voltage wanted [V]")
    i: Variable = Variable(unit="A", doc="current from p to n through the source")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.i == self.p.i
        yield self.p.i + self.n.i == 0
        yield self.v == self.u


class ConstantCurrent(OnePort):
    """Constant current from p to n through the source, ``i = I``.

    Source: Modelica.Electrical.Analog.Sources.ConstantCurrent.
    """

    I: Parameter = Parameter(1.0, unit="A", doc="current")  # noqa: E741

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.i == self.I


class StepCurrent(OnePort):
    """Current step, ``i = offset``, from `startTime` on ``offset + I``.

    Source: Modelica.Electrical.Analog.Sources.StepCurrent.
    """

    I: Parameter = Parameter(1.0, unit="A", doc="height of the step")  # noqa: E741
    offset: Parameter = Parameter(0.0, unit="A", doc="current before the step")
    startTime: Parameter = Parameter(0.0, unit="s", doc="time of the step")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.i == self.offset + where(ac.time >= self.startTime, self.I, 0.0)


class SineCurrent(OnePort):
    """Sine current, ``i = offset + I sin(2 pi f (t - startTime) + phase)``, and `offset` before `startTime`.

    Source: Modelica.Electrical.Analog.Sources.SineCurrent.
    """

    I: Parameter = Parameter(1.0, unit="A", doc="amplitude")  # noqa: E741
    f: Parameter = Parameter(1.0, unit="Hz", doc="frequency")
    phase: Parameter = Parameter(0.0, unit="rad", doc="phase")
    offset: Parameter = Parameter(0.0, unit="A", doc="current added to the sine")
    startTime: Parameter = Parameter(0.0, unit="s", doc="time at which the sine begins")

    def equations(self) -> Equations:
        yield from super().equations()
        wave = self.I * sin(2 * PI * self.f * (ac.time - self.startTime) + self.phase)
        yield self.i == self.offset + where(ac.time < self.startTime, 0.0, wave)


class SignalCurrent(OnePort):
    """Current given by a signal, from p to n through the source, ``i = u``.

    Source: Modelica.Electrical.Analog.Sources.SignalCurrent.
    """

    u: Input = Input(doc="current wanted [A]")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.i == self.u


class VoltageSensor(Component):
    """Voltage between two pins, ``y = p.v - n.v``; no current.

    Source: Modelica.Electrical.Analog.Sensors.VoltageSensor.
    """

    p: Pin = Pin()
    n: Pin = Pin()
    y: Output = Output(unit="V", doc="voltage from p to n")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.p.i == 0
        yield self.n.i == 0
        yield self.y == self.p.v - self.n.v


class CurrentSensor(Component):
    """Current of a branch, ``y = p.i``; no voltage drop.

    Source: Modelica.Electrical.Analog.Sensors.CurrentSensor.
    """

    p: Pin = Pin()
    n: Pin = Pin()
    y: Output = Output(unit="A", doc="current from p to n")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.p.v == self.n.v
        yield self.p.i + self.n.i == 0
        yield self.y == self.p.i
