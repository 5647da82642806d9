"""What each component with modes does at its events, against automata written by hand and followed with SciPy."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

import acausal as ac

from . import automata
from .automata import Case
from .hand_written import follow

CASES: tuple[Callable[[], Case], ...] = (
    automata.bearing_friction, automata.rotational_brake, automata.support_friction, automata.hard_stops,
    automata.clutch, automata.one_way_clutch, automata.lossy_gear, automata.elasto_gap, automata.elasto_backlash,
    automata.ideal_diode, automata.ideal_thyristor, automata.controlled_switch, automata.hysteresis,
    automata.triggered_sampler,
)  # fmt: skip


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
@pytest.mark.parametrize("made", CASES, ids=lambda made: made.__name__)
def test_transitions(made: Callable[[], Case], engine: Any) -> None:
    case = made()
    t = np.linspace(0.0, case.end, 400)
    path = follow(case.modes, case.begin, case.x, t)
    assert len(path.times) >= 3 and set(path.modes) == set(case.modes), "the automaton goes through all of its modes"
    solution = ac.compile(case.model).simulate(case.end, saveat=t, rtol=1e-9, engine=engine)
    at = np.array([event.t for event in solution.events])
    for time in path.times:
        assert np.abs(at - time).min() < 2e-7, f"nothing happens at t = {time:.9g} s"
    apart = np.abs(t[:, None] - np.array(path.times)).min(axis=1) > 1e-6
    for name, x in zip(case.states, path.x, strict=True):
        assert_allclose(np.asarray(solution[name])[apart], x[apart], atol=2e-6 * max(np.ptp(x), 1e-3), err_msg=name)
    for name in dict.fromkeys(n for mode in case.modes.values() for n in mode.shows):
        wanted = np.array([case.modes[mode].shows.get(name, np.nan) for mode in path.modes])
        said = apart & ~np.isnan(wanted)
        assert_allclose(np.asarray(solution[name])[said], wanted[said], err_msg=name)
