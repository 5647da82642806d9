"""Starts of large models where values are given for sums of many states."""

from __future__ import annotations

from typing import Any

import jax
import numpy as np
import pytest
from scipy.linalg import expm

import acausal as ac
from acausal import Array, Component, Equations, Parameter, connect, start
from acausal.components.translational import Fixed, Flange, Mass, SpringDamper
from acausal.lowering.conditions import Conditions
from acausal.lowering.held import Held, regrouped
from acausal.lowering.initial import given_starts
from acausal.lowering.numeric import NumericRun
from acausal.lowering.sparsity import Dependence

COUNT = 220
C, D, M, LENGTH = 4e4, 3.0, 2.0, 0.5


class Wagon(Component):
    """A mass behind a coupling, whose relative position is a state; its absolute position is given."""

    number: Parameter = Parameter(1.0)
    gap: Parameter = Parameter(LENGTH, unit="m")
    flange_a: Flange = Flange()
    flange_b: Flange = Flange()
    coupling: SpringDamper = SpringDamper(c=C, d=D, s_rel0=LENGTH)
    mass: Mass = Mass(m=M, s=start(number * gap, fixed=True), v=start(0.0, fixed=True))

    def equations(self) -> Equations:
        yield connect(self.flange_a, self.coupling.flange_a)
        yield connect(self.coupling.flange_b, self.mass.flange_a)
        yield connect(self.mass.flange_b, self.flange_b)


class Train(Component):
    count: int = COUNT
    gap: Parameter = Parameter(LENGTH, unit="m")
    wall: Fixed = Fixed()
    wagons: Array[Wagon] = Array(Wagon(gap=gap), "count", number=[k + 1.0 for k in range(COUNT)])

    def equations(self) -> Equations:
        yield connect(self.wall.flange, self.wagons[0].flange_a)
        yield connect(self.wagons[:-1].flange_b, self.wagons[1:].flange_a)


@pytest.fixture(scope="module")
def system() -> ac.System:
    return ac.compile(Train())


def strain(t: float) -> np.ndarray[Any, np.dtype[np.float64]]:
    """What the positions are, for each metre that the gaps are wider than the couplings: by the matrix exponential."""
    n = COUNT
    links = np.eye(n) - np.eye(n, k=-1)  # relative positions from absolute ones
    laplace = links.T @ links / M
    matrix = np.block([[np.zeros((n, n)), np.eye(n)], [-C * laplace, -D * laplace]])
    return (expm(matrix * t) @ np.concatenate([np.arange(1.0, n + 1), np.zeros(n)]))[:n]


@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_chain_starts_where_its_positions_are_given(system: ac.System, engine: Any) -> None:
    assert f"wagons[{COUNT - 1}].coupling.s_rel" in system.states
    solution = system.simulate(0.05, parameters={"gap": 0.6}, saveat=[0.0, 0.05], rtol=1e-9, engine=engine)
    numbers = np.arange(1, COUNT + 1)
    s = np.stack([solution[f"wagons[{k}].mass.s"] for k in range(COUNT)], axis=1)
    np.testing.assert_allclose(s[0], 0.6 * numbers, rtol=1e-13)
    np.testing.assert_allclose(solution["wagons[100].coupling.s_rel"][0], 0.6, rtol=1e-10)
    np.testing.assert_allclose(s[1], LENGTH * numbers + 0.1 * strain(0.05), atol=1e-6)


def test_derivatives_by_a_parameter_of_the_start(system: ac.System) -> None:
    def last(gap: Any) -> Any:
        run = system.simulate(0.05, parameters={"gap": gap}, saveat=[0.05], rtol=1e-9, engine="native")
        return run[f"wagons[{COUNT - 1}].mass.s"][-1]

    assert abs(float(jax.grad(last)(0.6)) - strain(0.05)[-1]) < 1e-5


def test_given_values_make_conditions_of_neighbours(system: ac.System) -> None:
    """With them the Jacobian has a few entries in each row, without them a staircase; both have the same root."""
    problem, low = system.initial, system.lowered
    p = system.program.default
    given = given_starts(problem, system.program.starts(p, np), {}, p, np)
    conditions = Conditions(problem, 0.0, p, given.ids, given.wanted)
    found = system.initialize_numeric(0.0, None, None)
    assert found is not None
    value, jacobian = conditions(np.concatenate(found[:2]))
    assert np.abs(value).max() < 1e-10
    assert np.diff(jacobian.indptr).max() <= 3
    whole = Dependence(low, low.schedule.groups).of_values(given.ids)
    assert np.diff(whole.indptr).max() >= COUNT - 1
    assert len(regrouped(low.schedule, list(range(len(low.schedule.groups))), given.ids, low.n_ids)) < 50
    run = NumericRun(low, 0.0, found[0], found[1], p, np.zeros(0, np.int64))
    np.testing.assert_allclose(run.value[given.ids], given.wanted, atol=1e-10)


def test_regrouped_schedule_computes_the_same(system: ac.System) -> None:
    """Nothing held, and values held that are those computed: the same values and derivatives."""
    low, p = system.lowered, system.program.default
    random = np.random.default_rng(3)
    x, dx = random.normal(size=low.n_x), random.normal(size=(low.n_x, 2))
    every = list(range(len(low.schedule.groups)))
    plain = NumericRun(low, 0.0, x, np.zeros(0), p, np.arange(low.n_x), dx)
    for held in (np.zeros(0, np.int64), system.initial.targets):
        groups = regrouped(low.schedule, every, held, low.n_ids)
        assert sum(g.size for g in groups) == sum(g.size for g in low.schedule.groups)
        put_in = Held(held, plain.value[held], plain.gradient[held])
        run = NumericRun(low, 0.0, x, np.zeros(0), p, np.arange(low.n_x), dx, groups=groups, held=put_in)
        for one, other in ((run.value, plain.value), (run.gradient, plain.gradient)):
            np.testing.assert_allclose(one, other, rtol=1e-9, atol=1e-9 * np.nanmax(np.abs(other)))
        value, gradient = run.computed(held)
        np.testing.assert_allclose(value, plain.value[held], rtol=1e-9)
        np.testing.assert_allclose(gradient, plain.gradient[held], rtol=1e-9, atol=1e-9)
