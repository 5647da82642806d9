"""Inputs that are tables: the run ends a step at each of their points, and passes over no pulse."""

from __future__ import annotations

from functools import cache
from typing import Any

import jax
import numpy as np
import pytest

import acausal as ac
from acausal import Component, Discrete, Equations, Input, Parameter, Variable, der, pre, when

WIDTHS = (1e-1, 1e-3, 1e-5, 1e-8)


class Counter(Component):
    """Integrates an input, and counts how often it rises above a threshold."""

    u: Input = Input()
    x: Variable = Variable(start=0.0, fixed=True)
    n: Discrete = Discrete(start=0)

    def equations(self) -> Equations:
        yield der(self.x) == self.u
        yield when(self.u > 0.5, {self.n: pre(self.n) + 1})


class Unfelt(Component):
    """No state feels the input: the size of the steps knows nothing of it."""

    u: Input = Input()
    x: Variable = Variable(start=0.0, fixed=True)
    n: Discrete = Discrete(start=0)

    def equations(self) -> Equations:
        yield der(self.x) == 1.0 - self.x
        yield when(self.u > 0.5, {self.n: pre(self.n) + 1})


class Stateless(Component):
    """An equation without states."""

    u: Input = Input()
    y: Variable = Variable()
    n: Discrete = Discrete(start=0)

    def equations(self) -> Equations:
        yield self.y + self.y**3 == 1.25 * self.u
        yield when(self.y > 0.5, {self.n: pre(self.n) + 1})


class Integral(Component):
    """Integrates an input, without events."""

    u: Input = Input()
    k: Parameter = Parameter(1.0)
    x: Variable = Variable(start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) == self.k * self.u


@cache
def compiled(model: Any) -> ac.System:
    return ac.compile(model())


@pytest.fixture(params=["native", "diffrax"])
def engine(request: pytest.FixtureRequest) -> Any:
    return request.param


def pulses(width: float) -> tuple[list[float], list[float]]:
    """Two triangles of height 2 and of this width, so of the area ``width``, with their peaks at 0.3 and 0.7."""
    h = 0.5 * width
    return [0.0, 0.3 - h, 0.3, 0.3 + h, 0.7 - h, 0.7, 0.7 + h, 1.0], [0.0, 0.0, 2.0, 0.0, 0.0, 2.0, 0.0, 0.0]


@pytest.mark.parametrize("model", [Counter, Unfelt, Stateless])
def test_no_pulse_is_passed_over(model: Any, engine: Any) -> None:
    for width in WIDTHS:
        solution = compiled(model).simulate(1.0, inputs={"u": pulses(width)}, saveat=2, engine=engine)
        assert solution["n"][-1] == 2
        risen = np.array([0.3 - 0.375 * width, 0.7 - 0.375 * width])
        times = np.array([event.t for event in solution.events])
        assert len(times) == 2
        np.testing.assert_allclose(times, risen, atol=1e-12)


@pytest.mark.parametrize("solver", [None, "adams"])
def test_integrals_have_their_areas(solver: Any, engine: Any) -> None:
    if solver is not None and engine == "diffrax":
        pytest.skip("a method of the native engine")
    for width in WIDTHS:
        given: dict[str, Any] = {"inputs": {"u": pulses(width)}, "solver": solver, "engine": engine}
        forward = compiled(Integral).simulate(1.0, saveat=[0.0, 0.5, 1.0], **given)
        np.testing.assert_allclose(forward["x"], [0.0, width, 2.0 * width], rtol=1e-5, atol=1e-6)
        assert forward.stats["steps"] < 300
        back = compiled(Integral).simulate(0.0, t0=1.0, saveat=[1.0, 0.5, 0.0], **given)
        np.testing.assert_allclose(back["x"], [0.0, -width, -2.0 * width], rtol=1e-5, atol=1e-6)


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_derivatives_know_the_pulses(engine: Any) -> None:
    def last(k: Any) -> Any:
        given: Any = {"inputs": {"u": pulses(1e-3)}, "parameters": {"k": k}, "engine": engine}
        return compiled(Integral).simulate(1.0, saveat=2, **given)["x"][-1]

    assert jax.grad(last)(2.0) == pytest.approx(2e-3, rel=1e-5)


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_inputs_with_points_of_their_own(engine: Any) -> None:
    """Points that coincide but for rounding, of two inputs, are one."""

    class Two(Component):
        a: Input = Input()
        b: Input = Input()
        x: Variable = Variable(start=0.0, fixed=True)
        n: Discrete = Discrete(start=0)

        def equations(self) -> Equations:
            yield der(self.x) == self.a - self.b
            yield when((self.a > 0.5) & (self.b > 0.5), {self.n: pre(self.n) + 1})

    times, values = pulses(1e-4)
    late = [*times[:4], *(np.nextafter(t, 2.0) for t in times[4:])]
    solution = ac.compile(Two()).simulate(
        1.0, inputs={"a": (times, values), "b": (late, values)}, saveat=2, engine=engine
    )
    assert solution["n"][-1] == 2
    assert solution["x"][-1] == pytest.approx(0.0, abs=1e-12)
