"""Friction with support, in series, on a belt and in mechanisms, beside equations and modes written by hand."""

from __future__ import annotations

import functools
from typing import Any

import jax
import numpy as np
import pytest
from scipy.integrate import solve_ivp

import acausal as ac
from acausal import (
    Component,
    DeclarationError,
    Equations,
    Parameter,
    SimulationError,
    Variable,
    connect,
    der,
    inner,
    start,
)
from acausal.components import blocks, rotational, thermal
from acausal.components import multibody as mb
from acausal.components import translational as tr
from acausal.components.examples import assemble

BOTH = ["native", pytest.param("diffrax", marks=pytest.mark.slow)]


class Belt(Component):
    """A mass on a moving belt, held by a spring; friction falls with the speed, so it sticks and slips."""

    m: Parameter = Parameter(2.0, unit="kg")
    c: Parameter = Parameter(50.0, unit="N/m")
    v_belt: Parameter = Parameter(0.5, unit="m/s")
    belt: tr.ConstantSpeed = tr.ConstantSpeed(v_fixed=v_belt)
    friction: tr.SupportFriction = tr.SupportFriction(useSupport=True, f_pos=[[0, 8], [4, 4]], peak=1.25)
    mass: tr.Mass = tr.Mass(m=m, s=start(0.0, fixed=True), v=start(0.0, fixed=True))
    spring: tr.Spring = tr.Spring(c=c)
    wall: tr.Fixed = tr.Fixed()

    def equations(self) -> Equations:
        yield connect(self.wall.flange, self.spring.flange_a)
        yield connect(self.spring.flange_b, self.mass.flange_a)
        yield connect(self.mass.flange_b, self.friction.flange_a)
        yield connect(self.belt.flange, self.friction.support)


def belt_by_hand(t1: float, c: float = 50.0, v_belt: float = 0.5) -> tuple[np.ndarray, list[float]]:
    """Position and velocity of the mass at t1, and the times at which it sticks and lets go."""
    m, events = 2.0, list[float]()

    def slide(t: float, y: np.ndarray) -> list[float]:
        return [y[1], (8.0 - abs(y[1] - v_belt) - c * y[0]) / m]

    def sticks(t: float, y: np.ndarray) -> float:
        return y[1] - v_belt

    sticks.terminal, sticks.direction = True, 1  # type: ignore[attr-defined]
    t, y = 0.0, np.zeros(2)
    while True:
        run = solve_ivp(slide, (t, t1), y, events=sticks, rtol=1e-12, atol=1e-13, method="DOP853")
        if run.status == 0:
            return run.y[:, -1], events
        t, s = float(run.t[-1]), run.y[0, -1]
        free = t + (1.25 * 8.0 / c - s) / v_belt
        events.append(t)
        if free > t1:
            return np.array([s + v_belt * (t1 - t), v_belt]), events
        events.append(free)
        t, y = free, np.array([1.25 * 8.0 / c, v_belt])


@functools.cache
def belt() -> ac.System:
    return ac.compile(Belt())


@pytest.mark.parametrize("engine", BOTH)
@pytest.mark.parametrize("rtol", [1e-4, 1e-7, 1e-10])
def test_a_mass_on_a_belt_sticks_and_slips(engine: Any, rtol: float) -> None:
    end, times = belt_by_hand(10.0)
    solution = belt().simulate(10.0, engine=engine, rtol=rtol, saveat=2)
    found = np.array([event.t for event in solution.events])
    assert len(times) > 12
    assert max(np.abs(found - t).min() for t in times) < max(10 * rtol, 1e-10)
    assert abs(solution["mass.s"][-1] - end[0]) < max(10 * rtol, 1e-10)
    assert abs(solution["mass.v"][-1] - end[1]) < max(10 * rtol, 1e-10)


