"""Sources that jump into constraints: what has been differentiated would have an impulse there."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Component, Equations, Parameter, Variable, der, reinit, when, where
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


class Moved(Component):
    """A mass on a given path, and the momentum that the force on it gives."""

    x: Variable = Variable(unit="m")
    v: Variable = Variable(unit="m/s")
    f: Variable = Variable(unit="N")
    p: Variable = Variable(unit="N*s", start=0.0, fixed=True)
    m: Parameter = Parameter(2.0, unit="kg")

    def path(self) -> Any:
        return ac.abs(self.phase())

    def phase(self) -> Any:
        return ac.sin(2 * ac.time - 1.0)

    def equations(self) -> Equations:
        yield self.x == self.path()
        yield der(self.x) == self.v
        yield self.m * der(self.v) == self.f
        yield der(self.p) == self.f


class Above(Moved):
    def path(self) -> Any:
        return ac.max(self.phase(), 0.0)


class Within(Moved):
    def path(self) -> Any:
        return ac.clip(self.phase(), -2.0, 0.0)


class AlongLines(Moved):
    def path(self) -> Any:
        return ac.table([0.0, 0.5, 2.0], [0.0, 1.0, 0.0])(ac.time)


@pytest.mark.parametrize("model", [Moved, Above, Within, AlongLines])
def test_a_kink_that_is_differentiated_twice_is_an_error(model: type[Component]) -> None:
    text = r"(?s)At t = 0\.5 s.*der\(x\) = where.*With it `p` .*whose slope does not"
    with pytest.raises(SimulationError, match=text):
        ac.compile(model()).simulate(1.0)


def test_a_kink_is_an_error_with_diffrax_too() -> None:
    with pytest.raises(SimulationError, match=r"(?s)At t = 0\.5 s.*With it `p` would have to jump"):
        ac.compile(Moved()).simulate(1.0, engine="diffrax")


def test_a_square_with_a_sign_has_no_kink() -> None:
    class Square(Moved):
        def path(self) -> Any:
            return self.phase() * ac.abs(self.phase())

    solution = ac.compile(Square()).simulate(1.0, rtol=1e-9, saveat=5)
    angle = 2 * np.asarray(solution.t) - 1.0
    speed = 4 * np.abs(np.sin(angle)) * np.cos(angle)
    np.testing.assert_allclose(solution["v"], speed, atol=1e-9)
    np.testing.assert_allclose(solution["p"], 2.0 * (speed - speed[0]), atol=1e-7)


def test_a_kink_that_is_differentiated_once_is_no_event() -> None:
    class Speed(HighPass):
        def source(self) -> Any:
            return ac.abs(ac.time - 0.5)

    solution = ac.compile(Speed()).simulate(1.0, rtol=1e-9)
    assert not solution.events
    np.testing.assert_allclose(solution["z"][-1], 1.0 - np.exp(-0.5) * (2.0 - np.exp(-0.5)), atol=1e-6)
