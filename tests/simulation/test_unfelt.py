"""Algebraic unknowns in the output solve their equations, also where they kink or jump and no state feels it."""

from __future__ import annotations

from typing import Any

import diffrax
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from numpy.testing import assert_allclose

import acausal as ac
from acausal import Array, Component, Equations, Parameter, Variable, der
from acausal.simulation.native import native_model

ENGINES = ("native", "diffrax")
TIMES = np.linspace(0.0, 10.0, 333)


class Kinked(Component):
    """``y + y^3 = k s(t) x`` with a signal s that kinks or jumps without an event, beside a slow state."""

    k: Parameter = Parameter(2.0)
    x: Variable = Variable(start=1.0, fixed=True)
    y: Variable = Variable()

    def signal(self) -> Any:
        """The signal."""
        return ac.noevent(ac.abs(ac.sin(5.0 * ac.time)))

    def equations(self) -> Equations:
        yield der(self.x) == -0.01 * self.x
        yield self.y + self.y**3 == self.k * self.signal() * self.x


class Jumping(Kinked):
    """The signal is a pulse of 3 ms, shorter than the steps."""

    def signal(self) -> Any:
        """The signal."""
        return ac.noevent(ac.where(ac.abs(ac.time - 5.0) < 1.5e-3, 1.0, 0.0))


class Many(Component):
    """A hundred of them, which are loops in the generated code."""

    parts: Array[Kinked] = Array(Kinked(), 100, k=[0.02 * (i + 1) for i in range(100)])


@pytest.mark.parametrize("engine", ENGINES)
def test_kinks(engine: Any) -> None:
    solution = ac.compile(Kinked()).simulate(10.0, engine=engine, rtol=1e-6, saveat=TIMES)
    y, right = solution["y"], 2.0 * np.abs(np.sin(5.0 * TIMES)) * np.exp(-0.01 * TIMES)
    assert_allclose(y + y**3, right, atol=2e-6)


@pytest.mark.parametrize("engine", ENGINES)
def test_a_pulse_between_steps(engine: Any) -> None:
    times = np.array([0.0, 4.0, 4.999, 5.0, 5.001, 6.0, 10.0])
    y = ac.compile(Jumping()).simulate(10.0, engine=engine, saveat=times)["y"]
    inside = np.abs(times - 5.0) < 1.5e-3
    assert_allclose(y + y**3, np.where(inside, 2.0 * np.exp(-0.01 * times), 0.0), atol=1e-6)


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_families(engine: Any) -> None:
    system = ac.compile(Many())
    assert "AC_FAMILIES" in native_model(system).source.text
    solution = system.simulate(3.0, engine=engine, rtol=1e-6, saveat=100)
    for i in (0, 37, 99):
        y = solution[f"parts[{i}].y"]
        right = 0.02 * (i + 1) * np.abs(np.sin(5.0 * solution.t)) * np.exp(-0.01 * solution.t)
        assert_allclose(y + y**3, right, atol=2e-6)


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_derivatives(engine: Any) -> None:
    """y by k and by the start of x at the output times, by the implicit-function theorem."""
    system = ac.compile(Kinked())

    def total(k: Any, x: Any, weight: Any) -> Any:
        values = {"parameters": {"k": k}, "initial": {"x": x}}
        return jnp.sum(weight * system.simulate(10.0, saveat=TIMES, rtol=1e-8, engine=engine, **values)["y"])

    weight = np.cos(np.arange(len(TIMES)))
    by_k, by_x = jax.grad(total, argnums=(0, 1))(2.0, 1.0, weight)
    y = np.asarray(system.simulate(10.0, saveat=TIMES, rtol=1e-10)["y"])
    slope = np.abs(np.sin(5.0 * TIMES)) * np.exp(-0.01 * TIMES) / (1.0 + 3.0 * y**2)
    assert_allclose(by_k, np.sum(weight * slope), rtol=1e-6)
    assert_allclose(by_x, np.sum(weight * 2.0 * slope), rtol=1e-6)


@pytest.mark.slow
def test_forward_mode() -> None:
    system = ac.compile(Kinked())

    def y(k: Any) -> Any:
        options: Any = {"engine": "diffrax", "adjoint": diffrax.ForwardMode(), "saveat": 11, "rtol": 1e-8}
        return system.simulate(1.0, parameters={"k": k}, **options)["y"]

    values, slopes = jax.jvp(y, (2.0,), (1.0,))
    t = np.linspace(0.0, 1.0, 11)
    assert_allclose(slopes, np.abs(np.sin(5.0 * t)) * np.exp(-0.01 * t) / (1.0 + 3.0 * values**2), rtol=1e-6, atol=1e-9)


class Ending(Component):
    """``y^2 = 1 x``, from t = 1 on ``0.1 x``, without an event."""

    x: Variable = Variable(start=1.0, fixed=True)
    y: Variable = Variable(start=1.0)

    def equations(self) -> Equations:
        yield der(self.x) == -0.1 * self.x * self.y
        yield self.y**2 == ac.noevent(ac.where(ac.time < 1.0, 1.0, 0.1)) * self.x


@pytest.mark.parametrize("engine", ENGINES)
def test_a_jump_that_a_state_feels(engine: Any) -> None:
    """The states are as they were, and y keeps its branch behind the jump."""
    times = np.array([0.0, 0.5, 0.999, 1.001, 1.5, 2.0])
    solution = ac.compile(Ending()).simulate(2.0, engine=engine, rtol=1e-8, saveat=times)
    before = (1.0 + 0.05 * times) ** -2.0  # x' = -0.1 x^1.5
    start = 1.05**-2.0
    after = (start**-0.5 + 0.05 * np.sqrt(0.1) * (times - 1.0)) ** -2.0
    x = np.where(times < 1.0, before, after)
    assert_allclose(solution["x"], x, rtol=1e-6)
    assert_allclose(solution["y"], np.sqrt(np.where(times < 1.0, 1.0, 0.1) * x), rtol=1e-6)