@pytest.mark.parametrize("engine", BOTH)
def test_derivatives_of_what_sticks_and_slips(engine: Any) -> None:
    def end(c: Any, v_belt: Any) -> Any:
        p = {"c": c, "v_belt": v_belt}
        return belt().simulate(3.0, parameters=p, engine=engine, rtol=1e-10, saveat=2)["mass.s"][-1]

    slopes = jax.grad(end, argnums=(0, 1))(50.0, 0.5)
    by_c = (belt_by_hand(3.0, c=50.001)[0][0] - belt_by_hand(3.0, c=49.999)[0][0]) / 2e-3
    by_v = (belt_by_hand(3.0, v_belt=0.50001)[0][0] - belt_by_hand(3.0, v_belt=0.49999)[0][0]) / 2e-5
    assert abs(slopes[0] / by_c - 1) < 1e-5
    assert abs(slopes[1] / by_v - 1) < 1e-5


class Dogs(Component):
    """A shaft on two gears; the clutch of the one opens as that of the other closes, while both carry."""

    motor: rotational.ConstantTorque = rotational.ConstantTorque(tau_constant=100.0)
    shaft: rotational.Inertia = rotational.Inertia(J=0.02)
    first: rotational.IdealGear = rotational.IdealGear(ratio=12.0)
    second: rotational.IdealGear = rotational.IdealGear(ratio=6.0)
    low: rotational.Clutch = rotational.Clutch(fn_max=2e4)
    high: rotational.Clutch = rotational.Clutch(fn_max=2e4)
    load: rotational.Inertia = rotational.Inertia(J=90.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True))
    early: blocks.Step = blocks.Step(height=-1.0, offset=1.0, startTime=4.4)
    late: blocks.Step = blocks.Step(startTime=4.4)

    def equations(self) -> Equations:
        yield connect(self.motor.flange, self.shaft.flange_a)
        yield connect(self.shaft.flange_b, self.first.flange_a, self.second.flange_a)
        yield connect(self.first.flange_b, self.low.flange_a)
        yield connect(self.second.flange_b, self.high.flange_a)
        yield connect(self.low.flange_b, self.high.flange_b, self.load.flange_a)
        yield connect(self.early.y, self.low.f_normalized)
        yield connect(self.late.y, self.high.f_normalized)

    def initial_equations(self) -> Equations:
        yield self.low.w_rel == 0


@pytest.mark.parametrize("engine", BOTH)
def test_one_clutch_takes_over_from_another(engine: Any) -> None:
    """The low gear turns the load with 1200 N m; then the high one brakes the shaft, and turns it with 600 N m."""
    low, high, J, tau = 90.0 + 144 * 0.02, 90.0 + 36 * 0.02, 0.02, 100.0
    w = 12 * tau / low * 4.4
    shaft, friction = 12 * w, 1e4
    slips = (shaft - 6 * w) / ((friction / 6 - tau) / J + 6 * friction / 90.0)
    at_end = w + friction / 90.0 * slips + 6 * tau / high * (5.0 - 4.4 - slips)
    system = ac.compile(Dogs())
    for rtol in (1e-6, 1e-9):
        solution = system.simulate(5.0, engine=engine, rtol=rtol, saveat=2)
        assert abs(solution["load.w"][-1] / at_end - 1) < 10 * rtol
        assert min(abs(event.t - 4.4 - slips) for event in solution.events) < 1e-9


class Furuta(Component):
    """A pendulum on a turning arm, whose bearing has dry friction."""

    world: mb.World = inner(mb.World(g=9.81))
    arm: mb.Revolute = mb.Revolute(
        n=(0.0, 1.0, 0.0), useAxisFlange=True, phi=start(0.0, fixed=True), w=start(2.0, fixed=True)
    )
    bearing: rotational.BearingFriction = rotational.BearingFriction(useSupport=True, tau_pos=[[0, 0.05]])
    bar: mb.BodyShape = mb.BodyShape(r=(0.3, 0.0, 0.0), r_CM=(0.15, 0.0, 0.0), m=0.2, I_22=0.002)
    hinge: mb.Revolute = mb.Revolute(n=(1.0, 0.0, 0.0), phi=start(2.0, fixed=True), w=start(0.0, fixed=True))
    rod: mb.Body = mb.Body(m=0.1, r_CM=(0.0, 0.2, 0.0), I_11=0.001, I_22=0.0001, I_33=0.001)

    def equations(self) -> Equations:
        yield connect(self.world.frame_b, self.arm.frame_a)
        yield connect(self.arm.frame_b, self.bar.frame_a)
        yield connect(self.bar.frame_b, self.hinge.frame_a)
        yield connect(self.hinge.frame_b, self.rod.frame_a)
        yield connect(self.arm.axis, self.bearing.flange_a)
        yield connect(self.arm.support, self.bearing.support)


