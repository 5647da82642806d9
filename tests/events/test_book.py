"""Hybrid models of a textbook, Tiller, *Modelica by Example* (2014), against analytic and SciPy's solutions."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

import acausal as ac
from acausal import Component, Discrete, Equations, Parameter, Variable, der, noevent, pre, sample, start, when, where

ENGINES = pytest.mark.parametrize("engine", ["native", pytest.param("diffrax", marks=pytest.mark.slow)])


class Heater(Component):
    """A room between two thresholds; the controller's state is a condition (chapter "Hysteresis")."""

    C: Parameter = Parameter(1.0, unit="J/K")
    h: Parameter = Parameter(2.0, unit="W/K")
    T_amb: Parameter = Parameter(285.0, unit="K")
    T_bar: Parameter = Parameter(295.0, unit="K")
    T: Variable = Variable(unit="K")
    Q: Variable = Variable(unit="W")
    heat: Discrete = Discrete()

    def initial_equations(self) -> Equations:
        yield self.T == self.T_bar - 0.5
        yield self.heat == 1.0

    def equations(self) -> Equations:
        yield self.Q == where(self.heat > 0.5, 25.0, 0.0)
        yield self.C * der(self.T) == self.Q - self.h * (self.T - self.T_amb)
        yield when([self.T > self.T_bar + 1.0, self.T < self.T_bar - 1.0], {self.heat: self.T < self.T_bar})


def switchings(t1: float) -> Iterator[float]:
    """Heated, T - 285 goes from 9 (at first from 9.5) to 11 on its way to 12.5; without heat from 11 to 9."""
    t, low = 0.0, 9.5
    while True:
        for span in (np.log((12.5 - low) / 1.5), np.log(11.0 / 9.0)):
            t += 0.5 * span
            if t > t1:
                return
            yield t
        low = 9.0


@ENGINES
def test_a_condition_is_the_state_of_a_controller(engine: Any) -> None:
    solution = ac.compile(Heater()).simulate(5.0, engine=engine, rtol=1e-10)
    times = np.array([e.t for e in solution.events])
    expected = np.array(list(switchings(5.0)))
    assert len(expected) == 18
    assert_allclose([times[np.abs(times - t).argmin()] for t in expected], expected, atol=1e-8)
    on = np.searchsorted(expected, np.asarray(solution.t)) % 2 == 0
    apart = np.abs(np.asarray(solution.t)[:, None] - expected).min(axis=1) > 1e-6
    assert_allclose(solution["heat"][apart], on[apart])


class TwoInertias(Component):
    """Two inertias with springs and dampers to each other and to the wall (chapter "Rotational")."""

    phi1: Variable = Variable(start=0.0, fixed=True)
    phi2: Variable = Variable(start=1.0, fixed=True)
    omega1: Variable = Variable(start=0.0, fixed=True)
    omega2: Variable = Variable(start=0.0, fixed=True)

    def equations(self) -> Equations:
        twist = self.phi2 - self.phi1
        yield self.omega1 == der(self.phi1)
        yield self.omega2 == der(self.phi2)
        yield 0.4 * der(self.omega1) == 11.0 * twist + 0.2 * der(twist)
        yield der(self.omega2) == -11.0 * twist - 0.2 * der(twist) - 5.0 * self.phi2 - 1.0 * der(self.phi2)


class Teeth(TwoInertias):
    """The speed from the time between two teeth, and from their number in 0.125 s (chapter "Speed measurement")."""

    a: Parameter = Parameter(2.0 * np.pi / 200.0)
    dt: Parameter = Parameter(0.125)
    after: Discrete = Discrete()
    before: Discrete = Discrete()
    last: Discrete = Discrete()
    interval: Discrete = Discrete()
    count: Discrete = Discrete()
    counted: Discrete = Discrete()

    def initial_equations(self) -> Equations:
        yield self.after == self.phi1 + self.a
        yield self.phi1 - self.a == self.before

    def equations(self) -> Equations:
        yield from super().equations()
        tooth = [self.phi1 >= pre(self.after), self.phi1 <= pre(self.before)]
        yield when(
            tooth,
            {self.interval: self.a / (ac.time - pre(self.last)), self.last: ac.time},
            {self.after: self.phi1 + self.a, self.before: self.phi1 - self.a},
        )
        sampled = {self.counted: pre(self.count) * self.a / self.dt, self.count: 0}
        yield when(sample(0.0, self.dt), sampled).elsewhen(tooth, {self.count: pre(self.count) + 1})


