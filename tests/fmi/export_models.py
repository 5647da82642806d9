"""Small models for the tests of FMI export, each of another kind."""

from __future__ import annotations

import acausal as ac
from acausal import (
    Array,
    Component,
    Discrete,
    Equations,
    Input,
    Output,
    Parameter,
    Variable,
    assert_,
    der,
    pre,
    reinit,
    sample,
    terminate,
    when,
)


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


class Ball(Component):
    """A ball that bounces and counts: a state event with a jump, and a discrete variable."""

    h: Variable = Variable(unit="m", start=1.0, fixed=True)
    v: Variable = Variable(unit="m/s", start=0.0, fixed=True)
    e: Parameter = Parameter(0.7)
    g: Parameter = Parameter(9.81, unit="m/s2")
    bounces: Discrete = Discrete(start=0)

    def equations(self) -> Equations:
        yield der(self.h) == self.v
        yield der(self.v) == -self.g
        yield when(self.h < 0, reinit(self.v, -self.e * pre(self.v)), {self.bounces: pre(self.bounces) + 1})


class Thermostat(Component):
    """A heater with two thresholds; the input warms, too."""

    T: Variable = Variable(start=15.0, fixed=True, nominal=20.0)
    u: Input = Input(start=0.0)
    on: Discrete = Discrete(start=1.0)
    low: Parameter = Parameter(18.0)
    high: Parameter = Parameter(22.0)

    def equations(self) -> Equations:
        yield der(self.T) == ac.where(self.on > 0.5, 2.0, 0.0) - 0.1 * (self.T - 10.0) + self.u
        yield when(self.T > self.high, {self.on: 0.0}).elsewhen(self.T < self.low, {self.on: 1.0})


class Sampled(Component):
    """A sampled controller: events by the time, also at the start."""

    x: Variable = Variable(start=1.0, fixed=True)
    u: Discrete = Discrete(start=0.0)
    k: Parameter = Parameter(2.0)

    def equations(self) -> Equations:
        yield der(self.x) == self.u - 0.1 * self.x
        yield when(sample(0.0, 0.25), {self.u: -self.k * self.x})


