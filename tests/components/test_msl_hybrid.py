"""Hybrid examples of the Modelica Standard Library against solutions found in another way."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

import acausal as ac
from acausal.components import electrical

from . import msl_hybrid as msl

ENGINES = ("native", pytest.param("diffrax", marks=pytest.mark.slow))
both = pytest.mark.parametrize("engine", ENGINES)


@cache
def compiled(make: Callable[..., ac.Component], *arguments: float) -> ac.System:
    return ac.compile(make(*arguments))


def run(make: Callable[..., ac.Component], t: np.ndarray, engine: Any, *arguments: float) -> ac.Solution:
    return compiled(make, *arguments).simulate(t[-1], saveat=t, engine=engine, rtol=1e-9)


@both
def test_coupled_clutches(engine: Any) -> None:
    """Momentum is that of the drive; friction obeys its law, brings speeds together, and never gives energy."""
    t = np.linspace(0.0, 1.5, 301)
    t = t[np.isin(t, (0.4, 0.9), invert=True)]  # there the clutches are pressed: which side is given is rounding
    solution = run(msl.coupled_clutches, t, engine)
    w = [np.asarray(solution[f"J{k}.w"]) for k in (1, 2, 3, 4)]
    assert_allclose(sum(w), 10.0 + (1 - np.cos(10 * np.pi * t)) / np.pi, rtol=1e-8)
    presses = [20 * np.cos(0.4 * np.pi * t), 20.0 * (t >= 0.4), 20.0 * (t >= 0.9)]
    for k, press in enumerate(presses):
        tau, slip = np.asarray(solution[f"clutch{k + 1}.tau"]), w[k + 1] - w[k]
        most, slides = 0.5 * np.maximum(press, 0.0), np.abs(slip) > 1e-7
        assert_allclose(tau[slides], (np.sign(slip) * most)[slides], atol=1e-7)
        assert np.all(np.abs(tau) <= 1.1 * most + 1e-7)
        assert np.all(tau * slip >= -1e-7)
        assert slides.any()


@both
def test_backlash(engine: Any) -> None:
    t = np.linspace(0.0, 1.0, 101)
    solution = run(msl.backlash, t, engine)
    free = solve_ivp(lambda t, y: [y[1], (-20e3 * y[0] - 50 * y[1]) / 5], (0, 1), [np.pi / 2, 0], t_eval=t, rtol=1e-11)
    assert_allclose(solution["inertia1.phi"], free.y[0], atol=1e-6)
    energy = 2.5 * solution["inertia2.w"] ** 2 + 1e4 * np.maximum(np.abs(solution["inertia2.phi"]) - np.pi / 8, 0) ** 2
    lost = solution["elastoBacklash.lossPower"]
    assert np.all(np.asarray(lost) >= -1e-6)
    assert np.all(np.diff(energy) <= 1e-6 * energy[0])
    through = np.abs(np.asarray(solution["inertia2.phi"])) < np.pi / 8
    assert through.sum() > 5
    assert_allclose(np.asarray(solution["elastoBacklash.tau"])[through], 0.0, atol=1e-9)


@both
def test_rolling_wheel(engine: Any) -> None:
    t = np.linspace(0.0, 5.0, 51)
    solution = run(msl.rolling_wheel, t, engine)
    end = np.sqrt(10.0 / 10.0) * 5.0  # drag 10 N (v/5)^2 against 10 N m at 1 m; 2 kg in effect
    wanted = end * np.tanh(np.maximum(t - 0.1, 0.0) * 10.0 / (2.0 * end))
    assert_allclose(solution["mass.v"], wanted, atol=1e-7)


@both
def test_eddy_current_brake_turns_all_energy_into_heat(engine: Any) -> None:
    t = np.linspace(0.0, 3.0, 31)
    solution = run(msl.eddy_current_brake, t, engine)
    heat = 10.0 * (solution["body.T"] - 293.15)
    assert_allclose(heat + 0.5 * solution["inertia.w"] ** 2, 5000.0, rtol=1e-8)


@pytest.mark.parametrize("load", [-6.0, 0.0, 4.0])
@both
def test_lossy_gear(engine: Any, load: float) -> None:
    """Torques by quadrant; energy in is energy stored and lost; equal to a solution by hand where nothing is stuck."""
    t = np.linspace(0.0, 2.0, 401)
    solution = run(msl.lossy_gear, t, engine, load)
    w, tau_a, tau_b = (np.asarray(solution[n]) for n in ("gear.w_a", "gear.flange_a.tau", "gear.flange_b.tau"))
    moves = np.abs(w) > 1e-6
    efficiency = np.where(tau_a * w > 0, 0.8, 1 / 0.6)
    assert_allclose(-tau_b[moves], 2.0 * (efficiency * tau_a)[moves], atol=1e-6)
    assert np.all(solution["gear.lossPower"] >= -1e-9)

    def rate(t: float, w: np.ndarray) -> list[float]:
        """a from J1 a = T - tau_a, J2 a/2 = 2 eta tau_a + load, the efficiency eta as the torque asks for."""
        drive, forward = 10 * np.sin(2 * np.pi * t), w[0] > 0
        for eta in (0.8, 1 / 0.6):
            a = (drive + load / (2 * eta)) / (1 + 1.5 / (4 * eta))
            if ((drive - a) * (1 if forward else -1) > 0) == (eta == 0.8):
                return [a]
        return [a]

    run_free = np.flatnonzero(moves)
    spans = np.split(run_free, np.flatnonzero(np.diff(run_free) > 1) + 1)
    longest = max(spans, key=len)
    longest = longest[1:-1] if len(longest) < len(t) else longest
    sign = np.sign(w[longest])
    longest = longest[: int(np.argmax(sign != sign[0])) or len(longest)]
    by_hand = solve_ivp(rate, t[longest[[0, -1]]], [w[longest[0]]], t_eval=t[longest], rtol=1e-9, max_step=1e-3)
    assert_allclose(w[longest], by_hand.y[0], atol=2e-3)


def test_what_is_held_twice_without_a_share_is_named() -> None:
    with pytest.raises(ac.SimulationError, match=r"At t = 0 s the equations are singular(.|\n)*two closed switches"):
        ac.compile(msl.two_switches()).simulate(1.0)


@both
def test_two_frictions_share_a_load(engine: Any) -> None:
    """A brake and a bearing hold a shaft up to 3 + 1 N m, each with the same share, and let go together."""
    t = np.linspace(0.0, 6.0, 121)
    solution = run(msl.braked_bearing, t, engine)
    load = np.minimum(t, 4.0)
    held = t < 3.99
    assert_allclose(np.asarray(solution["brake.tau"])[held], 0.75 * load[held], rtol=1e-6, atol=1e-9)
    assert_allclose(np.asarray(solution["bearing.tau"])[held], 0.25 * load[held], rtol=1e-6, atol=1e-9)
    assert_allclose(np.asarray(solution["rotor.w"]), np.maximum(t - 4.0, 0.0) ** 2 / 2 / 2.0, atol=1e-6)


@both
def test_rectifier_keeps_the_books(engine: Any) -> None:
    """Power of the sources is what is stored and lost; every diode obeys its characteristic."""
    t = np.linspace(0.0, 0.1, 4001)
    solution = run(msl.rectifier, t, engine)
    parts = ["V1", "V2", "V3", "L1", "L2", "L3", *(f"D{k}" for k in range(1, 7)), "C1", "C2", "R"]
    power = sum(np.asarray(solution[f"{p}.v"]) * np.asarray(solution[f"{p}.i"]) for p in parts)
    assert_allclose(power, 0.0, atol=1e-5)
    for k in range(1, 7):
        v, i = np.asarray(solution[f"D{k}.v"]), np.asarray(solution[f"D{k}.i"])
        on = v > 2.0
        assert_allclose(np.where(on, (i - 2e-6) * 1e-4 + 2.0, i * 1e6)[np.abs(v - 2.0) > 1e-7],
                        v[np.abs(v - 2.0) > 1e-7], rtol=1e-5, atol=1e-6)  # fmt: skip
    late = t > 0.06
    assert_allclose(np.mean(np.asarray(solution["R.v"])[late]), 3 * np.sqrt(3) / np.pi * 326, rtol=0.12)


@both
def test_chua_circuit(engine: Any) -> None:
    t = np.linspace(0.0, 2000.0, 101)
    solution = run(msl.chua, t, engine)

    def rates(t: float, y: np.ndarray) -> list[float]:
        v1, v2, i = y
        diode = -0.409091 * v1 + (-0.757576 + 0.409091) * np.clip(v1, -1.0, 1.0)
        return [(0.565 * (v2 - v1) - diode) / 10, (0.565 * (v1 - v2) - i) / 100, (v2 - 12.5e-3 * i) / 18]

    wanted = solve_ivp(rates, (0, 2000), [4, 0, 0], "LSODA", t_eval=t, rtol=1e-11, atol=1e-12, max_step=1.0)
    assert_allclose(solution["C1.v"], wanted.y[0], atol=1e-3)


def test_nand_gate() -> None:
    t = np.array([5e-3, 15e-3, 25e-3, 35e-3, 45e-3, 55e-3, 65e-3])
    solution = ac.compile(msl.nand_gate()).simulate(t[-1], saveat=t)
    both_on = (np.asarray(solution["x1.v"]) > 4.9) & (np.asarray(solution["x2.v"]) > 4.9)
    assert both_on.tolist() == [False, False, True, False, False, False, True]
    assert np.all((np.asarray(solution["C.v"]) < 2.5) == both_on)


@both
def test_multivibrator(engine: Any) -> None:
    """Half a period is ``R C log 3``: from -7.5 V to 7.5 V on the way to 15 V."""
    t = np.linspace(0.0, 1.0, 51)
    solution = run(msl.multivibrator, t, engine)
    half, first = 0.1 * np.log(3.0), 0.1 * np.log(23.0 / 7.5)
    wanted = first + half * np.arange(int((1.0 - first) / half) + 1)
    found = np.array([e.t for e in solution.events])
    assert np.abs(found[None] - wanted[:, None]).min(axis=1).max() < 1e-4
    turns = np.searchsorted(wanted, t)
    clear = np.abs(t[:, None] - wanted[None]).min(axis=1) > 1e-3
    assert_allclose(np.asarray(solution["out.v"])[clear], np.where(turns % 2 == 0, -15.0, 15.0)[clear], rtol=1e-9)


@pytest.mark.parametrize("rtol", [1e-4, 1e-6, 1e-8])
def test_multivibrator_of_first_order(rtol: float) -> None:
    """With a time constant of 10 us the switching is a mode that grows a thousand times faster than the error control
    sees: a step that is too long for it would keep the output at an equilibrium that it has to leave."""
    system = ac.compile(msl.multivibrator(electrical.OpAmpLimited(useFirstOrder=True)))
    solution = system.simulate(1.0, saveat=101, rtol=rtol, engine="native")
    clear = np.abs(np.asarray(solution["out.v"])) > 14.9
    assert clear.mean() > 0.95
    found = np.array([e.t for e in solution.events if any("amp" in c for c in e.causes)])
    turns = found[np.diff(found, prepend=-1.0) > 1e-3]
    assert_allclose(np.diff(turns)[1:], 0.1 * np.log(3.0), rtol=1e-3)
    assert len(turns) == 10


@both
def test_controlled_temperature(engine: Any) -> None:
    """Two exponentials: heated with 10 W to 304.15 K, cooling to 302.15 K, with a time constant of 10 s."""
    t = np.linspace(0.0, 10.0, 101)
    solution = run(msl.controlled_temperature, t, engine)
    T, heats, here, wanted = 298.15, True, 0.0, []
    for time in t:
        while True:
            goal, limit = (398.15, 304.15) if heats else (298.15, 302.15)
            switch = here + 10.0 * np.log((goal - T) / (goal - limit))
            if switch >= time:
                break
            T, here, heats = limit, switch, not heats
        wanted.append(goal + (T - goal) * np.exp(-(time - here) / 10.0))
    assert_allclose(solution["body.T"], wanted, rtol=1e-8)
