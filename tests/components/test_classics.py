"""Textbook systems from library components against equations written by hand, followed by SciPy."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

import acausal as ac
from acausal import Component, Equations, Input, Output, Parameter, Variable, connect, der, inner, sqrt, start
from acausal.components import blocks, planar, rotational, translational

ENGINES = pytest.mark.parametrize("engine", ["native", pytest.param("diffrax", marks=pytest.mark.slow)])
SLOW = pytest.mark.parametrize("engine", [pytest.param(e, marks=pytest.mark.slow) for e in ("native", "diffrax")])
AT_REST: dict[str, Any] = {"phi": start(0.0, fixed=True), "w": start(0.0, fixed=True)}


def follow(rate: Any, t: tuple[float, float], x: Any, **options: Any) -> Any:
    """SciPy's solution of ``dx/dt = rate(t, x)`` between two times."""
    return solve_ivp(rate, t, x, "DOP853", rtol=1e-11, atol=1e-12, **options)


class OpenTank(Component):
    """Torricelli's law; what is empty stays so."""

    q_in: Input = Input(unit="m3/s")
    q_out: Output = Output(unit="m3/s")
    A: Parameter = Parameter(1.0, unit="m2")
    hole: Parameter = Parameter(0.01, unit="m2")
    g: Parameter = Parameter(9.81, unit="m/s2")
    h: Variable = Variable(unit="m", start=1.0, fixed=True)

    def equations(self) -> Equations:
        yield self.A * der(self.h) == self.q_in - self.q_out
        yield self.q_out == self.hole * sqrt(2.0 * self.g * ac.max(self.h, 0.0))


class TwoTanks(Component):
    one: OpenTank = OpenTank()
    two: OpenTank = OpenTank(h=start(0.5, fixed=True))

    def equations(self) -> Equations:
        yield self.one.q_in == 0
        yield connect(self.one.q_out, self.two.q_in)


@ENGINES
def test_tanks_run_empty(engine: Any) -> None:
    """Where a tank has run empty, the slope of the root is infinite and that of what it is taken of zero."""
    solution = ac.compile(TwoTanks()).simulate(200.0, engine=engine, rtol=1e-8, saveat=[10.0, 30.0, 60.0, 200.0])
    a = 0.01 * np.sqrt(2.0 * 9.81)

    def rate(t: float, h: Any) -> Any:
        return a * (max(1.0 - a / 2.0 * t, 0.0) - np.sqrt(np.maximum(h, 0.0)))

    assert_allclose(solution["one.h"], [(1 - a * 5.0) ** 2, (1 - a * 15.0) ** 2, 0.0, 0.0], atol=1e-7)
    assert_allclose(solution["two.h"][:3], follow(rate, (0.0, 60.0), [0.5], t_eval=[10.0, 30.0, 60.0]).y[0], atol=1e-6)
    assert abs(solution["two.h"][-1]) < 1e-6


class Gearbox(Component):
    """A planetary gear whose ring is braked, let go at 2 s, and joined to the sun by a clutch from 2.5 s on."""

    motor: rotational.ConstantTorque = rotational.ConstantTorque(tau_constant=5.0)
    sun: rotational.Inertia = rotational.Inertia(J=0.1, **AT_REST)
    ring: rotational.Inertia = rotational.Inertia(J=0.2, **AT_REST)
    carrier: rotational.Inertia = rotational.Inertia(J=1.0)
    gear: rotational.IdealPlanetary = rotational.IdealPlanetary(ratio=2.0)
    load: rotational.Damper = rotational.Damper(d=0.5)
    wall: rotational.Fixed = rotational.Fixed()
    brake: rotational.Brake = rotational.Brake(fn_max=100.0)
    clutch: rotational.Clutch = rotational.Clutch(fn_max=100.0)
    first: blocks.Step = blocks.Step(height=-1.0, offset=1.0, startTime=2.0)
    direct: blocks.Step = blocks.Step(height=1.0, startTime=2.5)

    def equations(self) -> Equations:
        yield connect(self.motor.flange, self.sun.flange_a)
        yield connect(self.sun.flange_b, self.gear.sun, self.clutch.flange_a)
        yield connect(self.gear.ring, self.ring.flange_a)
        yield connect(self.ring.flange_b, self.brake.flange_a, self.clutch.flange_b)
        yield connect(self.gear.carrier, self.carrier.flange_a)
        yield connect(self.carrier.flange_b, self.load.flange_a)
        yield connect(self.load.flange_b, self.wall.flange)
        yield connect(self.first.y, self.brake.f_normalized)
        yield connect(self.direct.y, self.clutch.f_normalized)


