"""Conditions whose sides are equal at the start: rounding decides nothing."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.linalg import expm

import acausal as ac
from acausal import Component, Equations, Variable, connect, der, start, where
from acausal.components import electrical, rotational


class Resting(Component):
    """A shaft whose speed at the start follows from others, which cancel: 0.1 + 0.2 - 0.3 is 5e-17."""

    motor: rotational.Inertia = rotational.Inertia(J=1.0, phi=start(0.0, fixed=True))
    bearing: rotational.BearingFriction = rotational.BearingFriction(tau_pos=((0.0, 1.0), (1.0, 1.0)))
    shaft: rotational.Spring = rotational.Spring(c=10.0)
    load: rotational.Inertia = rotational.Inertia(J=2.0, w=start(0.0, fixed=True), a=start(0.25, fixed=True))

    def equations(self) -> Equations:
        yield connect(self.motor.flange_a, self.bearing.flange_a)
        yield connect(self.bearing.flange_b, self.shaft.flange_a)
        yield connect(self.shaft.flange_b, self.load.flange_a)

    def initial_equations(self) -> Equations:
        yield self.motor.w * 3.0 == 3.0 * (0.1 + 0.2 - self.load.w) - 0.9


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_what_rests_but_for_rounding_is_stuck(engine: Any) -> None:
    solution = ac.compile(Resting()).simulate(0.5, saveat=[0.0, 0.25, 0.5], rtol=1e-9, engine=engine)
    assert abs(solution["motor.w"][0]) < 1e-15
    assert_allclose(solution["bearing.mode"], 0.0)
    w = np.sqrt(5.0)
    assert_allclose(solution["load.phi"], -0.05 * np.cos(w * np.array([0.0, 0.25, 0.5])), atol=1e-7)


class Soon(Component):
    """x begins to rise at 1 s, and has passed 0 within the rounding of time."""

    x: Variable = Variable(start=-1e-10, fixed=True)
    y: Variable = Variable(start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) == where(ac.time < 1.0, 0.0, where(self.x > 0.0, 300.0, 3000.0))
        yield der(self.y) == where(ac.time < 1.0, 1.0, 0.0)


@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_what_has_just_switched_does_not_switch_back(engine: Any) -> None:
    """The second event is so soon that time is still at its threshold but for rounding, and moves away from it."""
    system = ac.compile(Soon())
    for x in (-1e-10, -3e-10, -1e-9):
        solution = system.simulate(2.0, engine=engine, initial={"x": x}, saveat=2)
        assert [len(event.causes) for event in solution.events] == [1, 1]
        assert abs(solution["x"][-1] - 300.0) < 1e-8
        assert abs(solution["y"][-1] - 1.0) < 1e-13


class SwitchedCapacitor(Component):
    """A capacitor carries charge from the source to another one, as a resistance of T/C would.

    At t = 0 the clock's time in its period is its width but for rounding, and the first charge takes 1e-8 s.
    """

    source: electrical.ConstantVoltage = electrical.ConstantVoltage(V=1.0)
    carrier: electrical.Capacitor = electrical.Capacitor(C=1e-8, v=start(0.0, fixed=True))
    store: electrical.Capacitor = electrical.Capacitor(C=1e-7, v=start(0.0, fixed=True))
    switch: electrical.ControlledIdealTwoWaySwitch = electrical.ControlledIdealTwoWaySwitch(Ron=1.0, Goff=1e-9)
    clock: electrical.PulseVoltage = electrical.PulseVoltage(V=1.0, period=1e-3, width=50.0, startTime=5e-4)
    ground: electrical.Ground = electrical.Ground()

    def equations(self) -> Equations:
        yield connect(self.source.p, self.switch.n1)
        yield connect(self.switch.p, self.carrier.p)
        yield connect(self.switch.n2, self.store.p)
        yield connect(self.clock.p, self.switch.control)
        yield connect(self.source.n, self.carrier.n, self.store.n, self.clock.n, self.ground.p)


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_a_clock_that_begins_at_its_switch(engine: Any) -> None:
    times = np.arange(11) * 5e-4
    solution = ac.compile(SwitchedCapacitor()).simulate(5e-3, engine=engine, rtol=1e-9, saveat=times)
    assert_allclose([e.t for e in solution.events], times[1:], rtol=1e-12)
    state, expected = np.zeros(2), [np.zeros(2)]
    for k in range(10):  # each half of a period is linear
        g = np.array([1.0, 1e-9])[:: 1 - 2 * (k % 2)]  # to the source, to the store
        a = np.array([[-(g[0] + g[1]) / 1e-8, g[1] / 1e-8], [g[1] / 1e-7, -g[1] / 1e-7]])
        rest = -np.linalg.solve(a, [g[0] / 1e-8, 0.0])
        state = rest + expm(5e-4 * a) @ (state - rest)
        expected.append(state)
    assert_allclose(solution["store.v"], np.array(expected)[:, 1], atol=1e-9)
