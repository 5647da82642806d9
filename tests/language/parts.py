"""Small components that the tests of the language are written with."""

from __future__ import annotations

import acausal as ac
from acausal import Component, Connector, Equations, Flow, Input, Output, Parameter, Potential, Variable, connect, der


class Pin(Connector):
    v: Potential = Potential(unit="V")
    i: Flow = Flow(unit="A")


class TwoPin(Component, partial=True):
    p: Pin = Pin()
    n: Pin = Pin()
    v: Variable = Variable(unit="V")
    i: Variable = Variable(unit="A")

    def equations(self) -> Equations:
        yield self.v == self.p.v - self.n.v
        yield self.i == self.p.i
        yield self.p.i + self.n.i == 0


class Resistor(TwoPin):
    R: Parameter = Parameter(1.0, unit="ohm", min=0.0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v == self.R * self.i


class Conductor(TwoPin):
    """Not a subclass of Resistor, but it has a field R too."""

    R: Parameter = Parameter(1.0, unit="ohm", min=0.0)
    k: Parameter = Parameter(1.0, unit="1")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.i == self.k * self.v / self.R


class Diode(TwoPin):
    Is: Parameter = Parameter(1e-9, unit="A")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.i == self.Is * (ac.exp(self.v / 0.025) - 1)


class Capacitor(TwoPin):
    C: Parameter = Parameter(1e-3, unit="F", min=0.0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.C * der(self.v) == self.i


class Source(TwoPin):
    V: Parameter = Parameter(1.0, unit="V")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v == self.V


class Ground(Component):
    p: Pin = Pin()

    def equations(self) -> Equations:
        yield self.p.v == 0


class Cell(Component):
    """RC low-pass with a common node `g`."""

    p: Pin = Pin()
    n: Pin = Pin()
    g: Pin = Pin()
    resistor: TwoPin = Resistor(R=2.0)
    capacitor: Capacitor = Capacitor(C=0.01, v=ac.start(0.0, fixed=True))

    def equations(self) -> Equations:
        yield connect(self.p, self.resistor.p)
        yield connect(self.resistor.n, self.capacitor.p, self.n)
        yield connect(self.capacitor.n, self.g)


class Gain(Component):
    k: Parameter = Parameter(1.0)
    u: Input = Input()
    y: Output = Output()

    def equations(self) -> Equations:
        yield self.y == self.k * self.u


class RC(Component):
    """Source, resistor, capacitor and ground in a loop."""

    source: TwoPin = Source(V=1.0)
    resistor: TwoPin = Resistor(R=2.0)
    capacitor: Capacitor = Capacitor(C=0.5, v=ac.start(0.0, fixed=True))
    ground: Ground = Ground()

    def equations(self) -> Equations:
        yield connect(self.source.p, self.resistor.p)
        yield connect(self.resistor.n, self.capacitor.p)
        yield connect(self.capacitor.n, self.source.n, self.ground.p)
