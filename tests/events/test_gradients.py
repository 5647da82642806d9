"""Derivatives through the times of events, with respect to parameters and start values, against finite differences and
closed forms."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from numpy.testing import assert_allclose

import acausal as ac
from acausal import Component, Discrete, Equations, Input, Parameter, Variable, der, pre, reinit, sample, when, where

from .benchmarks import BouncingBall, FullWave, StickSlip
from .constrained import Wall


class Thermostat(Component):
    """Two thresholds, with the time at which it last switched."""

    T: Variable = Variable(start=15.0, fixed=True)
    low: Parameter = Parameter(18.0)
    high: Parameter = Parameter(22.0)
    power: Parameter = Parameter(2.0)
    on: Discrete = Discrete(start=1)
    last: Discrete = Discrete(start=0)

    def equations(self) -> Equations:
        yield der(self.T) == where(self.on > 0.5, self.power, 0.0) - 0.1 * (self.T - 10.0)
        yield when(self.T > self.high, {self.on: 0, self.last: ac.time}).elsewhen(
            self.T < self.low, {self.on: 1, self.last: ac.time}
        )


class Sampled(Component):
    """A sampled controller whose interval and first time are parameters."""

    x: Variable = Variable(start=1.0, fixed=True)
    u: Discrete = Discrete(start=0.0)
    K: Parameter = Parameter(1.5)
    T: Parameter = Parameter(0.3)
    first: Parameter = Parameter(0.1)

    def equations(self) -> Equations:
        yield der(self.x) == self.u - self.x
        yield when(sample(self.first, self.T), {self.u: -self.K * self.x})


class Mixed(Component):
    """An algebraic unknown of a nonlinear equation, a condition on it, a new state that depends on it, and time."""

    x: Variable = Variable(start=0.0, fixed=True)
    y: Variable = Variable(start=0.1)
    n: Discrete = Discrete(start=0)
    a: Parameter = Parameter(1.2)
    b: Parameter = Parameter(0.4)

    def equations(self) -> Equations:
        yield der(self.x) == self.a - 0.2 * self.x * where(self.y > self.b / 2, self.y, 0.5)
        yield self.y + self.y**3 == self.x + 0.1 * ac.sin(3 * ac.time)
        yield when(self.y > self.b, reinit(self.x, -0.5 * self.a * pre(self.y)), {self.n: pre(self.n) + 1})


@dataclass(frozen=True)
class Case:
    """A model, values to differentiate by, a variable, and the end of the run."""

    model: Callable[[], Component]
    parameters: dict[str, float]
    initial: dict[str, float]
    seen: tuple[str, ...]
    t1: float


CASES = {
    "ball": Case(BouncingBall, {"e": 0.7, "g": 9.81}, {"h": 1.0, "v": 0.3}, ("h", "v", "last"), 1.7),
    "stick_slip": Case(StickSlip, {"friction.peak": 1.6, "spring.c": 8.0, "mass.m": 1.3, "v_belt": 0.12},
                       {"mass.s": 0.01}, ("mass.s", "mass.v"), 4.0),
    "full_wave": Case(FullWave, {"source.V": 11.0, "source.f": 1.1, "load.R": 9.0, "d1.Vknee": 0.3},
                      {"capacitor.v": 2.0}, ("capacitor.v", "d2.v"), 1.6),
    "thermostat": Case(Thermostat, {"low": 18.2, "high": 21.5, "power": 2.1}, {"T": 14.0}, ("T", "last"), 12.0),
    "sampled": Case(Sampled, {"K": 1.4, "T": 0.31, "first": 0.12}, {"x": 0.9}, ("x", "u"), 1.5),
    "mixed": Case(Mixed, {"a": 1.3, "b": 0.45}, {"x": 0.05}, ("x", "y"), 3.0),
    "wall": Case(Wall, {"L": 1.1, "e": 0.8}, {"x": 0.75}, ("x", "vx", "vy"), 1.6),
}  # fmt: skip


def values_of(case: Case, engine: Any = "native") -> Callable[[jax.Array], jax.Array]:
    """Values of what is seen half way and at the end, as a function of all parameters and start values."""
    system = ac.compile(case.model())
    n = len(case.parameters)

    def values(x: jax.Array) -> jax.Array:
        parameters = dict(zip(case.parameters, x[:n], strict=True))
        initial = dict(zip(case.initial, x[n:], strict=True))
        solution = system.simulate(
            case.t1, parameters=parameters, initial=initial, engine=engine, rtol=1e-11,
            saveat=np.array([0.55 * case.t1, case.t1]),
        )  # fmt: skip
        return jnp.concatenate([jnp.asarray(solution[name]) for name in case.seen])

    return values


@pytest.mark.slow_case("full_wave", "mixed", "wall")
@pytest.mark.parametrize("name", CASES)
def test_derivatives_through_events(name: str) -> None:
    case = CASES[name]
    values = values_of(case)
    x = jnp.array([*case.parameters.values(), *case.initial.values()])
    found = np.asarray(jax.jacfwd(values)(x))
    assert np.abs(found).max() > 0.1
    for k in range(len(x)):
        step = 1e-5 * max(abs(float(x[k])), 0.1)
        difference = (values(x.at[k].add(step)) - values(x.at[k].add(-step))) / (2 * step)
        assert_allclose(found[:, k], difference, rtol=2e-5, atol=2e-6 * max(1.0, np.abs(difference).max()))


@pytest.mark.slow_case("stick_slip", "full_wave", "mixed", "wall", "thermostat", "sampled")
@pytest.mark.parametrize("name", CASES)
def test_both_engines_have_the_same_derivatives(name: str) -> None:
    case = CASES[name]
    x = jnp.array([*case.parameters.values(), *case.initial.values()])
    native, diffrax = (np.asarray(jax.jacfwd(values_of(case, engine))(x)) for engine in ("native", "diffrax"))
    assert_allclose(diffrax, native, rtol=1e-5, atol=1e-6 * np.abs(native).max())


def test_forward_and_reverse_agree() -> None:
    case = CASES["ball"]
    values = values_of(case)
    x = jnp.array([*case.parameters.values(), *case.initial.values()])
    forward, reverse = jax.jacfwd(values)(x), jax.jacrev(values)(x)
    assert_allclose(reverse, forward, rtol=1e-9, atol=1e-12)
    batch = jax.vmap(values)(jnp.stack([x, 1.01 * x]))
    assert_allclose(batch[1], values(1.01 * x), rtol=1e-9)


def test_time_of_the_bounces_in_closed_form() -> None:
    """``t_2 = sqrt(2 h/g) (1 + 2 e)``: derivatives with respect to h, g and e."""
    system = ac.compile(BouncingBall())

    def second(h: jax.Array, g: jax.Array, e: jax.Array) -> jax.Array:
        run = system.simulate(1.3, parameters={"g": g, "e": e}, initial={"h": h}, engine="native", rtol=1e-11, saveat=2)
        return jnp.asarray(run["last"])[-1]

    found = jax.grad(second, argnums=(0, 1, 2))(1.0, 9.81, 0.7)
    fall = np.sqrt(2 / 9.81)
    assert_allclose(found, [fall * 2.4 / 2, -fall * 2.4 / 2 / 9.81, 2 * fall], rtol=1e-9)


def test_the_end_of_a_run_that_ends_itself() -> None:
    """What `terminal()` writes has derivatives, too."""

    class Ends(Component):
        x: Variable = Variable(start=0.0, fixed=True)
        rate: Parameter = Parameter(2.0)
        last: Discrete = Discrete(start=0)

        def equations(self) -> Equations:
            yield der(self.x) == self.rate
            yield when(ac.terminal(), {self.last: self.x**2})

    def last(rate: jax.Array) -> jax.Array:
        run = ac.compile(Ends()).simulate(0.5, parameters={"rate": rate}, engine="native", saveat=2)
        return jnp.asarray(run["last"])[-1]

    assert_allclose(jax.grad(last)(2.0), 2 * 2.0 * 0.25, rtol=1e-9)


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_what_is_written_where_terminate_ends_a_run(engine: Any) -> None:
    """It follows the time of the end: x is 0.5 there whatever its rate, and the time 0.5 / rate."""

    class Stopped(Component):
        x: Variable = Variable(start=0.0, fixed=True)
        rate: Parameter = Parameter(2.0)
        last: Discrete = Discrete(start=0)
        end: Discrete = Discrete(start=0)

        def equations(self) -> Equations:
            yield der(self.x) == self.rate
            yield when(self.x > 0.5, ac.terminate("done"))
            yield when(ac.terminal(), {self.last: self.x**2, self.end: ac.time})

    system = ac.compile(Stopped())

    def written(rate: jax.Array) -> jax.Array:
        run = system.simulate(1.0, parameters={"rate": rate}, engine=engine, saveat=2)
        return jnp.stack([jnp.asarray(run[name])[-1] for name in ("last", "end")])

    assert_allclose(written(jnp.asarray(2.0)), [0.25, 0.25], rtol=1e-9)
    assert_allclose(jax.jacrev(written)(2.0), [0.0, -0.125], rtol=1e-6, atol=1e-9)


class Jump(Component):
    """A rate that jumps at a threshold: ``x(t1) = a + r (t1 - a / k)``, with a table and a number as inputs."""

    x: Variable = Variable(start=0.0, fixed=True)
    k: Parameter = Parameter(1.5)
    a: Input = Input(start=1.0)
    r: Input = Input(start=3.0)

    def equations(self) -> Equations:
        yield der(self.x) == where(self.x < self.a, self.k, self.r)


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_a_rate_that_jumps_in_closed_form(engine: Any) -> None:
    system = ac.compile(Jump())

    def end(k: Any, r: Any) -> Any:
        inputs = {"a": (np.array([0.0, 2.0]), np.array([0.5, 1.5])), "r": r}
        run = system.simulate(2.0, parameters={"k": k}, inputs=inputs, engine=engine, rtol=1e-9, saveat=2)
        return jnp.asarray(run["x"])[-1]

    # x = k t meets a = (1 + t) / 2 at t = 1 / (2 k - 1)
    def exact(k: Any, r: Any) -> Any:
        t = 1.0 / (2.0 * k - 1.0)
        return k * t + r * (2.0 - t)

    assert_allclose(jax.grad(end, argnums=(0, 1))(1.5, 3.0), jax.grad(exact, argnums=(0, 1))(1.5, 3.0), rtol=1e-8)


def test_a_function_of_time_as_an_input() -> None:
    """The threshold ``1 + sin t / 2`` is met at ``k t = 1 + sin t / 2``."""
    system = ac.compile(Jump())

    def end(k: Any) -> Any:
        run = system.simulate(
            2.0, parameters={"k": k}, inputs={"a": lambda t: 1.0 + 0.5 * jnp.sin(t)}, rtol=1e-10, saveat=2,
            engine="diffrax",
        )  # fmt: skip
        return jnp.asarray(run["x"])[-1]

    t = 1.0
    for _ in range(50):
        t = (1.0 + 0.5 * np.sin(t)) / 1.5
    # d/dk of k t* + 3 (2 - t*), where (k - cos(t*) / 2) dt* = -t* dk
    assert_allclose(jax.grad(end)(1.5), t + (1.5 - 3.0) * -t / (1.5 - 0.5 * np.cos(t)), rtol=1e-8)


class Threshold(Component):
    """No states: a nonlinear load whose source changes once with a latch, at ``y = top`` on the way up."""

    y: Variable = Variable()
    top: Parameter = Parameter(0.4)
    on: Discrete = Discrete(start=0)
    last: Discrete = Discrete(start=0)

    def equations(self) -> Equations:
        yield self.y + self.y**3 == where(pre(self.on) > 0.5, self.top, 1.0) * ac.sin(ac.time)
        yield when(self.y > self.top, {self.on: 1, self.last: ac.time})


@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_a_model_without_states(engine: Any) -> None:
    """The latch is set at ``sin t = top + top^3``; behind it ``y + y^3 = top sin t``."""
    system = ac.compile(Threshold())

    def seen(top: Any) -> Any:
        run = system.simulate(1.5, parameters={"top": top}, engine=engine, saveat=np.array([0.2, 1.5]))
        return jnp.stack([jnp.asarray(run["y"])[-1], jnp.asarray(run["last"])[-1]])

    found = np.asarray(jax.jacfwd(seen)(0.4))
    wanted = (1.0 + 3.0 * 0.4**2) / np.cos(np.arcsin(0.4 + 0.4**3))
    y = float(seen(0.4)[0])
    assert_allclose(y + y**3, 0.4 * np.sin(1.5), rtol=1e-8)
    assert_allclose(found, [np.sin(1.5) / (1.0 + 3.0 * y**2), wanted], rtol=1e-7)


@pytest.mark.slow
def test_diffrax_within_a_compiled_program() -> None:
    """`when` cannot be carried out there; conditions are stepped over, and what that does to derivatives is said."""
    system = ac.compile(BouncingBall())

    def height(e: Any) -> Any:
        return jnp.asarray(system.simulate(1.0, parameters={"e": e}, engine="diffrax", saveat=2)["h"])[-1]

    for inside in (jax.jit(height), lambda e: jax.vmap(height)(e * jnp.ones(2))):
        with pytest.raises(ac.SimulationError, match=r"inside of jit or vmap .*it cannot run"):
            inside(0.7)
    data = {"t": np.linspace(0.1, 1.0, 10), "h": np.ones(10)}
    with pytest.raises(ac.SimulationError, match=r"and so in a calibration or an ensemble\) it cannot run\."):
        ac.calibrate(system, data, free={"e": (0.5, 0.9)}, engine="diffrax")
    jumps = ac.compile(Jump())

    def end(k: Any) -> Any:
        return jnp.asarray(jumps.simulate(2.0, parameters={"k": k}, engine="diffrax", saveat=2)["x"])[-1]

    assert_allclose(jax.jit(end)(1.5), 5.0, rtol=1e-6)
    with pytest.warns(UserWarning, match=r"leave out the jump where they are not:\n    `x < a` \(.*test_gradients.py:"):
        jax.jit(jax.grad(end))(1.5)
