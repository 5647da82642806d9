"""Ideal diodes, thyristors and triac: two straight lines with an event where they meet."""

from __future__ import annotations

from acausal import Component, Discrete, Equations, Input, Parameter, Variable, connect, pre, where

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
