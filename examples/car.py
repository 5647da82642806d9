"""The body of a car on a bumpy road, with two suspensions that replace each other: the example of the README."""
# pyright: reportUnknownMemberType=false
# (the stubs of the plotting library are incomplete)

from pathlib import Path
from typing import Any

from matplotlib import pyplot

import acausal as ac
from acausal import Component, Equations, Parameter, connect, start, where
from acausal.components import translational as tr


class Suspension(tr.PartialCompliantWithVelocity):
    """A spring, and a damper that is harder when it extends than when it is compressed."""

    c: Parameter = Parameter(2e4, unit="N/m", doc="spring constant")
    d: Parameter = Parameter(2500.0, unit="N*s/m", doc="damping when extended; compressed, a fifth of it")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.f == self.c * self.s_rel + where(self.v_rel > 0, 1.0, 0.2) * self.d * self.v_rel


class Car(Component):
    """Road, suspension and body, one above the other; positions from the static ones."""

    road: tr.Position = tr.Position(exact=True)
    suspension: tr.PartialCompliantWithVelocity = Suspension()  # any component of this type can take its place
    body: tr.Mass = tr.Mass(m=350.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True))

    def equations(self) -> Equations:
        yield self.road.s_ref == 0.03 * ac.sin(12.6 * ac.time)
        yield connect(self.road.flange, self.suspension.flange_a)
        yield connect(self.suspension.flange_b, self.body.flange_a)


def main(out: Path = Path("car.png")) -> None:
    """Simulate both and draw the bodies' motion."""
    linear = ac.redeclare(Car(), {"suspension": tr.SpringDamper(c=2e4, d=1500.0)})
    figure: Any = pyplot.figure(figsize=(8.0, 3.2), layout="constrained")
    axes = figure.subplots()
    for label, model in (("harder in rebound", Car()), ("linear", linear)):
        solution = ac.compile(model).simulate(t1=3.0, rtol=1e-8)
        axes.plot(solution.t, solution["body.s"], label=f"body, {label}")
    axes.plot(solution.t, solution["road.s_ref"], "0.6", label="road")  # pyright: ignore[reportPossiblyUnboundVariable]
    axes.set(xlabel="t [s]", ylabel="position [m]")
    axes.margins(y=0.25)
    axes.legend(loc="upper right", ncols=3)
    figure.savefig(out)


if __name__ == "__main__":
    main()
