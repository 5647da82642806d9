"""Events that do not let time pass: chattering and accumulation are named, with time and source line."""

from __future__ import annotations

import inspect
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

import acausal as ac
from acausal import Component, Discrete, Equations, Parameter, Variable, der, pre, reinit, when, where

from .benchmarks import BouncingBall

ENGINES = ("native", "diffrax")
BOTH = ("native", pytest.param("diffrax", marks=pytest.mark.slow))


def line_of(cls: type[Component], text: str) -> str:
    """File and line in which a class has a text, as errors give it."""
    lines, first = inspect.getsourcelines(cls)
    (at,) = [first + i for i, line in enumerate(lines) if text in line]
    return rf"\.py:{at} "


class Sliding(Component):
    """``x' = -sign(x)``, as a `where`: the solution slides along x = 0, where the right-hand side jumps."""

    x: Variable = Variable(start=1.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) == where(self.x > 0, -1.0, 1.0)


@pytest.mark.parametrize("engine", ENGINES)
def test_chattering(engine: Any) -> None:
    place = line_of(Sliding, "where(self.x > 0")
    pattern = rf"At t = 1(\.0\d*)? s a condition chatters(.|\n)*`x > 0` \(.*{place}"
    with pytest.raises(ac.SimulationError, match=pattern):
        ac.compile(Sliding()).simulate(2.0, engine=engine)


def test_chattering_that_the_solver_steps_over_costs_all_steps() -> None:
    with pytest.raises(ac.SimulationError, match="look for chattering in this variable"):
        ac.compile(Sliding()).simulate(2.0, events=False, max_steps=10_000)


@pytest.mark.parametrize(
    ("engine", "e"), [("native", 0.1), ("native", 0.5), ("native", 0.9), ("diffrax", 0.5),
                      *(pytest.param("diffrax", e, marks=pytest.mark.slow) for e in (0.1, 0.9))]
)  # fmt: skip
def test_accumulation(engine: Any, e: float) -> None:
    """The ball comes to rest at ``sqrt(2 h/g) (1 + e)/(1 - e)``; it does not fall through the floor."""
    system, end = ac.compile(BouncingBall()), np.sqrt(2 / 9.81) * (1 + e) / (1 - e)
    place = line_of(BouncingBall, "yield when(")
    with pytest.raises(ac.SimulationError, match=rf"accumulate at this time(.|\n)*`h < 0` \(.*{place}") as caught:
        system.simulate(20.0, parameters={"e": e}, engine=engine)
    assert_allclose(float(str(caught.value).split()[3]), end, rtol=1e-4)
    before = system.simulate(end * (1 - 1e-4), parameters={"e": e}, engine=engine, saveat=2)
    assert 0.0 <= before["h"][-1] < 1e-7


class Rests(Component):
    """A ball that stays on the floor once it is slow."""

    h: Variable = Variable(unit="m", start=1.0, fixed=True)
    v: Variable = Variable(unit="m/s", start=0.0, fixed=True)
    g: Parameter = Parameter(9.81, unit="m/s2")
    e: Parameter = Parameter(0.7, unit="1")
    bounces: Discrete = Discrete(start=0)
    rests: Discrete = Discrete(start=0)
    slow: Parameter = Parameter(1e-3, unit="m/s")

    def equations(self) -> Equations:
        v_after = -self.e * pre(self.v)
        yield der(self.h) == self.v
        yield der(self.v) == where(self.rests > 0.5, 0.0, -self.g)
        yield when(
            self.h < 0,
            {self.rests: where(v_after < self.slow, 1, 0), self.bounces: pre(self.bounces) + 1},
            reinit(self.v, where(v_after < self.slow, 0.0, v_after)),
        )


@pytest.mark.parametrize("engine", BOTH)
def test_a_mode_for_what_rests(engine: Any) -> None:
    solution = ac.compile(Rests()).simulate(20.0, engine=engine, saveat=[10.0, 20.0], rtol=1e-9)
    n = int(np.ceil(np.log(1e-3 / np.sqrt(2 * 9.81)) / np.log(0.7)))
    assert set(solution["bounces"]) == {n}
    assert_allclose(solution["h"], 0.0, atol=1e-10)
    assert_allclose(solution["v"], 0.0, atol=1e-12)


@pytest.mark.parametrize("engine", BOTH)
def test_a_condition_that_is_passed_twice_is_no_accumulation(engine: Any) -> None:
    """`reinit` in the direction of the motion, or of something else: nothing is turned back."""

    class Pushed(Component):
        x: Variable = Variable(start=-1.0, fixed=True)
        v: Variable = Variable(start=1.0, fixed=True)
        w: Variable = Variable(start=0.0, fixed=True)

        def equations(self) -> Equations:
            yield der(self.x) == self.v
            yield der(self.v) == 0.0
            yield der(self.w) == 0.0
            yield when(self.x > 0, reinit(self.v, 2 * pre(self.v)), reinit(self.w, 1.0))

    solution = ac.compile(Pushed()).simulate(2.0, engine=engine, saveat=[2.0])
    assert_allclose(solution["x"], 2.0, rtol=1e-9)
    assert_allclose(solution["w"], 1.0)
