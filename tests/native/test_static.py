"""Models without states: the native engine follows their equations through time, with events and derivatives."""

from __future__ import annotations

from typing import Any

import jax
import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import brentq

import acausal as ac
from acausal import Array, Component, Discrete, Equations, Input, Parameter, Variable, connect
from acausal.components import electrical

T = np.linspace(0.0, 10.0, 41)


class Explicit(Component):
    k: Parameter = Parameter(2.0)
    y: Variable = Variable()

    def equations(self) -> Equations:
        yield self.y == self.k * ac.sin(ac.time)


class Implicit(Component):
    """``y^3 + y = k + sin 3t + u``."""

    k: Parameter = Parameter(2.0)
    u: Input = Input(start=0.5)
    y: Variable = Variable(start=1.0)

    def equations(self) -> Equations:
        yield self.y**3 + self.y == self.k + ac.sin(3 * ac.time) + self.u


class Counting(Component):
    """Counts how often the solution of ``y^3 + y = 2 sin t`` rises above 0.5, and half seconds."""

    y: Variable = Variable(start=0.0)
    n: Discrete = Discrete(start=0)
    m: Discrete = Discrete(start=0)

    def equations(self) -> Equations:
        yield self.y**3 + self.y == 2 * ac.sin(ac.time)
        yield ac.when(self.y > 0.5, {self.n: ac.pre(self.n) + 1})
        yield ac.when(ac.sample(0.25, 0.5), {self.m: ac.pre(self.m) + 1})


class OnlySamples(Component):
    n: Discrete = Discrete(start=0)

    def equations(self) -> Equations:
        yield ac.when(ac.sample(0.1, 0.5), {self.n: ac.pre(self.n) + 1})


class Cell(Component):
    """A resistor, and behind it a nonlinear one to ground."""

    a: electrical.Pin = electrical.Pin()
    v: Variable = Variable(unit="V", start=0.0)
    R: Parameter = Parameter(1.0, unit="ohm")
    G: Parameter = Parameter(1.0, unit="A/V3")

    def equations(self) -> Equations:
        yield self.a.v - self.v == self.R * self.a.i
        yield self.a.i == self.G * self.v**3


class Star(Component):
    n: int = 150
    source: electrical.SineVoltage = electrical.SineVoltage(V=2.0, f=0.1)
    line: electrical.Resistor = electrical.Resistor(R=0.01)
    ground: electrical.Ground = electrical.Ground()
    cells: Array[Cell] = Array(Cell(), "n")

    def equations(self) -> Equations:
        yield connect(self.source.n, self.ground.p)
        yield connect(self.source.p, self.line.p)
        yield connect(self.line.n, self.cells.a)


def cube_root(right: float) -> float:
    """y with ``y^3 + y = right``."""
    return float(brentq(lambda y: y**3 + y - right, -5.0, 5.0, xtol=1e-15, rtol=1e-15))


def native(model: Component, t1: float = 10.0, **options: Any) -> ac.Solution:
    solution = ac.compile(model).simulate(t1, engine="native", **options)
    assert solution.stats["engine"] == "native"
    assert not solution.system.states
    return solution


@pytest.mark.parametrize("solver", ["rodas5p", "rk4", "adams"])
def test_explicit_and_implicit(solver: str) -> None:
    how: dict[str, Any] = {"saveat": T, "solver": solver, "dt": 0.1 if solver == "rk4" else None}
    assert_allclose(native(Explicit(), **how)["y"], 2 * np.sin(T), atol=1e-13)
    assert_allclose(native(Implicit(), **how)["y"], [cube_root(2.5 + np.sin(3 * t)) for t in T], rtol=1e-12)


def test_a_table_as_input_backwards() -> None:
    solution = native(Implicit(), 0.0, t0=10.0, saveat=T[::-1], inputs={"u": ([0.0, 5.0, 10.0], [0.0, 1.0, -3.0])})
    wanted = [cube_root(2 + np.sin(3 * t) + np.interp(t, [0, 5, 10], [0, 1, -3])) for t in T[::-1]]
    assert_allclose(solution["y"], wanted, rtol=1e-10)


