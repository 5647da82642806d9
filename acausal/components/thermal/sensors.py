"""Ideal measurement of temperatures [K] and heat flow rates."""

from __future__ import annotations

from acausal import Component, Equations, Output, conditional, connect

from .interfaces import HeatPort
from .sources import FixedTemperature


class TemperatureSensor(Component):
    """Temperature of what is connected, ``T = port.T``; takes no heat.

    >>> model = assemble("body.port - meter.port", body=FixedTemperature(T=310.0), meter=TemperatureSensor())
    >>> run(model)["meter.T"][-1]
    310.0

    Source: Modelica.Thermal.HeatTransfer.Sensors.TemperatureSensor.
    """

    port: HeatPort = HeatPort()
    T: Output = Output(unit="K", doc="temperature")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.T == self.port.T
        yield self.port.Q_flow == 0


class RelTemperatureSensor(Component):
    """Temperature difference, ``T_rel = port_a.T - port_b.T``; takes no heat.

    >>> model = assemble("hot.port - meter.port_a", "cold.port - meter.port_b", hot=FixedTemperature(T=310.0),
    ...                  cold=FixedTemperature(T=300.0), meter=RelTemperatureSensor())
    >>> run(model)["meter.T_rel"][-1]
    10.0

    Source: Modelica.Thermal.HeatTransfer.Sensors.RelTemperatureSensor.
    """

    port_a: HeatPort = HeatPort()
    port_b: HeatPort = HeatPort()
    T_rel: Output = Output(unit="K", doc="temperature difference a minus b")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.T_rel == self.port_a.T - self.port_b.T
        yield self.port_a.Q_flow == 0
        yield self.port_b.Q_flow == 0


class HeatFlowSensor(Component):
    """Heat flow rate of a branch from a to b; no temperature difference.

    >>> model = assemble("heater.port - meter.port_a", "meter.port_b - cold.port", heater=FixedHeatFlow(Q_flow=8.0),
    ...                  meter=HeatFlowSensor(), cold=FixedTemperature(T=300.0))
    >>> run(model)["meter.Q_flow"][-1]
    8.0

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


class ConditionalFixedHeatFlowSensor(Component):
    """Heat flow rate of a branch from a to b, which `useFixedTemperature` holds at 293.15 K.

    >>> model = assemble("hot.port - wall.port_a", "wall.port_b - meter.port_a", hot=FixedTemperature(T=313.15),
    ...                  wall=ThermalConductor(G=2.0), meter=ConditionalFixedHeatFlowSensor(useFixedTemperature=True))
    >>> held = run(model)
    >>> held["meter.port_b.T"][-1], held["wall.Q_flow"][-1]
    (293.15, 40.0)

    Source: Modelica.Thermal.HeatTransfer.Sensors.ConditionalFixedHeatFlowSensor.
    """

    useFixedTemperature: bool = False
    port_a: HeatPort = HeatPort()
    port_b: HeatPort = HeatPort()
    heatFlowSensor: HeatFlowSensor = HeatFlowSensor()
    fixedTemperature: FixedTemperature = conditional(FixedTemperature(), "useFixedTemperature")
    Q_flow: Output = Output(unit="W", doc="heat flow rate from a to b")

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.port_a, self.heatFlowSensor.port_a)
        yield connect(self.heatFlowSensor.port_b, self.port_b)
        if self.useFixedTemperature:
            yield connect(self.fixedTemperature.port, self.heatFlowSensor.port_a)
        yield connect(self.heatFlowSensor.Q_flow, self.Q_flow)
