"""What happens at events, on both engines: order, left limits, iteration, samples, the start and the end of a run."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

import acausal as ac
from acausal import (
    Component,
    Discrete,
    Equations,
    Parameter,
    Variable,
    assert_,
    change,
    der,
    edge,
    noevent,
    pre,
    reinit,
    sample,
    terminate,
    when,
    where,
)

QUICK = ("test_the_first_of_several", "test_sampled_feedback", "test_where_switches")
"""Tests that run with the diffrax engine, too, where slow tests do not run: compiling for JAX takes seconds each."""


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    if "engine" in metafunc.fixturenames:
        quick = metafunc.function.__name__.startswith(QUICK)
        other = "diffrax" if quick else pytest.param("diffrax", marks=pytest.mark.slow)
        metafunc.parametrize("engine", ["native", other])


def run(model: Component, t1: float, engine: Any, n: int = 11, **options: Any) -> ac.Solution:
    return ac.compile(model).simulate(t1, saveat=np.linspace(0.0, t1, n), engine=engine, rtol=1e-9, **options)


def times(solution: ac.Solution, text: str = "") -> list[float]:
    return [e.t for e in solution.events if any(text in c for c in e.causes)]


class Clock(Component):
    """``x = t``, and what the tests add."""

    x: Variable = Variable(start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) == 1.0


class Order(Clock):
    """Two conditions that switch within one step, the later one written first."""

    order: Discrete = Discrete(start=0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield when(self.x > 0.5003, {self.order: 10 * pre(self.order) + 2}).elsewhen(
            self.x > 0.5001, {self.order: 10 * pre(self.order) + 1}
        )
        yield when(ac.time > 0.9, {self.late: self.order})

    late: Discrete = Discrete(start=0)


def test_the_first_of_several_switches_comes_first(engine: Any) -> None:
    solution = run(Order(), 1.0, engine)
    assert solution["late"][-1] == 12
    assert_allclose(times(solution), [0.5001, 0.5003, 0.9], atol=1e-10)


class Together(Clock):
    """Two at the very same moment: the first branch counts; statements all see the values before."""

    a: Discrete = Discrete(start=1)
    b: Discrete = Discrete(start=2)
    branch: Discrete = Discrete(start=0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield when(self.x > 0.5, {self.a: pre(self.b), self.b: pre(self.a)})
        yield when(2 * self.x > 1.0, {self.branch: 1}).elsewhen(self.x > 0.5, {self.branch: 2})


def test_statements_of_one_moment_see_the_values_before_it(engine: Any) -> None:
    solution = run(Together(), 1.0, engine)
    assert [solution[n][-1] for n in ("a", "b", "branch")] == [2, 1, 1]
    assert_allclose(np.unique(np.round(times(solution), 10)), [0.5])


class Iteration(Clock):
    """An event that causes another at the same moment, which causes a third."""

    a: Discrete = Discrete(start=0)
    b: Discrete = Discrete(start=0)
    c: Discrete = Discrete(start=0)
    v: Variable = Variable(start=1.0, fixed=True)

    def equations(self) -> Equations:
        yield from super().equations()
        yield der(self.v) == 0.0
        yield when(self.x > 0.25, {self.a: 1})
        yield when(self.a > 0.5, {self.b: pre(self.b) + 1}, reinit(self.v, 5.0))
        yield when(self.v > 4.0, {self.c: pre(self.c) + self.b})


def test_events_follow_each_other_to_a_fixed_point(engine: Any) -> None:
    solution = run(Iteration(), 1.0, engine, n=4)
    assert_allclose(solution["v"], [1, 5, 5, 5])
    assert [solution[n][-1] for n in "abc"] == [1, 1, 1]
    assert_allclose(times(solution), 0.25, atol=1e-12)


class Endless(Clock):
    """What changes whenever it has changed, from a moment on."""

    toggle: Discrete = Discrete(start=0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.toggle == where((self.x > 0.5) & (pre(self.toggle) < 0.5), 1.0, 0.0)


def test_an_iteration_without_end_is_named(engine: Any) -> None:
    pattern = r"At t = 0.5\d* s the events do not come to an end(.|\n)*pre\(toggle\)"
    with pytest.raises(ac.SimulationError, match=pattern):
        run(Endless(), 1.0, engine)


class Contradiction(Clock):
    """``y > 0`` makes y negative: no value of the condition agrees with the equation."""

    y: Variable = Variable()

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == where(self.y > 0, -1.0, 1.0) * where(self.x > 0.5, 1.0, -1.0) + 0.5 * where(self.x > 0.5, 0, 3)


def test_a_condition_that_contradicts_itself_is_named(engine: Any) -> None:
    pattern = r"At t = 0.5\d* s no values(.|\n)*`y > 0`(.|\n)*test_semantics.py:\d+"
    with pytest.raises(ac.SimulationError, match=pattern):
        run(Contradiction(), 1.0, engine)


class Edges(Clock):
    """`edge`, `change`, conditions on discrete variables, one count of each."""

    on: Discrete = Discrete(start=0)
    ups: Discrete = Discrete(start=0)
    changes: Discrete = Discrete(start=0)

    def equations(self) -> Equations:
        yield from super().equations()
        s = ac.sin(2 * np.pi * self.x)
        yield self.on == where(s > 0.5, 1, 0)
        yield when(edge(s > 0.5), {self.ups: pre(self.ups) + 1})
        yield when(change(self.on), {self.changes: pre(self.changes) + 1})


def test_edges_and_changes(engine: Any) -> None:
    solution = run(Edges(), 3.0, engine)
    assert solution["ups"][-1] == 3 and solution["changes"][-1] == 6
    wanted = np.sort(np.concatenate([np.arange(3) + 1 / 12, np.arange(3) + 5 / 12]))
    assert_allclose(np.unique(np.round(times(solution), 9)), wanted, atol=2e-9)


class Samples(Clock):
    """Two rates, the second a multiple of the first but for its start; parameters as interval."""

    T: Parameter = Parameter(0.25)
    fast: Discrete = Discrete(start=0)
    slow: Discrete = Discrete(start=0)
    both: Discrete = Discrete(start=0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield when(sample(0.0, self.T), {self.fast: pre(self.fast) + 1})
        yield when(sample(0.5, 2 * self.T), {self.slow: pre(self.slow) + 1})
        yield when(sample(0.0, self.T) & sample(0.5, 2 * self.T), {self.both: pre(self.both) + 1})


def test_samples(engine: Any) -> None:
    solution = run(Samples(), 2.1, engine)
    assert [solution[n][-1] for n in ("fast", "slow", "both")] == [9, 4, 4]
    assert_allclose(times(solution), np.arange(9) / 4)
    quick = run(Samples(), 2.1, engine, parameters={"T": 0.1})
    assert [quick[n][-1] for n in ("fast", "slow", "both")] == [22, 9, 9]


class Trigger(Clock):
    """A signal that is true at samples only, the first of them at the start, and what counts its edges."""

    on: Discrete = Discrete(start=0)
    ups: Discrete = Discrete(start=0)
    downs: Discrete = Discrete(start=0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.on == where(sample(0.0, 0.25), 1, 0)
        yield when(self.on > 0.5, {self.ups: pre(self.ups) + 1})
        yield when(~(self.on > 0.5), {self.downs: pre(self.downs) + 1})


def test_a_sample_is_over_at_the_same_time(engine: Any) -> None:
    solution = run(Trigger(), 1.1, engine, n=12)
    assert not np.any(np.asarray(solution["on"]))
    wanted = np.floor(np.asarray(solution.t) / 0.25 + 1e-9) + 1
    assert_allclose(solution["ups"], wanted)
    assert_allclose(solution["downs"], wanted)


def test_sampled_feedback_is_that_of_the_recursion(engine: Any) -> None:
    """x' = u - x with u held between samples: x(k+1) = a x(k) + (1 - a) u(k)."""

    class Loop(Component):
        x: Variable = Variable(start=1.0, fixed=True)
        u: Discrete = Discrete(start=0.0)
        K: Parameter = Parameter(1.5)

        def equations(self) -> Equations:
            yield der(self.x) == self.u - self.x
            yield when(sample(0.0, 0.2), {self.u: -self.K * self.x})

    solution = run(Loop(), 2.0, engine)
    a, x = np.exp(-0.2), 1.0
    for k in range(10):
        assert_allclose(solution["x"][k], x, rtol=1e-8)
        x = a * x - (1 - a) * 1.5 * x


