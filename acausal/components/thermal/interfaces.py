"""The port through which heat flows, and bases of what has ports."""

from __future__ import annotations

from acausal import Component, Connector, Equations, Flow, Potential, Variable, conditional


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
