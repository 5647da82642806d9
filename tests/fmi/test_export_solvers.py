"""Exported units with an explicit method inside, and what the method does to their answer."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import acausal as ac
import acausal.fmi
from acausal.fmi import ExportError

from .export_models import Ball, Chain, Implicit, Oscillator, Pendulum, Rectifier, Sampled
from .export_unit import OK, Unit

ENDS = {Oscillator: 2.0, Implicit: 2.0, Pendulum: 2.0, Chain: 2.0, Ball: 1.5, Rectifier: 2.0, Sampled: 2.0}


def stepped(model: Any, folder: Path, step: float, **options: Any) -> tuple[Any, np.ndarray, np.ndarray]:
    """The system, communication points away from its events, and the states there."""
    system = ac.compile(model())
    one = Unit(ac.fmi.export(system, folder / "one.fmu", kind="cs", **options), folder / "x").instance()
    assert one.enter(tolerance=1e-9) == OK and one.call("ExitInitializationMode") == OK
    n = round(ENDS[model] / step)
    values = []
    for k in range(n):
        assert one.step(k * step, step) == OK, one.messages
        values.append(one.get(*system.states))
    one.free()
    t = step * np.arange(1, n + 1)
    events = system.simulate(ENDS[model], rtol=1e-10).events
    away = np.abs(t[:, None] - [e.t for e in events]).min(axis=1, initial=1.0) > 1e-6
    return system, t[away], np.array(values)[away]


@pytest.mark.parametrize("options", [{"solver": "rk4", "dt": 1e-3}, {"solver": "adams"}], ids=["rk4", "adams"])
@pytest.mark.parametrize("model", ENDS)
def test_explicit_methods_agree_with_simulate(model, options, tmp_path):
    system, t, found = stepped(model, tmp_path, 0.05, **options)
    exact = system.simulate(ENDS[model], saveat=t, rtol=1e-10)
    wanted = np.stack([exact[n] for n in system.states], axis=1)
    assert np.abs(found - wanted).max() <= 1e-6 * np.ptp(wanted, axis=0).max()


def test_rk4_is_of_order_four_and_cuts_a_step_into_equal_parts(tmp_path):
    """`dt` of 0.1 s in steps of 0.25 s: three parts of 1/12 s, as `simulate` with that step."""
    errors = []
    for dt in (0.1, 0.05):
        system, t, found = stepped(Oscillator, tmp_path / str(dt), 0.25, solver="rk4", dt=dt)
        same = system.simulate(2.0, saveat=t, solver="rk4", dt=0.25 / np.ceil(0.25 / dt))
        assert np.abs(found - np.stack([same[n] for n in system.states], axis=1)).max() <= 1e-13
        exact = system.simulate(2.0, saveat=t, rtol=1e-12)
        errors.append(np.abs(found - np.stack([exact[n] for n in system.states], axis=1)).max())
    assert np.log2(errors[0] / errors[1]) / np.log2(5 / 3) == pytest.approx(4.0, abs=0.3)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"solver": "euler"}, r"solver='euler' is not one of rodas5p, rk4, adams"),
        ({"solver": "rk4"}, r"give the step, `dt=1e-4`"),
        ({"dt": 1e-3}, r"'rk4', and no other method, takes fixed steps"),
        ({"solver": "rk4", "dt": -1.0}, r"dt=-1.0: the step inside the unit must be positive"),
    ],
)
def test_wrong_solvers(options, message, tmp_path):
    with pytest.raises(ExportError, match=message):
        ac.fmi.export(ac.compile(Oscillator()), tmp_path / "a.fmu", **options)