class Ticking(Sampled):
    """A signal that is true at the samples, and is counted."""

    tick: Discrete = Discrete(start=0.0)
    ticks: Discrete = Discrete(start=0.0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.tick == ac.where(sample(0.0, 0.25), 1.0, 0.0)
        yield when(self.tick > 0.5, {self.ticks: pre(self.ticks) + 1.0})


class Pulsed(Component):
    """Pulses from one clock end where those from another begin, but for rounding, before the start included."""

    x: Variable = Variable(start=0.0, fixed=True)
    one: Discrete = Discrete(start=0)
    other: Discrete = Discrete(start=0)
    ends: Discrete = Discrete(start=-1e3)

    def equations(self) -> Equations:
        yield der(self.x) == self.one - self.other
        yield when(sample(-0.15, 0.2), {self.one: pre(self.one) + 1, self.ends: ac.time + 0.1})
        yield when(sample(-0.05, 0.2), {self.other: pre(self.other) + 1})
        yield when(ac.time >= self.ends, reinit(self.x, pre(self.x) + 1.0))


class Dosed(Component):
    """Two vessels that exchange what is in them and lose nothing; a dose changes their sum, by `when` and `reinit`."""

    a: Variable = Variable(start=1.0, fixed=True)
    b: Variable = Variable(start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.a) == self.b - self.a
        yield der(self.b) == self.a - self.b
        yield when(sample(0.3, 0.25), ac.reinit(self.a, ac.pre(self.a) + 1.0))
        yield when(self.b > 1.2, ac.reinit(self.b, ac.pre(self.b) - 0.5))


class Rectifier(Component):
    """An ideal diode: its mode and the algebraic equations decide each other."""

    R: Parameter = Parameter(2.0)
    C: Parameter = Parameter(0.5)
    s: Variable = Variable()
    i: Variable = Variable()
    v: Variable = Variable(start=0.2, fixed=True)
    vd: Variable = Variable()

    def equations(self) -> Equations:
        off = self.s < 0
        yield self.vd == ac.where(off, self.s, 1e-3 * self.s)
        yield self.i == ac.where(off, 1e-3 * self.s, self.s)
        yield ac.sin(5 * ac.time) == self.R * self.i + self.vd + self.v
        yield self.C * der(self.v) == self.i - 0.1 * self.v


class Wall(Component):
    """A Cartesian pendulum that swings against a wall: a jump of velocities with retained constraints."""

    L: Parameter = Parameter(1.0)
    x: Variable = Variable(start=0.8, fixed=True)
    y: Variable = Variable(start=-0.6)
    vx: Variable = Variable(start=0.0, fixed=True)
    vy: Variable = Variable()
    tension: Variable = Variable()

    def equations(self) -> Equations:
        yield der(self.x) == self.vx
        yield der(self.y) == self.vy
        yield der(self.vx) == -self.tension * self.x
        yield der(self.vy) == -self.tension * self.y - 9.81
        yield self.x**2 + self.y**2 == self.L**2
        yield when(self.x < -0.2, reinit(self.vx, -0.8 * pre(self.vx)))


class Rounded(Component):
    """Rounding in an equation."""

    x: Variable = Variable(start=0.0, fixed=True)
    y: Variable = Variable()

    def equations(self) -> Equations:
        yield der(self.x) == 1.0 - 0.2 * self.y
        yield self.y == ac.floor(2.0 * self.x)


class StruckTwice(Component):
    """A state that is set twice at a moment, and the edge of a condition on what a discrete variable was."""

    x: Variable = Variable(start=0.0, fixed=True)
    left: Discrete = Discrete(start=0.0)
    n: Discrete = Discrete(start=0)
    seen: Discrete = Discrete(start=0)

    def equations(self) -> Equations:
        yield der(self.x) == 1.0
        yield when(
            [self.x >= 2.0, sample(1.0, 5.0)], reinit(self.x, pre(self.x) + 1.5),
            {self.left: pre(self.x), self.n: pre(self.n) + 1},
        )  # fmt: skip
        yield when(ac.edge(pre(self.n) > 1.5), {self.seen: pre(self.seen) + 1})


class Ends(Component):
    """Warns, and ends the simulation."""

    x: Variable = Variable(start=0.0, fixed=True)
    last: Discrete = Discrete(start=0.0)

    def equations(self) -> Equations:
        yield der(self.x) == 1.0
        yield assert_(self.x < 0.5, "x is large", level="warning")
        yield when(self.x > 0.8, terminate("x has reached 0.8"))
        yield when(ac.terminal(), {self.last: self.x})


class Breaks(Component):
    """An assertion fails at t = 0.5."""

    x: Variable = Variable(start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) == 1.0
        yield assert_(self.x < 0.5, "100 % is too much")


class BreaksUnseen(Component):
    """The same without an event."""

    x: Variable = Variable(start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) == 1.0
        yield assert_(ac.noevent(self.x < 0.5), "this is too much")


class Latch(Component):
    """Positive feedback: either output agrees with the equations for a while, the start value says which is there."""

    y0: Parameter = Parameter(1.0)
    y: Variable = Variable(start=y0)
    x: Variable = Variable(start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield self.y == ac.where(ac.sin(2 * ac.time) + 0.5 * self.y > 0, 1.0, -1.0)
        yield der(self.x) == self.y - self.x


class Swing(Component):
    """A Cartesian pendulum without velocities of its own: states that the model does not declare."""

    x: Variable = Variable(start=0.6, fixed=True)
    y: Variable = Variable(start=-0.8)
    tension: Variable = Variable()

    def equations(self) -> Equations:
        yield der(der(self.x)) == -self.tension * self.x
        yield der(der(self.y)) == -self.tension * self.y - 9.81
        yield self.x**2 + self.y**2 == 1.0

    def initial_equations(self) -> Equations:
        yield der(self.x) == 0.5
