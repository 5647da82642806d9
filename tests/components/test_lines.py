"""Transmission lines of lumped sections against the equations of the continuous line."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Component
from acausal.components import electrical, thermal
from acausal.components.examples import assemble

R, L, G, C, LENGTH, LOAD = 0.4, 2e-6, 3e-4, 1e-10, 20.0, 30.0


def fed(line: Component, source: Component, load: Component, *more: str, **parts: Component) -> Component:
    return assemble(
        "source.p - line.p1", "line.p2 - load.p", "source.n - line.p3 - load.n - ground.p", *more,
        source=source, line=line, load=load, ground=electrical.Ground(), **parts,
    )  # fmt: skip


def far_end(line: Component, t: Any, load: float, engine: Any = "auto") -> ac.Solution:
    model = fed(line, electrical.ConstantVoltage(V=1.0), electrical.Resistor(R=load))
    return ac.compile(model).simulate(float(t[-1]), saveat=t, rtol=1e-9, engine=engine)


def test_direct_current_attenuates_as_in_the_continuous_line() -> None:
    """V2/V1 = 1/(cosh(a) + Z sinh(a)/R_load), a = length sqrt(r g), Z = sqrt(r/g); the sections err with 1/N^2."""
    a, Z = LENGTH * np.sqrt(R * G), np.sqrt(R / G)
    wanted = 1 / (np.cosh(a) + Z * np.sinh(a) / LOAD)
    errors = []
    for N in (1, 4, 8):
        line = electrical.OLine(N=N, r=R, l=L, g=G, c=C, length=LENGTH)
        errors.append(abs(float(far_end(line, np.array([0.0, 1.0]), LOAD)["load.v"][-1]) - wanted))
    assert errors[0] < 1e-2 * wanted
    assert 3.9 < errors[1] / errors[2] < 4.1


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_a_step_diffuses_along_an_rc_line(engine: Any) -> None:
    """Open end of a line of resistance and capacitance: v = 1 - 4/pi sum (-1)^k/(2k+1) exp(-(2k+1)^2 pi^2 t/(4 RC))."""
    time = R * C * LENGTH**2
    t = time * np.linspace(0.0, 1.0, 11)
    k = np.arange(40)[:, None]
    terms = (-1.0) ** k / (2 * k + 1) * np.exp(-(((2 * k + 1) * np.pi / 2) ** 2) * t / time)
    wanted = 1 - 4 / np.pi * terms.sum(axis=0)
    solution = far_end(electrical.ULine(N=40, r=R, c=C, length=LENGTH), t, 1e12, engine)
    np.testing.assert_allclose(solution["load.v"][1:], wanted[1:], atol=3e-4)
    np.testing.assert_allclose(solution["line.v[40]"], solution["line.shunts[39].v"])


def test_heat_of_a_line_is_the_power_it_takes() -> None:
    """At 400 K everywhere the series resistance has grown by 10 %, and the leakage fallen by 20 %."""
    line = electrical.OLine(
        N=5, r=R, l=L, g=G, c=C, length=LENGTH, alpha_R=1e-3, alpha_G=2.5e-3, T_ref=300.0, useHeatPort=True
    )
    model = fed(line, electrical.ConstantVoltage(V=10.0), electrical.Resistor(R=LOAD), "line.heatPort - bath.port",
                bath=thermal.FixedTemperature(T=400.0))  # fmt: skip
    hot = ac.compile(model).simulate(1.0, saveat=[1.0], rtol=1e-9)
    taken = -10.0 * np.asarray(hot["source.i"]) - np.asarray(hot["load.LossPower"])
    np.testing.assert_allclose(hot["bath.port.Q_flow"], taken, rtol=1e-8)
    same = electrical.OLine(N=5, r=1.1 * R, l=L, g=G / 1.25, c=C, length=LENGTH)
    np.testing.assert_allclose(hot["load.v"] / 10.0, far_end(same, np.array([1.0]), LOAD)["load.v"], rtol=1e-8)