def test_events() -> None:
    solution = native(Counting(), 20.0, saveat=2)
    rises = [np.arcsin(0.625 / 2) + 2 * np.pi * k for k in range(4)]
    found = [e.t for e in solution.events if "> 0.5" in e.causes[0] or "0.5 <" in e.causes[0]]
    assert_allclose([t for t in found if np.cos(t) > 0], rises, atol=1e-8)
    assert (solution["n"][-1], solution["m"][-1]) == (4, 40)
    assert native(OnlySamples(), saveat=2)["n"][-1] == 20


def test_derivatives_and_batches() -> None:
    system = ac.compile(Implicit())

    def outcome(k: Any) -> Any:
        return system.simulate(10.0, parameters={"k": k}, saveat=T, engine="native")["y"]

    y = np.asarray(outcome(2.0))
    assert_allclose(jax.jacfwd(outcome)(2.0), 1 / (3 * y**2 + 1), rtol=1e-9)
    batch = jax.vmap(outcome)(np.array([1.0, 2.0, 3.0]))
    assert_allclose(batch[1], y, rtol=1e-12)


def test_large() -> None:
    """Above the size that is written out: loops over families. ``V = v + v^3 + 150 * 0.01 v^3``."""
    t = np.array([0.0, 1.0, 2.0, 6.0])
    solution = native(Star(), 6.0, saveat=t)
    wanted = [brentq(lambda v, u=u: v + 2.5 * v**3 - u, -3.0, 3.0, xtol=1e-15) for u in 2 * np.sin(0.2 * np.pi * t)]
    assert_allclose(solution["cells.v"], np.tile(np.array(wanted)[:, None], 150), atol=1e-10)


class Revolving(Component):
    """An angle given by sine and cosine, which fit at every half turn."""

    rate: Parameter = Parameter(7.0)
    angle: Variable = Variable(start=0.4)

    def equations(self) -> Equations:
        lag = self.angle - self.rate * ac.time
        yield ac.sin(lag) == 0.5 * ac.cos(lag)


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
@pytest.mark.parametrize("save", [[0.0, 3.0], [3.0], [0.0, 1.4, 3.0]])
def test_far_output_times_stay_on_the_branch(engine: Any, save: list[float]) -> None:
    solution = ac.compile(Revolving()).simulate(3.0, saveat=save, engine=engine, rtol=1e-8)
    wanted = 7.0 * np.array(save) + np.arctan(0.5)
    assert np.asarray(solution["angle"]) == pytest.approx(wanted, abs=1e-9)


@pytest.mark.slow
def test_slopes_over_far_output_times() -> None:
    system = ac.compile(Revolving())

    def final(rate: Any) -> Any:
        return system.simulate(3.0, parameters={"rate": rate}, saveat=[0.0, 3.0], engine="diffrax")["angle"][-1]

    assert float(jax.grad(final)(7.0)) == pytest.approx(3.0, rel=1e-9)
    assert float(jax.jacfwd(final)(7.0)) == pytest.approx(3.0, rel=1e-9)


class Turning(Revolving):
    """With a condition on the angle, found between output times."""

    y: Variable = Variable()

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == ac.where(self.angle > 10.0, 1.0, 0.0)


@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_far_output_times_stay_on_the_branch_with_events(engine: Any) -> None:
    solution = ac.compile(Turning()).simulate(3.0, saveat=[0.0, 3.0], engine=engine, rtol=1e-8)
    assert float(np.asarray(solution["angle"])[-1]) == pytest.approx(21.0 + np.arctan(0.5), abs=1e-9)
    assert [e.t for e in solution.events] == pytest.approx([(10.0 - np.arctan(0.5)) / 7.0], abs=1e-6)
