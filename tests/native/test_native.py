"""The native engine beside the diffrax engine, closed forms and finite differences."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal import AcausalError, SimulationError
from acausal.simulation import engines, native
from acausal.simulation.native import native_model
from acausal.simulation.native_build import flags

from .models import Balanced, Branches, Carried, Damped, Decay, Driven, Free, LinearBlock, Pendulum, Torn

TIGHT = 1e-11
MODELS = [Decay, Balanced, Torn, LinearBlock, Pendulum, Damped, Branches]
LOOPED = [Decay, Balanced, Torn, LinearBlock, Branches, Pendulum, Damped, Driven, Carried]
FED = (Driven, Carried)


@pytest.fixture(scope="module")
def systems() -> dict[type, ac.System]:
    return {model: ac.compile(model()) for model in [*MODELS, *FED, Free]}


@pytest.fixture(scope="module")
def looped() -> dict[type, ac.System]:
    """The same models with families as loops, as large models are."""
    made = {model: ac.compile(model()) for model in LOOPED}
    before, native.LARGEST = native.LARGEST, 0
    for system in made.values():
        assert native_model(system).large
    native.LARGEST = before
    return made


@pytest.mark.slow_case(Torn, LinearBlock, Damped)
@pytest.mark.parametrize("model", MODELS)
def test_both_engines_agree(systems: dict[type, ac.System], model: Any) -> None:
    system = systems[model]
    native, other = (system.simulate(2.0, rtol=1e-9, saveat=41, engine=engine) for engine in ("native", "diffrax"))
    assert native.stats["engine"] == "native"
    for name in native.names:
        np.testing.assert_allclose(native[name], other[name], rtol=3e-7, atol=3e-7, err_msg=name)


@pytest.mark.parametrize("model", LOOPED)
def test_loops_give_the_same(systems: dict[type, ac.System], looped: dict[type, ac.System], model: Any) -> None:
    inputs = {"u": (np.array([0.0, 0.4, 2.0]), np.array([0.0, 1.0, -0.5]))} if model in FED else None
    until = 0.08 if model is Branches else 1.0  # rounding decides about the steps across a jump
    a, b = (s[model].simulate(until, inputs=inputs, rtol=1e-9, saveat=21, engine="native") for s in (systems, looped))
    for name in a.names:
        np.testing.assert_allclose(a[name], b[name], rtol=1e-8, atol=1e-10, err_msg=name)


@pytest.mark.parametrize("model", [m for m in LOOPED if m not in FED])
def test_gradients_of_loops(systems: dict[type, ac.System], looped: dict[type, ac.System], model: Any) -> None:
    names = list(systems[model].parameters)

    def states(system: ac.System, v: Any) -> Any:
        given = dict(zip(names, v, strict=True))
        until = 0.08 if model is Branches else 0.5
        return system.simulate(until, parameters=given, rtol=1e-8, saveat=5, engine="native").x

    v = jnp.array([systems[model].parameters[n] for n in names])
    a, b = (jax.jacfwd(lambda v, s=s: states(s[model], v))(v) for s in (systems, looped))
    np.testing.assert_allclose(a, b, rtol=1e-9, atol=1e-11)


def test_closed_form(systems: dict[type, ac.System]) -> None:
    solution = systems[Decay].simulate(3.0, engine="native", rtol=1e-10, parameters={"k": 1.3})
    np.testing.assert_allclose(solution["x"], 2.0 * np.exp(-1.3 * solution.t), rtol=1e-8)
    np.testing.assert_allclose(solution["y"], solution["x"] ** 2 + 1.3, rtol=1e-14)


def test_backwards_and_at_given_times(systems: dict[type, ac.System]) -> None:
    times = np.array([3.0, 1.7, 1.0])
    solution = systems[Decay].simulate(1.0, t0=3.0, engine="native", rtol=1e-10, saveat=times)
    np.testing.assert_allclose(solution["x"], 2.0 * np.exp(-0.7 * (times - 3.0)), rtol=1e-8)


def test_pendulum_stays_on_its_circle(systems: dict[type, ac.System]) -> None:
    solution = systems[Pendulum].simulate(20.0, engine="native", rtol=1e-8)
    radius = np.hypot(solution["x"], solution["y"])
    np.testing.assert_allclose(radius, 1.2, rtol=1e-10)
    energy = 0.5 * (solution["vx"] ** 2 + solution["vy"] ** 2) + 9.81 * solution["y"]
    np.testing.assert_allclose(energy, 0.0, atol=2e-5)


@pytest.mark.parametrize("u", [0.7, (np.array([0.0, 0.4, 2.0]), np.array([0.0, 1.0, -0.5]))], ids=["number", "table"])
def test_inputs(systems: dict[type, ac.System], u: Any) -> None:
    a, b = (
        systems[Driven].simulate(2.0, inputs={"u": u}, rtol=1e-9, saveat=21, engine=engine)
        for engine in ("native", "diffrax")
    )
    for name in ("x", "y", "u"):
        np.testing.assert_allclose(a[name], b[name], rtol=1e-6, atol=1e-7, err_msg=name)


def difference(f: Any, v: Any, i: int) -> float:
    """Central difference, Richardson-extrapolated."""
    h = 2e-3 * max(abs(float(v[i])), 0.1)
    e = np.zeros(len(v))
    e[i] = 1.0
    coarse = (f(v + 2 * h * e) - f(v - 2 * h * e)) / (4 * h)
    fine = (f(v + h * e) - f(v - h * e)) / (2 * h)
    return float((4 * fine - coarse) / 3)


CASES = [
    (Decay, ["k", "x0"], [], "y"),
    (Decay, ["k"], ["x"], "x"),
    (Balanced, ["a", "b"], [], "x"),
    (Torn, ["a"], ["x"], "y"),
    (LinearBlock, ["g"], ["x"], "e"),
    (Pendulum, ["g"], [], "y"),
    (Pendulum, ["L", "g"], [], "x"),
    (Branches, ["k"], ["x", "y"], "z"),
    (Free, ["a"], ["y"], "x"),
    (Free, ["a"], ["z"], "y"),
    (Balanced, ["a"], [], "der(x)"),
    (Pendulum, ["L"], ["y"], "tension"),
]


@pytest.mark.slow_case(LinearBlock, Branches)
@pytest.mark.parametrize(("model", "parameters", "initial", "seen"), CASES)
def test_gradients(
    systems: dict[type, ac.System], model: Any, parameters: list[str], initial: list[str], seen: str
) -> None:
    system = systems[model]
    start = system.simulate(0.01, engine="native", saveat=2)
    v = jnp.array([system.parameters[n] for n in parameters] + [float(start[n][0]) for n in initial])
    # away from the kinks of the model's branches
    until = 0.08 if model is Branches else 1.5

    def loss(v: Any, rtol: float = TIGHT) -> Any:
        given = dict(zip(parameters, v, strict=False))
        at = dict(zip(initial, v[len(parameters) :], strict=True))
        solution = system.simulate(until, parameters=given, initial=at, rtol=rtol, saveat=6, engine="native")
        return jnp.sum(solution[seen] * jnp.arange(1.0, 7.0))

    reverse = jax.grad(loss)(v)
    forward = jax.jacfwd(loss)(v)
    np.testing.assert_allclose(reverse, forward, rtol=1e-12)
    for i in range(len(v)):
        expected = difference(loss, np.asarray(v), i)
        np.testing.assert_allclose(reverse[i], expected, rtol=1e-6, atol=1e-7 * float(jnp.abs(reverse).max()))


def test_jit_vmap_and_batches_of_gradients(systems: dict[type, ac.System]) -> None:
    def last(k: Any) -> Any:
        return systems[Decay].simulate(1.0, parameters={"k": k}, rtol=1e-10, saveat=3, engine="native")["x"][-1]

    ks = jnp.array([0.3, 0.7, 1.1])
    np.testing.assert_allclose(jax.jit(jax.vmap(last))(ks), 2 * np.exp(-np.asarray(ks)), rtol=1e-8)
    np.testing.assert_allclose(jax.vmap(jax.grad(last))(ks), -2 * np.exp(-np.asarray(ks)), rtol=1e-7)


class Resting(ac.Component):
    """An oscillator at its equilibrium, until the equilibrium moves."""

    y: ac.Variable = ac.Variable(start=1.0, fixed=True)
    v: ac.Variable = ac.Variable(start=0.0, fixed=True)
    u: ac.Parameter = ac.Parameter(1.0)

    def equations(self) -> ac.Equations:
        yield ac.der(self.y) == self.v
        yield ac.der(self.v) == 100.0 * (self.u - self.y)


def test_derivatives_of_a_solution_that_rests() -> None:
    """y = u + (1 - u) cos(10 t): the solution at u = 1 takes any step, its derivative does not."""
    system, t = ac.compile(Resting()), np.linspace(0.0, 1.0, 11)
    for rtol in (1e-4, 1e-6, 1e-9):

        def run(u: Any, rtol: float = rtol) -> Any:
            return system.simulate(1.0, parameters={"u": u}, saveat=t, rtol=rtol, engine="native")["y"]

        np.testing.assert_allclose(jax.jacfwd(run)(1.0), 1.0 - np.cos(10.0 * t), atol=100.0 * rtol)


def test_gradient_of_a_constant_input(systems: dict[type, ac.System]) -> None:
    def last(u: Any) -> Any:
        return systems[Driven].simulate(1.0, inputs={"u": u}, rtol=1e-10, saveat=3, engine="native")["x"][-1]

    np.testing.assert_allclose(jax.grad(last)(0.4), 1 - np.exp(-2.0), rtol=1e-7)


def test_many_parameters_take_several_sweeps() -> None:
    class Sum(ac.Component):
        a: ac.Parameter = ac.Parameter(1.0)
        n: int = 11
        parts: ac.Array[Decay] = ac.Array(Decay(), "n")

        def equations(self) -> ac.Equations:
            yield from ()

    system = ac.compile(Sum())

    def total(k: Any) -> Any:
        solution = system.simulate(1.0, parameters={"parts.k": k}, rtol=1e-10, saveat=2, engine="native")
        return jnp.sum(solution["parts.x"][-1])

    k = jnp.linspace(0.1, 1.1, 11)
    np.testing.assert_allclose(jax.grad(total)(k), -2 * np.exp(-np.asarray(k)), rtol=1e-7)


def test_derivatives_with_respect_to_times_are_refused(systems: dict[type, ac.System]) -> None:
    with pytest.raises(SimulationError, match="engine='diffrax'"):
        jax.grad(lambda t1: systems[Decay].simulate(t1, engine="native", saveat=3)["x"][-1])(1.0)


def test_why_not_native() -> None:
    class Python(ac.Component):
        x: ac.Variable = ac.Variable(start=1.0, fixed=True)

        def equations(self) -> ac.Equations:
            yield ac.der(self.x) == ac.function(lambda v: -jnp.sin(v), name="restore")(self.x)

    system = ac.compile(Python())
    with pytest.raises(SimulationError, match="function `restore` is Python"):
        system.simulate(1.0, engine="native")
    assert system.simulate(1.0).stats.get("engine", "diffrax") == "diffrax"
    with pytest.raises(SimulationError, match="There is no engine 'fortran'"):
        system.simulate(1.0, engine="fortran")  # pyright: ignore[reportArgumentType]


def test_no_compiler_is_said_once(monkeypatch: pytest.MonkeyPatch) -> None:
    from acausal.simulation.native_build import NoCompiler

    def none() -> Any:
        raise NoCompiler("There is no C compiler.")

    monkeypatch.setattr(engines, "compiler", none)
    monkeypatch.setattr(engines, "_said", set())
    system = ac.compile(Decay())
    with pytest.warns(UserWarning, match="no C compiler"):
        assert system.simulate(0.1, saveat=2).stats.get("engine") != "native"
    with pytest.raises(SimulationError, match="there is no C compiler"):
        system.simulate(0.1, engine="native")


def test_a_failure_names_the_time_and_the_variable() -> None:
    class Explodes(ac.Component):
        x: ac.Variable = ac.Variable(start=1.0, fixed=True)

        def equations(self) -> ac.Equations:
            yield ac.der(self.x) == self.x**2

    system = ac.compile(Explodes())
    with pytest.raises(SimulationError, match=r"stopped at t = 1[. ].*\n.*variable there is x = "):
        system.simulate(2.0, engine="native")
    ended = system.simulate(2.0, engine="native", throw=False)
    assert ended.result == "dt_min_reached"
    assert ended.t[-1] < 1.0 + 1e-6


def test_singular_pivots_are_exchanged() -> None:
    class Swapped(ac.Component):
        """The algebraic unknowns come in an order that puts zeros on the diagonal."""

        x: ac.Variable = ac.Variable(start=1.0, fixed=True)
        a: ac.Variable = ac.Variable(start=0.6)
        b: ac.Variable = ac.Variable(start=0.4)

        def equations(self) -> ac.Equations:
            yield ac.der(self.x) == -self.a
            yield self.b + self.b**3 + 0 * self.a == 0.5 * self.x
            yield self.a**3 + self.a * self.b == self.x

    system = ac.compile(Swapped())
    a, b = (system.simulate(1.0, rtol=1e-9, saveat=9, engine=e) for e in ("native", "diffrax"))
    np.testing.assert_allclose(a["a"], b["a"], rtol=1e-6)


def test_source_is_the_same_every_time_and_readable() -> None:
    first, second = (native_model(ac.compile(Branches())).source.text for _ in range(2))
    assert first == second
    assert "/* z */" in first
    assert "if (" in first, "an expensive branch is behind a condition"


@pytest.mark.parametrize("model", [Decay, Torn, Pendulum])
def test_runge_kutta_has_order_four_and_equals_diffrax(systems: dict[type, ac.System], model: Any) -> None:
    system = systems[model]
    exact = system.simulate(1.0, rtol=1e-12, saveat=6, engine="native").x
    errors = [
        np.abs(system.simulate(1.0, solver="rk4", dt=dt, saveat=6, engine="native").x - exact).max()
        for dt in (0.04, 0.02)
    ]
    assert 11 < errors[0] / errors[1] < 30
    a, b = (system.simulate(1.0, solver="rk4", dt=0.04, saveat=6, engine=e) for e in ("native", "diffrax"))
    np.testing.assert_allclose(a.x, b.x, rtol=1e-6, atol=1e-7)


@pytest.mark.parametrize("model", [Decay, Torn, LinearBlock, Pendulum])
def test_adams_follows_its_tolerance(systems: dict[type, ac.System], model: Any) -> None:
    system = systems[model]
    exact = system.simulate(2.0, rtol=1e-12, saveat=41, engine="native")
    steps = []
    for rtol in (1e-4, 1e-7, 1e-10):
        solution = system.simulate(2.0, solver="adams", rtol=rtol, saveat=41, engine="native")
        np.testing.assert_allclose(solution.x, exact.x, atol=30 * rtol)
        np.testing.assert_allclose(solution.w, exact.w, atol=30 * rtol)
        steps.append(solution.stats["steps"])
    assert steps[2] < 5 * steps[0], "the order grows with the accuracy"


def test_methods_are_checked(systems: dict[type, ac.System]) -> None:
    with pytest.raises(SimulationError, match="give the step"):
        systems[Decay].simulate(1.0, solver="rk4", engine="native")
    with pytest.raises(SimulationError, match="no solver 'adams'"):
        systems[Decay].simulate(1.0, solver="adams", engine="diffrax")


class NoNumber(ac.Component):
    """The first derivative is no number, the second one is."""

    b: ac.Parameter = ac.Parameter(-1.0)
    x: ac.Variable = ac.Variable(start=1.0, fixed=True)
    y: ac.Variable = ac.Variable(start=1.0, fixed=True)

    def equations(self) -> ac.Equations:
        yield ac.der(self.x) == ac.sqrt(self.b)
        yield ac.der(self.y) == -self.y


@pytest.mark.parametrize("solver", ["rodas5p", "adams"])
def test_what_is_no_number_is_no_solution(solver: str) -> None:
    with pytest.raises(SimulationError, match=r"der\(x\) is nan there"):
        ac.compile(NoNumber()).simulate(1.0, engine="native", solver=solver)


def test_own_options_for_the_compiler(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("ACAUSAL_CACHE", str(tmp_path))
    monkeypatch.setenv("ACAUSAL_CFLAGS", "-O0 '-DAC_NO SPACE'")
    assert flags()[-2:] == ("-O0", "-DAC_NO SPACE")
    monkeypatch.setenv("ACAUSAL_CFLAGS", "-no-such-option")
    with pytest.raises(AcausalError, match="-no-such-option"):
        ac.compile(Branches()).simulate(t1=0.1)


def test_explicit_methods_are_compiled_when_they_are_asked_for(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("ACAUSAL_CACHE", str(tmp_path))
    system = ac.compile(Branches())
    system.simulate(t1=0.1)
    assert len(list(tmp_path.glob("*"))) == 1
    for method in ("adams", "adams", "rodas5p"):
        system.simulate(t1=0.1, solver=method)
    assert len(list(tmp_path.glob("*"))) == 2
