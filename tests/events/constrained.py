"""Events of models with retained constraints."""

from __future__ import annotations

from acausal import Component, Discrete, Equations, Parameter, Variable, der, pre, reinit, when


class Wall(Component):
    """A pendulum in Cartesian coordinates, index 3, that swings against an upright wall at ``x = -wall L``."""

    L: Parameter = Parameter(1.0, unit="m")
    g: Parameter = Parameter(9.81, unit="m/s2")
    e: Parameter = Parameter(0.8, unit="1")
    wall: Parameter = Parameter(0.2, unit="1")
    x: Variable = Variable(start=0.8, fixed=True, unit="m")
    y: Variable = Variable(start=-0.6, unit="m")
    vx: Variable = Variable(start=0.0, fixed=True, unit="m/s")
    vy: Variable = Variable(start=0.0, unit="m/s")
    tension: Variable = Variable(unit="1/s2")
    hits: Discrete = Discrete(start=0)

    def equations(self) -> Equations:
        yield der(self.x) == self.vx
        yield der(self.y) == self.vy
        yield der(self.vx) == -self.tension * self.x
        yield der(self.vy) == -self.tension * self.y - self.g
        yield self.x**2 + self.y**2 == self.L**2
        back = reinit(self.vx, -self.e * pre(self.vx))
        yield when(self.x < -self.wall * self.L, back, {self.hits: pre(self.hits) + 1})
