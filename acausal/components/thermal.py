"""One-dimensional heat transfer with lumped elements (Modelica Standard Library 4.0, `Modelica.Thermal.HeatTransfer`).

Temperatures are absolute [K]; the heat flow of a port is positive into the component.
"""

from __future__ import annotations

from acausal import (
    Array,
    Component,
    Connector,
    Equations,
    Flow,
    Input,
    Output,
    Parameter,
    Potential,
    Variable,
    conditional,
    der,
)


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


class PartialConditionalHeatPort(Component, partial=True):
    """Losses of a mechanical element, `lossPower`, given to `heatPort` with `useHeatPort`.

    Source: Modelica.Thermal.HeatTransfer.Interfaces.PartialElementaryConditionalHeatPortWithoutT.
    """

    useHeatPort: bool = False
    heatPort: HeatPort = conditional(HeatPort(), "useHeatPort")
    lossPower: Variable = Variable(unit="W", doc="power lost as heat")

    def equations(self) -> Equations:
        yield from super().equations()
        if self.useHeatPort:
            yield self.heatPort.Q_flow == -self.lossPower


class HeatCapacitor(Component):
    """Lumped body of one temperature, ``C dT/dt = Q_flow``.

    >>> model = assemble("body.port - heater.port", body=HeatCapacitor(C=4.0, T=start(300.0, fixed=True)),
    ...                  heater=FixedHeatFlow(Q_flow=20.0))
    >>> close(run(model, at=[0.5, 1.0])["body.T"], [302.5, 305.0])
    True

    Source: Modelica.Thermal.HeatTransfer.Components.HeatCapacitor.
    """

    port: HeatPort = HeatPort()
    C: Parameter = Parameter(1.0, unit="J/K", min=0.0, doc="heat capacity")
    T: Variable = Variable(unit="K", start=293.15, nominal=300.0, doc="temperature of the body")
    der_T: Variable = Variable(unit="K/s", doc="rate of the temperature")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.T == self.port.T
        yield self.der_T == der(self.T)
        yield self.C * self.der_T == self.port.Q_flow


class ThermalConductor(Element1D):
    """Conduction without storage, ``Q_flow = G dT``.

    >>> model = assemble("body.port - wall.port_a", "wall.port_b - outside.port", wall=ThermalConductor(G=2.0),
    ...                  body=HeatCapacitor(C=4.0, T=start(400.0, fixed=True)), outside=FixedTemperature(T=300.0))
    >>> close(run(model, at=[0.5, 1.0])["body.T"], 300 + 100 * np.exp([-0.25, -0.5]))
    True

    Source: Modelica.Thermal.HeatTransfer.Components.ThermalConductor.
    """

    G: Parameter = Parameter(1.0, unit="W/K", doc="thermal conductance")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.Q_flow == self.G * self.dT


class ThermalResistor(Element1D):
    """Conduction without storage, ``dT = R Q_flow``.

    >>> model = assemble("inside.port - wall.port_a", "wall.port_b - outside.port", wall=ThermalResistor(R=2.0),
    ...                  inside=FixedTemperature(T=310.0), outside=FixedTemperature(T=300.0))
    >>> run(model)["wall.Q_flow"][-1]
    5.0

    Source: Modelica.Thermal.HeatTransfer.Components.ThermalResistor.
    """

    R: Parameter = Parameter(1.0, unit="K/W", doc="thermal resistance")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.dT == self.R * self.Q_flow


class PartialConvection(Component, partial=True):
    """Heat from a solid to a fluid: ``Q_flow = solid.Q_flow = -fluid.Q_flow``, ``dT = solid.T - fluid.T``.

    Source: Modelica.Thermal.HeatTransfer.Components.Convection.
    """

    solid: HeatPort = HeatPort()
    fluid: HeatPort = HeatPort()
    Q_flow: Variable = Variable(unit="W", doc="heat flow rate from the solid to the fluid")
    dT: Variable = Variable(unit="K", doc="temperature difference, solid minus fluid")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.dT == self.solid.T - self.fluid.T
        yield self.solid.Q_flow == self.Q_flow
        yield self.fluid.Q_flow == -self.Q_flow


class Convection(PartialConvection):
    """Heat from a solid to a fluid, ``Q_flow = Gc dT``, the conductance being a signal.

    >>> model = assemble("wall.port - air.solid", "air.fluid - outside.port", "wind.y - air.Gc", air=Convection(),
    ...                  wall=FixedTemperature(T=310.0), outside=FixedTemperature(T=300.0),
    ...                  wind=blocks.Slope(offset=1.0, slope=2.0))
    >>> run(model, at=[0.0, 1.0])["air.Q_flow"]
    [10.0, 30.0]

    Source: Modelica.Thermal.HeatTransfer.Components.Convection.
    """

    Gc: Input = Input(unit="W/K", doc="convective thermal conductance")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.Q_flow == self.Gc * self.dT