class AtTheStart(Clock):
    """Conditions that hold from the start do not become true then; `initial()` does."""

    n: Discrete = Discrete(start=0)
    m: Discrete = Discrete(start=7)
    y: Variable = Variable(start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield from super().equations()
        yield der(self.y) == where(self.x >= 0, 1.0, -1.0)
        yield when(self.x > -1.0, {self.n: pre(self.n) + 1})
        yield when([ac.initial(), self.x > 0.5], {self.m: pre(self.m) + 1})


def test_events_at_the_start(engine: Any) -> None:
    solution = run(AtTheStart(), 1.0, engine)
    assert set(solution["n"]) == {0.0}
    assert (solution["m"][0], solution["m"][-1]) == (8, 9)
    assert_allclose(solution["y"], solution.t, atol=1e-12)


class LeftAtTheStart(Clock):
    """What `d` was before the start is another value than it begins with: this is a change, after the start."""

    d: Discrete = Discrete(start=0)
    n: Discrete = Discrete(start=0)
    changes: Discrete = Discrete(start=0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.d == (self.x < 0.5)
        yield when(pre(self.d) > 0.5, {self.n: pre(self.n) + 1})
        yield when(ac.change(self.d), {self.changes: pre(self.changes) + 1})  # true from the beginning


def test_what_becomes_true_with_left_limits_behind_the_start_acts(engine: Any) -> None:
    """Modelica Language Specification 3.6, 8.6: left limits become values, and events are looked for again."""
    solution = run(LeftAtTheStart(), 1.0, engine)
    assert set(solution["n"]) == {1.0}
    assert (solution["changes"][0], solution["changes"][-1]) == (0, 1)


def test_a_switch_at_the_very_start(engine: Any) -> None:
    """A ball that lies on the floor and is thrown up, or falls from it at once."""
    from .benchmarks import BouncingBall

    system = ac.compile(BouncingBall())
    up = system.simulate(0.1, initial={"h": 0.0, "v": 1.0}, engine=engine, saveat=3)
    assert_allclose(up["h"][-1], 0.1 - 9.81 / 2 * 0.01, rtol=1e-9)
    assert up["bounces"][-1] == 0
    down = system.simulate(0.1, initial={"h": 0.0, "v": -1.0}, engine=engine, saveat=3)
    assert_allclose(down["h"][-1], 0.07 - 9.81 / 2 * 0.01, rtol=1e-9)
    assert down["bounces"][-1] == 1


class Ending(Clock):
    """Ends when x is large enough; what is written at the end."""

    end: Parameter = Parameter(0.625)
    last: Discrete = Discrete(start=-1.0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield when(self.x > self.end, terminate("x is large enough"))
        yield when(ac.terminal(), {self.last: self.x})


def test_the_end(engine: Any) -> None:
    solution = run(Ending(), 1.0, engine)
    assert "x is large enough" in str(solution.result)
    assert_allclose(solution.t[-1], 0.625, rtol=1e-12)
    assert_allclose(solution["x"][-1], 0.625, rtol=1e-12)
    assert_allclose(solution["last"][-1], 0.625, rtol=1e-12)  # an end is an end: `terminal()` is true there
    assert solution["last"][0] == -1.0
    whole = run(Ending(), 1.0, engine, parameters={"end": 2.0})
    assert_allclose(whole["last"][-1], 1.0, rtol=1e-9)


class Refused(Ending):
    """What it has come to is looked at when it ends."""

    most: Parameter = Parameter(0.5)

    def equations(self) -> Equations:
        yield from super().equations()
        yield ac.assert_(~ac.terminal() | (self.x < self.most), "too much in the end")


def test_assertions_at_the_end_hold_where_it_was_terminated(engine: Any) -> None:
    """A failed assertion takes precedence over a successful end; Modelica Language Specification 8.3.7."""
    for end in (0.625, 2.0):
        with pytest.raises(ac.SimulationError, match="too much in the end"):
            run(Refused(), 1.0, engine, parameters={"end": end})
        assert_allclose(run(Refused(), 1.0, engine, parameters={"end": end, "most": 3.0})["last"][-1], min(end, 1.0))


class Over(Clock):
    """Ends before it has begun."""

    def equations(self) -> Equations:
        yield from super().equations()
        yield when(ac.initial(), terminate("nothing to do"))


class Begun(Clock):
    """Says what a start has to be."""

    least: Parameter = Parameter(0.5)

    def equations(self) -> Equations:
        yield from super().equations()
        yield ac.assert_(~ac.initial() | (self.least < 1.0), "least is too large")


def test_assertions_on_the_start_alone(engine: Any) -> None:
    run(Begun(), 1.0, engine)
    with pytest.raises(ac.SimulationError, match=r"At t = 0 s the assertion of Begun .* least is too large"):
        run(Begun(), 1.0, engine, parameters={"least": 2.0})


def test_an_end_at_the_start_is_an_event(engine: Any) -> None:
    solution = run(Over(), 1.0, engine)
    assert "nothing to do" in str(solution.result)
    assert solution.t.tolist() == [0.0]
    [event] = solution.events
    assert event.t == 0.0
    assert "`initial()`" in event.causes[0]
    assert "test_semantics.py" in event.causes[0]


class Asserted(Clock):
    limit: Parameter = Parameter(0.5)

    def equations(self) -> Equations:
        yield from super().equations()
        yield assert_(self.x < self.limit, "too far")


class Warned(Clock):
    def equations(self) -> Equations:
        yield from super().equations()
        yield assert_(self.x < 0.5, "rather far", level="warning")


def test_assertions(engine: Any) -> None:
    with pytest.raises(ac.SimulationError, match=r"At t = 0.5\d* s(.|\n)*Asserted \(.*test_semantics.py:\d+.*too far"):
        run(Asserted(), 1.0, engine)
    assert run(Asserted(), 1.0, engine, parameters={"limit": 2.0})["x"][-1] == pytest.approx(1.0)
    with pytest.warns(UserWarning, match="rather far") as told:
        run(Warned(), 1.0, engine)
    assert [w.filename for w in told] == [__file__]


class Switched(Component):
    """``y' = -1`` above 1 and ``-3`` below: exact, if the switch is."""

    y: Variable = Variable(start=2.0, fixed=True)
    z: Variable = Variable(start=2.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.y) == where(self.y > 1.0, -1.0, -3.0)
        yield der(self.z) == noevent(where(self.z > 1.0, -1.0, -3.0))


def test_where_switches_exactly_and_noevent_is_left_to_the_solver(engine: Any) -> None:
    solution = run(Switched(), 2.0, engine, n=21)
    assert_allclose(solution["y"], np.where(solution.t < 1, 2 - solution.t, 1 - 3 * (solution.t - 1)), atol=1e-11)
    assert_allclose(solution["z"], solution["y"], atol=1e-6)
    assert len(solution.events) == 1 and "y > 1" in solution.events[0].causes[0]
    assert ":" in solution.events[0].causes[0].split("test_semantics.py")[1]


class Rounded(Clock):
    """Functions that jump."""

    low: Variable = Variable(start=0.0, fixed=True)
    saw: Variable = Variable(start=0.0, fixed=True)
    high: Variable = Variable(start=0.0, fixed=True)
    side: Variable = Variable(start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield from super().equations()
        yield der(self.low) == ac.floor(self.x)
        yield der(self.high) == ac.ceil(self.x)
        yield der(self.saw) == ac.mod(self.x, 0.5)
        yield der(self.side) == ac.sign(self.x - 1.3)


def test_functions_that_jump(engine: Any) -> None:
    solution = run(Rounded(), 2.75, engine, n=12)
    t = solution.t
    whole = np.floor(t)
    assert_allclose(solution["low"], whole * (whole - 1) / 2 + whole * (t - whole), atol=1e-9)
    assert_allclose(solution["high"], whole * (whole + 1) / 2 + (whole + 1) * (t - whole), atol=1e-9)
    halves = np.floor(2 * t)
    assert_allclose(solution["saw"], halves / 8 + (t - halves / 2) ** 2 / 2, atol=1e-9)
    assert_allclose(solution["side"], np.where(t < 1.3, -t, t - 2.6), atol=1e-9)


def test_many_instances_have_their_own_events(engine: Any) -> None:
    class Cell(Component):
        x: Variable = Variable(start=0.0, fixed=True)
        rate: Parameter = Parameter(1.0)
        n: Discrete = Discrete(start=0)

        def equations(self) -> Equations:
            yield der(self.x) == self.rate
            yield when(self.x > 1.0, reinit(self.x, 0.0), {self.n: pre(self.n) + 1})

    class Cells(Component):
        cells: ac.Array[Cell] = ac.Array(Cell(), 5)

    rates = {f"cells[{i}].rate": 1.0 + 0.7 * i for i in range(5)}
    solution = ac.compile(Cells()).simulate(3.2, parameters=rates, engine=engine, saveat=2, rtol=1e-9)
    for i, rate in enumerate(rates.values()):
        assert solution[f"cells[{i}].n"][-1] == int(3.2 * rate)
        assert_allclose(solution[f"cells[{i}].x"][-1], (3.2 * rate) % 1.0, atol=1e-9)


def test_run_backward_is_refused(engine: Any) -> None:
    with pytest.raises(ac.SimulationError, match="forward in time only"):
        ac.compile(Switched()).simulate(-1.0, engine=engine)


class Degenerate(Component):
    """Coupled equations, of which two become the same on the left at t = 1; nothing but a mode changes there."""

    x: Variable = Variable(start=0.0, fixed=True)
    a: Variable = Variable()
    b: Variable = Variable()
    c: Variable = Variable()
    d: Variable = Variable()

    def equations(self) -> Equations:
        yield der(self.x) == -self.x + 1e-3
        yield self.a + self.b + self.c == 1 + self.x
        yield ac.where(ac.time < 1.0, 2.0, 1.0) * self.a + self.b + self.c == 2
        yield self.a + 2 * self.b + self.c - self.d == 0
        yield self.a - self.b + 3 * self.c + self.d == 1


def test_equations_that_a_mode_makes_singular_are_an_error(engine: Any) -> None:
    with pytest.raises(ac.SimulationError, match=r"At t = 1 s the equations are singular .*\s.*determines `a`, `b`"):
        ac.compile(Degenerate()).simulate(2.0, saveat=5, engine=engine)


class Latched(Component):
    """`y` is on from the start, if what it was before is given; the event at t = 0.5 s turns it off."""

    y: Discrete = Discrete(start=0.0)
    x: Variable = Variable(start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) == 1
        yield self.y == where((pre(self.y) > 0.5) & (self.x < 0.5) | (self.x > 2.0), 1.0, 0.0)


def test_a_fixed_start_of_a_discrete_is_what_it_was_before(engine: Any) -> None:
    """Modelica Language Specification 8.6: ``pre(y) = y.start``, which is no condition on `y` itself."""
    for fixed in (True, False):
        for before, then in ((1.0, 1.0), (0.0, 0.0)):
            system = ac.compile(Latched(y=ac.start(before, fixed=fixed)))
            solution = system.simulate(1.0, saveat=[0.0, 0.4, 0.9], engine=engine)
            assert_allclose(solution["y"], [then, then, 0.0])
    never = ac.compile(Latched(x=ac.start(1.0, fixed=True), y=ac.start(1.0, fixed=True))).simulate(0.5, engine=engine)
    assert_allclose(never["y"], 0.0)


class Bistable(Component):
    """``v = clip(10 v + 0.1 x, -1, 1)`` has three solutions at the start, one in each of its modes."""

    x: Variable = Variable(start=0.0, fixed=True)
    v: Variable = Variable(start=0.0)

    def equations(self) -> Equations:
        yield der(self.x) == -self.x
        u = 10 * self.v + 0.1 * self.x
        yield self.v == where(u > 1, 1.0, where(u < -1, -1.0, u))


@pytest.mark.parametrize(("guess", "found"), [(0.0, 0.0), (0.5, 1.0), (-0.5, -1.0)])
def test_start_values_choose_one_of_several_modes(guess: float, found: float, engine: Any) -> None:
    solution = ac.compile(Bistable(v=ac.start(guess))).simulate(1.0, saveat=[0.0, 1.0], engine=engine)
    assert_allclose(solution["v"], [found, found], atol=1e-9)