def teeth(t1: float) -> Any:
    """Times of the teeth, with SciPy."""

    def rate(t: float, z: Any) -> list[float]:
        twist, speed = z[1] - z[0], z[3] - z[2]
        torque = 11.0 * twist + 0.2 * speed
        return [z[2], z[3], torque / 0.4, -torque - 5.0 * z[1] - z[3]]

    t, z, found = 0.0, np.array([0.0, 1.0, 0.0, 0.0]), []
    while True:
        def turned(_: float, now: Any, then: float = z[0]) -> float:
            return abs(now[0] - then) - 2.0 * np.pi / 200.0

        turned.terminal, turned.direction = True, 1.0  # type: ignore[attr-defined]
        run = solve_ivp(rate, (t, t1), z, "DOP853", events=turned, rtol=1e-12, atol=1e-13, max_step=0.01)
        if run.status == 0:
            return np.array(found)
        t, z = run.t[-1], run.y[:, -1]
        found.append(t)


@ENGINES
def test_speed_from_the_teeth_of_a_wheel(engine: Any) -> None:
    """Where the wheel stands at the start is the first tooth: initial equations give discrete variables."""
    middles = np.arange(0.0625, 2.0, 0.125)
    solution = ac.compile(Teeth()).simulate(2.0, engine=engine, rtol=1e-10, saveat=middles)
    expected = teeth(float(middles[-1]))
    times = np.array([e.t for e in solution.events])
    assert_allclose([times[np.abs(times - t).argmin()] for t in expected], expected, atol=1e-8)
    a = 2.0 * np.pi / 200.0
    numbers = [((expected >= t - 0.1875) & (expected < t - 0.0625)).sum() for t in middles]
    assert max(numbers) > 9
    assert_allclose(solution["counted"], np.array(numbers) * a / 0.125, atol=1e-9)
    assert_allclose(solution["interval"][-1], a / (expected[-1] - expected[-2]), rtol=1e-6)


class Votes(Component):
    """Conditions are numbers where they are counted with, in blocks that are iterated on, too."""

    x: Variable = Variable(start=0.0, fixed=True)
    n: Variable = Variable(start=0.0, fixed=True)
    y: Variable = Variable()
    z: Variable = Variable()

    def equations(self) -> Equations:
        votes = [self.x > 0.2, self.x > 0.5, self.x > 0.8]
        yield der(self.x) == 1.0
        yield der(self.n) == votes[0] + votes[1] + votes[2]
        yield self.y + self.z**3 == noevent(votes[0]) + noevent(votes[1]) - self.x
        yield self.z == -noevent(votes[0]) + 0.1 * self.y


@ENGINES
def test_conditions_that_are_counted(engine: Any) -> None:
    solution = ac.compile(Votes()).simulate(1.0, engine=engine, rtol=1e-9, saveat=[0.1, 0.4, 0.6, 1.0])
    assert_allclose(solution["n"], [0.0, 0.2, 0.5, 1.5], atol=1e-9)
    y, z = solution["y"][-1], solution["z"][-1]
    assert_allclose([y + z**3, z - 0.1 * y], [1.0, -1.0], atol=1e-8)


class Counted(Component):
    heater: Heater = Heater()

    def initial_equations(self) -> Equations:
        yield self.heater.heat == 0.0


class Left(Heater):
    def initial_equations(self) -> Equations:
        yield pre(self.heat) == 0.0


@pytest.mark.parametrize("model", [Counted(), Left()])
def test_a_discrete_variable_of_another_component(model: Component) -> None:
    with pytest.raises(ac.DeclarationError, match=r"before the first event `.*heat` has its start value: .*test_book"):
        ac.compile(model)


def test_a_start_value_of_a_discrete_variable() -> None:
    """What an initial equation says counts before the start value; without one, the start value."""
    assert ac.compile(Heater(heat=start(0.0))).simulate(0.1)["heat"][0] == 1.0
