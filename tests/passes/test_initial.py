"""Consistent starts from guesses, fixed starts and initial equations."""

from __future__ import annotations

import time
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal import Array, Component, Connector, Equations, Flow, Parameter, Potential, Variable, connect, der, start
from acausal.errors import InitializationError


class Pendulum(Component):
    """A pendulum in Cartesian coordinates."""

    L: Parameter = Parameter(1.0)
    g: Parameter = Parameter(9.81)
    x: Variable = Variable()
    y: Variable = Variable()
    u: Variable = Variable()
    v: Variable = Variable()
    T: Variable = Variable()

    def equations(self) -> Equations:
        yield der(self.x) == self.u
        yield der(self.y) == self.v
        yield der(self.u) == self.T * self.x
        yield der(self.v) == self.T * self.y - self.g
        yield self.x**2 + self.y**2 == self.L**2


def started(model: Component, initial: dict[str, float] | None = None) -> dict[str, float]:
    """Values of all states at the checked start."""
    system = ac.compile(model)
    x0, w0, p, left = system.initialize_with_residual(0.0, None, initial)
    system.check_initial(x0, w0, p, left)
    return dict(zip((*system.states, *system.algebraics), np.concatenate([x0, w0]).tolist(), strict=True))


def test_guesses_move_to_the_nearest_consistent_point() -> None:
    at = started(Pendulum(x=ac.start(3.0), y=ac.start(-4.0), u=ac.start(1.0), v=ac.start(0.75)))
    assert at == pytest.approx({"x": 0.6, "y": -0.8, "u": 1.0, "v": 0.75}, abs=1e-12)


def test_a_guess_that_is_consistent_stays() -> None:
    at = started(Pendulum(x=ac.start(1.0), y=ac.start(0.0)))
    assert at == pytest.approx({"x": 1.0, "y": 0.0, "u": 0.0, "v": 0.0}, abs=1e-15)


def test_fixed_starts_hold_and_others_follow() -> None:
    at = started(Pendulum(x=ac.start(0.6, fixed=True), y=ac.start(-1.0), u=ac.start(2.0, fixed=True)))
    assert at["x"] == 0.6 and at["u"] == 2.0
    assert at["y"] == pytest.approx(-0.8, abs=1e-12)
    assert at["v"] == pytest.approx(1.5, abs=1e-12)


@pytest.mark.parametrize("angle", [0.0, 0.5, 1.0, 2.0, 3.0, 4.0])
def test_redundant_fixed_starts_are_accepted(angle: float) -> None:
    x, y = np.sin(angle), -np.cos(angle)
    at = started(
        Pendulum(
            x=ac.start(x, fixed=True),
            y=ac.start(y, fixed=True),
            u=ac.start(-y, fixed=True),
            v=ac.start(x, fixed=True),
        )
    )
    assert at["x"] == x and at["y"] == y


def test_inconsistent_fixed_starts_are_named() -> None:
    model = Pendulum(x=ac.start(1.0, fixed=True), y=ac.start(0.01, fixed=True))
    with pytest.raises(InitializationError, match=r"x\*\*2 \+ y\*\*2") as info:
        started(model)
    assert "Held exactly (fixed start values): x = 1, y = 0.01" in str(info.value)


def test_initial_keyword_is_a_condition() -> None:
    at = started(Pendulum(x=ac.start(1.0), y=ac.start(0.0)), {"x": 0.0})
    assert at["x"] == 0.0
    assert abs(at["y"]) == pytest.approx(1.0)
    assert started(Pendulum(x=ac.start(0.1), y=ac.start(-1.0)), {"T": -12.0})["y"] < 0


class Rooted(Component):
    """An algebraic unknown that must move far, and a state that must not move at all."""

    x: Variable = Variable(start=1.0)
    z: Variable = Variable(start=0.1)
    k: Variable = Variable(start=2.0)
    rate: Parameter = Parameter(-0.5)

    def equations(self) -> Equations:
        yield der(self.x) == -self.z
        yield self.z + ac.sin(self.z) / 2 + self.x == 40
        yield der(self.k) == self.rate * self.k

    def initial_equations(self) -> Equations:
        yield der(self.k) == -3.0


