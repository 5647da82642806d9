"""Events that only switch modes: the compiled run carries them out itself, and gives what the iteration gives."""

from __future__ import annotations

from typing import Any

import pytest
from numpy.testing import assert_allclose, assert_array_equal

import acausal as ac
from acausal import Component, Equations, Variable, der, sin, where
from acausal.simulation import native_library
from models.kbc import reference_crane


class Chopped(Component):
    """A wave that drives a lag only while it is above 0.3; the lag has two gains."""

    x: Variable = Variable(start=0.0, fixed=True)
    w: Variable = Variable()

    def equations(self) -> Equations:
        yield self.w == where(sin(40 * ac.time) > 0.3, sin(40 * ac.time), 0.0) + 0.1 * self.x
        yield der(self.x) == where(self.x < 0.3, 5.0, 2.0) * (self.w - self.x)


class Jumping(Component):
    """A condition that moves another one by a jump of an algebraic unknown: one event, several turns."""

    x: Variable = Variable(start=0.0, fixed=True)
    jump: Variable = Variable()
    after: Variable = Variable()

    def equations(self) -> Equations:
        yield der(self.x) == 1.0
        yield self.jump == where(self.x > 1.0, 2.0, 0.0)
        yield self.after == where(self.jump + 0.1 * self.x > 1.5, 1.0, -1.0)


@pytest.fixture
def calls(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """Runs of compiled code so far."""
    made: list[Any] = []
    original = native_library.NativeLibrary.run

    def run(*args: Any, **options: Any) -> Any:
        made.append(original(*args, **options))
        return made[-1]

    monkeypatch.setattr(native_library.NativeLibrary, "run", run)
    return made


def both(model: Component, t1: float, calls: list[Any], monkeypatch: pytest.MonkeyPatch, **how: Any) -> list[Any]:
    """The solution, the number of compiled runs, and the same with every event left to the iteration."""
    system = ac.compile(model)
    own = system.simulate(t1, engine="native", **how)
    n = len(calls)
    monkeypatch.setattr(native_library, "PASSED", 0)
    left = system.simulate(t1, engine="native", **how)
    assert len(calls) - n >= len(left.events) > 0
    return [own, n, left]


def same(own: ac.Solution, left: ac.Solution, names: tuple[str, ...], atol: float = 0.0) -> None:
    assert [e.causes for e in own.events] == [e.causes for e in left.events]
    assert_allclose([e.t for e in own.events], [e.t for e in left.events], rtol=1e-13, atol=1e-15)
    for name in names:
        assert_allclose(own[name], left[name], rtol=1e-9, atol=atol)


def test_more_events_than_a_run_has_room_for(calls: list[Any], monkeypatch: pytest.MonkeyPatch) -> None:
    room = native_library.PASSED
    own, n, left = both(Chopped(), 20.0, calls, monkeypatch, saveat=401, rtol=1e-8)
    assert len(own.events) > 3 * room
    assert [len(run.passed) for run in calls[: n - 1]] == [room] * (n - 1)  # and each of these ends at one more
    assert sum(len(run.passed) for run in calls[:n]) + n - 1 == len(own.events)
    same(own, left, ("x", "w"), 1e-14)


@pytest.mark.parametrize("solver", ["rk4", "adams"])
def test_explicit_methods(solver: str, calls: list[Any], monkeypatch: pytest.MonkeyPatch) -> None:
    how = {"dt": 1e-3} if solver == "rk4" else {}
    own, n, left = both(Chopped(), 1.0, calls, monkeypatch, saveat=41, solver=solver, **how)
    assert n == 1
    same(own, left, ("x", "w"), 1e-14)


def test_output_at_the_time_of_an_event_shows_what_follows(calls: list[Any]) -> None:
    solution = ac.compile(Jumping()).simulate(2.0, saveat=[0.0, 0.5, 1.0, 2.0], engine="native", rtol=1e-9)
    switched = solution.events[0].t
    solution = ac.compile(Jumping()).simulate(2.0, saveat=[0.0, 0.5, switched, 2.0], engine="native", rtol=1e-9)
    assert_array_equal(solution["jump"], [0.0, 0.0, 2.0, 2.0])


def test_what_takes_several_turns_is_left_to_the_iteration(calls: list[Any]) -> None:
    solution = ac.compile(Jumping()).simulate(2.0, saveat=5, engine="native")
    assert_array_equal(solution["after"], [-1.0, -1.0, 1.0, 1.0, 1.0])
    assert len(solution.events) == 1
    assert [c.split(" (")[0] for c in solution.events[0].causes] == ["`x > 1`"]
    assert len(calls) == 2 and not calls[0].passed


def test_most_steps_count_over_all_stretches(calls: list[Any]) -> None:
    with pytest.raises(ac.SimulationError, match="most steps allowed, 50, were taken"):
        ac.compile(Chopped()).simulate(20.0, engine="native", max_steps=50)
    assert len(calls) == 1 and calls[0].passed


@pytest.mark.slow_case("rigid")
@pytest.mark.parametrize("joint", ["compliant", "rigid"])
def test_the_crane(joint: Any, calls: list[Any], monkeypatch: pytest.MonkeyPatch) -> None:
    model = reference_crane(hydraulics="extended", joint=joint)
    own, n, left = both(model, 20.0, calls, monkeypatch, saveat=201)
    assert n == 1 and len(own.events) >= 2
    same(own, left, ("cylinder.piston.s", "cylinder.chamber_a.p", "boom.phi"))
