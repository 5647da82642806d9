"""Small models of the analysis tests."""

from __future__ import annotations

from acausal import Component, Equations, Input, Parameter, Variable, der


class Oscillator(Component):
    """Mass on a spring with damping, released at 1 m."""

    m: Parameter = Parameter(1.0, unit="kg", min=0.0)
    c: Parameter = Parameter(4.0, unit="N/m", min=0.0)
    d: Parameter = Parameter(0.3, unit="N.s/m", min=0.0)
    idle: Parameter = Parameter(2.0, unit="N", doc="has no influence")
    double: Parameter = Parameter(2 * c, unit="N/m", doc="depends on another parameter")
    s: Variable = Variable(unit="m", start=1.0, fixed=True, doc="position")
    v: Variable = Variable(unit="m/s", start=0.0, fixed=True, doc="speed")
    f: Variable = Variable(unit="N", doc="force of the spring")
    unused: Variable = Variable(unit="N")

    def equations(self) -> Equations:
        yield der(self.s) == self.v
        yield self.m * der(self.v) == -self.f - self.d * self.v
        yield self.f == self.c * self.s
        yield self.unused == self.idle


class Explosive(Component):
    """``x' = a x^2`` from 1: it leaves every bound at ``t = 1/a``."""

    a: Parameter = Parameter(0.1, unit="1/s", min=0.0)
    x: Variable = Variable(unit="1", start=1.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) == self.a * self.x**2


class Tank(Component):
    """A tank with inflow and linear outflow: ``V' = u - k V``."""

    k: Parameter = Parameter(0.5, unit="1/s", min=0.0)
    V: Variable = Variable(unit="m3", start=1.0, fixed=True)
    u: Input = Input(unit="m3/s")

    def equations(self) -> Equations:
        yield der(self.V) == self.u - self.k * self.V
