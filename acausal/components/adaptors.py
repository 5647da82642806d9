"""Flanges as signals: what a model needs to be driven through signals alone, as the unit of another tool.

The derivatives of a signal may come as signals of their own. Where the signals are inputs of the whole model, index
reduction takes them for the derivatives that it needs; inside a model it differentiates what gives the first signal.
"""

from __future__ import annotations

from acausal import Component, Equations, Expr, Input, Output, der, derivative_rule


def differentiated(signal: Expr, *derivatives: Expr) -> Equations:
    """Say that each of these signals is the derivative of the one before."""
    for lower, higher in zip((signal, *derivatives), derivatives, strict=False):
        yield derivative_rule(lower, higher)


class PotentialToFlowAdaptor(Component, partial=True):
    """Potential `p` and its derivatives are given, the flow `f` that this takes is the answer.

    Subclasses have the flange and its two equations.

    Source: Modelica.Blocks.Interfaces.Adaptors.PotentialToFlowAdaptor
    as mechanics uses it: without derivatives of the flow.
    """

    use_pder: bool = True
    use_pder2: bool = True
    p: Input = Input(doc="potential")
    pder: Input = Input(doc="its derivative, with use_pder")
    pder2: Input = Input(doc="its second derivative, with use_pder and use_pder2")
    f: Output = Output(doc="flow that drives what is connected")

    def equations(self) -> Equations:
        yield from super().equations()
        used = (self.use_pder, self.use_pder and self.use_pder2)
        signals = (self.pder, self.pder2)
        yield from differentiated(self.p, *(s for s, use in zip(signals, used, strict=True) if use))
        for signal, use in zip(signals, used, strict=True):
            if not use:
                yield signal == 0


class FlowToPotentialAdaptor(Component, partial=True):
    """The flow `f` is given, potential `p` and its derivatives are the answer.

    Subclasses have the flange and its two equations.

    Source: Modelica.Blocks.Interfaces.Adaptors.FlowToPotentialAdaptor
    as mechanics uses it: without derivatives of the flow.
    """

    use_pder: bool = True
    use_pder2: bool = True
    p: Output = Output(doc="potential")
    pder: Output = Output(doc="its derivative, zero without use_pder")
    pder2: Output = Output(doc="its second derivative, zero without use_pder and use_pder2")
    f: Input = Input(doc="flow that drives what is connected")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.pder == (der(self.p) if self.use_pder else 0.0)
        yield self.pder2 == (der(self.pder) if self.use_pder and self.use_pder2 else 0.0)