def furuta_by_hand(t1: float) -> tuple[np.ndarray, list[float]]:
    """Angles and speeds of arm and pendulum at t1 by Lagrange's equations, and when the arm stops or goes.

    With the arm's length a and the centre of mass at h: ``M11 = arm + (Jx - Jy + m h^2) sin^2``, ``M12 = -m a h cos``
    and ``M22 = Jx + m h^2``.
    """
    m, a, h, g, friction = 0.1, 0.3, 0.2, 9.81, 0.05
    J, along = 0.001 + m * h * h, 0.0001
    arm = 0.002 + 0.2 * 0.15**2 + m * a * a + along

    def parts(y: np.ndarray) -> tuple[float, float, float, float]:
        """M11, M12, and what accelerates each coordinate without friction."""
        sin, cos, w, b = np.sin(y[1]), np.cos(y[1]), y[2], y[3]
        of_arm = -2 * (J - along) * sin * cos * w * b - m * a * h * sin * b * b
        of_rod = (J - along) * sin * cos * w * w + m * g * h * sin
        return arm + (J - along) * sin**2, -m * a * h * cos, of_arm, of_rod

    def field(t: float, y: np.ndarray, mode: int) -> list[float]:
        M11, M12, q1, q2 = parts(y)
        if mode == 0:
            return [0.0, y[3], 0.0, q2 / J]
        q1 -= mode * friction
        det = M11 * J - M12**2
        return [y[2], y[3], (J * q1 - M12 * q2) / det, (M11 * q2 - M12 * q1) / det]

    def holds(y: np.ndarray) -> float:
        _, M12, q1, q2 = parts(y)
        return q1 - M12 * q2 / J

    def switch(t: float, y: np.ndarray, mode: int) -> float:
        return mode * y[2] if mode else friction - abs(holds(y))

    switch.terminal, switch.direction = True, -1  # type: ignore[attr-defined]
    t, y, mode, events = 0.0, np.array([0.0, 2.0, 2.0, 0.0]), 1, list[float]()
    while True:
        how: dict[str, Any] = {"rtol": 1e-11, "atol": 1e-13, "method": "DOP853", "max_step": 0.02}
        run = solve_ivp(field, (t, t1), y, events=switch, args=(mode,), **how)
        t, y = float(run.t[-1]), run.y[:, -1]
        if run.status == 0:
            return y, events
        events.append(t)
        y[2] = 0.0
        mode = 0 if mode and abs(holds(y)) <= friction else int(np.sign(holds(y)))


@pytest.mark.parametrize("engine", BOTH)
def test_an_arm_with_dry_friction_under_a_pendulum(engine: Any) -> None:
    end, times = furuta_by_hand(3.0)
    solution = ac.compile(Furuta()).simulate(3.0, engine=engine, rtol=1e-9, saveat=2)
    found = np.array([event.t for event in solution.events])
    assert len(times) >= 6
    assert max(np.abs(found - t).min() for t in times) < 1e-8
    assert abs(solution["arm.phi"][-1] - end[0]) < 1e-8
    assert abs(solution["hinge.phi"][-1] - end[1]) < 1e-8


class Rotor(Component):
    bearing: rotational.BearingFriction = rotational.BearingFriction()
    inertia: rotational.Inertia = rotational.Inertia(phi=start(0.0, fixed=True), w=start(1.0, fixed=True))

    def equations(self) -> Equations:
        yield connect(self.inertia.flange_b, self.bearing.flange_a)