def test_algebraic_unknowns_do_not_pull_at_states() -> None:
    at = started(Rooted())
    assert at["x"] == 1.0
    assert at["k"] == pytest.approx(6.0, abs=1e-12)


def test_contradicting_initial_equations_are_named() -> None:
    class Contradicting(Component):
        """Steady, but the rate is given."""

        x: Variable = Variable(start=1.0)

        def equations(self) -> Equations:
            yield der(self.x) == -self.x

        def initial_equations(self) -> Equations:
            yield der(self.x) == 0
            yield self.x == 2

    with pytest.raises(InitializationError) as info:
        started(Contradicting())
    assert "x = 2" in str(info.value)


@pytest.mark.slow
def test_inside_jax_the_start_is_the_same() -> None:
    system = ac.compile(Pendulum(x=ac.start(0.6, fixed=True), y=ac.start(-1.0), u=ac.start(2.0, fixed=True)))

    def start(length: Any, x: Any) -> Any:
        return system.initialize(0.0, {"L": length}, {"x": x})[0]

    found = jax.jit(start)(1.0, 0.6)
    expected = system.initialize(0.0, {"L": 1.0}, {"x": 0.6})[0]
    assert np.allclose(found, expected, atol=1e-12)
    step = 1e-6
    for k in range(2):
        slope = jax.jacfwd(start, k)(1.0, 0.6)
        shift = [step * (k == 0), step * (k == 1)]
        high, low = start(1.0 + shift[0], 0.6 + shift[1]), start(1.0 - shift[0], 0.6 - shift[1])
        assert np.allclose(slope, (np.asarray(high) - np.asarray(low)) / (2 * step), atol=1e-7)


def test_inside_jax_redundant_starts() -> None:
    x, y = np.sin(0.7), -np.cos(0.7)
    system = ac.compile(Pendulum(x=ac.start(x, fixed=True), y=ac.start(y, fixed=True)))
    x0, _, _, left = jax.jit(lambda: system.initialize_with_residual(jnp.asarray(0.0), None, None))()
    assert np.max(left) < 1e-12
    assert np.isfinite(x0).all()


class Mass(Component):
    """A mass between springs."""

    m: Parameter = Parameter(1.0)
    s: Variable = Variable(start=0.1)
    v: Variable = Variable(start=0.0)
    f: Variable = Variable()

    def equations(self) -> Equations:
        yield der(self.s) == self.v
        yield self.m * der(self.v) == self.f


class Chain(Component):
    """Masses and springs in a row; one wants to be at rest, one to have a given force."""

    n: int = 10
    mass: Array[Mass] = Array(Mass(), "n")

    def equations(self) -> Equations:
        m = self.mass
        yield m[0].f == m[1].s - 2 * m[0].s
        yield m[1:-1].f == m[2:].s - 2 * m[1:-1].s + m[:-2].s
        yield m[-1].f == m[-2].s - m[-1].s

    def initial_equations(self) -> Equations:
        yield der(self.mass[3].v) == 0.25
        yield self.mass[5].v + self.mass[6].v == 1.0


@pytest.mark.parametrize("n", [10, 10_000])
def test_a_long_chain_with_a_few_initial_equations(n: int) -> None:
    system = ac.compile(Chain(n=n))
    begin = time.perf_counter()
    x0, w0, p, left = system.initialize_with_residual(0.0, None, None)
    assert time.perf_counter() - begin < 20
    system.check_initial(x0, w0, p, left)
    at = dict(zip(system.states, np.asarray(x0), strict=True))
    assert at["mass[2].s"] - 2 * at["mass[3].s"] + at["mass[4].s"] == pytest.approx(0.25, abs=1e-9)
    assert at["mass[5].v"] == pytest.approx(0.5, abs=1e-9)
    assert at["mass[9].s"] == 0.1 and at["mass[9].v"] == 0.0