class ConvectiveResistor(PartialConvection):
    """Heat from a solid to a fluid, ``dT = Rc Q_flow``, the resistance being a signal.

    >>> model = assemble("wall.port - air.solid", "air.fluid - outside.port", "calm.y - air.Rc",
    ...                  air=ConvectiveResistor(), wall=FixedTemperature(T=310.0), outside=FixedTemperature(T=300.0),
    ...                  calm=blocks.Slope(offset=1.0, slope=1.0))
    >>> run(model, at=[0.0, 1.0])["air.Q_flow"]
    [10.0, 5.0]

    Source: Modelica.Thermal.HeatTransfer.Components.ConvectiveResistor.
    """

    Rc: Input = Input(unit="K/W", doc="convective thermal resistance")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.dT == self.Rc * self.Q_flow


class BodyRadiation(Element1D):
    """Radiation between two bodies, ``Q_flow = Gr sigma (Ta^4 - Tb^4)``.

    >>> model = assemble("body.port - sky.port_a", "sky.port_b - night.port", sky=BodyRadiation(Gr=0.5),
    ...                  body=FixedTemperature(T=300.0), night=FixedTemperature(T=200.0))
    >>> close(run(model)["sky.Q_flow"][-1], 0.5 * 5.670374419e-8 * (300.0**4 - 200.0**4))
    True

    Source: Modelica.Thermal.HeatTransfer.Components.BodyRadiation; sigma from CODATA 2018.
    """

    Gr: Parameter = Parameter(1.0, unit="m2", doc="net radiation conductance")
    sigma: Parameter = Parameter(5.670374419e-8, unit="W/(m2*K4)", doc="Stefan-Boltzmann constant")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.Q_flow == self.Gr * self.sigma * (self.port_a.T**4 - self.port_b.T**4)


class ThermalCollector(Component):
    """Collects the heat of `m` ports of one temperature, ``port_b.Q_flow + sum(port_a[i].Q_flow) = 0``.

    >>> model = assemble("one.port - bus.port_a[0]", "two.port - bus.port_a[1]", "bus.port_b - sink.port",
    ...                  bus=ThermalCollector(m=2), one=FixedHeatFlow(Q_flow=3.0), two=FixedHeatFlow(Q_flow=4.0),
    ...                  sink=FixedTemperature(T=300.0))
    >>> run(model)["sink.port.Q_flow"][-1]
    7.0

    Source: Modelica.Thermal.HeatTransfer.Components.ThermalCollector.
    """

    m: int = 3
    port_a: Array[HeatPort] = Array(HeatPort(), "m")
    port_b: HeatPort = HeatPort()

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.port_b.Q_flow + sum(self.port_a[i].Q_flow for i in range(self.m)) == 0
        for i in range(self.m):
            yield self.port_a[i].T == self.port_b.T


class FixedTemperature(Component):
    """Boundary of a given temperature, ``port.T = T``.

    >>> model = assemble("hot.port - wall.port_a", "wall.port_b - cold.port", hot=FixedTemperature(T=350.0),
    ...                  wall=ThermalConductor(G=2.0), cold=FixedTemperature(T=300.0))
    >>> run(model)["cold.port.Q_flow"][-1]
    100.0

    Source: Modelica.Thermal.HeatTransfer.Sources.FixedTemperature.
    """

    port: HeatPort = HeatPort()
    T: Parameter = Parameter(293.15, unit="K", doc="temperature")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.port.T == self.T


class PrescribedTemperature(Component):
    """Boundary whose temperature is a signal, ``port.T = T``.

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


class CelsiusTemperatureSensor(Component):
    """Temperature of what is connected in degrees Celsius, ``T = port.T - 273.15``; takes no heat.

    >>> model = assemble("body.port - meter.port", body=FixedTemperature(T=310.15), meter=CelsiusTemperatureSensor())
    >>> run(model)["meter.T"][-1]
    37.0

    Source: Modelica.Thermal.HeatTransfer.Celsius.TemperatureSensor.
    """

    port: HeatPort = HeatPort()
    T: Output = Output(doc="temperature in degrees Celsius")
    ice: Parameter = Parameter(273.15, doc="0 degC in kelvin")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.T + self.ice == self.port.T
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
