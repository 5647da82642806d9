"""Heat ports as signals, for units that exchange signals only."""

from __future__ import annotations

from acausal import Component, Equations, Input, Output, der

from ..adaptors import differentiated
from .interfaces import HeatPort


class GeneralHeatFlowToTemperatureAdaptor(Component):
    """The heat flow `f` is taken from the port; the answer is its temperature `p` and the derivative `pder`.

    ``heatPort.Q_flow = f``, ``p = heatPort.T``: an `f` that is positive cools.

    >>> model = assemble("flow.y - answer.f", "body.port - answer.heatPort", flow=blocks.Constant(k=-8.0),
    ...                  body=HeatCapacitor(C=4.0, T=start(300.0, fixed=True)),
    ...                  answer=GeneralHeatFlowToTemperatureAdaptor())
    >>> signals = run(model, at=[0.5, 1.0])
    >>> close(signals["answer.p"], [301.0, 302.0]) and close(signals["answer.pder"], [2.0, 2.0])
    True

    Source: Modelica.Thermal.HeatTransfer.Components.GeneralHeatFlowToTemperatureAdaptor.
    """

    use_pder: bool = True
    heatPort: HeatPort = HeatPort()
    p: Output = Output(unit="K", doc="temperature")
    pder: Output = Output(unit="K/s", doc="its derivative, zero without use_pder")
    f: Input = Input(unit="W", doc="heat flow rate into the port")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.p == self.heatPort.T
        yield self.heatPort.Q_flow == self.f
        yield self.pder == (der(self.p) if self.use_pder else 0.0)


class GeneralTemperatureToHeatFlowAdaptor(Component):
    """Temperature `p` and its derivative `pder` hold the port; the answer is the heat flow `f` that this takes.

    ``heatPort.T = p``, ``f = -heatPort.Q_flow``. Without `use_pder` the derivative is not given.

    >>> model = assemble("heater.port - one.port - answer.heatPort", "answer.p - hold.p", "answer.pder - hold.pder",
    ...                  "hold.f - answer.f", "hold.heatPort - two.port", heater=FixedHeatFlow(Q_flow=12.0),
    ...                  one=HeatCapacitor(C=4.0, T=start(300.0, fixed=True)), two=HeatCapacitor(C=2.0),
    ...                  answer=GeneralHeatFlowToTemperatureAdaptor(), hold=GeneralTemperatureToHeatFlowAdaptor())
    >>> signals = run(model, at=[0.5, 1.0])
    >>> close(signals["two.T"], [301.0, 302.0]) and close(signals["hold.f"], [4.0, 4.0])
    True

    Source: Modelica.Thermal.HeatTransfer.Components.GeneralTemperatureToHeatFlowAdaptor.
    """

    use_pder: bool = True
    heatPort: HeatPort = HeatPort()
    p: Input = Input(unit="K", doc="temperature")
    pder: Input = Input(unit="K/s", doc="its derivative, with use_pder")
    f: Output = Output(unit="W", doc="heat flow rate out of the port")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.heatPort.T == self.p
        yield self.f == -self.heatPort.Q_flow
        if self.use_pder:
            yield from differentiated(self.p, self.pder)
        else:
            yield self.pder == 0
