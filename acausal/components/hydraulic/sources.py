"""Tank, pressure and flow sources, pumps. The speed of a pump is in revolutions per second."""

from __future__ import annotations

from acausal import Component, Equations, Input, Parameter, clip

from .interfaces import HydraulicPort, PartialTwoPort


class Tank(Component):
    """Tank of constant pressure, ``port.p = p``; takes and gives any amount of oil.

    Source: effort source of the return line, Fig. 6; Modelica.Fluid.Sources.FixedBoundary.
    """

    port: HydraulicPort = HydraulicPort()
    p: Parameter = Parameter(1e5, unit="Pa", doc="pressure")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.port.p == self.p


class PressureSource(Component):
    """Pressure given by a signal, ``port.p = p``.

    Source: Modelica.Fluid.Sources.Boundary_pT with p_in.
    """

    port: HydraulicPort = HydraulicPort()
    p: Input = Input(doc="pressure [Pa]", nominal=1e6)

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.port.p == self.p


class FlowSource(PartialTwoPort):
    """Volume flow rate from a to b given by a signal, ``q = u``.

    Source: modulated flow source of Fig. 6.
    """

    u: Input = Input(doc="volume flow rate wanted [m3/s]", nominal=1e-3)

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.q == self.u


class MeteringPump(PartialTwoPort):
    """Pump whose flow from a to b is proportional to a signal, ``q = u V_disp omega``.

    Source: Eq. 2.
    """

    u: Input = Input(doc="flow gain, -1 to 1")
    V_disp: Parameter = Parameter(2.5e-4, unit="m3", min=0.0, doc="displacement per revolution")
    omega: Parameter = Parameter(25.0, unit="1/s", doc="speed in revolutions per second")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.q == self.u * self.V_disp * self.omega


class PressureCompensatedPump(PartialTwoPort):
    """Pump from a (suction) to b (delivery), swung back as the delivery pressure nears its set point.

    ``q = V_disp omega clip((p_set - port_b.p)/dp_full, 0, 1)``.

    Source: Eq. 5, with the flow limited to what the pump can deliver.
    """

    V_disp: Parameter = Parameter(2.5e-4, unit="m3", min=0.0, doc="displacement per revolution")
    omega: Parameter = Parameter(25.0, unit="1/s", doc="speed in revolutions per second")
    p_set: Parameter = Parameter(25e6, unit="Pa", doc="pressure set point, of no flow")
    dp_full: Parameter = Parameter(1e6, unit="Pa", min=1e-30, doc="deviation from the set point for full flow")

    def equations(self) -> Equations:
        yield from super().equations()
        stroke = clip((self.p_set - self.port_b.p) / self.dp_full, 0.0, 1.0)
        yield self.q == self.V_disp * self.omega * stroke
