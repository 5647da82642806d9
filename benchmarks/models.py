"""The models that the benchmarks build from the component library."""

from acausal import Array, Component, Equations, Parameter, connect, start
from acausal.components.electrical import Capacitor, ConstantVoltage, Ground, Pin, Resistor
from acausal.components.translational import ConstantForce, Fixed, Flange, Mass, SpringDamper


class RCCell(Component):
    """One cell of the line: a resistor in the way, a capacitor to ground."""

    R: Parameter = Parameter(1.0, unit="ohm", doc="resistance of the cell")
    C: Parameter = Parameter(1.0, unit="F", doc="capacitance of the cell")
    p: Pin = Pin()
    n: Pin = Pin()
    g: Pin = Pin()
    resistor: Resistor = Resistor(R=R)
    capacitor: Capacitor = Capacitor(C=C, v=start(0.0, fixed=True))

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.p, self.resistor.p)
        yield connect(self.resistor.n, self.capacitor.p, self.n)
        yield connect(self.capacitor.n, self.g)


class Ladder(Component):
    """A line of `cells` RC cells behind a source of 1 V, open at the far end.

    The line has 1 ohm and 1 F in all, each cell its part of it: time constants run from 0.4 s down to 1/(4 N^2) s.
    """

    count: int = 10
    R: Parameter = Parameter(1.0, unit="ohm", doc="resistance of the whole line")
    C: Parameter = Parameter(1.0, unit="F", doc="capacitance of the whole line")
    number: Parameter = Parameter(10.0, unit="1", doc="number of cells")
    source: ConstantVoltage = ConstantVoltage(V=1.0)
    ground: Ground = Ground()
    cells: Array[RCCell] = Array(RCCell(R=R / number, C=C / number), "count")

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.source.n, self.ground.p)
        yield connect(self.source.p, self.cells[0].p)
        yield connect(self.cells[:-1].n, self.cells[1:].p)
        yield connect(self.cells[:].g, self.ground.p)


def ladder(cells: int) -> Ladder:
    """The ladder with this many cells."""
    return Ladder(count=cells, number=float(cells))


class PairCell(Component):
    """A spring-damper and two masses rigidly joined: the joint's force is unknown, so the index is 3."""

    m: Parameter = Parameter(1.0, unit="kg", doc="mass of each of the two")
    L: Parameter = Parameter(0.25, unit="m", doc="length of each of the two")
    c: Parameter = Parameter(1.0, unit="N/m", doc="spring constant")
    d: Parameter = Parameter(0.01, unit="N*s/m", doc="damping constant")
    position: Parameter = Parameter(0.0, unit="m", doc="where the first mass is at the start")
    flange_a: Flange = Flange()
    flange_b: Flange = Flange()
    spring: SpringDamper = SpringDamper(c=c, d=d, s_rel0=2 * L)
    first: Mass = Mass(m=m, L=L, s=start(position, fixed=True), v=start(0.0, fixed=True))
    second: Mass = Mass(m=m, L=L)

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.flange_a, self.spring.flange_a)
        yield connect(self.spring.flange_b, self.first.flange_a)
        yield connect(self.first.flange_b, self.second.flange_a)
        yield connect(self.second.flange_b, self.flange_b)


class Chain(Component):
    """A bar of `count` cells: fixed at one end, pulled with 1 N at the other from t = 0 on."""

    count: int = 10
    fixed: Fixed = Fixed()
    pull: ConstantForce = ConstantForce(f_constant=1.0)
    cells: Array[PairCell] = Array(PairCell(), "count")

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.fixed.flange, self.cells[0].flange_a)
        yield connect(self.cells[:-1].flange_b, self.cells[1:].flange_a)
        yield connect(self.cells[-1].flange_b, self.pull.flange)


CHAIN_STIFFNESS, CHAIN_DAMPING, CHAIN_MASS = 1.0, 0.02, 1.0
"""Of the whole bar: N/m, N s/m, kg."""


def chain(cells: int) -> Chain:
    """The bar of 1 m with this many cells, each with a pair of masses, so 2 x `cells` masses in all."""
    length = 1.0 / (4 * cells)
    cell = PairCell(m=CHAIN_MASS / (2 * cells), L=length, c=CHAIN_STIFFNESS * cells, d=CHAIN_DAMPING * cells)
    positions = [(4 * k + 2.5) * length for k in range(cells)]
    return Chain(count=cells, cells=Array(cell, cells, position=positions))