@pytest.mark.parametrize(
    ("table", "text"),
    [
        ([[0, -1]], r"BearingFriction\(tau_pos=\[\[0.0, -1.0\]\]\): torque must not be negative"),
        ([[0, 1, 2]], r"takes rows \(speed, torque\)"),
        ([], r"takes rows \(speed, torque\)"),
        ([[0, 1], [0, 2]], "begin at 0 and increase"),
        ([[0.5, 1], [1, 2]], "begin at 0 and increase"),
    ],
)
def test_tables_of_friction_are_checked(table: list[list[float]], text: str) -> None:
    with pytest.raises(DeclarationError, match=text) as caught:
        ac.compile(Rotor(bearing=rotational.BearingFriction(tau_pos=table)))
    assert "test_friction_trains.py" in str(caught.value)


@pytest.mark.parametrize(
    ("table", "text"),
    [
        ([[0, 0.9, 0.9]], r"takes rows \(speed, eta_mf1, eta_mf2, tau_bf1, tau_bf2\)"),
        ([[0, 0, 0.9, 0, 0]], "eta_mf1 has to be above 0 and at most 1"),
        ([[0, 0.9, 1.1, 0, 0]], "eta_mf2 has to be above 0 and at most 1"),
        ([[0, 0.9, 0.9, 0, -1]], "tau_bf2 must not be negative"),
    ],
)
def test_tables_of_losses_are_checked(table: list[list[float]], text: str) -> None:
    class Geared(Component):
        inertia: rotational.Inertia = rotational.Inertia()
        gear: rotational.LossyGear = rotational.LossyGear(ratio=2.0, lossTable=table)

        def equations(self) -> Equations:
            yield connect(self.inertia.flange_b, self.gear.flange_a)

    with pytest.raises(DeclarationError, match=text):
        ac.compile(Geared())


def test_a_mass_that_starts_beyond_its_stops_is_an_error() -> None:
    class Slide(Component):
        mass: tr.MassWithStopAndFriction = tr.MassWithStopAndFriction(
            L=0.2, smin=0.1, smax=0.9, s=start(0.5, fixed=True), v=start(0.0, fixed=True)
        )

    system = ac.compile(Slide())
    moving = {"mass.s": 0.8, "mass.v": 1.0}, {"mass.s": 0.2, "mass.v": -1.0}
    for initial in ({"mass.s": 0.81}, {"mass.s": 0.19}, *moving):
        with pytest.raises(SimulationError, match=r"assertion of mass .* start between smin and smax"):
            system.simulate(0.1, initial=initial)
    for initial in ({"mass.s": 0.8, "mass.v": -1.0}, {"mass.s": 0.2}):
        assert 0.2 <= system.simulate(0.1, initial=initial)["mass.s"][-1] < 0.8
    with pytest.raises(SimulationError, match="start between smin and smax"):
        system.simulate(0.1, parameters={"mass.L": 1.0})


FALLING = [[0.0, 0.4], [10.0, 0.2]]


@pytest.mark.parametrize("engine", BOTH)
@pytest.mark.parametrize(
    ("rotor", "friction", "field"),
    [
        (rotational.Inertia(), rotational.BearingFriction(tau_pos=FALLING), "tau_pos"),
        (rotational.Inertia(), rotational.Brake(mu_pos=FALLING), "mu_pos"),
        (tr.Mass(), tr.SupportFriction(f_pos=FALLING), "f_pos"),
        (tr.Mass(), tr.Brake(mu_pos=FALLING), "mu_pos"),
    ],
)
def test_friction_is_not_continued_to_where_it_drives(
    rotor: Component, friction: Component, field: str, engine: Any
) -> None:
    """Falling friction is continued by a line, beyond 20 rad/s to less than none."""
    pressed = ["press.y - friction.f_normalized"] if field == "mu_pos" else []
    model = assemble(
        "rotor.flange_b - friction.flange_a", *pressed, rotor=rotor, friction=friction, press=blocks.Constant(k=1.0)
    )
    speed = "rotor.v" if isinstance(rotor, tr.Mass) else "rotor.w"
    system = ac.compile(model)
    slow = system.simulate(1.0, initial={speed: 19.0}, engine=engine)
    assert 18.0 < slow[speed][-1] < 19.0
    text = rf"assertion of friction .* beyond its last row `{field}` is continued below zero, and drives: end it with"
    with pytest.raises(SimulationError, match=text):
        system.simulate(1.0, initial={speed: 30.0}, engine=engine)


