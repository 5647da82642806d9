"""Functions of one combination of derivatives: index reduction where no linear combination of equations will do."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import acausal as ac
from acausal import Component, Equations, Variable, der
from acausal.errors import StructureError


class Published(Component):
    """``x + exp(-x' - y y'') = g1``, ``x + y y' + y^2 = g2``, for x = cos t, y = 2 + sin t.

    Source: Tan, Nedialkov and Pryce (2017), BIT 57, 845-865, (4.3), the example of expression substitution.
    """

    x: Variable = Variable(start=1.0)
    y: Variable = Variable(start=2.0)

    def equations(self) -> Equations:
        x, y, sin, cos = self.x, self.y, ac.sin(ac.time), ac.cos(ac.time)
        yield x + ac.exp(-der(x) - y * der(der(y))) == cos + ac.exp(sin * (3 + sin))
        yield x + y * der(y) + y**2 == cos + (2 + sin) * cos + (2 + sin) ** 2


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_the_published_example(engine: Any) -> None:
    system = ac.compile(Published())
    assert system.report().structural_index == 2
    solution = system.simulate(1.5, rtol=1e-9, engine=engine)
    t = np.asarray(solution.t)
    np.testing.assert_allclose(solution["x"], np.cos(t), atol=1e-7)
    np.testing.assert_allclose(solution["y"], 2 + np.sin(t), atol=1e-7)


class Shared(Component):
    """``(x' + y')^3 = 2 - x``, ``sin(x' + y') = 1 - y``: y follows from x, so the index is 1."""

    x: Variable = Variable(start=1.0, fixed=True)
    y: Variable = Variable(start=0.2)

    def first(self, s: Any) -> Any:
        return s**3

    def equations(self) -> Equations:
        s = der(self.x) + der(self.y)
        yield self.first(s) + self.x == 2
        yield ac.sin(s) + self.y == 1


class SharedExp(Shared):
    """With an exponential in the place of the cube."""

    def first(self, s: Any) -> Any:
        return ac.exp(s)


@pytest.mark.parametrize("model", [Shared, SharedExp])
def test_functions_of_a_sum_of_derivatives(model: Any) -> None:
    system = ac.compile(model())
    assert system.report().structural_index == 1
    solution = system.simulate(0.5, rtol=1e-9, saveat=6)

    def rate(_: float, x: Any) -> Any:
        """``y = 1 - sin s``, ``x' + y' = s`` with s and its slope over x."""
        s, ds = (np.cbrt(2 - x), -1 / (3 * np.cbrt(2 - x) ** 2)) if model is Shared else (np.log(2 - x), -1 / (2 - x))
        return s / (1 - np.cos(s) * ds)

    exact = solve_ivp(rate, (0, 0.5), [1.0], method="DOP853", rtol=1e-11, atol=1e-12, t_eval=np.asarray(solution.t))
    np.testing.assert_allclose(solution["x"], exact.y[0], atol=1e-8)


def test_an_equation_that_repeats_another_in_another_form_is_named() -> None:
    class Pendulum(Component):
        """Its length is written twice."""

        x: Variable = Variable(start=1.0)
        y: Variable = Variable(start=0.0)
        a: Variable = Variable()
        b: Variable = Variable()

        def equations(self) -> Equations:
            yield der(der(self.x)) == -self.a * self.x - self.b * self.x
            yield der(der(self.y)) == -self.a * self.y - self.b * self.y - 9.81
            yield self.x**2 + self.y**2 == 1
            yield ac.sqrt(self.x**2 + self.y**2) == 1

    with pytest.raises(StructureError, match="follows from the others") as caught:
        ac.compile(Pendulum())
    assert [e.replace(" ", "") for e in caught.value.equations] == ["x**2+y**2=1", "sqrt(x**2+y**2)=1"]


def test_an_equation_that_contradicts_another_is_named() -> None:
    class Twice(Component):
        """A sum and its square."""

        y: Variable = Variable()
        z: Variable = Variable()

        def equations(self) -> Equations:
            yield (self.y + self.z) ** 2 == 2
            yield self.y + self.z == 1

    with pytest.raises(StructureError, match=r"(?s)\(y \+ z\)\*\*2 = 2.*y \+ z = 1.*0 = 1"):
        ac.compile(Twice())
