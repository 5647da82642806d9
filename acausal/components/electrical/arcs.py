"""Switches that an arc keeps closed for a while after they open."""

from __future__ import annotations

import acausal as ac
from acausal import Discrete, Equations, Expr, Input, Parameter, pre, when, where

from .interfaces import ConditionalHeatPort, OnePort, Pin


class PartialSwitchWithArc(ConditionalHeatPort, OnePort, partial=True):
    """Switch whose current is carried by an arc for a while after opening.

    Closed ``v = Ron i``; open and quenched ``i = Goff v``; between ``v = min(Vmax, V0 + dVdt (t - tSwitch)) sign(i)``,
    an arc, which is quenched when ``|i| <= Goff |v|``.

    Source: Modelica.Electrical.Analog.Interfaces.IdealSwitchWithArc.
    """

    Ron: Parameter = Parameter(1e-5, unit="ohm", doc="resistance of the closed switch")
    Goff: Parameter = Parameter(1e-5, unit="S", doc="conductance of the open switch")
    V0: Parameter = Parameter(30.0, unit="V", doc="voltage of the arc at first")
    dVdt: Parameter = Parameter(10e3, unit="V/s", doc="rise of the arc's voltage")
    Vmax: Parameter = Parameter(60.0, unit="V", doc="largest voltage of the arc")
    off: Discrete = Discrete(start=1.0, doc="whether it is open, but perhaps not quenched")
    quenched: Discrete = Discrete(start=1.0, doc="whether the arc of the open switch is quenched")
    tSwitch: Discrete = Discrete(start=-1e6, unit="s", doc="time of the last opening")

    def switched(self, off: Expr) -> Equations:
        """Equations of the switch, which is open where `off` holds."""
        arc = ac.min(self.Vmax, self.V0 + self.dVdt * (ac.time - self.tSwitch)) * ac.sign(self.i)
        quenches = (ac.abs(self.i) <= ac.abs(self.v) * self.Goff) | (pre(self.quenched) > 0.5)
        yield self.off == where(off, 1.0, 0.0)
        yield when(self.off > 0.5, {self.tSwitch: ac.time})
        yield self.quenched == where((self.off > 0.5) & quenches, 1.0, 0.0)
        opened = where(self.quenched > 0.5, self.i - self.Goff * self.v, (self.v - arc) / (self.Ron + 1 / self.Goff))
        yield where(self.off > 0.5, opened, (self.v - self.Ron * self.i) * self.Goff) == 0
        yield self.LossPower == self.v * self.i


class OpenerWithArc(PartialSwitchWithArc):
    """Switch with an arc that a signal opens: ``control`` true (1), open.

    >>> model = assemble("source.p - load.p", "load.n - coil.p", "coil.n - switch.p", "switch.n - source.n - ground.p",
    ...                  "hand.y - switch.control", switch=OpenerWithArc(V0=30.0, Vmax=60.0), load=Resistor(R=1.0),
    ...                  coil=Inductor(L=0.01, i=start(50.0, fixed=True)), source=ConstantVoltage(V=50.0),
    ...                  hand=blocks.Step(startTime=0.005), ground=Ground())
    >>> arc = run(model, at=[0.004, 0.006, 0.5])
    >>> close(arc["switch.v"][1:], [40.0, 50.0], 1e-2) and close(arc["load.i"][0], 50.0, 1e-3)
    True

    Source: Modelica.Electrical.Analog.Ideal.OpenerWithArc.
    """

    control: Input = Input(doc="whether it is open, 1 or 0")

    def equations(self) -> Equations:
        yield from super().equations()
        yield from self.switched(self.control > 0.5)


class CloserWithArc(PartialSwitchWithArc):
    """Switch with an arc that a signal closes: ``control`` true (1), closed.

    >>> model = assemble("source.p - load.p", "load.n - switch.p", "switch.n - source.n - ground.p",
    ...                  "hand.y - switch.control", switch=CloserWithArc(), load=Resistor(R=5.0), ground=Ground(),
    ...                  source=ConstantVoltage(V=10.0), hand=blocks.Step(startTime=0.5))
    >>> close(run(model, at=[0.2, 0.7])["load.i"], [0.0, 2.0], 1e-3)
    True

    Source: Modelica.Electrical.Analog.Ideal.CloserWithArc.
    """

    control: Input = Input(doc="whether it is closed, 1 or 0")

    def equations(self) -> Equations:
        yield from super().equations()
        yield from self.switched(self.control <= 0.5)


class ControlledOpenerWithArc(PartialSwitchWithArc):
    """Switch with an arc that a potential opens: open where ``control.v > level``.

    >>> model = assemble("source.p - load.p", "load.n - coil.p", "coil.n - switch.p", "hand.p - switch.control",
    ...                  "switch.n - source.n - hand.n - ground.p", switch=ControlledOpenerWithArc(),
    ...                  coil=Inductor(L=0.01, i=start(50.0, fixed=True)), source=ConstantVoltage(V=50.0),
    ...                  load=Resistor(R=1.0), hand=StepVoltage(startTime=0.005), ground=Ground())
    >>> arc = run(model, at=[0.004, 0.006, 0.5])
    >>> close(arc["switch.v"][1:], [40.0, 50.0], 1e-2) and close(arc["load.i"][0], 50.0, 1e-3)
    True

    Source: Modelica.Electrical.Analog.Ideal.ControlledOpenerWithArc.
    """

    level: Parameter = Parameter(0.5, unit="V", doc="potential of the change-over")
    control: Pin = Pin()

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.control.i == 0
        yield from self.switched(self.control.v > self.level)


class ControlledCloserWithArc(PartialSwitchWithArc):
    """Switch with an arc that a potential closes: closed where ``control.v > level``.

    >>> model = assemble("source.p - load.p", "load.n - switch.p", "hand.p - switch.control",
    ...                  "switch.n - source.n - hand.n - ground.p", switch=ControlledCloserWithArc(), ground=Ground(),
    ...                  load=Resistor(R=5.0), source=ConstantVoltage(V=10.0), hand=StepVoltage(startTime=0.5))
    >>> close(run(model, at=[0.2, 0.7])["load.i"], [0.0, 2.0], 1e-3)
    True

    Source: Modelica.Electrical.Analog.Ideal.ControlledCloserWithArc.
    """

    level: Parameter = Parameter(0.5, unit="V", doc="potential of the change-over")
    control: Pin = Pin()

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.control.i == 0
        yield from self.switched(self.control.v < self.level)
