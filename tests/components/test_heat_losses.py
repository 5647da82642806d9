"""Chains of frictions: what their heat ports give is what the motion loses, through all that sticks and slips."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal.components import blocks, rotational
from acausal.components.examples import assemble, start

from .msl_shafts import heat_losses


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_shafts_lose_what_their_frictions_give_off(engine: Any) -> None:
    """Rotational.Examples.HeatLosses: 0.33 J of heat, the frictions stick and slip some two hundred times."""
    t = np.linspace(0.0, 1.0, 20001)
    solution = ac.compile(heat_losses()).simulate(1.0, saveat=t, rtol=1e-8, engine=engine)

    def value(name: str) -> np.ndarray:
        return np.asarray(solution[name])

    kinetic = sum(value(f"inertia{k}.w") ** 2 for k in range(1, 7))
    elastic = 0.5e4 * (value("springDamper.phi_rel") ** 2 + value("spring3.phi_rel") ** 2)
    elastic += value("elastoBacklash.tau_c") ** 2 / 2e5
    power = value("torque.tau") * value("inertia1.w") + value("convection.fluid.Q_flow")
    work = np.concatenate([[0.0], np.cumsum((power[1:] + power[:-1]) / 2 * np.diff(t))])
    assert -np.trapezoid(value("convection.fluid.Q_flow"), t) > 0.3
    np.testing.assert_allclose(kinetic + elastic, work, atol=1e-5)
    assert len(solution.events) > 150


@pytest.mark.parametrize("J", [0.1, 1.0, 100.0])
def test_one_way_clutch_lets_go_of_any_inertia(J: float) -> None:
    """Pulled forward by ``3 t``, against the 2 N m that hold: from t = 2/3 s on ``J dw/dt = 3 t - 2``."""
    model = assemble(
        "press.y - clutch.f_normalized", "wall.flange - clutch.flange_a", "clutch.flange_b - rotor.flange_a",
        "ramp.y - drive.tau", "drive.flange - rotor.flange_b", press=blocks.Constant(k=1.0), wall=rotational.Fixed(),
        clutch=rotational.OneWayClutch(fn_max=4.0), ramp=blocks.Slope(slope=3.0), drive=rotational.Torque(),
        rotor=rotational.Inertia(J=J, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
    )  # fmt: skip
    t = np.linspace(0.0, 2.0, 21)
    solution = ac.compile(model).simulate(2.0, saveat=t, rtol=1e-8)
    pull = np.maximum(3 * t - 2.0, 0.0)
    np.testing.assert_allclose(solution["rotor.w"], pull**2 / 6 / J, atol=1e-6 + 1e-3 / J)  # eps0 = 1e-4 more holds
