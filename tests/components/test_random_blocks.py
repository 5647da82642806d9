"""Sources, continuous blocks and controllers with random parameters, against closed forms and SciPy's integrator."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import acausal as ac
from acausal import Component
from acausal.components import blocks
from acausal.components.examples import assemble

Wave = Callable[[Any], Any]
T = 2.0


def source(kind: str, rng: np.random.Generator) -> tuple[Component, Wave]:
    """A source with random parameters, and its output over time."""
    at, offset, height, f, phase = (*rng.uniform(-0.5, 0.5, 1), *rng.uniform(-2.0, 2.0, 2), *rng.uniform(0.3, 3.0, 2))
    common: dict[str, Any] = {"startTime": at, "offset": offset}

    def begun(y: Wave) -> Wave:
        return lambda t: offset + np.where(t < at, 0.0, y(t - at))

    if kind == "ExpSine":
        block = blocks.ExpSine(amplitude=height, f=f, phase=phase, damping=phase, **common)
        return block, begun(lambda t: height * np.exp(-t * phase) * np.sin(2 * np.pi * f * t + phase))
    if kind == "Sinc":
        return blocks.Sinc(amplitude=height, f=f, **common), begun(lambda t: height * np.sinc(2 * f * t))
    if kind == "Exponentials":
        top = height * (1 - np.exp(-phase / f))
        block = blocks.Exponentials(outMax=height, riseTime=phase, riseTimeConst=f, fallTimeConst=2 * f, **common)
        rise: Wave = lambda t: height * (1 - np.exp(-t / f))  # noqa: E731
        return block, begun(lambda t: np.where(t < phase, rise(t), top * np.exp(-(t - phase) / (2 * f))))
    if kind == "KinematicPTP":
        slow = abs(height) > f**2 / phase
        t1 = f / phase if slow else np.sqrt(abs(height) / phase)
        t2 = abs(height) / f if slow else t1
        path = blocks.KinematicPTP(deltaq=height, qd_max=f, qdd_max=phase, startTime=at)
        push: Wave = lambda t: np.where(t < t1, 1.0, np.where(t < t2, 0.0, np.where(t < t1 + t2, -1.0, 0.0)))  # noqa: E731
        return path, lambda t: np.where(t < at, 0.0, np.sign(height) * phase * push(t - at))
    rising, width, falling, rest = rng.uniform(0.02, 0.3, 4) * (rng.random(4) < [0.7, 1.0, 0.7, 1.0])
    period, n = rising + width + falling + rest, int(rng.integers(-1, 4))
    repeats: dict[str, Any] = {"amplitude": height, "period": period, "nperiod": n, **common}

    def repeated(shape: Wave) -> Wave:
        def y(t: np.ndarray) -> Any:
            number = np.floor(t / period)
            return np.where((n < 0) | (number < n), shape(t - number * period), 0.0)

        return begun(y)

    if kind == "Pulse":
        return blocks.Pulse(width=100 * width / period, **repeats), repeated(lambda t: np.where(t < width, height, 0.0))
    if kind == "SawTooth":
        return blocks.SawTooth(**repeats), repeated(lambda t: height * t / period)

    def trapezoid(t: np.ndarray) -> Any:
        up, down = t / max(rising, 1e-9), (rising + width + falling - t) / max(falling, 1e-9)
        return height * np.clip(np.minimum(up, down), 0.0, 1.0)

    return blocks.Trapezoid(rising=rising, width=width, falling=falling, **repeats), repeated(trapezoid)


@pytest.mark.parametrize("seed", range(2))
def test_sources(seed: int) -> None:
    rng = np.random.default_rng(seed)
    kinds = ["ExpSine", "Sinc", "Exponentials", "KinematicPTP", "Pulse", "SawTooth", "Trapezoid"] * 3
    made = {f"{kind}{i}": source(kind, rng) for i, kind in enumerate(kinds)}
    model = assemble(**{name: block for name, (block, _) in made.items()})
    times = np.sort(rng.uniform(0.0, T, 200))
    run = ac.compile(model).simulate(t1=T, saveat=times)
    for name, (_, wave) in made.items():
        np.testing.assert_allclose(run[f"{name}.y"], wave(times), atol=1e-9, err_msg=name)


def limited(kind: str, init: str, rng: np.random.Generator, u: Wave) -> tuple[Component, float, Wave]:
    """A LimPID with random parameters, its constant set point, and its output over time where it measures `u`."""
    k, Ti, Td, Ni, Nd = rng.uniform([0.5, 0.2, 0.05, 0.3, 3.0], [3.0, 1.0, 0.3, 2.0, 12.0])
    kFF, high = rng.uniform([0.5, 0.5], [2.0, 2.0])
    wp, wd, xi, xd, low, wanted = rng.uniform([0.0, 0.0, -0.5, -0.5, -2.0, -1.0], [1.5, 1.0, 0.5, 0.5, -0.3, 1.0])
    begins = rng.uniform(low, high)
    with_i, with_d, filtered = "I" in kind, "D" in kind, Td / Nd

    def output(t: Any, x: Any) -> tuple[Any, Any]:
        derivative = Td / filtered * (wd * wanted - u(t) - x[1]) if with_d else 0.0
        free = k * (wp * wanted - u(t) + (x[0] if with_i else 0.0) + derivative) + kFF * u(t)
        return free, np.clip(free, low, high)

    def rates(t: float, x: Any) -> list[float]:
        free, y = output(t, x)
        return [(wanted - u(t) + (y - free) / (k * Ni)) / Ti, (wd * wanted - u(t) - x[1]) / filtered]

    now = float(u(np.zeros(())))
    start = [xi, xd] if init == "InitialState" else [begins / k - wp * wanted + now, wd * wanted - now]
    block = blocks.LimPID(
        controllerType=kind, initType=init, withFeedForward=True, k=k, Ti=Ti, Td=Td, Ni=Ni, Nd=Nd, kFF=kFF, wp=wp,
        wd=wd, yMax=high, yMin=low, xi_start=xi, xd_start=xd, y_start=begins,
    )  # fmt: skip
    exact = solve_ivp(rates, (0.0, T), start, rtol=1e-10, atol=1e-12, dense_output=True).sol
    return block, wanted, lambda t: output(t, exact(t))[1]


@pytest.mark.parametrize("seed", range(2))
def test_limited_controllers(seed: int) -> None:
    """All types, with feed-forward, from states and from an output (where no limit is, with the feed-forward)."""
    rng = np.random.default_rng(seed)
    f, phase = rng.uniform(0.2, 1.0), rng.uniform(-1.0, 1.0)
    kinds = [("P", "InitialState"), ("PI", "InitialState"), ("PD", "InitialState"), ("PID", "InitialState"),
             ("PI", "InitialOutput"), ("PID", "InitialOutput")]  # fmt: skip
    made = {f"c{i}": limited(*kind, rng, lambda t: np.sin(2 * np.pi * f * t + phase)) for i, kind in enumerate(kinds)}
    parts: dict[str, Component] = {name: block for name, (block, _, _) in made.items()}
    parts |= {f"of_{name}": blocks.Constant(k=wanted) for name, (_, wanted, _) in made.items()}
    wires = [f"of_{name}.y - {name}.u_s" for name in made] + [f"wave.y - {name}.u_m - {name}.u_ff" for name in made]
    times = np.linspace(0.0, T, 41)
    model = assemble(*wires, wave=blocks.Sine(f=f, phase=phase), **parts)
    run = ac.compile(model).simulate(t1=T, saveat=times, rtol=1e-9, atol=1e-11)
    for name, (_, _, wave) in made.items():
        np.testing.assert_allclose(run[f"{name}.y"], wave(times), atol=2e-6, err_msg=name)
