"""Small models for the tests of co-simulation."""

from __future__ import annotations

from acausal import Component, Equations, Input, Output, Parameter, Variable, connect, der, start
from acausal.components import translational


class TwoMasses(Component):
    """Two masses, each held by a spring and a damper, with a spring and a damper between them."""

    one: translational.Mass = translational.Mass(m=2.0, s=start(1.0, fixed=True), v=start(0.0, fixed=True))
    two: translational.Mass = translational.Mass(m=1.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True))
    left: translational.SpringDamper = translational.SpringDamper(c=20.0, d=0.5)
    middle: translational.SpringDamper = translational.SpringDamper(c=10.0, d=1.0)
    wall: translational.Fixed = translational.Fixed()

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.wall.flange, self.left.flange_a)
        yield connect(self.left.flange_b, self.one.flange_a)
        yield connect(self.one.flange_b, self.middle.flange_a)
        yield connect(self.middle.flange_b, self.two.flange_a)


class RigidMasses(Component):
    """Two masses joined rigidly, on a spring: index 3; split, each side needs the other's acceleration."""

    one: translational.Mass = translational.Mass(m=2.0, s=start(1.0, fixed=True), v=start(0.0, fixed=True))
    two: translational.Mass = translational.Mass(m=0.5)
    left: translational.Spring = translational.Spring(c=20.0)
    wall: translational.Fixed = translational.Fixed()

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.wall.flange, self.left.flange_a)
        yield connect(self.left.flange_b, self.one.flange_a)
        yield connect(self.one.flange_b, self.two.flange_a)


class Decay(Component):
    """``tau dy/dt = u - y``."""

    u: Input = Input()
    y: Output = Output(start=1.0, fixed=True)
    tau: Parameter = Parameter(0.5, unit="s")

    def equations(self) -> Equations:
        yield self.tau * der(self.y) == self.u - self.y


class Gain(Component):
    """``y = k u + b``."""

    u: Input = Input()
    y: Output = Output()
    k: Parameter = Parameter(1.0)
    b: Parameter = Parameter(0.0)
    x: Variable = Variable(start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield self.y == self.k * self.u + self.b
        yield der(self.x) == self.y
