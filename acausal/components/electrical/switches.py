"""Ideal switches, diodes and thyristors: two straight lines with an event where they meet."""

from __future__ import annotations

import acausal as ac
from acausal import Component, Discrete, Equations, Expr, Input, Parameter, Variable, connect, pre, when, where

from .basic import Capacitor, Resistor
from .interfaces import ConditionalHeatPort, OnePort, Pin


class PartialIdealSemiconductor(ConditionalHeatPort, OnePort, partial=True):
    """Two straight lines over a curve parameter `s`: blocking for ``s < 0``, conducting above.

    Where `off`, ``v = s 1 V + Vknee``, ``i = Goff v``; else ``v = Ron s 1 A + Vknee``, ``i = s 1 A + Goff Vknee``.

    Source: Modelica.Electrical.Analog.Interfaces.IdealSemiconductor; Clauss, Elmqvist, Mattsson, Otter and Schwarz,
    Mixed domain modeling in Modelica, FDL 2002.
    """

    Ron: Parameter = Parameter(1e-5, unit="ohm", min=0.0, doc="resistance while conducting")
    Goff: Parameter = Parameter(1e-5, unit="S", min=0.0, doc="conductance while blocking")
    Vknee: Parameter = Parameter(0.0, unit="V", min=0.0, doc="threshold voltage")
    unitVoltage: Parameter = Parameter(1.0, unit="V", doc="scale of s as a voltage")
    unitCurrent: Parameter = Parameter(1.0, unit="A", doc="scale of s as a current")
    off: Discrete = Discrete(start=1.0, doc="whether it blocks")
    s: Variable = Variable(start=0.0, doc="curve parameter of the characteristic")

    def equations(self) -> Equations:
        yield from super().equations()
        blocks = self.off > 0.5
        yield self.v == self.s * where(blocks, self.unitVoltage, self.Ron * self.unitCurrent) + self.Vknee
        conducted = where(blocks, self.Goff * self.unitVoltage, self.unitCurrent)
        yield self.i == self.s * conducted + self.Goff * self.Vknee
        yield self.LossPower == self.v * self.i


