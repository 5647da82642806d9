"""A quarter of a car on a bumpy road, with two suspensions that replace each other."""
# pyright: reportUnknownMemberType=false
# (the stubs of the plotting and numerical libraries are incomplete)

from pathlib import Path
from typing import Any

from matplotlib import pyplot

import acausal as ac
from acausal import Component, Equations, Parameter, connect, start, where
from acausal.components import blocks
from acausal.components import translational as tr


class Suspension(tr.PartialCompliantWithVelocity):
    """A spring, and a damper that is harder when it extends than when it is compressed."""

    c: Parameter = Parameter(2e4, unit="N/m", doc="spring constant")
    d_bump: Parameter = Parameter(500.0, unit="N*s/m", doc="damping when compressed")
    d_rebound: Parameter = Parameter(2500.0, unit="N*s/m", doc="damping when extended")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.f == self.c * self.s_rel + where(self.v_rel > 0, self.d_rebound, self.d_bump) * self.v_rel


class QuarterCar(Component):
    """Road, tyre, wheel, suspension and body, one above the other; positions from the static ones."""

    bumps: blocks.SignalSource = blocks.Sine(amplitude=0.03, f=2.0)
    road: tr.Position = tr.Position(exact=True)
    tyre: tr.SpringDamper = tr.SpringDamper(c=2e5, d=100.0)
    wheel: tr.Mass = tr.Mass(m=40.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True))
    suspension: tr.PartialCompliantWithVelocity = Suspension()  # any component of this type can take its place
    body: tr.Mass = tr.Mass(m=350.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True))

    def equations(self) -> Equations:
        yield self.road.s_ref == self.bumps.y
        yield connect(self.road.flange, self.tyre.flange_a)
        yield connect(self.tyre.flange_b, self.wheel.flange_a)
        yield connect(self.wheel.flange_b, self.suspension.flange_a)
        yield connect(self.suspension.flange_b, self.body.flange_a)


def main(out: Path = Path("quarter_car.png")) -> None:
    """Simulate both and draw the bodies' motion."""
    car = QuarterCar()
    linear = ac.redeclare(car, {"suspension": tr.SpringDamper(c=2e4, d=1500.0)})
    figure: Any = pyplot.figure(figsize=(8.0, 3.2), layout="constrained")
    axes = figure.subplots()
    for label, model in (("harder in rebound", car), ("linear", linear)):
        solution = ac.compile(model).simulate(t1=3.0, rtol=1e-8)
        axes.plot(solution.t, solution["body.s"], label=f"body, {label}")
    axes.plot(solution.t, solution["road.s_ref"], "0.6", label="road")
    axes.set(xlabel="t [s]", ylabel="position [m]")
    axes.set_ylim(top=0.055)
    axes.legend(loc="upper right", ncols=3)
    figure.savefig(out)


if __name__ == "__main__":
    main()