class Pair(Component):
    """Two masses joined rigidly, both with fixed starts."""

    a: Mass = Mass(s=ac.start(0.0, fixed=True), v=ac.start(1.0, fixed=True))
    b: Mass = Mass(s=ac.start(0.5, fixed=True), v=ac.start(1.0, fixed=True))

    def equations(self) -> Equations:
        yield self.b.s == self.a.s + 0.5
        yield self.a.f + self.b.f == -self.a.s


class Pairs(Component):
    """Many of them."""

    n: int = 2
    pair: Array[Pair] = Array(Pair(), "n")


@pytest.mark.parametrize("n", [2, 3000])
def test_many_redundant_fixed_starts(n: int) -> None:
    system = ac.compile(Pairs(n=n))
    assert system.report().states == 2 * n
    begin = time.perf_counter()
    x0, w0, p, left = system.initialize_with_residual(0.0, None, None)
    system.check_initial(x0, w0, p, left)
    assert time.perf_counter() - begin < 20
    with pytest.raises(InitializationError, match="fixed start"):
        system.check_initial(*system.initialize_with_residual(0.0, None, {"pair[1].a.s": 0.2}))


def test_the_report_names_what_guesses_choose() -> None:
    report = ac.compile(Pendulum(x=start(0.6, fixed=True), u=start(2.0))).report()
    assert report.left_open == 1 and report.open_names == ("u", "v")  # y follows from x
    assert "start               1 value by guesses, of: u, v\n" in str(report)
    report = ac.compile(Pendulum(x=start(0.6, fixed=True), u=start(2.0, fixed=True))).report()
    assert report.left_open == 0 and report.open_names == ()
    assert "start               determined\n" in str(report)


def test_what_initial_equations_determine_is_not_left_open() -> None:
    class Rest(Pendulum):
        def initial_equations(self) -> Equations:
            yield self.u == 3.0 * self.x
            yield self.x == 0.6

    assert ac.compile(Rest()).report().left_open == 0


class Pendulums(Component):
    """Many pendulums whose guesses are off."""

    n: int = 2
    pendulum: Array[Pendulum] = Array(Pendulum(x=ac.start(3.0), y=ac.start(-4.0), u=ac.start(1.0)), "n")


@pytest.mark.parametrize("n", [2, 1000])
def test_many_invariants(n: int) -> None:
    system = ac.compile(Pendulums(n=n))
    x0, w0, p, left = system.initialize_with_residual(0.0, None, None)
    system.check_initial(x0, w0, p, left)
    at = dict(zip(system.states, np.asarray(x0), strict=True))
    assert at["pendulum[1].x"] == pytest.approx(0.6, abs=1e-3)
    assert at["pendulum[1].y"] == pytest.approx(-0.8, abs=1e-3)
    assert at["pendulum[1].v"] == pytest.approx(0.75, abs=1e-3)


class Steep(Component):
    """Newton's method from the guess runs into a valley of the residual that holds no root."""

    y: Variable = Variable(start=1.5)
    x: Variable = Variable(start=1.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) == -self.y
        yield self.y**3 - 2 * self.y + 2 + self.x == 1.0


class SteepStart(Steep):
    """The same as a condition of the start."""

    x: Variable = Variable(start=1.0)

    def initial_equations(self) -> Equations:
        yield self.x + 0.1 * self.x**3 == 1.1


@pytest.mark.parametrize("model", [Steep, SteepStart])
def test_other_attempts_are_made_inside_jax_too(model: type[Component]) -> None:
    system = ac.compile(model())
    w0 = system.initialize()[1]
    inside = jax.jit(lambda t: system.initialize(t)[1])(0.0)
    assert abs(float(w0[0])) == pytest.approx(1.7692923542386314, abs=1e-12)
    assert float(inside[0]) == pytest.approx(float(w0[0]), abs=1e-12)


class Fed(Component):
    """A start that depends on the input at that time."""

    u: ac.Input = ac.Input()
    x: Variable = Variable(start=0.0)
    y: Variable = Variable()

    def equations(self) -> Equations:
        yield der(self.x) == self.u - self.x
        yield self.y + self.y**3 == self.u

    def initial_equations(self) -> Equations:
        yield der(self.x) == 0


