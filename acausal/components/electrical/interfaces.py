"""Pins and the bases of electrical components."""

from __future__ import annotations

from acausal import Component, Connector, Equations, Expr, Flow, Parameter, Potential, Variable, conditional

from .. import blocks, thermal


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


class TwoPort(Component, partial=True):
    """Two ports of two pins each: ``v1 = p1.v - n1.v``, ``i1 = p1.i = -n1.i``, and so for port 2.

    Source: Modelica.Electrical.Analog.Interfaces.TwoPort.
    """

    p1: Pin = Pin()
    n1: Pin = Pin()
    p2: Pin = Pin()
    n2: Pin = Pin()
    v1: Variable = Variable(unit="V", doc="voltage of the left port")
    v2: Variable = Variable(unit="V", doc="voltage of the right port")
    i1: Variable = Variable(unit="A", doc="current from p1 to n1")
    i2: Variable = Variable(unit="A", doc="current from p2 to n2")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v1 == self.p1.v - self.n1.v
        yield self.v2 == self.p2.v - self.n2.v
        yield self.i1 == self.p1.i
        yield self.i2 == self.p2.i
        yield self.p1.i + self.n1.i == 0
        yield self.p2.i + self.n2.i == 0


class ConditionalHeatPort(Component, partial=True):
    """Power loss, given to `heatPort` with `useHeatPort`; without it the device has the temperature `T`.

    Source: Modelica.Electrical.Analog.Interfaces.ConditionalHeatPort.
    """

    useHeatPort: bool = False
    heatPort: thermal.HeatPort = conditional(thermal.HeatPort(), "useHeatPort")
    T: Parameter = Parameter(293.15, unit="K", doc="temperature of the device without a heat port")
    LossPower: Variable = Variable(unit="W", doc="power lost as heat")

    T_heatPort: Variable = Variable(unit="K", doc="temperature of the device")

    @property
    def temperature(self) -> Expr:
        """`T_heatPort` as what it is equal to, for the equations of the device [K]."""
        return self.heatPort.T if self.useHeatPort else self.T

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.T_heatPort == self.temperature
        if self.useHeatPort:
            yield self.heatPort.Q_flow == -self.LossPower


class VoltageSource(OnePort, partial=True):
    """Voltage source whose voltage is the output of a `signalSource`, which subclasses choose.

    Source: Modelica.Electrical.Analog.Interfaces.VoltageSource.
    """

    offset: Parameter = Parameter(0.0, unit="V", doc="voltage added to the signal")
    startTime: Parameter = Parameter(0.0, unit="s", doc="time at which the signal begins")
    signalSource: blocks.SO = blocks.Step()

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v == self.signalSource.y


class CurrentSource(OnePort, partial=True):
    """Current source whose current from p to n is the output of a `signalSource`, which subclasses choose.

    Source: Modelica.Electrical.Analog.Interfaces.CurrentSource.
    """

    offset: Parameter = Parameter(0.0, unit="A", doc="current added to the signal")
    startTime: Parameter = Parameter(0.0, unit="s", doc="time at which the signal begins")
    signalSource: blocks.SO = blocks.Step()

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.i == self.signalSource.y