@SLOW
def test_a_planetary_gear_shifts(engine: Any) -> None:
    def free(t: float, w: Any, tau: float = 0.0) -> Any:
        """Accelerations of sun and ring; `tau` is the clutch's torque."""
        a = np.array([[0.1, 0.0, 1.0], [0.0, 0.2, 2.0], [1.0 / 3.0, 2.0 / 3.0, -3.0]])
        return np.linalg.solve(a, [5.0 - tau, tau, -0.5 * (w[0] + 2.0 * w[1]) / 3.0])[:2]

    def together(t: float, w: Any) -> float:
        return w[0] - w[1]

    together.terminal = True  # type: ignore[attr-defined]
    low = 30.0 * (1.0 - np.exp(-0.5 * 2.0 / 1.9))  # 1.9 is the inertia at the carrier
    w = follow(free, (2.0, 2.5), [3.0 * low, 0.0]).y[:, -1]
    slip = 50.0 * np.sign(w[0] - w[1])
    end = follow(lambda t, w: free(t, w, slip), (2.5, 4.0), w, events=together)
    final = 10.0 + (end.y[0, -1] - 10.0) * np.exp(-0.5 * (4.0 - end.t[-1]) / 1.3)
    solution = ac.compile(Gearbox()).simulate(4.0, engine=engine, rtol=1e-10, saveat=[2.0, 2.5, 4.0])
    assert_allclose(solution["carrier.w"], [low, (w[0] + 2.0 * w[1]) / 3.0, final], atol=1e-8)
    assert min(abs(e.t - end.t[-1]) for e in solution.events) < 1e-8


class Crab(Component):
    """The crab of an overhead crane with a load on a rigid rope; a limited controller moves it by 1 m."""

    planarWorld: planar.PlanarWorld = inner(planar.PlanarWorld())
    wall: planar.Fixed = planar.Fixed()
    rail: planar.Prismatic = planar.Prismatic(useFlange=True, s=start(0.0, fixed=True), v=start(0.0, fixed=True))
    crab: planar.Body = planar.Body(m=10.0, I=0.0)
    hinge: planar.Revolute = planar.Revolute(phi=start(0.2 - np.pi / 2, fixed=True), w=start(0.0, fixed=True))
    rope: planar.FixedTranslation = planar.FixedTranslation(r=(2.0, 0.0))
    load: planar.Body = planar.Body(m=5.0, I=0.3)
    force: translational.Force = translational.Force()
    sensor: translational.PositionSensor = translational.PositionSensor()
    wanted: blocks.Constant = blocks.Constant(k=1.0)
    control: blocks.LimPID = blocks.LimPID(k=50.0, Ti=10.0, Td=1.0, yMax=30.0)

    def equations(self) -> Equations:
        yield connect(self.wall.frame, self.rail.frame_a)
        yield connect(self.rail.frame_b, self.crab.frame_a, self.hinge.frame_a)
        yield connect(self.hinge.frame_b, self.rope.frame_a)
        yield connect(self.rope.frame_b, self.load.frame_a)
        yield connect(self.rail.flange_a, self.force.flange, self.sensor.flange)
        yield connect(self.wanted.y, self.control.u_s)
        yield connect(self.sensor.s, self.control.u_m)
        yield connect(self.control.y, self.force.f)


@SLOW
def test_a_crab_is_moved_by_a_controller_at_its_limit(engine: Any) -> None:
    def rate(t: float, z: Any) -> list[float]:
        x, phi, v, w, integral, filtered = z
        d = 10.0 * (-x - filtered)
        wanted = 50.0 * (1.0 - x + integral + d)
        f = np.clip(wanted, -30.0, 30.0)
        s, c = np.sin(phi), np.cos(phi)
        a = [[15.0, -10.0 * s], [-10.0 * s, 20.3]]
        acc = np.linalg.solve(a, [f + 10.0 * c * w * w, -98.1 * c])
        return [v, w, acc[0], acc[1], (1.0 - x + (f - wanted) / 45.0) / 10.0, d]

    solution = ac.compile(Crab()).simulate(4.0, engine=engine, rtol=1e-9, saveat=[1.0, 2.0, 4.0])
    start_ = [0.0, 0.2 - np.pi / 2, 0.0, 0.0, 0.0, 0.0]
    expected = follow(rate, (0.0, 4.0), start_, t_eval=[1.0, 2.0, 4.0], max_step=2e-3).y
    assert_allclose(solution["rail.s"], expected[0], atol=1e-6)
    assert_allclose(solution["hinge.phi"], expected[1], atol=1e-6)
