"""Boundaries of given temperature or heat flow."""

from __future__ import annotations

from acausal import Component, Equations, Input, Parameter

from .interfaces import HeatPort


class FixedTemperature(Component):
    """Boundary of a given temperature [K], ``port.T = T``; for degrees Celsius there is `celsius.FixedTemperature`.

    >>> model = assemble("hot.port - wall.port_a", "wall.port_b - cold.port", hot=FixedTemperature(T=350.0),
    ...                  wall=ThermalConductor(G=2.0), cold=FixedTemperature(T=300.0))
    >>> run(model)["cold.port.Q_flow"][-1]
    100.0

    Source: Modelica.Thermal.HeatTransfer.Sources.FixedTemperature.
    """

    port: HeatPort = HeatPort()
    T: Parameter = Parameter(293.15, unit="K", min=0.0, doc="temperature")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.port.T == self.T


class PrescribedTemperature(Component):
    """Boundary whose temperature is a signal [K], ``port.T = T`` (`celsius.PrescribedTemperature`: in degrees Celsius).

    >>> model = assemble("ramp.y - hot.T", "hot.port - wall.port_a", "wall.port_b - cold.port",
    ...                  hot=PrescribedTemperature(), wall=ThermalConductor(G=2.0), cold=FixedTemperature(T=300.0),
    ...                  ramp=blocks.Slope(offset=300.0, slope=10.0))
    >>> run(model, at=[0.0, 1.0])["wall.Q_flow"]
    [0.0, 20.0]

    Source: Modelica.Thermal.HeatTransfer.Sources.PrescribedTemperature.
    """

    port: HeatPort = HeatPort()
    T: Input = Input(unit="K", doc="temperature")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.port.T == self.T


class FixedHeatFlow(Component):
    """Given heat flow into what is connected, ``port.Q_flow = -Q_flow (1 + alpha (port.T - T_ref))``.

    >>> model = assemble("heater.port - wall.port_a", "wall.port_b - cold.port", heater=FixedHeatFlow(Q_flow=8.0),
    ...                  wall=ThermalConductor(G=2.0), cold=FixedTemperature(T=300.0))
    >>> run(model)["heater.port.T"][-1]
    304.0

    Source: Modelica.Thermal.HeatTransfer.Sources.FixedHeatFlow.
    """

    port: HeatPort = HeatPort()
    Q_flow: Parameter = Parameter(1.0, unit="W", doc="heat flow rate out of the port")
    T_ref: Parameter = Parameter(293.15, unit="K", doc="reference temperature")
    alpha: Parameter = Parameter(0.0, unit="1/K", doc="temperature coefficient of the heat flow rate")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.port.Q_flow == -self.Q_flow * (1 + self.alpha * (self.port.T - self.T_ref))


class PrescribedHeatFlow(Component):
    """Heat flow given by a signal into what is connected, ``port.Q_flow = -Q_flow (1 + alpha (port.T - T_ref))``.

    >>> model = assemble("ramp.y - heater.Q_flow", "heater.port - wall.port_a", "wall.port_b - cold.port",
    ...                  heater=PrescribedHeatFlow(), ramp=blocks.Slope(slope=8.0), wall=ThermalConductor(G=2.0),
    ...                  cold=FixedTemperature(T=300.0))
    >>> run(model, at=[0.0, 1.0])["heater.port.T"]
    [300.0, 304.0]

    Source: Modelica.Thermal.HeatTransfer.Sources.PrescribedHeatFlow.
    """

    port: HeatPort = HeatPort()
    Q_flow: Input = Input(unit="W", doc="heat flow rate out of the port")
    T_ref: Parameter = Parameter(293.15, unit="K", doc="reference temperature")
    alpha: Parameter = Parameter(0.0, unit="1/K", doc="temperature coefficient of the heat flow rate")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.port.Q_flow == -self.Q_flow * (1 + self.alpha * (self.port.T - self.T_ref))
