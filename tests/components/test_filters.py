"""Filters against SciPy's transfer functions."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy import signal

import acausal as ac
from acausal.components import blocks
from acausal.components.examples import assemble

ROOTS = {
    "CriticalDamping": lambda n: -np.ones(n) / np.sqrt(10 ** (0.3 / n) - 1),
    "Bessel": lambda n: signal.besselap(n, norm="mag")[1],
    "Butterworth": lambda n: signal.buttap(n)[1],
}
"""Poles with a gain of about -3 dB at 1 rad/s, from closed formulas and SciPy's own scaling."""


def stepped(block: ac.Component, t: np.ndarray) -> np.ndarray:
    model = assemble("step.y - filter.u", step=blocks.Step(), filter=block)
    return np.asarray(ac.compile(model).simulate(float(t[-1]), saveat=t, rtol=1e-10)["filter.y"])


@pytest.mark.parametrize("order", [1, 5])
@pytest.mark.parametrize("kind", ROOTS)
@pytest.mark.parametrize("passes", ["LowPass", "HighPass"])
def test_step_of_a_filter(kind: str, passes: str, order: int) -> None:
    """SciPy's -3 dB are a gain of sqrt(1/2), those of the standard library 10^(-3/20): 0.2 % more of the gain."""
    poles = np.asarray(ROOTS[kind](order), complex)
    move = signal.lp2lp_zpk if passes == "LowPass" else signal.lp2hp_zpk
    z, p, k = move([], poles, np.prod(-poles).real, 4 * np.pi)
    t = np.linspace(0.0, 1.0, 21)
    block = blocks.Filter(
        analogFilter=kind, filterType=passes, order=order, f_cut=2.0, gain=3.0, initType="InitialState"
    )  # fmt: skip
    wanted = 3.0 * signal.step(signal.ZerosPolesGain(z, p, k), T=t)[1]
    assert_allclose(stepped(block, t), wanted, atol=6e-3)


@pytest.mark.parametrize("kind", ROOTS)
def test_gain_at_the_cut(kind: str) -> None:
    wave = blocks.Sine(amplitude=1.0, f=2.0)
    model = assemble("wave.y - filter.u", wave=wave, filter=blocks.Filter(analogFilter=kind, order=3, f_cut=2.0))
    solution = ac.compile(model).simulate(8.0, saveat=np.linspace(7.5, 8.0, 401), rtol=1e-9)
    wanted = np.sqrt(0.5) if kind == "Butterworth" else 10 ** (-3 / 20)
    assert_allclose(np.max(np.abs(np.asarray(solution["filter.y"]))), wanted, rtol=1e-4)


@pytest.mark.parametrize("order", [3, 4])
@pytest.mark.parametrize("kind", ["Bessel", "Butterworth", "ChebyshevI"])
@pytest.mark.parametrize("passes", ["BandPass", "BandStop"])
def test_step_of_a_band_filter(kind: str, passes: str, order: int) -> None:
    """Against SciPy's transformation of the same poles, which stand in `LowPass` at their cut-off of 1 rad/s."""
    poles = {
        "Bessel": lambda: signal.besselap(order, norm="delay")[1], "Butterworth": lambda: signal.buttap(order)[1],
        "ChebyshevI": lambda: signal.cheb1ap(order, 1.5)[1],
    }[kind]()  # fmt: skip
    low, high = 1.5, 2.5
    move = signal.lp2bp_zpk if passes == "BandPass" else signal.lp2bs_zpk
    w, width = 2 * np.pi * np.sqrt(low * high), 2 * np.pi * (high - low)
    z, p, k = move([], np.asarray(poles, complex), np.prod(-poles).real, w, width)
    t = np.linspace(0.0, 2.0, 41)
    block = blocks.Filter(
        analogFilter=kind, filterType=passes, order=order, f_cut=high, f_min=low, A_ripple=1.5, gain=2.0,
        normalized=False, init="InitialState", u_nominal=10.0,
    )  # fmt: skip
    wanted = 2.0 * signal.step(signal.ZerosPolesGain(z, p, k), T=t)[1]
    assert_allclose(stepped(block, t), wanted, atol=1e-6)


