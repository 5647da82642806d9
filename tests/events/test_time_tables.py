"""Tables over time in the equations: a step ends at each of their points, and no pulse is passed over."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

import jax
import numpy as np
import pytest

import acausal as ac
from acausal import Component, Discrete, Equations, Expr, Input, Parameter, Variable, der, pre, when
from acausal.components.blocks import CombiTimeTable

WIDTH = 1e-6
TIMES = [0.0, 0.3 - WIDTH / 2, 0.3, 0.3 + WIDTH / 2, 0.7 - WIDTH / 2, 0.7, 0.7 + WIDTH / 2, 1.0]
VALUES = [0.0, 0.0, 2.0, 0.0, 0.0, 2.0, 0.0, 0.0]
PULSES = ac.table(TIMES, VALUES)
"""Two triangles of height 2 and of this width, with their peaks at 0.3 and 0.7."""


class Pulsed(Component):
    """Pulses of a period, and how many there were."""

    period: Parameter = Parameter(1.0)
    start: Parameter = Parameter(0.0)
    s: Variable = Variable()
    n: Discrete = Discrete(start=0)

    def equations(self) -> Equations:
        yield self.period * self.s == ac.time - self.start


class Counter(Pulsed):
    """Integrates the pulses, and counts them."""

    x: Variable = Variable(start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield from super().equations()
        yield der(self.x) == PULSES(self.s)
        yield when(PULSES(self.s) > 0.5, {self.n: pre(self.n) + 1})


class Unfelt(Pulsed):
    """The pulses are in the condition alone."""

    x: Variable = Variable(start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield from super().equations()
        yield der(self.x) == 1.0 - self.x
        yield when(PULSES(self.s) > 0.5, {self.n: pre(self.n) + 1})


class Stateless(Pulsed):
    """An equation without states."""

    y: Variable = Variable()

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y + self.y**3 == 1.25 * PULSES(self.s)
        yield when(self.y > 0.5, {self.n: pre(self.n) + 1})


class Integral(Component):
    """Integrates the pulses, without events."""

    k: Parameter = Parameter(1.0)
    period: Parameter = Parameter(1.0)
    x: Variable = Variable(start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) == self.k * PULSES(ac.time / self.period)


@cache
def compiled(model: Callable[[], Component]) -> ac.System:
    return ac.compile(model())


@pytest.fixture(params=["native", "diffrax"])
def engine(request: pytest.FixtureRequest) -> Any:
    return request.param


@pytest.mark.parametrize("model", [Counter, Unfelt, Stateless])
@pytest.mark.parametrize(("period", "start"), [(1.0, 0.0), (3.0, 0.2), (-2.0, 2.0)])
def test_no_pulse_is_passed_over(model: Any, period: float, start: float, engine: Any) -> None:
    solution = compiled(model).simulate(
        4.0, parameters={"period": period, "start": start}, saveat=2, engine=engine, atol=1e-12
    )
    peaks = np.sort([start + 0.3 * period, start + 0.7 * period])
    times = [event.t for event in solution.events if 0.0 < event.t]
    assert solution["n"][-1] == 2
    np.testing.assert_allclose(times, peaks - 0.375 * WIDTH * abs(period), atol=1e-11)
    if model is Counter:
        assert solution["x"][-1] == pytest.approx(2.0 * WIDTH * abs(period), rel=1e-4)


def test_a_falling_table_that_starts_on_its_point(engine: Any) -> None:
    class Falling(Component):
        y: Variable = Variable()
        n: Discrete = Discrete(start=0)

        def equations(self) -> Equations:
            yield self.y == ac.table([-1.0, -0.5, 0.0], [0.0, 1.0, 0.0])(-ac.time)
            yield when(self.y > 0.5, {self.n: pre(self.n) + 1})

    solution = ac.compile(Falling()).simulate(1.0, saveat=5, engine=engine)
    np.testing.assert_allclose(solution["y"], [0.0, 0.5, 1.0, 0.5, 0.0], atol=1e-12)
    assert [event.t for event in solution.events] == pytest.approx([0.25])


@pytest.mark.parametrize("solver", [None, "adams"])
def test_integrals_have_their_areas(solver: Any, engine: Any) -> None:
    if solver is not None and engine == "diffrax":
        pytest.skip("a method of the native engine")
    given: dict[str, Any] = {"solver": solver, "engine": engine, "atol": 1e-12}
    forward = compiled(Integral).simulate(1.0, saveat=[0.0, 0.5, 1.0], **given)
    np.testing.assert_allclose(forward["x"], [0.0, WIDTH, 2.0 * WIDTH], rtol=1e-5, atol=1e-12)
    assert forward.stats["steps"] < 300
    back = compiled(Integral).simulate(0.0, t0=1.0, saveat=[1.0, 0.5, 0.0], **given)
    np.testing.assert_allclose(back["x"], [0.0, -WIDTH, -2.0 * WIDTH], rtol=1e-5, atol=1e-12)


@pytest.mark.slow_case("diffrax")
def test_derivatives_know_the_pulses(engine: Any) -> None:
    def last(k: Any, period: Any) -> Any:
        given: Any = {"parameters": {"k": k, "period": period}, "engine": engine, "atol": 1e-12}
        return compiled(Integral).simulate(3.0, saveat=2, **given)["x"][-1]

    assert jax.grad(last)(2.0, 1.0) == pytest.approx(2.0 * WIDTH, rel=1e-4)
    # the area of a pulse grows with the period; its flanks move
    assert jax.grad(last, 1)(2.0, 1.0) == pytest.approx(4.0 * WIDTH, rel=1e-2)


@pytest.mark.slow_case("diffrax")
def test_long_periodic_tables(engine: Any) -> None:
    """A library table that is one interpolation, with a pulse every second; the pulse is hit where it returns."""
    times = [*np.linspace(0.0, 0.9, 50), 0.95, 0.95 + 1e-5, 0.95 + 2e-5, 1.0]
    values = [*[0.0] * 51, 1.0, 0.0, 0.0]

    class Counting(Component):
        table: CombiTimeTable = CombiTimeTable(
            table=[list(row) for row in zip(times, values, strict=True)], extrapolation="Periodic", timeScale=0.5,
        )  # fmt: skip
        x: Variable = Variable(start=0.0, fixed=True)
        n: Discrete = Discrete(start=0)

        def equations(self) -> Equations:
            yield der(self.x) == self.table.y[0]
            yield when(self.table.y[0] > 0.5, {self.n: pre(self.n) + 1})

    solution = ac.compile(Counting()).simulate(4.0, saveat=2, engine=engine, atol=1e-12)
    assert solution["n"][-1] == 8
    assert solution["x"][-1] == pytest.approx(8 * 0.5e-5, rel=1e-4)


def test_tables_over_a_remainder_without_events(engine: Any) -> None:
    class Repeating(Component):
        x: Variable = Variable(start=0.0, fixed=True)

        def equations(self) -> Equations:
            yield der(self.x) == PULSES(ac.mod(ac.time, 1.0))

    solution = ac.compile(Repeating()).simulate(5.0, saveat=2, engine=engine, events=False, atol=1e-12)
    assert solution["x"][-1] == pytest.approx(10.0 * WIDTH, rel=1e-4)


def tables_of(argument: Callable[[Any], Expr]) -> int:
    class Model(Component):
        a: Parameter = Parameter(2.0)
        u: Input = Input()
        x: Variable = Variable(start=0.0, fixed=True)

        def equations(self) -> Equations:
            yield der(self.x) == PULSES(argument(self))

    return len(ac.compile(Model()).lowered.time_tables)


@pytest.mark.parametrize(
    ("argument", "count"),
    [
        (lambda m: ac.time, 1),
        (lambda m: m.a * (ac.time - m.a) / 3.0, 1),
        (lambda m: ac.min(ac.time, m.a), 1),
        (lambda m: ac.time**2, 0),
        (lambda m: ac.time + m.u, 0),
        (lambda m: ac.time + m.x, 0),
        (lambda m: m.a, 0),
    ],
)
def test_tables_over_lines_in_time_are_found(argument: Any, count: int) -> None:
    assert tables_of(argument) == count


@pytest.mark.slow_case("diffrax")
def test_tables_of_many_instances(engine: Any) -> None:
    """One kernel for all instances, each with a shift of its own."""

    class Delayed(Component):
        shift: Parameter = Parameter(0.0)
        x: Variable = Variable(start=0.0, fixed=True)

        def equations(self) -> Equations:
            yield der(self.x) == PULSES(ac.time - self.shift)

    class Row(Component):
        parts: tuple[Delayed, ...] = tuple(Delayed(shift=0.01 * k) for k in range(9))

    solution = ac.compile(Row()).simulate(1.0, saveat=2, engine=engine, atol=1e-12)
    for k in range(9):
        assert solution[f"parts[{k}].x"][-1] == pytest.approx(2.0 * WIDTH, rel=1e-4), k