@pytest.mark.parametrize("u", [2.0, (np.array([0.0, 4.0]), np.array([1.0, 3.0]))], ids=["number", "table"])
@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_the_start_sees_the_inputs(u: Any, engine: Any) -> None:
    system = ac.compile(Fed())
    solution = system.simulate(2.5, t0=2.0, inputs={"u": u}, engine=engine, saveat=3)
    assert solution["x"][0] == pytest.approx(2.0, abs=1e-12)
    assert solution["y"][0] == pytest.approx(1.0, abs=1e-12)


def test_the_start_sees_an_input_that_is_a_function() -> None:
    system = ac.compile(Fed())
    solution = system.simulate(2.5, t0=2.0, inputs={"u": lambda t: 1 + 0.5 * t}, saveat=3)
    assert solution["x"][0] == pytest.approx(2.0, abs=1e-12)

    def first(a: Any) -> Any:
        return system.simulate(2.5, t0=2.0, inputs={"u": lambda t: a * t}, saveat=3, engine="diffrax")["x"][0]

    assert jax.jit(first)(1.5) == pytest.approx(3.0, abs=1e-12)


class Middle(Component):
    """The middle `m` of a rod from 0 to x is the state; nothing determines `f` and `g` where x is zero."""

    x: Variable = Variable(start=-1.0)
    m: Variable = Variable()
    f: Variable = Variable()
    g: Variable = Variable()

    def equations(self) -> Equations:
        yield self.x == 2 * self.m
        yield der(self.m) == -self.m * self.f
        yield self.x * self.f + self.g == 3
        yield self.x * self.f - self.g == 1


class Long(Middle):
    """Its length is 2."""

    def initial_equations(self) -> Equations:
        yield self.x * self.x == 4


class Right(Middle):
    """It ends at 2."""

    def initial_equations(self) -> Equations:
        yield self.x == 2


@pytest.mark.parametrize("sign", [-1.0, 1.0])
@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_guesses_are_carried_over_to_states(sign: float, engine: Any) -> None:
    solution = ac.compile(Long(x=ac.start(sign))).simulate(1.0, engine=engine, saveat=3)
    assert solution["m"][0] == pytest.approx(sign, abs=1e-12)
    assert solution["f"][0] == pytest.approx(sign, abs=1e-12)


@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_a_guess_where_a_linear_system_is_singular_is_left(engine: Any) -> None:
    solution = ac.compile(Right(x=ac.start(0.0))).simulate(1.0, engine=engine, saveat=3)
    assert solution["m"][0] == pytest.approx(1.0, abs=1e-12)
    assert solution["f"][0] == pytest.approx(1.0, abs=1e-12)


@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_a_start_where_a_linear_system_is_singular_is_an_error(engine: Any) -> None:
    system = ac.compile(Middle(x=ac.start(0.0, fixed=True)))
    with pytest.raises(ac.SimulationError, match=r"do not determine their unknowns:\n\s+x\*f \+ g = 3"):
        system.simulate(1.0, engine=engine)


class Node(Connector):
    v: Potential = Potential()
    i: Flow = Flow()


class Store(Component):
    node: Node = Node()
    x: Variable = Variable(start=1.0)

    def equations(self) -> Equations:
        yield self.x == self.node.v
        yield der(self.x) == self.node.i


class Leak(Component):
    node: Node = Node()
    y: Variable = Variable()

    def equations(self) -> Equations:
        yield self.y == self.node.v
        yield self.node.i == self.y


class Leaking(Component):
    z: Variable = Variable(start=4.0)
    store: Store = Store()
    leak: Leak = Leak()

    def equations(self) -> Equations:
        yield connect(self.store.node, self.leak.node)
        yield self.z == 2 * self.leak.y


def test_guesses_by_modification_count_before_those_of_classes() -> None:
    assert started(Leaking(leak=Leak(y=start(5.0)))) == {"store.x": 5.0}
    assert started(Leaking(leak=Leak(y=start(5.0)), store=Store(x=start(3.0)))) == {"store.x": 3.0}


def test_guesses_of_the_model_count_before_those_of_the_classes_of_its_parts() -> None:
    assert started(Leaking()) == {"store.x": 2.0}
