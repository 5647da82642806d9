"""Switched-mode converters in continuous and discontinuous conduction against their exact piecewise solutions."""

from __future__ import annotations

from functools import cache
from typing import Any

import jax
import numpy as np
import pytest
from numpy.testing import assert_allclose

import acausal as ac

from .converters import MODELS, Values, solved

PERIOD, WIDTH, T1 = 1e-4, 0.4, 7.3e-4


@cache
def compiled(name: str) -> ac.System:
    return ac.compile(MODELS[name][0])


@pytest.mark.parametrize("engine", ["native", "diffrax"])
@pytest.mark.parametrize("load", [3.0, 200.0])
@pytest.mark.parametrize("name", MODELS)
def test_exact_times_and_values(name: str, load: float, engine: Any) -> None:
    """With little load the diode's current ends in each period: its times are those of the exact solution."""
    _, current, law = MODELS[name]
    x, wanted = solved(law, Values(R=load), T1, WIDTH, PERIOD)
    found = compiled(name).simulate(T1, parameters={"R": load}, rtol=1e-10, saveat=2, engine=engine)
    assert_allclose([found[current][-1], found["capacitor.v"][-1]], x, rtol=1e-8, atol=1e-9)
    times = np.array([e.t for e in found.events if e.t > 0.0])
    late = np.abs(times[None] - np.array(wanted)[:, None]).min(axis=1)
    early = np.abs(times[:, None] - np.array(wanted)[None]).min(axis=1)
    assert max(late.max(), early.max()) < 1e-8 * T1
    assert (len(wanted) > 16) == (load > 100.0) or name != "buck", "the discontinuous case is one"


@pytest.mark.parametrize("name", MODELS)
def test_gradients_through_all_switchings(name: str) -> None:
    """Of the output voltage by the inductance and the load, against differences of the exact solution."""
    law, system = MODELS[name][2], compiled(name)

    def output(L: Any, R: Any) -> Any:
        given = {"L": L, "R": R}
        return system.simulate(T1, parameters=given, rtol=1e-10, saveat=2, engine="native")["capacitor.v"][-1]

    slopes = jax.grad(output, argnums=(0, 1))(2e-4, 200.0)
    for slope, key, value in zip(slopes, ("L", "R"), (2e-4, 200.0), strict=True):
        near = [Values(**{"R": 200.0, key: value * (1 + s)}) for s in (-1e-5, 1e-5)]
        ends = [solved(law, values, T1, WIDTH, PERIOD)[0][1] for values in near]
        assert_allclose(slope, (ends[1] - ends[0]) / (2e-5 * value), rtol=1e-5)


@pytest.mark.parametrize("rtol", [1e-4, 1e-6, 1e-8])
def test_coarse_tolerances_find_the_same_switchings(rtol: float) -> None:
    """Fewer steps, the same course: the error follows the tolerance."""
    _, current, law = MODELS["boost"]
    x, _ = solved(law, Values(R=200.0), T1, WIDTH, PERIOD)
    found = compiled("boost").simulate(T1, parameters={"R": 200.0}, rtol=rtol, saveat=2)
    assert_allclose([found[current][-1], found["capacitor.v"][-1]], x, rtol=50 * rtol, atol=50 * rtol)
