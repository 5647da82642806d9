"""Equations that say the same of two variables become equalities."""

from __future__ import annotations

from itertools import product
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Component, Equations, Parameter, Variable, der


class Beside(Component):
    """Two differences of the same two states, one of them possibly the other way round, and what follows from both."""

    turned: bool = False
    k: Parameter = Parameter(2.0)
    x: Variable = Variable(start=1.0, fixed=True)
    y: Variable = Variable(start=0.0, fixed=True)
    a: Variable = Variable()
    b: Variable = Variable()

    def equations(self) -> Equations:
        yield self.a == self.y - self.x
        yield self.b == (self.x - self.y if self.turned else self.y - self.x)
        yield der(self.x) == self.k * self.a
        yield der(self.y) == self.k * (self.b if self.turned else -self.b)


@pytest.mark.parametrize(("turned", "engine"), list(product((False, True), ("native", "diffrax"))))
def test_two_differences_of_the_same_are_one(turned: bool, engine: Any) -> None:
    system = ac.compile(Beside(turned=turned))
    assert len(system.stages.reduced.unknown.nonzero()[0]) == 5  # x, y, their derivatives, and one difference
    run = system.simulate(1.0, saveat=11, rtol=1e-9, engine=engine)
    np.testing.assert_array_equal(run["b"], -run["a"] if turned else run["a"])
    np.testing.assert_allclose(run["a"], -np.exp(-4.0 * run.t), rtol=1e-7)


def test_what_is_said_twice_of_the_same_variable_is_an_error_still() -> None:
    class Twice(Component):
        x: Variable = Variable(start=1.0, fixed=True)
        y: Variable = Variable(start=0.0, fixed=True)
        a: Variable = Variable()

        def equations(self) -> Equations:
            yield self.a == self.y - self.x
            yield self.a == self.y - self.x
            yield der(self.x) == self.a
            yield der(self.y) == -self.a

    with pytest.raises(ac.StructureError, match="structurally singular"):
        ac.compile(Twice())
