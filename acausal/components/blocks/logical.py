"""Blocks that choose."""

from __future__ import annotations

from acausal import Component, Equations, Input, Output, Parameter, where


class Switch(Component):
    """One of two signals, ``y = u1`` where ``u2 >= threshold`` (true, for a boolean 0 or 1), else ``u3``.

    >>> class Choice(Component):
    ...     ramp: Slope = Slope(slope=1.0)
    ...     one: Constant = Constant(k=1.0)
    ...     switch: Switch = Switch()
    ...     def equations(self):
    ...         yield connect(self.one.y, self.switch.u1)
    ...         yield connect(self.ramp.y, self.switch.u2, self.switch.u3)
    >>> run(Choice(), at=[0.0, 0.25, 1.0])["switch.y"]
    [0.0, 0.25, 1.0]

    Source: Modelica.Blocks.Logical.Switch with a Modelica.Blocks.Logical.GreaterEqualThreshold.
    """

    u1: Input = Input(doc="signal above the threshold")
    u2: Input = Input(doc="signal that decides")
    u3: Input = Input(doc="signal below the threshold")
    y: Output = Output(doc="chosen signal")
    threshold: Parameter = Parameter(0.5, doc="threshold of u2")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == where(self.u2 >= self.threshold, self.u1, self.u3)
