"""An equilibrium that becomes unstable while the steps are long is left: such steps are refused."""

from __future__ import annotations

from typing import Any

import diffrax
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from numpy.testing import assert_allclose

import acausal as ac
from acausal import Component, Equations, Parameter, Variable, der
from acausal.simulation import Rodas5P
from acausal.simulation.linear_solvers import DenseLU
from acausal.simulation.rodas5p_tableau import GAMMA


class Pitchfork(Component):
    """``x' = k ((t - 1) x - x^3 + b)``: from t = 1 s on, x = 0 is unstable, and x goes to ``sqrt(t - 1)``."""

    x: Variable = Variable(start=0.0, fixed=True)
    y: Variable = Variable(start=0.0, fixed=True, doc="is slow, so that the steps are long")
    k: Parameter = Parameter(1e6)
    b: Parameter = Parameter(1e-9)

    def equations(self) -> Equations:
        yield der(self.x) == self.k * ((ac.time - 1.0) * self.x - self.x**3 + self.b)
        yield der(self.y) == 1.0 - self.y


@pytest.mark.parametrize("engine", ["native", "diffrax"])
@pytest.mark.parametrize("rtol", [1e-3, 1e-4, 1e-6])
def test_unstable_equilibrium_is_left(engine: Any, rtol: float) -> None:
    solution = ac.compile(Pitchfork()).simulate(2.0, rtol=rtol, engine=engine, saveat=[1.5, 2.0])
    assert_allclose(np.abs(solution["x"]), np.sqrt([0.5, 1.0]), rtol=1e-4)
    assert solution.stats["rejected"] > 5
    if rtol <= 1e-6:  # which side it takes is decided by 1e-9
        assert (np.asarray(solution["x"]) > 0).all()


@pytest.mark.slow
def test_gradient_through_steps_that_were_refused() -> None:
    """At the end ``x = sqrt(t - 1)``, whatever k is; y does not depend on k either."""
    system = ac.compile(Pitchfork())

    def end(k: Any) -> Any:
        return system.simulate(2.0, parameters={"k": k}, rtol=1e-6, engine="diffrax", saveat=[2.0])["x"][0]

    value, slope = jax.value_and_grad(end)(1e6)
    assert_allclose([value, slope * 1e6], [1.0, 0.0], atol=1e-5)


@pytest.mark.slow
def test_many_runs_at_once() -> None:
    system = ac.compile(Pitchfork())

    def end(b: Any) -> Any:
        return system.simulate(2.0, parameters={"b": b}, rtol=1e-6, engine="diffrax", saveat=[2.0])["x"][0]

    assert_allclose(jax.vmap(end)(jnp.array([-1e-8, 1e-8, 1e-9])), [-1.0, 1.0, 1.0], atol=1e-4)


@pytest.mark.parametrize(("rate", "step", "refused"), [(1e3, 1.0, True), (1e3, 1e-4, False), (-1e3, 1.0, False)])
def test_sign_of_the_determinant(rate: float, step: float, refused: bool) -> None:
    """W = 1/(gamma h) - rate, with an algebraic equation that makes rows change places."""
    solver, mass = DenseLU(), jnp.array([1.0, 0.0, 1.0])
    jacobian = jnp.array([[0.0, 2.0, 1.0], [3.0, 1e-3, 5.0], [0.0, 0.0, rate]])
    diagonal = mass / (GAMMA * step)
    factors, kept = solver.factor(diagonal, jacobian, solver.init())
    outrun, reference = solver.outrun(factors, diagonal, jacobian, kept)
    exact = np.sign(np.linalg.det(1e9 * np.diag(mass) - np.asarray(jacobian)))
    at_step = np.sign(np.linalg.det(np.diag(diagonal) - np.asarray(jacobian)))
    assert bool(outrun) == refused == (at_step != exact)
    assert int(reference) == exact


def test_fixed_steps_are_not_refused() -> None:
    """A controller that does not ask for the error takes what it is told."""
    solution = diffrax.diffeqsolve(
        diffrax.ODETerm(lambda t, y, args: 5.0 * y), Rodas5P(), 0.0, 1.0, 0.125, jnp.array([1.0])
    )
    assert_allclose(solution.ys, [[np.exp(5.0)]], rtol=1e-4)