class IdealDiode(PartialIdealSemiconductor):
    """Ideal diode: blocks where the curve parameter is negative.

    >>> model = assemble("source.p - diode.p", "diode.n - load.p", "source.n - load.n - ground.p", diode=IdealDiode(),
    ...                  source=SineVoltage(V=10.0, f=1.0), load=Resistor(R=5.0), ground=Ground())
    >>> close(run(model, at=[0.25, 0.75])["load.i"], [2.0, 0.0], 1e-4)
    True

    Source: Modelica.Electrical.Analog.Ideal.IdealDiode.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.off == where(self.s < 0, 1.0, 0.0)


class IdealThyristor(PartialIdealSemiconductor):
    """Ideal thyristor: conducts from the moment at which `fire` is true until the current stops.

    >>> model = assemble("source.p - thyristor.p", "thyristor.n - load.p", "source.n - load.n - ground.p",
    ...                  "gate.y - thyristor.fire", thyristor=IdealThyristor(), gate=blocks.Step(startTime=0.2),
    ...                  source=SineVoltage(V=10.0, f=1.0), load=Resistor(R=5.0), ground=Ground())
    >>> close(run(model, at=[0.1, 0.25, 0.75, 1.25])["load.i"], [0.0, 2.0, 0.0, 2.0], 1e-4)
    True

    Source: Modelica.Electrical.Analog.Ideal.IdealThyristor.
    """

    fire: Input = Input(doc="whether to fire, 1 or 0")

    def equations(self) -> Equations:
        yield from super().equations()
        waits = (pre(self.off) > 0.5) & (self.fire <= 0.5)
        yield self.off == where((self.s < 0) | waits, 1.0, 0.0)


class IdealGTOThyristor(PartialIdealSemiconductor):
    """Ideal gate turn-off thyristor: conducts while `fire` is true and the curve parameter is not negative.

    >>> model = assemble("source.p - thyristor.p", "thyristor.n - load.p", "source.n - load.n - ground.p",
    ...                  "gate.y - thyristor.fire", thyristor=IdealGTOThyristor(), load=Resistor(R=5.0),
    ...                  gate=blocks.Pulse(period=0.4), source=ConstantVoltage(V=10.0), ground=Ground())
    >>> close(run(model, at=[0.1, 0.3, 0.5])["load.i"], [2.0, 0.0, 2.0], 1e-4)
    True

    Source: Modelica.Electrical.Analog.Ideal.IdealGTOThyristor.
    """

    fire: Input = Input(doc="whether to conduct, 1 or 0")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.off == where((self.s < 0) | (self.fire <= 0.5), 1.0, 0.0)


class PartialIdealSwitch(ConditionalHeatPort, OnePort, partial=True):
    """Switch of resistance `Ron` while closed and conductance `Goff` while open.

    Source: Modelica.Electrical.Analog.Interfaces.IdealSwitch.
    """

    Ron: Parameter = Parameter(1e-5, unit="ohm", min=0.0, doc="resistance of the closed switch")
    Goff: Parameter = Parameter(1e-5, unit="S", min=0.0, doc="conductance of the open switch")
    unitVoltage: Parameter = Parameter(1.0, unit="V", doc="scale of s as a voltage")
    unitCurrent: Parameter = Parameter(1.0, unit="A", doc="scale of s as a current")
    s: Variable = Variable(start=0.0, doc="curve parameter")

    def switched(self, off: Expr) -> Equations:
        """Equations of the switch, which is open where `off` holds."""
        yield self.v == self.s * where(off, self.unitVoltage, self.Ron * self.unitCurrent)
        yield self.i == self.s * where(off, self.Goff * self.unitVoltage, self.unitCurrent)
        yield self.LossPower == self.v * self.i


class IdealClosingSwitch(PartialIdealSwitch):
    """Switch that a signal closes: ``control`` true (1), closed; false (0), open.

    >>> model = assemble("source.p - switch.p", "switch.n - load.p", "source.n - load.n - ground.p",
    ...                  "hand.y - switch.control", switch=IdealClosingSwitch(), hand=blocks.Step(startTime=0.5),
    ...                  source=ConstantVoltage(V=10.0), load=Resistor(R=5.0), ground=Ground())
    >>> close(run(model, at=[0.2, 0.7])["load.i"], [0.0, 2.0], 1e-4)
    True

    Source: Modelica.Electrical.Analog.Ideal.IdealClosingSwitch.
    """

    control: Input = Input(doc="whether it is closed, 1 or 0")

    def equations(self) -> Equations:
        yield from super().equations()
        yield from self.switched(self.control <= 0.5)


class IdealOpeningSwitch(PartialIdealSwitch):
    """Switch that a signal opens: ``control`` true (1), open; false (0), closed.

    >>> model = assemble("source.p - switch.p", "switch.n - load.p", "source.n - load.n - ground.p",
    ...                  "hand.y - switch.control", switch=IdealOpeningSwitch(), hand=blocks.Step(startTime=0.5),
    ...                  source=ConstantVoltage(V=10.0), load=Resistor(R=5.0), ground=Ground())
    >>> close(run(model, at=[0.2, 0.7])["load.i"], [2.0, 0.0], 1e-4)
    True

    Source: Modelica.Electrical.Analog.Ideal.IdealOpeningSwitch.
    """

    control: Input = Input(doc="whether it is open, 1 or 0")

    def equations(self) -> Equations:
        yield from super().equations()
        yield from self.switched(self.control > 0.5)


class ControlledIdealClosingSwitch(PartialIdealSwitch):
    """Switch that a potential closes: closed where ``control.v > level``.

    >>> model = assemble("source.p - switch.p", "switch.n - load.p", "source.n - load.n - hand.n - ground.p",
    ...                  "hand.p - switch.control", switch=ControlledIdealClosingSwitch(), load=Resistor(R=5.0),
    ...                  hand=StepVoltage(startTime=0.5), source=ConstantVoltage(V=10.0), ground=Ground())
    >>> close(run(model, at=[0.2, 0.7])["load.i"], [0.0, 2.0], 1e-4)
    True

    Source: Modelica.Electrical.Analog.Ideal.ControlledIdealClosingSwitch.
    """

    level: Parameter = Parameter(0.5, unit="V", doc="potential of the change-over")
    control: Pin = Pin()

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.control.i == 0
        yield from self.switched(self.control.v < self.level)


class ControlledIdealOpeningSwitch(PartialIdealSwitch):
    """Switch that a potential opens: open where ``control.v > level``.

    >>> model = assemble("source.p - switch.p", "switch.n - load.p", "source.n - load.n - hand.n - ground.p",
    ...                  "hand.p - switch.control", switch=ControlledIdealOpeningSwitch(), load=Resistor(R=5.0),
    ...                  hand=StepVoltage(startTime=0.5), source=ConstantVoltage(V=10.0), ground=Ground())
    >>> close(run(model, at=[0.2, 0.7])["load.i"], [2.0, 0.0], 1e-4)
    True

    Source: Modelica.Electrical.Analog.Ideal.ControlledIdealOpeningSwitch.
    """

    level: Parameter = Parameter(0.5, unit="V", doc="potential of the change-over")
    control: Pin = Pin()

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.control.i == 0
        yield from self.switched(self.control.v > self.level)


class PartialTwoWaySwitch(ConditionalHeatPort, partial=True):
    """Switch from `p` to `n2` or to `n1`, of resistance `Ron` where closed and conductance `Goff` where open.

    Source: Modelica.Electrical.Analog.Ideal.IdealTwoWaySwitch.
    """

    p: Pin = Pin()
    n1: Pin = Pin()
    n2: Pin = Pin()
    Ron: Parameter = Parameter(1e-5, unit="ohm", min=0.0, doc="resistance of the closed switch")
    Goff: Parameter = Parameter(1e-5, unit="S", min=0.0, doc="conductance of the open switch")
    unitVoltage: Parameter = Parameter(1.0, unit="V", doc="scale of s1 and s2 as voltages")
    unitCurrent: Parameter = Parameter(1.0, unit="A", doc="scale of s1 and s2 as currents")
    s1: Variable = Variable(start=0.0, doc="curve parameter of the way to n1")
    s2: Variable = Variable(start=0.0, doc="curve parameter of the way to n2")

    def switched(self, second: Expr) -> Equations:
        """Equations of the switch, which leads to `n2` where `second` holds, else to `n1`."""
        closed, opened = self.Ron * self.unitCurrent, self.Goff * self.unitVoltage
        yield self.p.i + self.n1.i + self.n2.i == 0
        yield self.p.v - self.n1.v == self.s1 * where(second, self.unitVoltage, closed)
        yield self.n1.i == -self.s1 * where(second, opened, self.unitCurrent)
        yield self.p.v - self.n2.v == self.s2 * where(second, closed, self.unitVoltage)
        yield self.n2.i == -self.s2 * where(second, self.unitCurrent, opened)
        yield self.LossPower == self.p.i * self.p.v + self.n1.i * self.n1.v + self.n2.i * self.n2.v


class IdealTwoWaySwitch(PartialTwoWaySwitch):
    """Switch from `p` to `n2` where `control` is true (1), else to `n1`.

    >>> model = assemble("source.p - switch.p", "switch.n1 - one.p", "switch.n2 - two.p", "hand.y - switch.control",
    ...                  "source.n - one.n - two.n - ground.p", switch=IdealTwoWaySwitch(), ground=Ground(),
    ...                  hand=blocks.Step(startTime=0.5), source=ConstantVoltage(V=10.0), one=Resistor(R=5.0),
    ...                  two=Resistor(R=2.0))
    >>> ways = run(model, at=[0.2, 0.7])
    >>> close(ways["one.i"], [2.0, 0.0], 1e-4) and close(ways["two.i"], [0.0, 5.0], 1e-4)
    True

    Source: Modelica.Electrical.Analog.Ideal.IdealTwoWaySwitch.
    """

    control: Input = Input(doc="whether it leads to n2, 1 or 0")

    def equations(self) -> Equations:
        yield from super().equations()
        yield from self.switched(self.control > 0.5)


class ControlledIdealTwoWaySwitch(PartialTwoWaySwitch):
    """Switch from `p` to `n2` where ``control.v > level``, else to `n1`.

    >>> model = assemble("source.p - switch.p", "switch.n1 - one.p", "switch.n2 - two.p", "hand.p - switch.control",
    ...                  "source.n - one.n - two.n - hand.n - ground.p", switch=ControlledIdealTwoWaySwitch(),
    ...                  hand=StepVoltage(startTime=0.5), source=ConstantVoltage(V=10.0), one=Resistor(R=5.0),
    ...                  two=Resistor(R=2.0), ground=Ground())
    >>> ways = run(model, at=[0.2, 0.7])
    >>> close(ways["one.i"], [2.0, 0.0], 1e-4) and close(ways["two.i"], [0.0, 5.0], 1e-4)
    True

    Source: Modelica.Electrical.Analog.Ideal.ControlledIdealTwoWaySwitch.
    """

    level: Parameter = Parameter(0.5, unit="V", doc="potential of the change-over")
    control: Pin = Pin()

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.control.i == 0
        yield from self.switched(self.control.v > self.level)


class IdealTriac(Component):
    """Triac: two ideal thyristors in opposite directions, both fired by `fire1`, with an RC element across.

    `idealThyristor` conducts from n to p, `idealThyristor1` from p to n.

    >>> model = assemble("source.p - triac.p", "triac.n - load.p", "source.n - load.n - ground.p",
    ...                  "gate.y - triac.fire1", triac=IdealTriac(Vknee=0.0, Cdis=1e-9), load=Resistor(R=5.0),
    ...                  gate=blocks.Step(startTime=0.2), source=SineVoltage(V=10.0, f=1.0), ground=Ground())
    >>> close(run(model, at=[0.1, 0.25, 0.75])["load.i"], [0.0, 2.0, -2.0], 1e-3)
    True

    Source: Modelica.Electrical.Analog.Ideal.IdealTriac.
    """

    p: Pin = Pin()
    n: Pin = Pin()
    fire1: Input = Input(doc="whether to fire, 1 or 0")
    Ron: Parameter = Parameter(1e-5, unit="ohm", min=0.0, doc="resistance while conducting")
    Goff: Parameter = Parameter(1e-5, unit="S", min=0.0, doc="conductance while blocking")
    Vknee: Parameter = Parameter(0.8, unit="V", min=0.0, doc="threshold voltage in both directions")
    Rdis: Parameter = Parameter(100.0, unit="ohm", doc="resistance against disturbances")
    Cdis: Parameter = Parameter(0.005, unit="F", doc="capacitance against disturbances")
    idealThyristor: IdealThyristor = IdealThyristor(Ron=Ron, Goff=Goff, Vknee=Vknee)
    idealThyristor1: IdealThyristor = IdealThyristor(Ron=Ron, Goff=Goff, Vknee=Vknee)
    resistor: Resistor = Resistor(R=Rdis)
    capacitor: Capacitor = Capacitor(C=Cdis)

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.n, self.idealThyristor.p, self.idealThyristor1.n, self.resistor.p)  # as drawn in the source
        yield connect(self.p, self.idealThyristor.n, self.idealThyristor1.p, self.capacitor.n)
        yield connect(self.resistor.n, self.capacitor.p)
        yield connect(self.fire1, self.idealThyristor.fire, self.idealThyristor1.fire)


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
