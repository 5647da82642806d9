"""Events of high-index models: what follows is consistent with all constraints."""

from __future__ import annotations

import warnings
from functools import cache
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

import acausal as ac
from acausal import Component, Equations, Variable, Vector, der, dot, pre, reinit, vector, when
from acausal.components import rotational
from acausal.components.examples import assemble, start

from .constrained import Wall

ENGINES = ("native", pytest.param("diffrax", marks=pytest.mark.slow))


@cache
def minimal(t1: float) -> tuple[np.ndarray, np.ndarray, list[float]]:
    """The pendulum at the wall with an angle, in which the rod needs no constraint: times, (angle, rate), hits."""
    L, g, e, wall = 1.0, 9.81, 0.8, 0.2
    t, y = 0.0, np.array([np.arcsin(0.8), 0.0])
    grid = np.linspace(0.0, t1, 201)
    rows, hits = [], []

    def touches(t: float, y: np.ndarray) -> float:
        return L * np.sin(y[0]) + wall * L

    touches.terminal, touches.direction = True, -1  # type: ignore[attr-defined]
    while True:
        part = solve_ivp(lambda t, y: [y[1], -g / L * np.sin(y[0])], (t, t1), y, "DOP853", events=touches, rtol=1e-13,
                         atol=1e-14, dense_output=True)  # fmt: skip
        inside = (grid >= t) & (grid <= part.t[-1])
        rows.append(part.sol(grid[inside]).T)
        if part.status == 0:
            return grid, np.concatenate(rows), hits
        t, y = part.t[-1], part.y[:, -1] * [1, -e]
        hits.append(t)


@pytest.mark.parametrize("engine", ENGINES)
def test_pendulum_at_a_wall(engine: Any) -> None:
    t, wanted, hits = minimal(3.0)
    assert len(hits) == 2
    system = ac.compile(Wall())
    assert system.report().structural_index == 3
    solution = system.simulate(3.0, saveat=t, engine=engine, rtol=1e-10)
    angle, rate = wanted.T
    assert_allclose(solution["x"], np.sin(angle), atol=2e-7)
    assert_allclose(solution["vx"], np.cos(angle) * rate, atol=2e-6)
    assert_allclose(solution["x"] ** 2 + solution["y"] ** 2, 1.0, atol=1e-9)
    assert_allclose(solution["x"] * solution["vx"] + solution["y"] * solution["vy"], 0.0, atol=1e-9)
    found = np.array([e.t for e in solution.events])
    assert np.abs(found[None] - np.array(hits)[:, None]).min(axis=1).max() < 1e-8
    assert solution["hits"][-1] == len(hits)


@pytest.mark.parametrize("engine", ENGINES)
def test_a_new_speed_passes_through_a_gear(engine: Any) -> None:
    """Two inertias on a gear are one: `reinit` of one speed sets the other."""

    class Kick(ac.Component):
        train: ac.Component = assemble(
            "motor.flange_b - gear.flange_a", "gear.flange_b - load.flange_a",
            motor=rotational.Inertia(J=0.1, phi=start(0.0, fixed=True), w=start(3.0, fixed=True)),
            gear=rotational.IdealGear(ratio=3.0), load=rotational.Inertia(J=2.0),
        )  # fmt: skip

        def equations(self) -> ac.Equations:
            yield ac.when(ac.time > 0.5, ac.reinit(self.train.load.w, -2.0))  # pyright: ignore[reportAttributeAccessIssue]

    solution = ac.compile(Kick()).simulate(1.0, saveat=[0.4, 0.6, 1.0], engine=engine, rtol=1e-9)
    assert_allclose(solution["train.load.w"], [1.0, -2.0, -2.0], rtol=1e-9)
    assert_allclose(solution["train.motor.w"], [3.0, -6.0, -6.0], rtol=1e-9)
    assert_allclose(solution["train.motor.phi"], [1.2, 1.5 - 0.6, 1.5 - 3.0], rtol=1e-8)


class Spherical(Component):
    """A pendulum in space, index 3, that is struck: its constraint leaves two speeds free."""

    both: bool = False
    r: Vector = Vector(Variable(unit="m"), (0.6, 0.64, -0.48))
    v: Vector = Vector(Variable(unit="m/s"), (0.3, 0.0, None))
    tension: Variable = Variable(unit="1/s2")

    def equations(self) -> Equations:
        yield der(self.r) == self.v
        yield der(self.v) == self.r * -self.tension + vector(0.0, 0.0, -9.81)
        yield dot(self.r, self.r) == 1.0
        second = [reinit(self.v[1], pre(self.v[1]))] if self.both else []
        yield when(ac.time > 0.1, reinit(self.v[0], -pre(self.v[0])), *second)


def test_what_shares_a_jump_is_told() -> None:
    text = r"(?s)At t = 0\.1 s `reinit` of `v\[1\]` does not say how `v\[2\]`, `v\[3\]` jump.*reinit\(v\[2\], pre"
    with pytest.warns(UserWarning, match=text):
        ac.compile(Spherical()).simulate(0.2)


def test_what_has_to_follow_is_not_told() -> None:
    t = [0.1 - 1e-9, 0.1]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ac.compile(Wall()).simulate(1.0)
        solution = ac.compile(Spherical(both=True)).simulate(0.2, rtol=1e-9, saveat=t)
    assert_allclose(solution["v[1]"][1], -solution["v[1]"][0], atol=1e-6)
    assert_allclose(solution["v[2]"][1], solution["v[2]"][0], atol=1e-6)
