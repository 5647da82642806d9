"""Linear first integrals: found from the equations, kept in a stiff run."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

import acausal as ac
from acausal import Component, Equations, Parameter, Variable, der


class Cycle(Component):
    """a -> b -> c -> a with mass action, the flows as variables; d only counts."""

    k: Parameter = Parameter(3.0)
    a: Variable = Variable(start=1.0, fixed=True)
    b: Variable = Variable(start=0.0, fixed=True)
    c: Variable = Variable(start=0.5, fixed=True)
    d: Variable = Variable(start=0.0, fixed=True)
    ab: Variable = Variable()
    bc: Variable = Variable()

    def equations(self) -> Equations:
        yield self.ab == self.k * self.a
        yield self.bc == self.k * self.b**2
        yield der(self.a) == self.a * self.c - self.ab
        yield der(self.b) == self.ab - self.bc
        yield der(self.c) == self.bc - self.c * self.a
        yield 2 * der(self.d) == -(self.ab - self.c * self.a) / 3


class Robertson(Component):
    """Robertson's reactions as differential equations only."""

    y1: Variable = Variable(start=1.0, fixed=True)
    y2: Variable = Variable(start=0.0, fixed=True, nominal=1e-5)
    y3: Variable = Variable(start=0.0, fixed=True)

    def equations(self) -> Equations:
        y1, y2, y3 = self.y1, self.y2, self.y3
        yield der(y1) == -0.04 * y1 + 1e4 * y2 * y3
        yield der(y2) == 0.04 * y1 - 1e4 * y2 * y3 - 3e7 * y2**2
        yield der(y3) == 3e7 * y2**2


def spanned(system: ac.System) -> np.ndarray:
    kept = system.lowered.conserved
    return kept.matrix(len(system.states))


def test_found_through_algebraic_variables_and_number_factors() -> None:
    system = ac.compile(Cycle())
    assert system.states == ("a", "b", "c", "d")
    found = spanned(system)
    wanted = np.array([[1.0, 1.0, 1.0, 0.0], [1.0, 0.0, 0.0, -6.0]])
    assert len(found) == 2
    assert np.linalg.matrix_rank(np.concatenate([found, wanted]), tol=1e-12) == 2


def test_found_in_the_sum_of_three() -> None:
    found = spanned(ac.compile(Robertson()))
    assert_allclose(found / found[0, 0], [[1.0, 1.0, 1.0]])


def test_none_where_something_leaks() -> None:
    assert len(spanned(ac.compile(Driven()))) == 0


class Driven(Component):
    """What leaves x does not all arrive in y."""

    x: Variable = Variable(start=1.0, fixed=True)
    y: Variable = Variable(start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) == -self.x * self.y
        yield der(self.y) == self.x * self.y + 0.1


@pytest.mark.parametrize("engine", ["native", "diffrax"])
@pytest.mark.parametrize("model", [Cycle, Robertson])
def test_kept_to_rounding(model: Any, engine: Any) -> None:
    system = ac.compile(model())
    solution = system.simulate(1e6 if model is Robertson else 10.0, saveat=50, rtol=1e-6, engine=engine)
    x = np.array([solution[n] for n in system.states])
    sums = spanned(system) @ x
    # between the ends of steps the interpolation has its own rounding
    assert_allclose(sums, np.broadcast_to(sums[:, :1], sums.shape), rtol=0, atol=1e-12)
    assert_allclose(sums[:, -1], sums[:, 0], rtol=0, atol=4e-16)


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_derivatives_are_those_without_it(engine: Any) -> None:
    import jax

    system = ac.compile(Cycle())

    def end(k: Any) -> Any:
        return system.simulate(2.0, parameters={"k": k}, saveat=2, rtol=1e-9, engine=engine)["b"][-1]

    h = 1e-4
    assert float(jax.grad(end)(3.0)) == pytest.approx((float(end(3.0 + h)) - float(end(3.0 - h))) / (2 * h), rel=1e-6)
