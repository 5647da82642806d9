"""Ideal measurement of pressure and flow."""

from __future__ import annotations

from acausal import Component, Equations, Output

from .interfaces import HydraulicPort, PartialTwoPort


class PressureSensor(Component):
    """Pressure at a port, ``p = port.p``; no flow.

    >>> run(assemble("tank.port - meter.port", tank=Tank(p=2e5), meter=PressureSensor()))["meter.p"][-1]
    200000.0

    Source: Modelica.Fluid.Sensors.Pressure.
    """

    port: HydraulicPort = HydraulicPort()
    p: Output = Output(unit="Pa", nominal=1e6, doc="absolute pressure")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.port.q == 0
        yield self.p == self.port.p


class RelativePressureSensor(Component):
    """Pressure difference between two ports, ``p_rel = port_a.p - port_b.p``; no flow.

    >>> model = assemble("one.port - meter.port_a", "two.port - meter.port_b", one=Tank(p=5e5), two=Tank(p=2e5),
    ...                  meter=RelativePressureSensor())
    >>> run(model)["meter.p_rel"][-1]
    300000.0

    Source: Modelica.Fluid.Sensors.RelativePressure.
    """

    port_a: HydraulicPort = HydraulicPort()
    port_b: HydraulicPort = HydraulicPort()
    p_rel: Output = Output(unit="Pa", nominal=1e6, doc="pressure at a over that at b")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.port_a.q == 0
        yield self.port_b.q == 0
        yield self.p_rel == self.port_a.p - self.port_b.p


class FlowSensor(PartialTwoPort):
    """Volume flow rate from a to b, `q_meter`; no pressure drop.

    >>> model = assemble("tank.port - pump.port_a - meter.port_b", "pump.port_b - meter.port_a", tank=Tank(),
    ...                  pump=FixedPump(V_disp=1e-4, omega=25.0), meter=FlowSensor())
    >>> run(model)["meter.q_meter"][-1]
    0.0025

    Source: Modelica.Fluid.Sensors.VolumeFlowRate.
    """

    q_meter: Output = Output(unit="m3/s", nominal=1e-3, doc="volume flow rate from a to b")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.dp == 0
        yield self.q_meter == self.q
