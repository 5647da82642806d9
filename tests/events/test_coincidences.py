"""Events that coincide with each other, with the ends of the run, with output times; conditions that only graze."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Component, Discrete, Equations, Parameter, Variable, der, edge, pre, reinit, sample, when, where

ENGINES = pytest.mark.parametrize("engine", ["native", "diffrax"])


class Together(Component):
    """Two conditions on different states that switch at the same time, one that needs both, and one at the end."""

    x: Variable = Variable(start=0.0, fixed=True)
    y: Variable = Variable(start=0.0, fixed=True)
    one: Discrete = Discrete(start=0)
    other: Discrete = Discrete(start=0)
    both: Discrete = Discrete(start=0)
    last: Discrete = Discrete(start=0)

    def equations(self) -> Equations:
        yield der(self.x) == 1.0
        yield der(self.y) == 3.0
        yield when(self.x > 0.1, {self.one: pre(self.one) + 1})
        yield when(self.y > 0.3, {self.other: pre(self.other) + 1})
        yield when((self.x > 0.1) & (self.y > 0.3), {self.both: pre(self.both) + 1})
        yield when(ac.time >= 1.0, {self.last: pre(self.last) + 1})


@ENGINES
def test_simultaneous_roots_and_one_at_the_end(engine: Any) -> None:
    solution = ac.compile(Together()).simulate(1.0, engine=engine, rtol=1e-9, saveat=2)
    assert [solution[n][-1] for n in ("one", "other", "both", "last")] == [1.0] * 4
    times = [event.t for event in solution.events]
    assert times[:-1] == pytest.approx([0.1] * (len(times) - 1), abs=1e-10) and times[-1] == 1.0


class Grazing(Component):
    """A sine that rises above, or stays below, a level close to its peak."""

    below: Parameter = Parameter(1e-4)
    x: Variable = Variable(start=0.0, fixed=True)
    v: Variable = Variable(start=1.0, fixed=True)
    n: Discrete = Discrete(start=0)

    def equations(self) -> Equations:
        yield der(self.x) == self.v
        yield der(self.v) == -self.x
        yield when(self.x > 1 - self.below, {self.n: pre(self.n) + 1})


@pytest.mark.parametrize(
    ("engine", "below"),
    [*(("native", d) for d in (1e-3, 1e-6, 1e-8, -1e-8, -1e-6, -1e-3)), ("diffrax", 1e-6), ("diffrax", -1e-6)],
)
def test_a_condition_that_grazes_its_switch(engine: Any, below: float) -> None:
    solution = ac.compile(Grazing()).simulate(
        7 * np.pi, parameters={"below": below}, engine=engine, rtol=1e-12, saveat=2
    )
    assert solution["n"][-1] == (4.0 if below > 0 else 0.0)
    found = [event.t for event in solution.events]
    if below < 0:
        assert not found
        return
    wanted = [2 * np.pi * k + np.pi / 2 - np.arccos(1 - below) for k in range(4)]
    np.testing.assert_allclose(found, wanted, atol=1e-9 / np.sqrt(2 * below))  # error of x over its slope there


class Sampled(Component):
    """Periods whose multiples coincide but for rounding: 3 * 0.1 is not 0.3."""

    x: Variable = Variable(start=0.0, fixed=True)
    often: Discrete = Discrete(start=0)
    seldom: Discrete = Discrete(start=0)
    both: Discrete = Discrete(start=0)

    def equations(self) -> Equations:
        yield der(self.x) == 1.0
        yield when(sample(0.0, 0.1), {self.often: pre(self.often) + 1})
        yield when(sample(0.0, 0.3), {self.seldom: pre(self.seldom) + 1})
        yield when(sample(0.0, 0.1) & sample(0.0, 0.3), {self.both: pre(self.both) + 1})


@pytest.mark.parametrize(("engine", "n"), [("native", 100), ("diffrax", 4)])
def test_samples_of_unlike_periods_coincide(engine: Any, n: int) -> None:
    solution = ac.compile(Sampled()).simulate(0.3 * n + 0.05, engine=engine, saveat=2)
    assert [solution[k][-1] for k in ("often", "seldom", "both")] == [3.0 * n + 1, n + 1.0, n + 1.0]


class EndsBefore(Component):
    """Something ends within rounding of a sample, before or behind it, and a second clock has just as much rounding."""

    at: Parameter = Parameter(0.005)
    x: Variable = Variable(start=0.0, fixed=True)
    ticks: Discrete = Discrete(start=0)
    others: Discrete = Discrete(start=0)
    ends: Discrete = Discrete(start=0)

    def equations(self) -> Equations:
        yield der(self.x) == 1.0
        yield when(sample(-0.015, 0.02), {self.ticks: pre(self.ticks) + 1})
        yield when(sample(0.005 + 3e-13, 0.02), {self.others: pre(self.others) + 1})
        yield when(ac.time >= self.at, {self.ends: pre(self.ends) + 1})


@pytest.mark.parametrize(
    ("engine", "before"), [*(("native", d) for d in (0.0, 1e-18, 1e-15, 1e-13, -1e-13)), ("diffrax", 1e-15)]
)
def test_a_sample_within_rounding_of_another_event_is_not_lost(engine: Any, before: float) -> None:
    run = ac.compile(EndsBefore()).simulate(0.05, parameters={"at": 0.005 - before}, engine=engine, saveat=2)
    assert [run[name][-1] for name in ("ticks", "others", "ends")] == [3.0, 3.0, 1.0]


class SplitByRounding(Component):
    """What a sample sees begins with it, beside a condition that switches at the same time but for rounding."""

    start: Parameter = Parameter(0.25)
    period: Parameter = Parameter(1.75)
    x: Variable = Variable(start=0.0, fixed=True)
    seen: Discrete = Discrete(start=0)

    def equations(self) -> Equations:
        elapsed = ac.time - self.start
        wrapped = elapsed - self.period * ac.floor((elapsed - 0.125) / self.period)
        yield der(self.x) == where(wrapped < self.period, 1.0, 2.0)  # false already at 0.25 - 1e-16
        yield when(sample(0.0, 0.25), {self.seen: pre(self.seen) + where(ac.time < self.start, 0.0, 1.0)})


@ENGINES
def test_a_sample_is_at_its_time_where_an_event_before_it_by_rounding_takes_it_along(engine: Any) -> None:
    solution = ac.compile(SplitByRounding()).simulate(0.6, engine=engine, saveat=2)
    assert solution["seen"][-1] == 2.0
    assert [event.t for event in solution.events if 0.2 < event.t < 0.3] == [0.25]


def test_samples_far_from_time_zero_are_taken_once() -> None:
    """At 1e6 s a period of 1 ms is known to 1e-7 of it only."""
    system = ac.compile(Sampled())
    run = system.simulate(1e6 + 10.0, t0=1e6, saveat=2)
    assert [run[k][-1] for k in ("often", "seldom")] == [101.0, 33.0]


class Chained(Component):
    """A `when` that triggers another, which triggers a third that resets the state: all at one time, in one event."""

    x: Variable = Variable(start=0.0, fixed=True)
    first: Discrete = Discrete(start=0)
    second: Discrete = Discrete(start=0)
    seen: Discrete = Discrete(start=0)
    at: Discrete = Discrete(start=-1)

    def equations(self) -> Equations:
        yield der(self.x) == 1.0
        yield when(self.x > 0.3, {self.first: pre(self.first) + 1})
        yield when(self.first > 0.5, {self.second: pre(self.second) + 1})
        yield when(
            self.second > 0.5, {self.seen: 10 * self.second + pre(self.second), self.at: ac.time}, reinit(self.x, -1.0)
        )


@ENGINES
def test_a_chain_of_triggers(engine: Any) -> None:
    """What a `when` sees as `pre` is the value before the event, although another has changed it."""
    solution = ac.compile(Chained()).simulate(2.0, engine=engine, rtol=1e-9, saveat=2)
    assert [solution[k][-1] for k in ("first", "second", "seen")] == [2.0, 1.0, 10.0]
    assert [event.t for event in solution.events] == pytest.approx([0.3, 1.6], abs=1e-9)
    assert solution["at"][-1] == solution.events[0].t
    assert solution["x"][-1] == pytest.approx(0.7, abs=1e-9)


class Remembered(Component):
    """A boolean and integers that depend on what they were."""

    x: Variable = Variable(start=0.0, fixed=True)
    on: Discrete = Discrete(start=0)
    i: Discrete = Discrete(start=3)
    old: Discrete = Discrete(start=-1)
    most: Discrete = Discrete(start=0)

    def equations(self) -> Equations:
        yield der(self.x) == 1.0
        doubled = where(pre(self.on) > 0.5, pre(self.i) * 2, pre(self.i) - 1)
        yield when(sample(0.1, 0.1), {self.on: 1 - pre(self.on), self.i: doubled, self.old: pre(self.i)})
        yield self.most == where(self.i > pre(self.most), self.i, pre(self.most))


@ENGINES
def test_left_limits_of_booleans_and_integers(engine: Any) -> None:
    """The last output time is beyond the end by rounding, and is shown."""
    solution = ac.compile(Remembered()).simulate(0.95, engine=engine, saveat=np.arange(0.05, 1.0, 0.1))
    on, i, old, most = 0, 3, -1, 3
    wanted = [(on, i, old, most)]
    for _ in range(9):
        on, i, old = 1 - on, i * 2 if on else i - 1, i
        most = i if i > most else most
        wanted.append((on, i, old, most))
    found = np.stack([solution[k] for k in ("on", "i", "old", "most")], axis=1)
    np.testing.assert_array_equal(found, wanted)


class StruckTwice(Component):
    """A sample sets a state, and the `when` that this triggers sets it again at the same moment."""

    step: Parameter = Parameter(1.5)
    x: Variable = Variable(start=0.0, fixed=True)
    left: Discrete = Discrete(start=0.0)

    def equations(self) -> Equations:
        yield der(self.x) == 1.0
        yield when(
            [self.x >= 2.0, sample(1.0, 5.0)], reinit(self.x, pre(self.x) + self.step), {self.left: pre(self.x)}
        )


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_a_second_reinit_at_the_same_moment_begins_from_the_first(engine: Any) -> None:
    system = ac.compile(StruckTwice())
    run = system.simulate(1.5, engine=engine, saveat=2)
    assert [run["x"][-1], run["left"][-1]] == pytest.approx([4.5, 2.5])


def test_derivatives_of_a_second_reinit_at_the_same_moment() -> None:
    import jax

    system = ac.compile(StruckTwice())
    slope = jax.grad(lambda a: system.simulate(1.5, parameters={"step": a}, saveat=2)["x"][-1])(1.5)
    assert slope == pytest.approx(2.0)


class EdgeOfBefore(Component):
    """The edge of a condition on what a discrete variable was."""

    x: Variable = Variable(start=0.0, fixed=True)
    count: Discrete = Discrete(start=0)
    seen: Discrete = Discrete(start=0)

    def equations(self) -> Equations:
        yield der(self.x) == 1.0
        yield when(sample(0.1, 0.1), {self.count: pre(self.count) + 1})
        yield when(edge(pre(self.count) > 2.5), {self.seen: pre(self.seen) + 1})


@ENGINES
def test_an_edge_of_a_left_limit(engine: Any) -> None:
    run = ac.compile(EdgeOfBefore()).simulate(0.55, engine=engine, saveat=2)
    assert [run["count"][-1], run["seen"][-1]] == [5.0, 1.0]


class ThrownDown(Component):
    """What reaches the ground is put below it, where it rises until it is pulled down; it does not come back."""

    x: Variable = Variable(start=0.5, fixed=True)
    falls: Discrete = Discrete(start=1)

    def equations(self) -> Equations:
        yield der(self.x) == where(self.falls > 0.5, -30.0, 0.5)
        yield when(self.x <= 0.0, {self.falls: 0}, reinit(self.x, -1.0)).elsewhen(ac.time > 0.5, {self.falls: 1})


@ENGINES
def test_what_is_set_elsewhere_need_not_come_back_to_its_switch(engine: Any) -> None:
    run = ac.compile(ThrownDown()).simulate(2.0, engine=engine, saveat=2)
    assert run["x"][-1] == pytest.approx(-1.0 + 0.5 * (0.5 - 1 / 60) - 30 * 1.5)
