"""Small models for the tests of FMI export, each of another kind."""

from __future__ import annotations

import acausal as ac
from acausal import Array, Component, Equations, Input, Output, Parameter, Variable, der


class Oscillator(Component):
    """A damped oscillator with an input and an output."""

    x: Variable = Variable(unit="m", start=1.0, fixed=True, doc="position")
    v: Variable = Variable(unit="m/s", start=0.0, fixed=True, nominal=2.0)
    u: Input = Input(unit="N", start=0.5)
    y: Output = Output(unit="m")
    same: Variable = Variable(unit="m", doc="another name of x")
    against: Variable = Variable(unit="m")
    pressure: Variable = Variable(unit="bar")
    k: Parameter = Parameter(4.0, unit="N/m", min=0.0)
    m: Parameter = Parameter(1.0, unit="kg", min=1e-3)
    d: Parameter = Parameter(0.3, unit="N.s/m")
    F: Parameter = Parameter(0.1, unit="N")
    curve: Parameter = Parameter(0.5, unit="1/m")
    period: Parameter = Parameter(6.283185307179586 * ac.sqrt(m / k), unit="s")

    def equations(self) -> Equations:
        yield der(self.x) == self.v
        yield self.m * der(self.v) == self.u - self.k * self.x - self.d * self.v + self.F * ac.sin(ac.time)
        yield self.y == 2 * self.x + self.curve * self.x**2
        yield self.same == self.x
        yield self.against == -self.x
        yield self.pressure == 3.0


class Implicit(Component):
    """A nonlinear algebraic equation that stays with the solver; the start value comes from a parameter."""

    a: Parameter = Parameter(1.5)
    x0: Parameter = Parameter(1.0)
    u: Input = Input(start=0.0)
    x: Variable = Variable(start=x0, fixed=True)
    y: Output = Output(start=0.5)

    def equations(self) -> Equations:
        yield der(self.x) == -self.y + self.u
        yield self.y + self.y**3 == self.a * self.x + 0.2 * self.u


class Balanced(Component):
    """The start comes from an initial equation and from the start value of a variable that is no state."""

    a: Parameter = Parameter(3.0)
    b: Parameter = Parameter(2.0)
    x: Variable = Variable(start=1.0)
    z: Variable = Variable()
    r: Variable = Variable(start=4.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) == self.b - self.a * self.x + ac.sin(ac.time)
        yield der(self.z) == self.x - self.z
        yield self.r == self.z**3 + self.b * self.z

    def initial_equations(self) -> Equations:
        yield self.b - self.a * self.x == 0


class Pendulum(Component):
    """A Cartesian pendulum: index 3, with retained constraints."""

    L: Parameter = Parameter(1.2, unit="m")
    g: Parameter = Parameter(9.81, unit="m/s2")
    x: Variable = Variable(start=L, fixed=True, unit="m")
    y: Variable = Variable(start=0.0, unit="m")
    vx: Variable = Variable(unit="m/s")
    vy: Variable = Variable(start=0.0, fixed=True, unit="m/s")
    tension: Variable = Variable(unit="1/s2")

    def equations(self) -> Equations:
        yield der(self.x) == self.vx
        yield der(self.y) == self.vy
        yield der(self.vx) == -self.tension * self.x
        yield der(self.vy) == -self.tension * self.y - self.g
        yield self.x**2 + self.y**2 == self.L**2


class Cell(Component):
    """One cell of a chain."""

    T: Variable = Variable(unit="degC", start=20.0, fixed=True)
    left: Variable = Variable(unit="degC")
    k: Parameter = Parameter(0.5, unit="1/s")

    def equations(self) -> Equations:
        yield der(self.T) == self.k * (self.left - self.T)


class Chain(Component):
    """An array of components, without inputs or outputs."""

    n: int = 3
    cells: Array[Cell] = Array(Cell(), "n")

    def equations(self) -> Equations:
        yield self.cells[0].left == 80.0
        yield self.cells[1:].left == self.cells[:-1].T


class Explodes(Component):
    """``x' = x^2``: no solution beyond t = 1."""

    x: Variable = Variable(start=1.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) == self.x**2
