"""Laws with a root at its foot: empty tanks, equal pressures, flows that reverse, contacts, motion from rest."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

import jax
import numpy as np
import pytest
from scipy.integrate import solve_ivp

import acausal as ac
from acausal import Component, Equations, Parameter, Variable, Vector, der, norm, sign, sin, sqrt, vector, where
from acausal.symbolic.expr import Expr

ENGINES = ("native", "diffrax")
Law = Callable[[Expr], Expr]


def integrated(f: Any, y0: Any, t: Any, **options: Any) -> Any:
    """Solution of an equation by hand at the times t, (n, n_t)."""
    return solve_ivp(f, (0.0, t[-1]), y0, t_eval=t, rtol=1e-11, atol=1e-13, method="Radau", **options).y


# ---- a start at the foot ----------------------------------------------------------------------------------------


class Filling(Component):
    """A tank that is empty at first, with a hole in its bottom."""

    k: Parameter = Parameter(0.1)
    h: Variable = Variable(start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.h) == 0.3 - self.k * sqrt(self.h)


class FromRest(Component):
    """Drag by the square of the speed, from rest."""

    v: Vector = Vector(Variable(), (0.0, 0.0))

    def equations(self) -> Equations:
        yield der(self.v) == vector(1.0, -9.81) - 0.3 * norm(self.v) * self.v


class RootOfTime(Component):
    x: Variable = Variable(start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) == sqrt(ac.time)


STARTS: dict[str, tuple[Component, Any]] = {
    "an empty tank": (Filling(), lambda t: {"h": integrated(lambda _, h: 0.3 - 0.1 * np.sqrt(np.abs(h)), [0.0], t)[0]}),
    "from rest": (
        FromRest(),
        lambda t: {
            "v[1]": integrated(lambda _, v: np.array([1.0, -9.81]) - 0.3 * np.hypot(*v) * v, [0.0, 0.0], t)[0],
            "v[2]": integrated(lambda _, v: np.array([1.0, -9.81]) - 0.3 * np.hypot(*v) * v, [0.0, 0.0], t)[1],
        },
    ),
    "a root of time": (RootOfTime(), lambda t: {"x": t**1.5 / 1.5}),
}


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("name", STARTS)
def test_an_infinite_slope_at_the_start(name: str, engine: Any) -> None:
    model, exact = STARTS[name]
    solution = ac.compile(model).simulate(2.0, rtol=1e-8, saveat=11, engine=engine)
    for variable, values in exact(np.asarray(solution.t)).items():
        np.testing.assert_allclose(solution[variable], values, rtol=1e-6, atol=1e-7, err_msg=variable)


class Weir(Component):
    """What flows over a weir, with the exponent 1.5: its second derivative is infinite at the edge."""

    k: Parameter = Parameter(2.0)
    h: Variable = Variable(start=0.5, fixed=True)

    def equations(self) -> Equations:
        yield der(self.h) == 0.3 - self.k * ac.max(self.h - 1.0, 0.0) ** 1.5


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
@pytest.mark.parametrize(
    ("model", "k", "step"), [(Filling(), 0.1, 0.001), (Weir(), 2.0, 0.01)], ids=["from the foot", "over a weir"]
)
def test_derivatives(model: Component, k: float, step: float, engine: Any) -> None:
    """A slope that is infinite at one point only does not make the derivatives of the run infinite."""
    system = ac.compile(model)

    def level(k: Any) -> Any:
        return system.simulate(4.0, rtol=1e-9, parameters={"k": k}, engine=engine, saveat=2)["h"][-1]

    slope = jax.grad(level)(k) if engine == "diffrax" else jax.jacfwd(level)(k)
    assert np.isclose(slope, (level(k + step) - level(k - step)) / (2.0 * step), rtol=1e-4)


class Guess(Component):
    """An unknown below a root, whose guess is zero because none is given."""

    q: Variable = Variable()
    x: Variable = Variable(start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield sqrt(self.q) + 0.1 * self.q == 2.0 + sin(ac.time)
        yield der(self.x) == self.q


@pytest.mark.parametrize("engine", ENGINES)
def test_a_guess_at_the_foot(engine: Any) -> None:
    solution = ac.compile(Guess()).simulate(2.0, rtol=1e-8, engine=engine)
    root = 5.0 * (np.sqrt(1.0 + 0.4 * (2.0 + np.sin(solution.t))) - 1.0)  # of 0.1 r^2 + r = 2 + sin(t)
    np.testing.assert_allclose(solution["q"], root**2, rtol=1e-6)


# ---- flows that reverse -----------------------------------------------------------------------------------------

FLOWS: dict[str, Law] = {
    "sign": lambda dp: sign(dp) * sqrt(ac.abs(dp)),
    "sign, power": lambda dp: 2.0 * sign(dp) * ac.abs(dp / 4.0) ** 0.5,
    "where": lambda dp: where(dp > 0.0, sqrt(dp), -sqrt(-dp)),
    "where, factors": lambda dp: where(dp <= 0.0, -0.5 * sqrt(-4.0 * dp), 0.5 * sqrt(4.0 * dp)),
    "three cases": lambda dp: where(dp > 0.0, sqrt(dp), where(dp < 0.0, -sqrt(-dp), 0.0)),
}
DROPS: dict[str, Law] = {
    "abs": lambda q: q * ac.abs(q),
    "factors": lambda q: 2.0 * (ac.abs(q) * (q / 2.0)),
    "sign": lambda q: sign(q) * q**2,
    "where": lambda q: where(q > 0.0, q**2, -(q**2)),
    "where, turned": lambda q: where(q < 0.0, -0.5 * q**2, 0.5 * q**2) * 2.0,
}


class Vessels(Component):
    """Two vessels at equal pressures, joined by a turbulent flow; one is filled and emptied."""

    a: Variable = Variable(start=1.0, fixed=True)
    b: Variable = Variable(start=1.0, fixed=True)
    q: Variable = Variable()
    dp: Variable = Variable()

    def law(self) -> Equations:
        raise NotImplementedError

    def equations(self) -> Equations:
        yield der(self.a) == 0.3 * sin(3.0 * ac.time) - self.q
        yield der(self.b) == self.q
        yield self.dp == self.a - self.b
        yield from self.law()


@cache
def vessels(t1: float) -> Any:
    """The difference by hand."""
    t = np.linspace(0.0, t1, 21)
    flow = lambda d: np.sign(d) * np.sqrt(np.abs(d))  # noqa: E731
    return integrated(lambda t, d: 0.3 * np.sin(3.0 * t) - 2.0 * flow(d), [0.0], t, max_step=0.01)[0]


@pytest.mark.parametrize(("form", "engine"), [*((form, "native") for form in FLOWS), ("where", "diffrax")])
def test_a_flow_that_reverses(form: str, engine: Any) -> None:
    """No event is needed, and none is found again and again where the difference is below the tolerances."""

    class Orifice(Vessels):
        def law(self) -> Equations:
            yield self.q == FLOWS[form](self.dp)

    check_reversal(ac.compile(Orifice()), engine)


@pytest.mark.parametrize(("form", "engine"), [*((form, "native") for form in DROPS), ("abs", "diffrax")])
def test_a_pressure_drop_that_reverses(form: str, engine: Any) -> None:
    """The drop is solved for the flow, of which it is no function at the reversal that Newton's method could use."""

    class Pipe(Vessels):
        def law(self) -> Equations:
            yield self.dp == DROPS[form](self.q)

    check_reversal(ac.compile(Pipe()), engine)


