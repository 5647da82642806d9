"""Output at the time of an event is what follows it, whatever the rounding of the located time."""

from __future__ import annotations

from typing import Any

import diffrax
import numpy as np
import pytest
from numpy.testing import assert_array_equal

import acausal as ac
from acausal import Component, Equations, Parameter, Variable, der, where
from acausal.errors import SimulationError


class Switched(Component):
    """``x' = -x`` until `at`, then ``x' = y - x`` with y = 1; stiff company moves the steps off round times."""

    at: Parameter = Parameter(1.0, unit="s")
    x: Variable = Variable(start=0.3, fixed=True)
    y: Variable = Variable()
    z: Variable = Variable(start=1.0, fixed=True)

    def equations(self) -> Equations:
        yield self.y == where(ac.time < self.at, 0.0, 1.0)
        yield der(self.x) == self.y - self.x
        yield der(self.z) == -37.0 * (self.z - self.x)


@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_output_at_the_time_of_an_event(engine: Any) -> None:
    system = ac.compile(Switched())
    for at in (0.1, 0.3, 0.7, 1.1, 1.7, 2.3, 2.9):
        t = np.array([0.0, 0.5 * at, at, 2.0 * at])
        solution = system.simulate(3.0 * at, parameters={"at": at}, saveat=t, engine=engine, rtol=1e-7)
        assert_array_equal(solution["y"], [0.0, 0.0, 1.0, 1.0], err_msg=f"at {at}")


@pytest.mark.parametrize("saveat", [diffrax.SaveAt(steps=True), diffrax.SaveAt(dense=True)], ids=["steps", "dense"])
def test_a_run_with_events_does_not_keep_the_steps_of_the_solver(saveat: Any) -> None:
    with pytest.raises(SimulationError, match=r"asks for the solver's own steps.*give output times"):
        ac.compile(Switched()).simulate(3.0, saveat=saveat)
