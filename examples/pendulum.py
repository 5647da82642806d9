"""A pendulum in Cartesian coordinates: the rod is a constraint, the index is 3, and it swings right over the top."""
# pyright: reportUnknownMemberType=false
# (the stubs of the plotting and numerical libraries are incomplete)

from math import cos, pi, sin
from pathlib import Path
from typing import Any

from matplotlib import pyplot

import acausal as ac
from acausal import Component, Equations, Parameter, Variable, der, start


class Pendulum(Component):
    """A point mass on a rigid rod; the rod's force is an unknown that no equation gives."""

    L: Parameter = Parameter(1.0, unit="m", doc="length of the rod")
    m: Parameter = Parameter(1.0, unit="kg", doc="mass")
    g: Parameter = Parameter(9.81, unit="m/s2", doc="gravity")
    x: Variable = Variable(unit="m")
    y: Variable = Variable(unit="m")
    vx: Variable = Variable(unit="m/s")
    vy: Variable = Variable(unit="m/s")
    tension: Variable = Variable(unit="N", doc="force in the rod")

    def equations(self) -> Equations:
        yield der(self.x) == self.vx
        yield der(self.y) == self.vy
        yield self.m * der(self.vx) == -self.tension * self.x / self.L
        yield self.m * der(self.vy) == -self.tension * self.y / self.L - self.m * self.g
        yield self.x**2 + self.y**2 == self.L**2


def main(out: Path = Path("pendulum.png")) -> None:
    """Simulate from just under the top, say what the compiler found, and draw the motion and the rod's force."""
    angle = 170 * pi / 180
    model = Pendulum(x=start(sin(angle), fixed=True), y=start(-cos(angle)), vx=start(0.0, fixed=True))
    system = ac.compile(model)
    print(system.report())
    solution = system.simulate(t1=10.0, rtol=1e-9)
    figure: Any = pyplot.figure(figsize=(8.0, 4.5), layout="constrained")
    above, below = figure.subplots(2, sharex=True)
    above.plot(solution.t, solution["x"], label="x")
    above.plot(solution.t, solution["y"], label="y")
    above.set_ylabel("[m]")
    above.legend()
    below.plot(solution.t, solution["tension"])
    below.set(xlabel="t [s]", ylabel="force in the rod [N]")
    figure.savefig(out)
    length = (solution["x"] ** 2 + solution["y"] ** 2) ** 0.5
    print(f"the rod's length stays within {abs(length - 1.0).max():.1e} m")


if __name__ == "__main__":
    main()
