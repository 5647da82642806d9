"""Ideal measurement of potentials, voltages, currents and power."""

from __future__ import annotations

from acausal import Component, Equations, Output

from .interfaces import Pin


class PotentialSensor(Component):
    """Potential of a pin, ``phi = p.v``; no current.

    >>> model = assemble("source.p - meter.p", "source.n - ground.p", source=ConstantVoltage(V=2.0), ground=Ground(),
    ...                  meter=PotentialSensor())
    >>> run(model)["meter.phi"][-1]
    2.0

    Source: Modelica.Electrical.Analog.Sensors.PotentialSensor.
    """

    p: Pin = Pin()
    phi: Output = Output(unit="V", doc="potential of the pin")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.p.i == 0
        yield self.phi == self.p.v


class VoltageSensor(Component):
    """Voltage between two pins, ``v = p.v - n.v``; no current.

    >>> model = assemble("source.p - meter.p", "source.n - meter.n - ground.p", source=ConstantVoltage(V=2.0),
    ...                  ground=Ground(), meter=VoltageSensor())
    >>> run(model)["meter.v"][-1]
    2.0

    Source: Modelica.Electrical.Analog.Sensors.VoltageSensor.
    """

    p: Pin = Pin()
    n: Pin = Pin()
    v: Output = Output(unit="V", doc="voltage from p to n")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.p.i == 0
        yield self.n.i == 0
        yield self.v == self.p.v - self.n.v


class CurrentSensor(Component):
    """Current of a branch, ``i = p.i``; no voltage drop.

    >>> model = assemble("source.p - meter.p", "meter.n - load.p", "source.n - load.n - ground.p", ground=Ground(),
    ...                  source=ConstantVoltage(V=2.0), meter=CurrentSensor(), load=Resistor(R=4.0))
    >>> run(model)["meter.i"][-1]
    0.5

    Source: Modelica.Electrical.Analog.Sensors.CurrentSensor.
    """

    p: Pin = Pin()
    n: Pin = Pin()
    i: Output = Output(unit="A", doc="current from p to n")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.p.v == self.n.v
        yield self.p.i + self.n.i == 0
        yield self.i == self.p.i


class PowerSensor(Component):
    """Power of a branch, ``power = (pv.v - nv.v) pc.i``; current path from `pc` to `nc`, voltage path `pv` to `nv`.

    >>> model = assemble("source.p - meter.pc - meter.pv", "meter.nc - load.p",
    ...                  "source.n - load.n - meter.nv - ground.p",
    ...                  source=ConstantVoltage(V=2.0), meter=PowerSensor(), load=Resistor(R=4.0), ground=Ground())
    >>> run(model)["meter.power"][-1]
    1.0

    Source: Modelica.Electrical.Analog.Sensors.PowerSensor.
    """

    pc: Pin = Pin()
    nc: Pin = Pin()
    pv: Pin = Pin()
    nv: Pin = Pin()
    power: Output = Output(unit="W", doc="power")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.pc.v == self.nc.v
        yield self.pc.i + self.nc.i == 0
        yield self.pv.i == 0
        yield self.nv.i == 0
        yield self.power == (self.pv.v - self.nv.v) * self.pc.i


class MultiSensor(Component):
    """Current, voltage and power of a branch, ``v = pv.v - nv.v``, ``i = pc.i``, ``power = v i``.

    >>> model = assemble("source.p - meter.pc - meter.pv", "meter.nc - load.p",
    ...                  "source.n - load.n - meter.nv - ground.p",
    ...                  source=ConstantVoltage(V=2.0), meter=MultiSensor(), load=Resistor(R=4.0), ground=Ground())
    >>> meter = run(model)
    >>> meter["meter.v"][-1], meter["meter.i"][-1], meter["meter.power"][-1]
    (2.0, 0.5, 1.0)

    Source: Modelica.Electrical.Analog.Sensors.MultiSensor.
    """

    pc: Pin = Pin()
    nc: Pin = Pin()
    pv: Pin = Pin()
    nv: Pin = Pin()
    v: Output = Output(unit="V", doc="voltage from pv to nv")
    i: Output = Output(unit="A", doc="current from pc to nc")
    power: Output = Output(unit="W", doc="power")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.pc.v == self.nc.v
        yield self.pc.i + self.nc.i == 0
        yield self.pv.i == 0
        yield self.nv.i == 0
        yield self.v == self.pv.v - self.nv.v
        yield self.i == self.pc.i
        yield self.power == self.v * self.i
