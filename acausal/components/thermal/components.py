"""Storage, conduction, convection and radiation of heat."""

from __future__ import annotations

from acausal import Array, Component, Equations, Input, Parameter, Variable, der

from .interfaces import Element1D, HeatPort


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
