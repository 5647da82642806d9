"""One-dimensional heat transfer with lumped elements (Modelica Standard Library 4.0, `Modelica.Thermal.HeatTransfer`).

Temperatures are absolute [K]; the heat flow of a port is positive into the component.
"""

from __future__ import annotations

from acausal import Component, Connector, Equations, Flow, Input, Output, Parameter, Potential, Variable, der


class HeatPort(Connector):
    """Point where heat can cross a component's boundary.

    Source: Modelica.Thermal.HeatTransfer.Interfaces.HeatPort.
    """

    T: Potential = Potential(unit="K", nominal=300.0, doc="temperature")
    Q_flow: Flow = Flow(unit="W", doc="heat flow rate into the component")


class Element1D(Component, partial=True):
    """Two ports, no storage: ``Q_flow = port_a.Q_flow = -port_b.Q_flow``, ``dT = port_a.T - port_b.T``.

    Source: Modelica.Thermal.HeatTransfer.Interfaces.Element1D.
    """

    port_a: HeatPort = HeatPort()
    port_b: HeatPort = HeatPort()
    Q_flow: Variable = Variable(unit="W", doc="heat flow rate from a to b")
    dT: Variable = Variable(unit="K", doc="temperature difference a minus b")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.dT == self.port_a.T - self.port_b.T
        yield self.port_a.Q_flow == self.Q_flow
        yield self.port_b.Q_flow == -self.Q_flow


class HeatCapacitor(Component):
    """Lumped body of one temperature, ``C dT/dt = Q_flow``.

    Source: Modelica.Thermal.HeatTransfer.Components.HeatCapacitor.
    """

    port: HeatPort = HeatPort()
    C: Parameter = Parameter(1.0, unit="J/K", min=0.0, doc="heat capacity")
    T: Variable = Variable(unit="K", start=293.15, nominal=300.0, doc="temperature of the body")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.T == self.port.T
        yield self.C * der(self.T) == self.port.Q_flow


class ThermalConductor(Element1D):
    """Conduction without storage, ``Q_flow = G dT``.

    Source: Modelica.Thermal.HeatTransfer.Components.ThermalConductor.
    """

    G: Parameter = Parameter(1.0, unit="W/K", doc="thermal conductance")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.Q_flow == self.G * self.dT


class ThermalResistor(Element1D):
    """Conduction without storage, ``dT = R Q_flow``.

    Source: Modelica.Thermal.HeatTransfer.Components.ThermalResistor.
    """

    R: Parameter = Parameter(1.0, unit="K/W", doc="thermal resistance")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.dT == self.R * self.Q_flow


class Convection(Element1D):
    """Heat from a solid (port a) to a fluid (port b), ``Q_flow = Gc dT``.

    Source: Modelica.Thermal.HeatTransfer.Components.Convection.
    """

    Gc: Input = Input(unit="W/K", doc="convective thermal conductance")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.Q_flow == self.Gc * self.dT


class BodyRadiation(Element1D):
    """Radiation between two bodies, ``Q_flow = Gr sigma (Ta^4 - Tb^4)``.

    Source: Modelica.Thermal.HeatTransfer.Components.BodyRadiation; sigma from CODATA 2018.
    """

    Gr: Parameter = Parameter(1.0, unit="m2", doc="net radiation conductance")
    sigma: Parameter = Parameter(5.670374419e-8, unit="W/(m2*K4)", doc="Stefan-Boltzmann constant")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.Q_flow == self.Gr * self.sigma * (self.port_a.T**4 - self.port_b.T**4)


class FixedTemperature(Component):
    """Boundary of a given temperature, ``port.T = T``.

    Source: Modelica.Thermal.HeatTransfer.Sources.FixedTemperature.
    """

    port: HeatPort = HeatPort()
    T: Parameter = Parameter(293.15, unit="K", doc="temperature")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.port.T == self.T


class PrescribedTemperature(Component):
    """Boundary whose temperature is a signal, ``port.T = T``.

    Source: Modelica.Thermal.HeatTransfer.Sources.PrescribedTemperature.
    """

    port: HeatPort = HeatPort()
    T: Input = Input(doc="temperature [K]")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.port.T == self.T


class FixedHeatFlow(Component):
    """Given heat flow into what is connected, ``port.Q_flow = -Q_flow``.

    Source: Modelica.Thermal.HeatTransfer.Sources.FixedHeatFlow with alpha = 0.
    """

    port: HeatPort = HeatPort()
    Q_flow: Parameter = Parameter(1.0, unit="W", doc="heat flow rate out of the port")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.port.Q_flow == -self.Q_flow


class PrescribedHeatFlow(Component):
    """Heat flow given by a signal into what is connected, ``port.Q_flow = -Q_flow``.

    Source: Modelica.Thermal.HeatTransfer.Sources.PrescribedHeatFlow with alpha = 0.
    """

    port: HeatPort = HeatPort()
    Q_flow: Input = Input(doc="heat flow rate out of the port [W]")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.port.Q_flow == -self.Q_flow


class TemperatureSensor(Component):
    """Temperature of what is connected, ``T = port.T``; takes no heat.

    Source: Modelica.Thermal.HeatTransfer.Sensors.TemperatureSensor.
    """

    port: HeatPort = HeatPort()
    T: Output = Output(unit="K", doc="temperature")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.T == self.port.T
        yield self.port.Q_flow == 0


class HeatFlowSensor(Component):
    """Heat flow rate of a branch from a to b; no temperature difference.

    Source: Modelica.Thermal.HeatTransfer.Sensors.HeatFlowSensor.
    """

    port_a: HeatPort = HeatPort()
    port_b: HeatPort = HeatPort()
    Q_flow: Output = Output(unit="W", doc="heat flow rate from a to b")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.port_a.T == self.port_b.T
        yield self.port_a.Q_flow + self.port_b.Q_flow == 0
        yield self.Q_flow == self.port_a.Q_flow