def check_reversal(system: ac.System, engine: Any) -> None:
    solution = system.simulate(4.0, rtol=1e-7, saveat=21, engine=engine)
    np.testing.assert_allclose(solution["dp"], vessels(4.0), atol=1e-6)
    assert not solution.events


@pytest.mark.parametrize("form", ["sign", "where", "where, factors"])
def test_a_flow_that_is_given_is_solved_for_the_pressure(form: str) -> None:
    class Pump(Component):
        q: Variable = Variable()
        dp: Variable = Variable()
        x: Variable = Variable(start=0.0, fixed=True)

        def equations(self) -> Equations:
            yield self.q == sin(3.0 * ac.time)
            yield self.q == FLOWS[form](self.dp)
            yield der(self.x) == self.dp

    solution = ac.compile(Pump()).simulate(3.0, engine="native")
    flow = np.sin(3.0 * np.asarray(solution.t))
    np.testing.assert_allclose(solution["dp"], flow * np.abs(flow), atol=1e-12)


# ---- conditions that keep a root in its domain ------------------------------------------------------------------


class Contact(Component):
    """A ball on a surface that yields as in Hertz's theory; the contact opens at an event."""

    x: Variable = Variable(start=0.1, fixed=True)
    v: Variable = Variable(start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) == self.v
        yield der(self.v) == -9.81 + where(self.x < 0.0, 1e4 * (-self.x) ** 1.5 * (1.0 - 0.3 * self.v), 0.0)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.slow_case("diffrax")
def test_a_contact_opens(engine: Any) -> None:
    """The force has no value beyond the point at which the contact opens, and the mode is held until there."""
    solution = ac.compile(Contact()).simulate(1.0, rtol=1e-9, saveat=11, engine=engine)
    force = lambda x, v: 1e4 * max(-x, 0.0) ** 1.5 * (1.0 - 0.3 * v)  # noqa: E731
    exact = integrated(lambda _, y: [y[1], -9.81 + force(*y)], [0.1, 0.0], np.asarray(solution.t), max_step=1e-3)
    np.testing.assert_allclose(solution["x"], exact[0], atol=1e-7)
    assert len(solution.events) == 8


class Emptying(Component):
    h: Variable = Variable(start=1.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.h) == -where(self.h > 0.0, sqrt(self.h), 0.0)


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_a_tank_runs_empty(engine: Any) -> None:
    solution = ac.compile(Emptying()).simulate(3.0, rtol=1e-8, engine=engine)
    np.testing.assert_allclose(solution["h"], np.maximum(1.0 - np.asarray(solution.t) / 2.0, 0.0) ** 2, atol=1e-6)


def test_what_is_no_root_of_the_condition_stays_an_event() -> None:
    class Jump(Component):
        x: Variable = Variable(start=-1.0, fixed=True)
        y: Variable = Variable(start=0.0, fixed=True)

        def equations(self) -> Equations:
            yield der(self.x) == 1.0
            yield der(self.y) == where(self.x > 0.0, 1.0 + sqrt(self.x), -sqrt(-self.x))

    solution = ac.compile(Jump()).simulate(2.0, rtol=1e-9)
    assert [round(float(event.t), 9) for event in solution.events] == [1.0]
    assert np.isclose(solution["y"][-1], -2 / 3 + 1 + 2 / 3, atol=1e-7)
