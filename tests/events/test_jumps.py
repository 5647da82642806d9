"""Sources that jump into constraints: what has been differentiated would have an impulse there."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Component, Equations, Variable, der, reinit, when, where
from acausal.errors import SimulationError

ENGINES = ("native", "diffrax")


class HighPass(Component):
    """``z' = x' - z`` behind a step of x: z jumps with it."""

    x: Variable = Variable()
    z: Variable = Variable(start=0.0, fixed=True)

    def source(self) -> Any:
        return where(ac.time > 0.5, 1.0, 0.0)

    def equations(self) -> Equations:
        yield self.x == self.source()
        yield der(self.z) == der(self.x) - self.z


@pytest.mark.parametrize("engine", ENGINES)
def test_a_state_that_would_have_to_jump_is_an_error(engine: Any) -> None:
    with pytest.raises(SimulationError, match=r"(?s)At t = 0\.5 s this equation jumps.*x = where.*With it `z` would"):
        ac.compile(HighPass()).simulate(1.0, engine=engine)


def test_a_ramp_and_a_step_of_its_slope_are_no_jump() -> None:
    class Ramp(HighPass):
        def source(self) -> Any:
            return where(ac.time > 0.5, ac.time - 0.5, 0.0)

    solution = ac.compile(Ramp()).simulate(1.0, rtol=1e-9)
    t = np.maximum(np.asarray(solution.t), 0.5)
    np.testing.assert_allclose(solution["z"], 1 - np.exp(0.5 - t), atol=1e-8)


class Held(Component):
    """A pendulum whose length is another one from a moment on."""

    x: Variable = Variable(start=1.0, fixed=True)
    y: Variable = Variable(start=0.0)
    T: Variable = Variable()

    def equations(self) -> Equations:
        yield der(der(self.x)) == -self.T * self.x
        yield der(der(self.y)) == -self.T * self.y - 9.81
        yield self.x**2 + self.y**2 == where(ac.time > 0.5, 1.2, 1.0)


def test_a_constraint_on_states_that_jumps_is_an_error() -> None:
    with pytest.raises(SimulationError, match=r"(?s)x\*\*2 \+ y\*\*2 = where.*With it `x`, `y` would"):
        ac.compile(Held()).simulate(1.0)


class Rate(Component):
    """The rate of what is sampled: nothing follows from it."""

    x: Variable = Variable()
    v: Variable = Variable()

    def equations(self) -> Equations:
        yield self.x == where(ac.time > 0.5, 1.0, 0.0)
        yield self.v == 2 * der(self.x)


def test_an_impulse_that_drives_nothing_is_a_warning() -> None:
    with pytest.warns(UserWarning, match=r"(?s)At t = 0\.5 s.*The results do not show the impulse"):
        solution = ac.compile(Rate()).simulate(1.0, saveat=[0.0, 0.4, 0.6, 1.0])
    assert np.array_equal(solution["x"], [0.0, 0.0, 1.0, 1.0])


def test_where_reinit_says_how_there_is_nothing_to_say() -> None:
    class Pushed(HighPass):
        def equations(self) -> Equations:
            yield from super().equations()
            yield when(ac.time > 0.5, reinit(self.z, self.z + 1.0))

    with warnings.catch_warnings():
        warnings.simplefilter("error")
        solution = ac.compile(Pushed()).simulate(1.0, rtol=1e-9)
    assert solution["z"][-1] == pytest.approx(np.exp(-0.5), abs=1e-7)