@pytest.mark.parametrize("order", [3, 4])
@pytest.mark.parametrize("normalized", [False, True])
def test_step_of_a_chebyshev_filter(order: int, normalized: bool) -> None:
    """The gain at rest is 1; with `normalized` it is -3 dB at the cut-off."""
    poles = signal.cheb1ap(order, 0.5)[1]
    block = blocks.Filter(analogFilter="ChebyshevI", order=order, f_cut=2.0, normalized=normalized, init="InitialState")
    scale = 1.0
    if normalized:
        w = np.linspace(1.0, 1.5, 100_001)
        gain = np.abs(np.prod(poles) / np.prod(1j * w[:, None] - poles, axis=1))
        scale = w[np.argmin(np.abs(gain - 10 ** (-3 / 20)))]
    p = 4 * np.pi * poles / scale
    t = np.linspace(0.0, 2.0, 41)
    wanted = signal.step(signal.ZerosPolesGain([], p, np.prod(-p).real), T=t)[1]
    assert_allclose(stepped(block, t), wanted, atol=3e-5)


def test_parameters_of_a_band_filter_stay_tunable() -> None:
    block = blocks.Filter(analogFilter="ChebyshevI", filterType="BandPass", f_cut=2.0, f_min=1.0)
    system = ac.compile(assemble("step.y - filter.u", step=blocks.Step(), filter=block))
    new = {"filter.f_cut": 3.0, "filter.f_min": 2.5, "filter.A_ripple": 1.0}
    other = blocks.Filter(analogFilter="ChebyshevI", filterType="BandPass", f_cut=3.0, f_min=2.5, A_ripple=1.0)
    t = np.linspace(0.0, 1.0, 11)
    found = system.simulate(1.0, saveat=t, rtol=1e-9, parameters=new)["filter.y"]
    again = ac.compile(assemble("step.y - filter.u", step=blocks.Step(), filter=other))
    assert_allclose(found, again.simulate(1.0, saveat=t, rtol=1e-9)["filter.y"], atol=1e-8)


@pytest.mark.parametrize(("f_min", "text"), [(0.0, "0 < f_min < f_cut"), (0.1, "poles on the real axis")])
def test_bands_that_are_none(f_min: float, text: str) -> None:
    band = blocks.Filter(analogFilter="CriticalDamping", filterType="BandPass", order=2, f_cut=5.0, f_min=f_min)
    with pytest.raises(ac.AcausalError, match=text):
        ac.compile(assemble("step.y - filter.u", step=blocks.Step(), filter=band)).simulate(1.0)


def test_critical_damping_is_the_filter_of_that_name() -> None:
    t = np.linspace(0.0, 2.0, 21)
    one = stepped(blocks.CriticalDamping(n=4, f=1.5, normalized=False, initType="InitialState"), t)
    kinds = {"analogFilter": "CriticalDamping", "order": 4, "normalized": False}
    other = stepped(blocks.Filter(f_cut=1.5, initType="InitialState", **kinds), t)  # pyright: ignore
    assert_allclose(one, other, atol=1e-8)
    assert np.all(one <= 1.0 + 1e-9) and one[-1] > 0.99


def test_lowpass_butterworth_is_the_filter_of_that_name() -> None:
    t = np.linspace(0.0, 2.0, 21)
    for order in (1, 2, 5):
        one = stepped(blocks.LowpassButterworth(n=order, f=1.5, initType="InitialState"), t)
        other = stepped(blocks.Filter(analogFilter="Butterworth", order=order, f_cut=1.5, init="InitialState"), t)
        assert_allclose(one, other, atol=1e-8)


@pytest.mark.parametrize(("changes", "text"), [
    ({"analogFilter": "Elliptic"}, "analogFilter='Elliptic'.*CriticalDamping, Bessel, Butterworth, ChebyshevI"),
    ({"filterType": "AllPass"}, "filterType='AllPass'.*LowPass, HighPass, BandPass, BandStop"),
    ({"order": 0}, "order=0"),
])  # fmt: skip
def test_unknown_filters(changes: dict[str, str | int], text: str) -> None:
    with pytest.raises(ac.DeclarationError, match=text):
        ac.compile(assemble("step.y - filter.u", step=blocks.Step(), filter=blocks.Filter(**changes)))  # pyright: ignore