@pytest.mark.parametrize("clutch", [rotational.Clutch(mu_pos=FALLING), rotational.OneWayClutch(mu_pos=FALLING)])
def test_a_clutch_that_is_open_may_turn_faster_than_its_table(clutch: Component) -> None:
    model = assemble(
        "press.y - clutch.f_normalized", "slow.flange_b - clutch.flange_a", "clutch.flange_b - fast.flange_a",
        press=blocks.Constant(k=0.0), clutch=clutch, slow=rotational.Inertia(w=start(0.0, fixed=True)),
        fast=rotational.Inertia(w=start(30.0, fixed=True)),
    )  # fmt: skip
    system = ac.compile(model)
    assert system.simulate(1.0)["fast.w"][-1] == 30.0
    with pytest.raises(SimulationError, match=r"assertion of clutch .* `mu_pos` is continued below zero"):
        system.simulate(1.0, parameters={"press.k": 1.0})


@pytest.mark.parametrize(
    ("last", "text"),
    [
        ((10.0, 0.95, 0.9, 1.0, 1.0), "lossTable` is continued to eta_mf1 above 1"),
        ((10.0, 0.9, 0.95, 1.0, 1.0), "lossTable` is continued to eta_mf2 above 1"),
        ((10.0, 0.9, 0.9, 0.4, 1.0), "lossTable` is continued to tau_bf1 below 0"),
        ((10.0, 0.9, 0.9, 1.0, 0.4), "lossTable` is continued to tau_bf2 below 0"),
    ],
)
def test_losses_are_not_continued_to_where_they_drive(last: tuple[float, ...], text: str) -> None:
    model = assemble(
        "motor.flange - rotor.flange_a", "rotor.flange_b - gear.flange_a", "gear.flange_b - load.flange_a",
        motor=rotational.ConstantTorque(tau_constant=20.0), rotor=rotational.Inertia(w=start(0.0, fixed=True)),
        gear=rotational.LossyGear(lossTable=[[0.0, 0.9, 0.9, 1.0, 1.0], list(last)]), load=rotational.Inertia(),
    )  # fmt: skip
    system = ac.compile(model)
    slow = system.simulate(0.5)
    assert 2.0 < slow["rotor.w"][-1] < 10.0
    with pytest.raises(SimulationError, match=rf"assertion of gear .*{text}: end it with a row at a higher speed"):
        system.simulate(1.0, initial={"rotor.w": 40.0})


