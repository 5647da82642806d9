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
    assert_allclose(np.max(np.abs(np.asarray(solution["filter.y"]))), 10 ** (-3 / 20), rtol=1e-4)


def test_critical_damping_is_the_filter_of_that_name() -> None:
    t = np.linspace(0.0, 2.0, 21)
    one = stepped(blocks.CriticalDamping(n=4, f=1.5, initType="InitialState"), t)
    other = stepped(blocks.Filter(analogFilter="CriticalDamping", order=4, f_cut=1.5, initType="InitialState"), t)
    assert_allclose(one, other, atol=1e-8)
    assert np.all(one <= 1.0 + 1e-9) and one[-1] > 0.99


@pytest.mark.parametrize(("changes", "text"), [
    ({"analogFilter": "Elliptic"}, "analogFilter='Elliptic'.*CriticalDamping, Bessel, Butterworth"),
    ({"filterType": "BandPass"}, "filterType='BandPass'.*LowPass, HighPass"),
    ({"order": 0}, "order=0"),
])  # fmt: skip
def test_unknown_filters(changes: dict[str, str | int], text: str) -> None:
    with pytest.raises(ac.DeclarationError, match=text):
        ac.compile(assemble("step.y - filter.u", step=blocks.Step(), filter=blocks.Filter(**changes)))  # pyright: ignore
