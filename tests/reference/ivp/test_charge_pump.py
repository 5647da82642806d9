"""The charge pump of the IVP test set: two capacitors and a MOS transistor that keeps its charge, index 2.

Source: Guenther, Denk and Feldmann (1995), How models for MOS transistors reflect charge distribution effects, Preprint
1745, TH Darmstadt; reference values: Test Set for IVP Solvers, release 2.4, problem `pump` (GAMD in quadruple
precision). Most codes fail on it: the capacitances jump where the channel comes and goes.
"""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq

import acausal as ac
from acausal import Component, Equations, Parameter, Variable, der, mod, sqrt, where

PERIOD, END = 120e-9, 1200e-9
C_S, C_D, C_OX, U_T0, GAMMA, PHI, U_HIGH = 1.6e-12, 0.4e-12, 4e-12, 0.2, 0.035, 1.01, 20.0
GATE_CHARGE, CURRENT = 0.126280042987675933e-12, 0.152255686815577e-3
"""Published, at the end of the last falling edge."""


class ChargePump(Component):
    """A pulsed voltage `U1` at the gate, capacitors at source (`U2`) and drain (`U3`)."""

    U_high: Parameter = Parameter(U_HIGH, unit="V")
    C_S: Parameter = Parameter(C_S, unit="F")
    C_D: Parameter = Parameter(C_D, unit="F")
    C_ox: Parameter = Parameter(C_OX, unit="F")
    U_T0: Parameter = Parameter(U_T0, unit="V")
    gamma: Parameter = Parameter(GAMMA)
    phi: Parameter = Parameter(PHI, unit="V")
    Q_G: Variable = Variable(unit="C", nominal=1e-12)
    Q_S: Variable = Variable(unit="C", nominal=1e-12)
    Q_D: Variable = Variable(unit="C", nominal=1e-12)
    Y_S: Variable = Variable(unit="C", nominal=1e-12, start=0.0, fixed=True)
    Y_D: Variable = Variable(unit="C", nominal=1e-12, start=0.0, fixed=True)
    U1: Variable = Variable(unit="V")
    U2: Variable = Variable(unit="V")
    U3: Variable = Variable(unit="V")
    i: Variable = Variable(unit="A", nominal=1e-3)

    def equations(self) -> Equations:
        t, rise = mod(ac.time, PERIOD), 10e-9
        edges = where(t < 110e-9, 1.0, (PERIOD - t) / rise)
        yield self.U1 == self.U_high * where(t < 50e-9, 0.0, where(t < 60e-9, (t - 50e-9) / rise, edges))
        yield der(self.Q_G) == -self.i
        yield der(self.Y_S) + der(self.Q_S) == 0
        yield der(self.Y_D) + der(self.Q_D) == 0
        yield self.Y_S == self.C_S * self.U2
        yield self.Y_D == self.C_D * self.U3
        low, high = ac.min(self.U2, self.U3), ac.max(self.U2, self.U3)
        bulk, threshold = sqrt(self.phi + low), self.U_T0 - self.gamma * sqrt(self.phi)
        flat_band = threshold - self.phi
        near = self.U1 - low - threshold - self.gamma * bulk
        far = ac.max(self.U1 - high - threshold - self.gamma * bulk, 0.0)
        channel = near + far - near * far / where(near > 0, near + far, 1.0)
        depleted = self.gamma * (sqrt(self.gamma**2 / 4 + ac.max(self.U1 - flat_band, 0.0)) - self.gamma / 2)
        below = where(self.U1 < flat_band, self.U1 - flat_band, depleted)
        yield self.Q_G == self.C_ox * where(near > 0, 2 / 3 * channel + self.gamma * bulk, below)
        yield self.Q_S == -self.C_ox / 3 * where(near > 0, channel, 0.0)
        yield self.Q_D == -self.C_ox / 3 * where(near > 0, channel, 0.0)


def exact(u1: float, rate: float) -> tuple[float, float, float]:
    """U2, U3 and the current: both capacitors have the channel's charge, which is a matter of U1 alone."""

    def channel(u1: float, q: float) -> tuple[float, float]:
        low, high = q / C_S, q / C_D
        bulk = np.sqrt(PHI + low)
        near = u1 - low - U_T0 - GAMMA * (bulk - np.sqrt(PHI))
        far = max(u1 - high - U_T0 - GAMMA * (bulk - np.sqrt(PHI)), 0.0)
        return near + far - near * far / (near + far), 2 / 3 * (near + far - near * far / (near + far)) + GAMMA * bulk

    def charge(u1: float) -> tuple[float, float]:
        if u1 <= U_T0:  # nothing in the channel, and U2 = U3 = 0
            return 0.0, C_OX * GAMMA * (np.sqrt(GAMMA**2 / 4 + u1 - U_T0 + GAMMA * np.sqrt(PHI) + PHI) - GAMMA / 2)
        q: Any = brentq(lambda q: q - C_OX / 3 * channel(u1, q)[0], 0.0, 1.2e-12 * u1, xtol=1e-27)
        return q, C_OX * channel(u1, q)[1]

    step, q = 1e-4, charge(u1)[0]
    slope = 0.0 if rate == 0.0 else (charge(u1 + step)[1] - charge(u1 - step)[1]) / (2 * step)
    return q / C_S, q / C_D, -slope * rate


@cache
def compiled() -> ac.System:
    return ac.compile(ChargePump())


def test_index() -> None:
    assert compiled().report().structural_index == 2
    assert len(compiled().states) == 2


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_all_ten_pulses(engine: Any) -> None:
    """Before the rise, within both edges, on top, and just before the end."""
    inside = np.array([30e-9, 50.05e-9, 55e-9, 85e-9, 114e-9, 119.95e-9])
    times = np.concatenate([[0.0], (np.arange(10)[:, None] * PERIOD + inside).ravel(), [END * (1 - 1e-12)]])
    solution = compiled().simulate(times[-1], saveat=times, rtol=1e-9, engine=engine)
    assert len(solution.events) == 59
    rates = np.array([0.0, *([0.0, 2e9, 2e9, 0.0, -2e9, -2e9] * 10), -2e9])
    wanted = np.array([exact(u, rate) for u, rate in zip(solution["U1"], rates, strict=True)])
    for k, (name, size) in enumerate((("U2", 10.0), ("U3", 40.0), ("i", 3e-3))):
        np.testing.assert_allclose(solution[name], wanted[:, k], atol=1e-7 * size, err_msg=name)
    assert solution["Q_G"][-1] == pytest.approx(GATE_CHARGE, rel=1e-7)
    assert solution["i"][-1] == pytest.approx(CURRENT, rel=1e-5)  # the published one holds five digits
