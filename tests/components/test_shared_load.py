"""Frictions that hold one rigid train share its load by a law, and both engines know the shares to rounding."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal.components import blocks
from acausal.components import rotational as rot
from acausal.components.examples import assemble, start

T = np.linspace(0.0, 2.0, 201)
PRECISE = 1e-9
TABLE = [[0, 0.9, 0.8, 0.2, 0.3]]


def train(n: int, gear: str) -> ac.Component:
    """n shafts with bearings that stick, in a row of gears, which stick as well if they are lossy."""
    rng = np.random.default_rng(0)
    parts: dict[str, ac.Component] = {
        "J0": rot.Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        "s": blocks.Sine(amplitude=2.0, f=0.5), "tau": rot.Torque(),
    }  # fmt: skip
    lines = ["s.y - tau.tau", "tau.flange - J0.flange_a"]
    for k in range(n):
        friction = [[0, rng.uniform(0.5, 2)], [5, rng.uniform(2, 4)]]
        parts[f"bearing{k}"] = rot.BearingFriction(tau_pos=friction, peak=1.1)
        lines.append(f"J{k}.flange_b - bearing{k}.flange_a")
        if k:
            ratio = rng.uniform(0.5, 3)
            parts[f"J{k}"] = rot.Inertia(J=rng.uniform(0.3, 3))
            lossy = gear == "lossy"
            parts[f"gear{k}"] = rot.LossyGear(ratio=ratio, lossTable=TABLE) if lossy else rot.IdealGear(ratio=ratio)
            lines += [f"J{k - 1}.flange_b - gear{k}.flange_a", f"gear{k}.flange_b - J{k}.flange_a"]
    return assemble(*lines, **parts)


def shares(solution: ac.Solution, n: int, gear: str) -> tuple[Any, Any]:
    """Acceleration of the first shaft, over GIVE, that each stuck element tells; and whether it is stuck."""
    told, stuck, ratio = list[Any](), list[Any](), 1.0

    def of(name: str) -> Any:
        return np.broadcast_to(np.asarray(solution[name]), T.shape)

    for k in range(n):
        if k and gear == "lossy":
            told.append(of(f"gear{k}.sa") * ratio)
            stuck.append(of(f"gear{k}.locked") > 0.5)
        ratio *= solution.system.parameters[f"gear{k}.ratio"] if k else 1.0
        told.append(of(f"bearing{k}.tau") / of(f"bearing{k}.tau0_max") * ratio)
        stuck.append(of(f"bearing{k}.locked") > 0.5)
    return np.array(told), np.array(stuck)


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
@pytest.mark.parametrize(("n", "gear"), [(3, "lossy"), pytest.param(5, "lossy", marks=pytest.mark.slow), (5, "ideal")])
def test_each_stuck_element_carries_its_share(n: int, gear: str, engine: Any) -> None:
    solution = ac.compile(train(n, gear)).simulate(T[-1], saveat=T, rtol=1e-8, engine=engine, max_steps=400)
    told, stuck = shares(solution, n, gear)
    assert (stuck.sum(axis=0) > 2).mean() > 0.3
    size = np.where(stuck, np.abs(told), 0.0).max(axis=0)
    apart = np.where(stuck, told, -np.inf).max(axis=0) - np.where(stuck, told, np.inf).min(axis=0)
    held = (stuck.sum(axis=0) > 1) & (T > 0)
    assert (apart[held] <= PRECISE * size[held]).all(), (apart[held] / size[held]).max()
    balance = solution["s.y"] - sum(solution[f"bearing{k}.tau"] / _ratio(solution, k) for k in range(n))
    if gear == "ideal":
        all_held = stuck.all(axis=0)
        assert np.abs(balance[all_held]).max() < 1e-9


def _ratio(solution: ac.Solution, k: int) -> float:
    return float(np.prod([solution.system.parameters[f"gear{i}.ratio"] for i in range(1, k + 1)]))


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_clutches_side_by_side_between_shafts_that_accelerate(engine: Any) -> None:
    """One holds the other shaft the other way round; each holds the same part of what it can."""
    rng = np.random.default_rng(1)
    clutches = {f"c{k}": rot.Clutch(fn_max=rng.uniform(5, 10), mu_pos=[[0, 0.4], [3, 0.3]]) for k in range(4)}
    ends = [("one", "two"), ("one", "two"), ("two", "one"), ("one", "two")]
    lines = ["s.y - tau.tau", "tau.flange - one.flange_a"]
    for name, (a, b) in zip(clutches, ends, strict=True):
        lines += [f"press.y - {name}.f_normalized"]
        lines += [f"{a}.flange_b - {name}.flange_a", f"{name}.flange_b - {b}.flange_a"]
    model = assemble(
        *lines, **clutches, s=blocks.Sine(amplitude=3.0, f=0.5), tau=rot.Torque(), press=blocks.Constant(k=1.0),
        one=rot.Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        two=rot.Inertia(J=2.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
    )  # fmt: skip
    run = ac.compile(model).simulate(T[-1], saveat=T, rtol=1e-8, engine=engine, max_steps=400)
    share = np.array([run[f"{n}.tau"] / run[f"{n}.tau0_max"] for n in clutches]) * np.array([[1], [1], [-1], [1]])
    assert np.ptp(share, axis=0).max() <= PRECISE * np.abs(share).max()
    carried = sum(run[f"{n}.tau"] * (-1 if n == "c2" else 1) for n in clutches)
    np.testing.assert_allclose(carried, -2 / 3 * run["s.y"], atol=1e-8)
