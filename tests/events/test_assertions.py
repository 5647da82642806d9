"""Assertions without events: checked at the start and at the points of the result, in runs that stay smooth."""

from __future__ import annotations

import warnings
from typing import Any

import jax
import numpy as np
import pytest

import acausal as ac
from acausal import Component, Equations, Input, Parameter, Variable, assert_, der, noevent, when


class Tank(Component):
    """Its level rises with a constant rate."""

    rate: Parameter = Parameter(1.0)
    top: Parameter = Parameter(2.0)
    x: Variable = Variable(start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) == self.rate
        yield assert_(noevent(self.x <= self.top), "the tank is full")
        yield assert_(self.rate > 0.0, "nothing comes in")


class Watched(Component):
    """The level of a tank in an array is seen by a condition on time and an algebraic variable."""

    tanks: ac.Array[Tank] = ac.Array(Tank(top=10.0), 3, rate=[1.0, 2.0, 3.0])
    total: Variable = Variable()

    def equations(self) -> Equations:
        yield self.total == self.tanks[0].x + self.tanks[1].x + self.tanks[2].x
        yield assert_(noevent((self.total <= 3.0) | (ac.time < 0.2)), "too much in all", level="warning")


class Emptied(Tank):
    """A tank that is emptied at an event."""

    def equations(self) -> Equations:
        yield from super().equations()
        yield when(ac.time >= 0.5, {self.x: -1.0})


@pytest.fixture(params=["native", "diffrax"])
def engine(request: pytest.FixtureRequest) -> Any:
    return request.param


def test_a_run_with_assertions_alone_has_no_events(engine: Any) -> None:
    system = ac.compile(Tank())
    assert system.hybrid is None
    assert system.located is system
    solution = system.simulate(1.0, engine=engine, events=False)
    assert solution["x"][-1] == pytest.approx(1.0)
    assert solution.events == ()


def test_the_first_point_of_the_result_is_named(engine: Any) -> None:
    system = ac.compile(Tank(top=0.55))
    text = r"At t = 0.6 s the assertion of Tank \(.*test_assertions.py:\d+ \(Tank\)\) does not hold: the tank is full"
    with pytest.raises(ac.SimulationError, match=text):
        system.simulate(1.0, saveat=np.linspace(0.0, 1.0, 11), engine=engine)
    ended = system.simulate(1.0, engine=engine, throw=False)  # who does not want errors looks at the values
    assert ended["x"][-1] == pytest.approx(1.0)


def test_the_start_is_checked_before_anything_runs(engine: Any) -> None:
    system = ac.compile(Tank())
    with pytest.raises(ac.SimulationError, match=r"At t = 0.3 s the assertion of Tank .* the tank is full"):
        system.simulate(1e6, t0=0.3, initial={"x": 2.5}, engine=engine)
    with pytest.raises(ac.SimulationError, match=r"At t = 0 s the assertion of Tank .* nothing comes in"):
        system.simulate(1.0, parameters={"rate": 0.0, "top": -1.0}, engine=engine)


def test_of_an_array_the_element_is_named(engine: Any) -> None:
    system = ac.compile(Watched())
    with pytest.warns(UserWarning, match=r"At t = 0.6 s the assertion of Watched .* too much in all") as told:
        system.simulate(0.9, saveat=[0.0, 0.3, 0.6, 0.9], engine=engine)
    assert [w.filename for w in told] == [__file__]
    with (
        pytest.warns(UserWarning, match=r"At t = 2 s the assertion of Watched .* too much in all"),
        pytest.raises(ac.SimulationError, match=r"At t = 4 s the assertion of tanks\[2\] .* the tank is full"),
    ):
        system.simulate(8.0, saveat=[0.0, 2.0, 4.0, 8.0], engine=engine)


@pytest.mark.slow_case("diffrax")
def test_a_run_with_events_is_checked_as_well(engine: Any) -> None:
    system = ac.compile(Emptied(top=0.45))
    with pytest.raises(ac.SimulationError, match=r"At t = 0.46 s the assertion of Emptied .* the tank is full"):
        system.simulate(1.0, saveat=np.linspace(0.0, 1.0, 51), engine=engine)
    assert system.simulate(1.0, parameters={"top": 0.6}, engine=engine)["x"][-1] == pytest.approx(-0.5)


@pytest.mark.slow_case("diffrax")
def test_derivatives_and_batches_go_through(engine: Any) -> None:
    system = ac.compile(Tank())

    def level(rate: Any) -> Any:
        return system.simulate(1.0, parameters={"rate": rate}, saveat=[1.0], engine=engine)["x"][-1]

    assert jax.grad(level)(1.5) == pytest.approx(1.0)
    assert jax.jit(level)(1.5) == pytest.approx(1.5)
    assert np.allclose(jax.vmap(level)(np.array([0.5, 1.5])), [0.5, 1.5])


class Fed(Component):
    """What is fed must not be too much."""

    u: Input = Input()
    x: Variable = Variable(start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) == self.u
        yield assert_(noevent(self.u <= 2.0), "too much is fed")


def test_inputs_are_those_of_the_moment(engine: Any) -> None:
    system = ac.compile(Fed())
    t = np.linspace(0.0, 1.0, 11)
    ramp = np.array([0.0, 1.0]), np.array([0.0, 3.0])
    functions = [ramp] if engine == "native" else [ramp, lambda t: 3.0 * t]
    for u in functions:
        with pytest.raises(ac.SimulationError, match=r"At t = 0.7 s the assertion of Fed .* too much is fed"):
            system.simulate(1.0, inputs={"u": u}, saveat=t, engine=engine)
    with pytest.raises(ac.SimulationError, match=r"At t = 0 s the assertion of Fed .* too much is fed"):
        system.simulate(1.0, inputs={"u": 2.5}, saveat=t, engine=engine)


class Begun(Tank):
    """A tank that begins below its middle; what it does later is its own affair."""

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        yield assert_(self.x < 0.5 * self.top, "it begins too full")
        yield assert_(self.x < 0.4 * self.top, "it begins rather full", level="warning")


def test_assertions_of_the_start(engine: Any) -> None:
    system = ac.compile(Begun())
    assert system.hybrid is None
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert system.simulate(1.9, engine=engine)["x"][-1] == pytest.approx(1.9)
    with pytest.raises(ac.SimulationError, match=r"At t = 0 s the assertion of Begun .* it begins too full"):
        system.simulate(0.1, initial={"x": 1.5}, engine=engine)
    with pytest.warns(UserWarning, match=r"At t = 0 s the assertion of Begun .* it begins rather full"):
        system.simulate(0.1, initial={"x": 0.9}, engine=engine)


class BegunWithEvents(Emptied):
    """The same beside an event, behind which the condition does not hold."""

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        yield assert_(self.x >= 0.0, "it begins empty")


def test_assertions_of_the_start_of_a_run_with_events(engine: Any) -> None:
    system = ac.compile(BegunWithEvents())
    assert system.simulate(1.0, engine=engine)["x"][-1] == pytest.approx(-0.5)
    with pytest.raises(ac.SimulationError, match=r"At t = 0 s the assertion of BegunWithEvents .* it begins empty"):
        system.simulate(1.0, initial={"x": -0.1}, engine=engine)
