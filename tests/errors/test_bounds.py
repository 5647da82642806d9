"""Bounds that are declared of variables: a solution outside of them is an error."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Component, Equations, Variable, der
from acausal.errors import SimulationError

ENGINES = ("native", "diffrax")


class Titration(Component):
    """A weak acid to which a base is given. The charges balance for a negative concentration, too, beyond a pole."""

    acid: Variable = Variable(start=0.1, fixed=True)
    base: Variable = Variable(start=0.0, fixed=True)
    hydrogen: Variable = Variable(start=1e-3, min=0.0)

    def equations(self) -> Equations:
        h = self.hydrogen
        yield der(self.acid) == -0.1 * self.acid
        yield der(self.base) == 0.1 * (0.2 - self.base)
        yield h + self.base == 1e-14 / h + 1.8e-5 * self.acid / (1.8e-5 + h)


@pytest.mark.parametrize("engine", ENGINES)
def test_a_step_to_another_solution_is_an_error(engine: Any) -> None:
    with pytest.raises(SimulationError, match=r"At t = 4\.\d+ s `hydrogen` = -\S+ lies outside its bounds \[0, inf\]"):
        ac.compile(Titration()).simulate(20.0, engine=engine)


def test_the_nominal_value_keeps_to_the_right_one() -> None:
    system = ac.compile(Titration(hydrogen=ac.start(1e-3, nominal=1e-10)))
    solution = system.simulate(20.0, rtol=1e-6)
    h, acid, base = (np.asarray(solution[name]) for name in ("hydrogen", "acid", "base"))
    np.testing.assert_allclose(h + base, 1e-14 / h + 1.8e-5 * acid / (1.8e-5 + h), rtol=1e-3)
    assert h.min() > 0.0


class Root(Component):
    """Of two solutions the one near the guess is taken."""

    x: Variable = Variable(max=1.0)
    y: Variable = Variable(start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield self.x**2 == 4.0 + self.y
        yield der(self.y) == 1.0


def test_the_wrong_root_at_the_start_is_an_error() -> None:
    with pytest.raises(SimulationError, match=r"(?s)At t = 0 s `x` = 2 lies outside .*\[-inf, 1\].*x: Variable"):
        ac.compile(Root(x=ac.start(1.0))).simulate(1.0)
    solution = ac.compile(Root(x=ac.start(-1.0))).simulate(1.0, rtol=1e-8)
    assert np.isclose(solution["x"][-1], -np.sqrt(5.0))


class Decay(Component):
    """Tends to its bound, which rounding and the tolerances may pass."""

    x: Variable = Variable(start=1.0, fixed=True, min=0.0)

    def equations(self) -> Equations:
        yield der(self.x) == -50.0 * self.x


@pytest.mark.parametrize("engine", ENGINES)
def test_the_tolerance_is_no_violation(engine: Any) -> None:
    ac.compile(Decay()).simulate(10.0, rtol=1e-4, engine=engine)


def test_without_throwing_the_values_are_there() -> None:
    assert ac.compile(Titration()).simulate(20.0, throw=False)["hydrogen"][-1] < 0.0
