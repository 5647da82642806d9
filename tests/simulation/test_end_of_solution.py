"""A solution that ends in finite time is an error, at that time; one with a jump goes on."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Component, Equations, Parameter, Variable, der, noevent, where
from models.kbc import reference_crane

ENGINES = ("native", "diffrax")


class MeetsZero(Component):
    """``x = sqrt(1 - 2 t)``: there is nothing after t = 1/2, where the right-hand side is infinite."""

    x: Variable = Variable(start=1.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) == -1 / self.x


class DeadCentre(Component):
    """``cos(p) = cos(2) - t``: the lever sin(p) vanishes at ``t = 1 + cos(2)``, which drives p against its stop."""

    p: Variable = Variable(start=2.0, fixed=True)

    def equations(self) -> Equations:
        yield ac.sin(self.p) * der(self.p) == 1


class GrowsOver(Component):
    """``x = 1/(1 - t)``."""

    x: Variable = Variable(start=1.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) == self.x**2


def end_of(model: Component, t1: float, **options: Any) -> float:
    """Time at which the error says that the run stopped."""
    with pytest.raises(ac.SimulationError) as error:
        ac.compile(model).simulate(t1, saveat=3, **options)
    found = re.match(r"The simulation stopped at t = (\S+) s of", str(error.value))
    assert found, str(error.value)
    return float(found[1])


@pytest.mark.parametrize("rtol", [1e-6, 1e-9])
@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize(
    ("model", "end"),
    [(MeetsZero(), 0.5), (DeadCentre(), 1 + np.cos(2.0)), (GrowsOver(), 1.0)],
    ids=["zero", "dead", "grows"],
)
def test_the_run_stops_where_the_solution_ends(model: Component, end: float, engine: str, rtol: float) -> None:
    assert abs(end_of(model, 2.0, engine=engine, rtol=rtol) - end) < 20 * rtol


@pytest.mark.parametrize("engine", ENGINES)
def test_the_rigid_crane_stops_at_its_dead_centre(engine: str) -> None:
    """The simplified cylinder has no bumpers: it drives the boom to where its lever is zero, at x = a + b - L0."""
    crane = reference_crane("simplified", "rigid", "endstop")
    end = end_of(crane, 20.0, engine=engine, rtol=1e-8)
    before = ac.compile(crane).simulate(end - 1e-3, saveat=2, rtol=1e-8)
    speed = 2.5e-4 * 25.0 / (np.pi / 4 * 0.25**2)
    assert abs(before["x"][-1] + 1e-3 * speed - 2.4) < 1e-5


class Jumps(Component):
    """The right-hand side jumps by `high` at t = 1 s, unlocated."""

    high: Parameter = Parameter(1e6)
    x: Variable = Variable(start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) == where(noevent(ac.time < 1.0), 1.0, self.high)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("high", [1e2, 1e6, 1e10])
def test_a_jump_of_the_right_hand_side_is_crossed(engine: Any, high: float) -> None:
    solution = ac.compile(Jumps(high=high)).simulate(1.5, saveat=4, engine=engine, rtol=1e-6)
    assert abs(solution["x"][-1] / (1.0 + 0.5 * high) - 1) < 1e-5


class Filling(Component):
    """A level that rises at the rate k up to a limit, which the solver has to find by its steps."""

    k: Parameter = Parameter(4.0)
    limit: Parameter = Parameter(2.0)
    x: Variable = Variable(start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) == noevent(where(self.x > self.limit, 0.0, self.k))


@pytest.mark.parametrize("engine", ENGINES)
def test_a_jump_that_steps_have_to_cross_does_not_hold_them(engine: Any) -> None:
    """A step that mixes values from both sides of the jump may end before it; the next ones must get beyond."""
    random, system = np.random.default_rng(1), ac.compile(Filling())
    for _ in range(30):
        rtol = 10.0 ** random.uniform(-11, -4)
        values = {"k": random.uniform(1.0, 10.0), "limit": random.uniform(0.1, 2.9)}
        solution = system.simulate(3.0, parameters=values, rtol=rtol, saveat=2, max_steps=400, engine=engine)
        assert abs(solution["x"][-1] - values["limit"]) < 100 * rtol * 3.0