class Housing(Component):
    """Motor, lossy gear and brake in a housing on an elastic mount; all that is lost heats one body."""

    sine: blocks.Sine = blocks.Sine(amplitude=30.0, f=0.4)
    motor: rotational.Torque = rotational.Torque(useSupport=True)
    rotor: rotational.Inertia = rotational.Inertia(J=0.05, phi=start(0.0, fixed=True), w=start(0.0, fixed=True))
    gear: rotational.LossyGear = rotational.LossyGear(
        ratio=-4.0, useSupport=True, useHeatPort=True,
        lossTable=[[0, 0.9, 0.85, 0.5, 0.6], [50, 0.95, 0.9, 1.0, 1.1], [500, 0.95, 0.9, 1.0, 1.1]],
    )  # fmt: skip
    load: rotational.Inertia = rotational.Inertia(J=1.0)
    brake: rotational.Brake = rotational.Brake(
        useSupport=True, useHeatPort=True, fn_max=100.0, peak=1.1, mu_pos=[[0, 0.2], [5, 0.15], [500, 0.15]]
    )
    press: blocks.Pulse = blocks.Pulse(period=1.7, width=40.0, startTime=0.9)
    house: rotational.Inertia = rotational.Inertia(J=0.5, phi=start(0.0, fixed=True), w=start(0.0, fixed=True))
    mount: rotational.SpringDamper = rotational.SpringDamper(c=500.0, d=5.0, useHeatPort=True)
    wall: rotational.Fixed = rotational.Fixed()
    oil: thermal.HeatCapacitor = thermal.HeatCapacitor(C=1000.0, T=start(300.0, fixed=True))
    work: Variable = Variable(unit="J", start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield connect(self.sine.y, self.motor.tau)
        yield connect(self.press.y, self.brake.f_normalized)
        yield connect(self.motor.flange, self.rotor.flange_a)
        yield connect(self.rotor.flange_b, self.gear.flange_a)
        yield connect(self.gear.flange_b, self.load.flange_a)
        yield connect(self.load.flange_b, self.brake.flange_a)
        yield connect(self.motor.support, self.house.flange_a, self.gear.support, self.brake.support)
        yield connect(self.house.flange_b, self.mount.flange_b)
        yield connect(self.mount.flange_a, self.wall.flange)
        yield connect(self.gear.heatPort, self.brake.heatPort, self.mount.heatPort, self.oil.port)
        yield der(self.work) == self.motor.tau * (self.rotor.w - self.house.w)


@pytest.mark.parametrize("engine", BOTH)
def test_a_gear_and_a_brake_in_an_elastic_housing_keep_the_energy(engine: Any) -> None:
    solution = ac.compile(Housing()).simulate(6.0, engine=engine, rtol=1e-8, saveat=601)
    rotor, load, house, phi = (np.asarray(solution[n]) for n in ("rotor.w", "load.w", "house.w", "house.phi"))
    kept = 0.025 * rotor**2 + 0.5 * load**2 + 0.25 * house**2 + 250.0 * phi**2 + 1000.0 * (solution["oil.T"] - 300.0)
    work = np.asarray(solution["work"])
    assert {-1.0, 0.0, 1.0} <= set(np.asarray(solution["gear.mode"]).tolist())  # it turns both ways, and stands
    np.testing.assert_allclose(kept, work, atol=1e-5 * work.max())


@pytest.mark.parametrize(
    ("part", "text"),
    [
        (tr.EndStops(s_min=1.0, s_max=0.5), "the lower bumper is above the upper one, s_min > s_max"),
        (blocks.DeadZone(uMax=-1.0, uMin=1.0), "the ends of a DeadZone are uMin <= uMax"),
    ],
)
def test_ends_in_the_wrong_order_are_an_error(part: Component, text: str) -> None:
    link = "mass.flange_b - part.flange" if isinstance(part, tr.EndStops) else "wave.y - part.u"
    mass = tr.Mass(s=start(0.0, fixed=True), v=start(0.0, fixed=True))
    model = assemble(link, part=part, mass=mass, wave=blocks.Sine())
    with pytest.raises(SimulationError, match=rf"assertion of part .* {text}"):
        ac.compile(model).simulate(1.0)


def test_a_freewheel_that_begins_backwards_is_an_error() -> None:
    """It would be locked at that relative speed."""
    model = assemble(
        "press.y - clutch.f_normalized", "one.flange_b - clutch.flange_a", "clutch.flange_b - two.flange_a",
        press=blocks.Constant(k=0.0), clutch=rotational.OneWayClutch(),
        one=rotational.Inertia(w=start(1.0, fixed=True)), two=rotational.Inertia(w=start(1.0, fixed=True)),
    )  # fmt: skip
    system = ac.compile(model)
    assert system.simulate(1.0, initial={"two.w": 2.0})["two.w"][-1] == 2.0
    assert system.simulate(1.0)["two.w"][-1] == 1.0
    with pytest.raises(SimulationError, match=r"assertion of clutch .* flange b turns slower than flange a"):
        system.simulate(1.0, initial={"two.w": 0.5})
