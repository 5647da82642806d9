"""Small models that each exercise one part of the native engine."""

from __future__ import annotations

import acausal as ac
from acausal import Component, Equations, Input, Parameter, Variable, der


class Decay(Component):
    """x' = -k x: the parameter in an equation, the start value from a parameter."""

    k: Parameter = Parameter(0.7)
    x0: Parameter = Parameter(2.0)
    x: Variable = Variable(start=x0, fixed=True)
    y: Variable = Variable()

    def equations(self) -> Equations:
        yield der(self.x) == -self.k * self.x
        yield self.y == self.x**2 + self.k


class Balanced(Component):
    """The start comes from an initial equation: x' = 0 at t = 0, so x(0) = b / a."""

    a: Parameter = Parameter(3.0)
    b: Parameter = Parameter(2.0)
    x: Variable = Variable(start=1.0)

    def equations(self) -> Equations:
        yield der(self.x) == self.b - self.a * self.x + ac.sin(ac.time)

    def initial_equations(self) -> Equations:
        yield self.b - self.a * self.x == 0


class Torn(Component):
    """A nonlinear algebraic equation that stays with the solver: y + y^3 = a x."""

    a: Parameter = Parameter(1.5)
    x: Variable = Variable(start=1.0, fixed=True)
    y: Variable = Variable(start=0.5)

    def equations(self) -> Equations:
        yield der(self.x) == -self.y
        yield self.y + self.y**3 == self.a * self.x


class Free(Torn):
    """The same, with a guess of x: the start may be given by another variable."""

    x: Variable = Variable(start=1.0)
    z: Variable = Variable()

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.z == self.x**2 + self.a * self.y


class LinearBlock(Component):
    """Five simultaneous linear equations, solved numerically inside the right-hand side."""

    g: Parameter = Parameter(2.0)
    x: Variable = Variable(start=1.0, fixed=True)
    a: Variable = Variable()
    b: Variable = Variable()
    c: Variable = Variable()
    d: Variable = Variable()
    e: Variable = Variable()

    def equations(self) -> Equations:
        g, x = self.g, self.x
        yield der(x) == -self.a - self.e
        yield (3 + g) * self.a + self.b + 0.5 * self.c * x + self.d + self.e == x
        yield self.a + 4 * self.b + g * self.c + 0.3 * self.d + 0.2 * self.e == 1
        yield 0.3 * self.a + self.b + (5 + x) * self.c + self.d + 0.7 * self.e == 2 * x
        yield self.a + 0.2 * self.b + self.c + 6 * self.d + g * self.e == 0
        yield 0.5 * self.a + self.b + 0.1 * self.c + self.d + 7 * self.e == x**2


class Swinging(Component, partial=True):
    """A mass at constant distance from a pivot; subclasses say what forces it."""

    L: Parameter = Parameter(1.2)
    g: Parameter = Parameter(9.81)
    x: Variable = Variable(start=L, fixed=True)
    y: Variable = Variable(start=0.0)
    vx: Variable = Variable()
    vy: Variable = Variable(start=0.0, fixed=True)
    tension: Variable = Variable()

    def equations(self) -> Equations:
        yield der(self.x) == self.vx
        yield der(self.y) == self.vy
        yield self.x**2 + self.y**2 == self.L**2


class Pendulum(Swinging):
    """A Cartesian pendulum: index 3, with retained constraints."""

    def equations(self) -> Equations:
        yield from super().equations()
        yield der(self.vx) == -self.tension * self.x
        yield der(self.vy) == -self.tension * self.y - self.g


class Damped(Swinging):
    """The same in air: the drag is an algebraic unknown, which the constraint on the accelerations depends on."""

    c: Parameter = Parameter(0.4)
    drag: Variable = Variable(start=0.1)

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.drag + 0.2 * self.drag**3 == self.c * (self.vx**2 + self.vy**2)
        yield der(self.vx) == -self.tension * self.x - self.drag * self.vx
        yield der(self.vy) == -self.tension * self.y - self.drag * self.vy - self.g


class Carried(Swinging):
    """The pivot accelerates sideways as the input says."""

    u: Input = Input(start=0.0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield der(self.vx) == -self.tension * self.x - self.u
        yield der(self.vy) == -self.tension * self.y - self.g


class Driven(Component):
    """A lag driven by an input, seen through a table."""

    T: Parameter = Parameter(0.5)
    u: Input = Input(start=0.0)
    x: Variable = Variable(start=0.0, fixed=True)
    y: Variable = Variable()

    def equations(self) -> Equations:
        yield self.T * der(self.x) == self.u - self.x
        yield self.y == ac.table([0.0, 0.5, 1.0], [0.0, 1.0, 1.2])(self.x)


class Branches(Component):
    """Every operator, and a `where` whose branches are expensive."""

    k: Parameter = Parameter(0.8)
    x: Variable = Variable(start=0.3, fixed=True)
    y: Variable = Variable(start=1.1, fixed=True)
    z: Variable = Variable()

    def equations(self) -> Equations:
        x, y, k = self.x, self.y, self.k
        costly = ac.exp(-y) * ac.log(2 + x**2) + ac.log10(3 + y**2) + (1.5 + ac.sin(y)) ** k
        cheap = ac.atan2(x, 1 + y**2) + ac.tanh(y) * ac.cosh(0.1 * x) - ac.sinh(0.1 * y)
        yield self.z == ac.where((x > 0) & ~(y > 1.4), costly, cheap)
        yield der(x) == -k * self.z + ac.cos(3 * ac.time) + ac.clip(y, -1.0, 1.0) * 0.1 + ac.min(x, 0.2) - ac.max(x, y)
        smooth = ac.asin(0.3 * ac.sin(x)) + ac.acos(0.2 * ac.cos(y)) + ac.atan(x) + ac.tan(0.1 * x) + ac.sqrt(1 + x**2)
        yield der(y) == 0.2 * smooth - y * ac.abs(y) ** 1.5 + ac.sign(x - 5.0) * 0.01 + (1 + y**2) ** -0.75
