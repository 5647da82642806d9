"""Equations that do not determine their unknowns at the start, at one moment, or on all of the solution."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Component, Equations, Variable, der
from acausal.errors import InitializationError, SimulationError

ENGINES = ("native", "diffrax")


class Circle(Component):
    """``x'^2 = 4 x``: nothing says which root, and from the guess 0 Newton's method sees no slope."""

    x: Variable = Variable(start=1.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) ** 2 == 4 * self.x


class Height(Component):
    """A point on a circle, of whose height nothing is said."""

    x: Variable = Variable(start=3.0, fixed=True)
    y: Variable = Variable()

    def equations(self) -> Equations:
        yield der(self.x) == 1
        yield self.x**2 + self.y**2 == 25


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_of_two_roots_without_a_guess_all_engines_take_the_upper_one(engine: Any) -> None:
    solution = ac.compile(Circle()).simulate(1.0, rtol=1e-9, engine=engine)
    np.testing.assert_allclose(solution["x"], (1 + np.asarray(solution.t)) ** 2, rtol=1e-7)
    solution = ac.compile(Height()).simulate(1.0, rtol=1e-9, engine=engine)
    np.testing.assert_allclose(solution["y"], np.sqrt(25 - (3 + np.asarray(solution.t)) ** 2), rtol=1e-7)


class Root(Component):
    """``y^3 = t``: the slope of y is infinite at the start."""

    y: Variable = Variable(start=0.0)

    def equations(self) -> Equations:
        yield self.y**3 == ac.time


class OneCurve(Component):
    """Both equations hold on all of ``x y = 1``, though each of them is another function."""

    x: Variable = Variable(start=1.0)
    y: Variable = Variable(start=1.0)

    def equations(self) -> Equations:
        yield self.x * self.y == 1
        yield self.x**2 * self.y == self.x


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize(("model", "names"), [(Root, "y"), (OneCurve, "x y")])
def test_what_is_not_determined_is_an_error(model: Any, names: str, engine: Any) -> None:
    with pytest.raises(SimulationError, match=r"(?s)do not determine.*=") as caught:
        ac.compile(model()).simulate(2.0, engine=engine)
    assert all(f"`{name}`" in str(caught.value) or f"{name} = nan" in str(caught.value) for name in names.split())


@pytest.mark.parametrize("engine", ENGINES)
def test_two_equations_that_touch_on_the_solution_only(engine: Any) -> None:
    class WithState(OneCurve):
        k: Variable = Variable(start=1.0, fixed=True)

        def equations(self) -> Equations:
            yield from super().equations()
            yield der(self.k) == -self.k

    with pytest.raises(SimulationError, match=r"do not determine `x`, `y`"):
        ac.compile(WithState()).simulate(2.0, engine=engine)


def test_a_start_at_which_time_divides() -> None:
    class Begins(Component):
        """``1/time`` at time 0."""

        x: Variable = Variable(start=1.0, fixed=True)
        y: Variable = Variable(start=2.0, fixed=True)

        def equations(self) -> Equations:
            yield der(self.x) == -self.x
            yield self.y == self.x + ac.cos(ac.time) / ac.time

    with pytest.raises(InitializationError, match=r"(?s)found no consistent start.*`y` has the fixed start value 2"):
        ac.compile(Begins()).simulate(1.0)


def test_a_number_over_a_time_of_zero_is_an_error_of_the_start() -> None:
    class Begins(Component):
        x: Variable = Variable(start=1.0, fixed=True)
        y: Variable = Variable()

        def equations(self) -> Equations:
            yield der(self.x) == -self.x
            yield self.y == 2.0 / ac.time

    with pytest.raises(InitializationError, match=r"(?s)found no consistent start.*`y` has the value 2 from"):
        ac.compile(Begins()).simulate(1.0, initial={"y": 2.0})
