"""Times of events against closed forms: no event is missed, none is where it should not be, on either engine."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Component, Equations, Parameter, Variable, der, where

from .benchmarks import KNOWN

SEEDS = 1000
FEW = 40
PRECISE = 1e-8
"""Of event times, relative to the length of the run."""


@cache
def compiled(name: str) -> ac.System:
    return ac.compile(KNOWN[name].model())


def check(name: str, seed: int, engine: Any) -> None:
    known = KNOWN[name]
    parameters, start, t1 = known.draw(np.random.default_rng(seed))
    wanted = known.times(parameters, start, t1)
    given: dict[str, Any] = {"parameters": parameters, "initial": start, "engine": engine}
    solution = compiled(name).simulate(t1, rtol=1e-10, saveat=2, **given)
    found = np.array([event.t for event in solution.events])
    late = np.abs(found[None] - wanted[:, None]).min(axis=1, initial=np.inf)
    assert late.max(initial=0.0) <= PRECISE * t1, f"seed {seed}: {wanted} and not {found}"
    if name == "ball":
        assert solution["bounces"][-1] == len(wanted) == len(found), f"seed {seed}: bounces"
    elif name == "full_wave":
        early = np.abs(found[:, None] - wanted[None]).min(axis=1, initial=np.inf)
        assert early.max(initial=0.0) <= PRECISE * t1, f"seed {seed}: {found} and not {wanted}"


@pytest.mark.parametrize("name", KNOWN)
def test_no_event_is_missed(name: str) -> None:
    for seed in range(FEW):
        check(name, seed, "native")


@pytest.mark.slow
@pytest.mark.parametrize("name", KNOWN)
def test_no_event_is_missed_in_many_runs(name: str) -> None:
    for seed in range(FEW, SEEDS):
        check(name, seed, "native")


@pytest.mark.parametrize(
    "name", [name if name == "ball" else pytest.param(name, marks=pytest.mark.slow) for name in KNOWN]
)
def test_the_diffrax_engine_finds_the_same_times(name: str) -> None:
    for seed in range(3):
        check(name, seed, "diffrax")


@pytest.mark.slow
@pytest.mark.parametrize("name", KNOWN)
def test_the_diffrax_engine_misses_no_event(name: str) -> None:
    for seed in range(3, 100):
        check(name, seed, "diffrax")


@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_the_trajectory_is_exact_too(engine: Any) -> None:
    """Height of the ball between its bounces: parabolas."""
    known, t = KNOWN["ball"], np.linspace(0.0, 2.4, 97)
    solution = compiled("ball").simulate(2.4, saveat=t, engine=engine, rtol=1e-9)
    times = known.times({"g": 9.81, "e": 0.7}, {"h": 1.0, "v": 0.0}, 2.4)
    speeds = np.concatenate([[0.0], np.sqrt(2 * 9.81) * 0.7 ** np.arange(1, len(times) + 1)])
    since = np.concatenate([[0.0], times])
    flight = np.searchsorted(times, t, side="right")
    flown = t - since[flight]
    height = np.where(flight == 0, 1.0, 0.0) + speeds[flight] * flown - 9.81 / 2 * flown**2
    np.testing.assert_allclose(solution["h"], height, atol=1e-9)
    np.testing.assert_allclose(solution["last"][flight > 0], since[flight][flight > 0], rtol=1e-10)


@pytest.mark.slow
def test_times_within_a_swing_that_the_states_do_not_feel() -> None:
    """A condition on time alone, on no states that would limit the steps: 2000 crossings in one run."""

    class Counting(ac.Component):
        x: ac.Variable = ac.Variable(start=0.0, fixed=True)
        n: ac.Discrete = ac.Discrete(start=0)
        m: ac.Discrete = ac.Discrete(start=0)

        def equations(self) -> ac.Equations:
            yield ac.der(self.x) == 1.0
            yield ac.when(ac.sin(ac.time) > 0.999, {self.n: ac.pre(self.n) + 1})
            yield ac.when(ac.sin(ac.time) < -0.5, {self.m: ac.pre(self.m) + 1})

    turns = 1000
    for engine, t1 in (("native", 2 * np.pi * turns), ("diffrax", 2 * np.pi * 20)):
        solution = ac.compile(Counting()).simulate(t1, engine=engine, saveat=2)
        assert solution["n"][-1] == solution["m"][-1] == round(t1 / (2 * np.pi))


class Wave(ac.Component):
    """A nonlinear conductor on a source that swings several times between two outputs."""

    y: ac.Variable = ac.Variable()
    n: ac.Discrete = ac.Discrete()
    high: ac.Discrete = ac.Discrete()

    def equations(self) -> ac.Equations:
        yield self.high == ac.where(self.y > 0.5, 1.0, 0.0)
        yield self.y + 0.1 * self.y**3 == ac.sin(2 * ac.PI * ac.time)
        yield ac.when(self.y > 0.5, {self.n: ac.pre(self.n) + 1})


@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_without_states_no_switch_is_missed_between_two_outputs(engine: Any) -> None:
    """y passes 1/2 where the sine is 1/2 + 0.1/8, twice in a period."""
    solution = ac.compile(Wave()).simulate(3.0, saveat=2, engine=engine)
    up = np.arcsin(0.5 + 0.1 / 8) / (2 * np.pi)
    wanted = np.sort([k + at for k in range(3) for at in (up, 0.5 - up)])
    np.testing.assert_allclose([event.t for event in solution.events], wanted, atol=1e-8)
    assert solution["n"][-1] == 3.0


class Pulse(ac.Component):
    """A pulse of area one, and how often it has come."""

    x: ac.Variable = ac.Variable(start=0.0, fixed=True)
    n: ac.Discrete = ac.Discrete()
    begin: ac.Parameter = ac.Parameter(0.5)
    end: ac.Parameter = ac.Parameter(0.6)

    def equations(self) -> ac.Equations:
        on = (ac.time >= self.begin) & (ac.time < self.end)
        yield ac.der(self.x) == ac.where(on, 1 / (self.end - self.begin), 0.0)
        yield ac.when(on, {self.n: ac.pre(self.n) + 1})


@pytest.mark.parametrize("solver", ["rodas5p", "rk4", "adams"])
def test_pulses_much_narrower_than_a_step(solver: str) -> None:
    """Thresholds of time that are parameters are hit to rounding, and no pulse is stepped over."""
    system = ac.compile(Pulse())
    for seed in range(60):
        rng = np.random.default_rng(seed)
        t1 = 10 ** rng.uniform(-2, 5)
        begin = t1 * rng.uniform(0.01, 0.98)
        end = begin + t1 * 10 ** rng.uniform(-11, -2)
        options: dict[str, Any] = {"dt": 0.037 * t1} if solver == "rk4" else {"rtol": 1e-4}
        solution = system.simulate(
            t1, parameters={"begin": begin, "end": end}, engine="native", solver=solver, saveat=2, **options
        )
        found = [solution.events[0].t, solution.events[-1].t]
        np.testing.assert_allclose(found, [begin, end], rtol=2e-15, err_msg=f"seed {seed}")
        assert solution["n"][-1] == 1.0
        np.testing.assert_allclose(solution["x"][-1], 1.0, atol=4e-15 * end / (end - begin), err_msg=f"seed {seed}")


@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_steps_of_floor_through_zero(engine: Any) -> None:
    """Just below zero, x + 1 is 1 to rounding: the step is where x changes its sign, and taken once."""
    offsets = np.random.default_rng(7).uniform(0.001, 0.01, 20 if engine == "native" else 2)

    class Steps(Component):
        offset: Parameter = Parameter(0.005)
        n: Variable = Variable()
        x: Variable = Variable(start=0.0, fixed=True)

        def equations(self) -> Equations:
            yield self.n == ac.floor((ac.time - self.offset) / 0.1)
            yield der(self.x) == self.n

    system = ac.compile(Steps())
    for offset in offsets.tolist():
        run = system.simulate(0.25, parameters={"offset": offset}, engine=engine, rtol=1e-8)
        assert [e.t for e in run.events] == pytest.approx([offset, offset + 0.1, offset + 0.2], abs=1e-15, rel=1e-15)
        assert run["x"][-1] == pytest.approx(-offset + 0.1 + 2 * (0.05 - offset), abs=1e-9)


def test_a_switch_that_is_not_found_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    """Were the functions of the conditions blind, the run would go on with modes that do not hold."""

    class Turned(Component):
        x: Variable = Variable(start=1.0, fixed=True)

        def equations(self) -> Equations:
            yield der(self.x) == where(self.x > 0.5, -1.0, -0.1)

    def blind(self: Any, t: Any, y: Any, args: Any) -> Any:
        return 1.0 + 0.0 * self.slack

    monkeypatch.setattr("acausal.simulation.switch.Switch.sides", blind)
    text = r"By t = 1 s these conditions have switched.*\n    `x > 0.5`"
    with pytest.raises(ac.SimulationError, match=text) as found:
        ac.compile(Turned()).simulate(1.0, engine="diffrax")
    assert "hangs on rounding" in str(found.value)
