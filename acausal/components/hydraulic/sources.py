"""Tank, pressure and flow sources, pumps. The speed of a pump is in revolutions per second."""

from __future__ import annotations

from acausal import Component, Equations, Input, Parameter, clip

from .interfaces import HydraulicPort, PartialTwoPort


class Tank(Component):
    """Tank of constant pressure, ``port.p = p``; takes and gives any amount of oil.

    >>> model = assemble("tank.port - orifice.port_a", "orifice.port_b - drain.port", oil=ac.inner(Oil()),
    ...                  tank=Tank(p=2e5), orifice=LaminarRestriction(G=1e-9), drain=Tank(p=1e5))
    >>> run(model)["orifice.q"][-1]
    0.0001

    Source: effort source of the return line, Fig. 6; Modelica.Fluid.Sources.FixedBoundary.
    """

    port: HydraulicPort = HydraulicPort()
    p: Parameter = Parameter(1e5, unit="Pa", doc="pressure")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.port.p == self.p


class PressureSource(Component):
    """Pressure given by a signal, ``port.p = p``.

    >>> model = assemble("wave.y - source.p", "source.port - volume.port", wave=blocks.Slope(offset=1e5, slope=1e6),
    ...                  source=PressureSource(), volume=ControlVolume(V=1.2e-3), oil=ac.inner(Oil(B=1.2e9)))
    >>> close(run(model)["volume.port.q"][-1], 1.2e-3 / 1.2e9 * 1e6)
    True

    Source: Modelica.Fluid.Sources.Boundary_pT with p_in.
    """

    port: HydraulicPort = HydraulicPort()
    p: Input = Input(doc="pressure [Pa]", nominal=1e6)

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.port.p == self.p


class FlowSource(PartialTwoPort):
    """Volume flow rate from a to b given by a signal, ``q = u``.

    >>> model = assemble("flow.y - pump.u", "tank.port - pump.port_a", "pump.port_b - volume.port", oil=ac.inner(Oil()),
    ...                  flow=blocks.Constant(k=1e-6), tank=Tank(), pump=FlowSource(),
    ...                  volume=ControlVolume(V=1.2e-3, p=start(1e5, fixed=True)))
    >>> close(run(model)["volume.p"], [1e5, 1e5 + 1e6])
    True

    Source: modulated flow source of Fig. 6.
    """

    u: Input = Input(doc="volume flow rate wanted [m3/s]", nominal=1e-3)

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.q == self.u


class MeteringPump(PartialTwoPort):
    """Pump whose flow from a to b is proportional to a signal, ``q = u V_disp omega``.

    >>> model = assemble("gain.y - pump.u", "tank.port - pump.port_a - pump.port_b", gain=blocks.Constant(k=-0.5),
    ...                  tank=Tank(), pump=MeteringPump(V_disp=1e-4, omega=25.0))
    >>> run(model)["pump.q"][-1]
    -0.00125

    Source: Eq. 2.
    """

    u: Input = Input(doc="flow gain, -1 to 1")
    V_disp: Parameter = Parameter(2.5e-4, unit="m3", min=0.0, doc="displacement per revolution")
    omega: Parameter = Parameter(25.0, unit="1/s", doc="speed in revolutions per second")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.q == self.u * self.V_disp * self.omega


class FixedPump(PartialTwoPort):
    """Pump of constant displacement at constant speed, from a to b, ``q = V_disp omega``; needs a relief valve.

    >>> model = assemble("tank.port - pump.port_a - relief.port_b", "pump.port_b - relief.port_a", oil=ac.inner(Oil()),
    ...                  tank=Tank(p=1e5), pump=FixedPump(V_disp=1e-4, omega=20.0), relief=ReliefValve(p_set=20e6))
    >>> 20e6 < run(model)["pump.port_b.p"][-1] < 22e6
    True

    Source: Merritt, Hydraulic Control Systems (1967), section 4.2, without leakage.
    """

    V_disp: Parameter = Parameter(2.5e-4, unit="m3", min=0.0, doc="displacement per revolution")
    omega: Parameter = Parameter(25.0, unit="1/s", doc="speed in revolutions per second")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.q == self.V_disp * self.omega


class PressureCompensatedPump(PartialTwoPort):
    """Pump from a (suction) to b (delivery), swung back as the delivery pressure nears its set point.

    ``q = V_disp omega clip((p_set - port_b.p)/dp_full, 0, 1)``.

    >>> model = assemble("tank.port - pump.port_a", "pump.port_b - load.port", tank=Tank(), load=Tank(p=24.75e6),
    ...                  pump=PressureCompensatedPump(V_disp=1e-4, omega=20.0, p_set=25e6, dp_full=1e6))
    >>> run(model)["pump.q"][-1]  # a quarter of the 2e-3 m3/s
    0.0005

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
