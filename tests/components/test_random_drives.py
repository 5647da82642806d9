"""Random drive trains with frictions, brakes, clutches, freewheels, gears and backlash: they keep the books."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.integrate import cumulative_simpson

import acausal as ac
from acausal import Component
from acausal.components import blocks, electrical
from acausal.components import rotational as rot
from acausal.components.examples import assemble, start

T = np.linspace(0.0, 2.0, 20001)
LOSSY = "damper", "both", "backlash", "clutch", "freewheel", "lossy", "bearing", "brake"


def drive(rng: np.random.Generator) -> tuple[dict[str, Component], list[str], str]:
    """Parts, connections, and the shaft that a torque drives.

    Some shafts have a bearing with friction or a brake that pulses; they are joined in a tree, and sometimes twice.
    """

    def within(low: float, high: float) -> float:
        return float(rng.uniform(low, high))

    links: dict[str, Callable[[], Component]] = {
        "spring": lambda: rot.Spring(c=within(5, 200)), "damper": lambda: rot.Damper(d=within(0.1, 5)),
        "both": lambda: rot.SpringDamper(c=within(5, 200), d=within(0, 3)),
        "backlash": lambda: rot.ElastoBacklash(c=within(50, 500), d=within(0, 3), b=within(0.1, 0.8)),
        "clutch": lambda: rot.Clutch(fn_max=within(1, 10), mu_pos=[[0, 0.4], [3, 0.3]], peak=within(1, 1.2)),
        "freewheel": lambda: rot.OneWayClutch(fn_max=within(0.5, 3), mu_pos=[[0, 0.5]]),
        "gear": lambda: rot.IdealGear(ratio=within(0.5, 3)),
        "lossy": lambda: rot.LossyGear(
            ratio=within(0.5, 3), lossTable=[[0, within(0.7, 1), within(0.7, 1), within(0, 0.5), within(0, 0.5)]]
        ),
        "disc": lambda: rot.Disc(deltaPhi=0.1),
    }  # fmt: skip
    n, parts, lines = int(rng.integers(2, 6)), dict[str, Component](), list[str]()
    for k in range(n):
        speed = float(rng.choice([0.0, within(-3, 3)]))
        parts[f"J{k}"] = rot.Inertia(J=within(0.3, 3), phi=start(within(-0.3, 0.3)), w=start(speed))
        held = rng.random()
        if held < 0.25:
            friction = [[0, within(0.1, 2)], [5, within(2, 4)]]
            parts[f"bearing{k}"] = rot.BearingFriction(tau_pos=friction, peak=within(1, 1.5))
            lines.append(f"J{k}.flange_b - bearing{k}.flange_a")
        elif held < 0.45:
            parts[f"brake{k}"] = rot.Brake(fn_max=within(0.5, 5), mu_pos=[[0, 0.5]], peak=within(1, 1.3))
            parts[f"foot{k}"] = blocks.Pulse(period=within(0.3, 1.0), startTime=within(0, 0.5))
            lines += [f"J{k}.flange_b - brake{k}.flange_a", f"foot{k}.y - brake{k}.f_normalized"]
    pairs = [(int(rng.integers(0, k)), k) for k in range(1, n)]
    pairs += [tuple(rng.choice(n, 2, replace=False).tolist()) for _ in range(int(rng.integers(0, 2)))]
    for k, (a, b) in enumerate(pairs):
        kind = str(rng.choice(list(links)))
        name = f"{kind}_{k}"
        parts[name] = links[kind]()
        if kind in ("clutch", "freewheel"):
            pulse = blocks.Pulse(period=within(0.3, 1.0), startTime=within(0, 0.5))
            parts[f"press{k}"] = pulse if kind == "clutch" else blocks.Constant(k=within(0, 1))
            lines.append(f"press{k}.y - {name}.f_normalized")
        lines += [f"J{a}.flange_b - {name}.flange_a", f"{name}.flange_b - J{b}.flange_a"]
    driven = f"J{int(rng.integers(0, n))}"
    parts |= {"s": blocks.Sine(amplitude=within(1, 10), f=within(0.3, 2)), "tau": rot.Torque()}
    lines += ["s.y - tau.tau", f"tau.flange - {driven}.flange_a"]
    if rng.random() < 0.4:
        parts |= {
            "V": electrical.ConstantVoltage(V=within(5, 20)), "R": electrical.Resistor(R=within(0.5, 2)),
            "L": electrical.Inductor(L=within(0.01, 0.1), i=start(0.0)), "ground": electrical.Ground(),
            "emf": electrical.RotationalEMF(k=within(0.2, 1)),
        }  # fmt: skip
        lines += ["V.p - R.p", "R.n - L.p", "L.n - emf.p", "emf.n - V.n - ground.p"]
        lines.append(f"emf.flange - J{int(rng.integers(0, n))}.flange_b")
    return parts, lines, driven


def books(s: ac.Solution, parts: dict[str, Component], driven: str) -> tuple[Any, Any, Any]:
    """Power that goes in, energy that is stored, power that is lost (n_t,); no element gives away what it loses."""
    value = s.system.parameters

    def of(name: str) -> Any:
        return np.broadcast_to(np.asarray(s[name]), T.shape)

    put_in, stored, lost = of("s.y") * of(f"{driven}.w"), np.zeros(len(T)), np.zeros(len(T))
    for name in parts:
        kind = name.rstrip("0123456789").rstrip("_")
        if kind == "J":
            stored = stored + 0.5 * value[f"{name}.J"] * of(f"{name}.w") ** 2
        if kind in ("spring", "both"):
            stored = stored + 0.5 * value[f"{name}.c"] * of(f"{name}.phi_rel") ** 2
        if kind == "backlash":
            beyond = np.maximum(np.abs(of(f"{name}.phi_rel")) - value[f"{name}.b"] / 2, 0.0)
            stored = stored + 0.5 * value[f"{name}.c"] * beyond**2
        if kind in LOSSY:
            power = of(f"{name}.lossPower")
            assert (power >= -1e-5 * max(1.0, np.abs(power).max())).all(), f"{name} gains {-power.min()} W"
            lost = lost + power
    if "emf" in parts:
        put_in = put_in + value["V.V"] * of("L.i")
        stored, lost = stored + 0.5 * value["L.L"] * of("L.i") ** 2, lost + of("R.LossPower")
    return put_in, stored, lost


def kept(seed: int, engine: Any = "native") -> bool:
    """Whether a random drive train runs; then its books have to be right. False where an error names a cause."""
    parts, lines, driven = drive(np.random.default_rng(seed))
    try:
        system = ac.compile(assemble(*lines, **parts))
        solution = system.simulate(T[-1], saveat=T, rtol=1e-8, engine=engine, max_steps=200_000)
    except ac.AcausalError as error:
        assert any(word in str(error) for word in (".py:", "connect(")), f"seed {seed}: {error}"
        return False
    put_in, stored, lost = books(solution, parts, driven)
    change = stored - stored[0] - cumulative_simpson(put_in - lost, x=T, initial=0.0)
    size = max(cumulative_simpson(np.abs(put_in) + lost, x=T)[-1], np.abs(stored).max(), 1e-3)
    assert np.abs(change).max() < 1e-3 * size, f"seed {seed}: {np.abs(change).max() / size}"
    return True


@pytest.mark.parametrize("seeds", [range(4), *(pytest.param(range(k, k + 4), marks=pytest.mark.slow) for k in (4, 8))])
def test_random_drives_keep_the_books(seeds: range) -> None:
    assert sum(kept(seed) for seed in seeds) >= 3


@pytest.mark.slow
@pytest.mark.parametrize("first", range(12, 212, 20))
def test_many_random_drives(first: int) -> None:
    assert sum(kept(seed) for seed in range(first, first + 20)) >= 16


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(4))
def test_random_drives_on_the_diffrax_engine(seed: int) -> None:
    assert kept(seed, "diffrax")
