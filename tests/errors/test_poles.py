"""Steps past a pole of algebraic equations, to another branch of their solutions: an error."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import acausal as ac
from acausal import Component, Equations, Variable, Vector, der
from acausal.errors import SimulationError

ENGINES = ("native", "diffrax")
K1, K2, K3 = 7.65e-18, 4.03e-11, 5.32e-18
"""Equilibria."""
R1, B1, R2, R3, B3 = 21.893, 2.14e9, 32.318, 21.893, 1.07e9
"""Rates."""


class BatchReactor(Component):
    """Six balances, a balance of charges and three equilibria. The concentrations y are of the order of 1e-9.

    Source: Biegler, Damiano and Blau (1986), Nonlinear parameter estimation: a case study comparison, AIChE Journal 32,
    29-45.
    """

    x: Vector = Vector(Variable(), (1.5776, 8.32, 0.0, 0.0, 0.0, 0.0142))
    y: Vector = Vector(Variable(), (0.0131, 0.0, 0.0, 0.0))

    def equations(self) -> Equations:
        x, y = self.x, self.y
        one = R1 * x[1] * x[5] - B1 * y[3]
        two = R2 * x[1] * y[1]
        three = R3 * x[3] * x[5] - B3 * y[2]
        rates = (-two, -one - two, two + three, -three, one, -one - three)
        for i in range(6):
            yield der(x[i]) == rates[i]
        yield y[0] == -0.0131 + x[5] + y[1] + y[2] + y[3]
        yield y[1] == K2 * x[0] / (K2 + y[0])
        yield y[2] == K3 * x[2] / (K3 + y[0])
        yield y[3] == K1 * x[4] / (K1 + y[0])


def by_hand(t1: float) -> Any:
    """The balances at t1, with the balance of charges solved for the logarithm of y1."""

    def rates(_: float, x: Any) -> list[float]:
        y = lambda h: (K2 * x[0] / (K2 + h), K3 * x[2] / (K3 + h), K1 * x[4] / (K1 + h))  # noqa: E731
        h = np.exp(brentq(lambda u: sum(y(np.exp(u))) - np.exp(u) - 0.0131 + x[5], -60.0, 5.0, xtol=1e-14))
        y2, y3, y4 = y(h)
        one, two, three = R1 * x[1] * x[5] - B1 * y4, R2 * x[1] * y2, R3 * x[3] * x[5] - B3 * y3
        return [-two, -one - two, two + three, -three, one, -one - three]

    start = [1.5776, 8.32, 0.0, 0.0, 0.0, 0.0142]
    return solve_ivp(rates, (0.0, t1), start, method="Radau", rtol=1e-8, atol=1e-11).y[:, -1]


@pytest.mark.parametrize("engine", ENGINES)
def test_a_batch_reactor(engine: Any) -> None:
    """At the default tolerance, to which 1e-9 is nothing, y1 passes the pole at -K2: the reaction would stand still."""
    system = ac.compile(BatchReactor())
    with pytest.raises(SimulationError, match=r"(?s)Between t = .* passed a pole.*with `y\[1\]`.*y\[2\] = ") as caught:
        system.simulate(0.2, engine=engine)
    assert "BatchReactor" in str(caught.value)
    solution = system.simulate(0.2, rtol=1e-8, engine=engine)
    np.testing.assert_allclose(solution["x"][-1], by_hand(0.2), rtol=1e-5)


class Slip(Component):
    """A quotient that nothing follows from may pass a pole."""

    w: Variable = Variable(start=-1.0, fixed=True)
    slip: Variable = Variable()

    def equations(self) -> Equations:
        yield der(self.w) == 1.0
        yield self.slip == 1.0 / self.w


def test_a_result_may_pass_a_pole() -> None:
    assert np.isclose(ac.compile(Slip()).simulate(2.1, saveat=11)["slip"][-1], 1.0 / 1.1)


class Removable(Component):
    """Numerator and denominator pass zero together."""

    x: Variable = Variable(start=0.7)
    z: Variable = Variable(start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield self.x**3 + (self.x**2 - 1.0) / (self.x - 1.0) == 2.5 + ac.time
        yield der(self.z) == self.x


def test_a_quotient_without_a_pole_may_be_passed() -> None:
    x = ac.compile(Removable()).simulate(2.0, rtol=1e-8, saveat=8)["x"]
    np.testing.assert_allclose(x**3 + x + 1.0, 2.5 + np.linspace(0.0, 2.0, 8), rtol=1e-6)
    assert x[0] < 1.0 < x[-1]
