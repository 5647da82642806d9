"""Systems with events as participants in this process, against the same model in one piece."""

from __future__ import annotations

import diffrax
import numpy as np
import pytest

import acausal as ac
from acausal import Component, Equations, Input, Output, Variable, connect, der, start
from acausal.components import hydraulic as hy
from acausal.components import translational as tr
from acausal.fmi import CoSimulation, CoSimulationError, SystemParticipant, split
from acausal.fmi.participant import constant

from .export_models import Ends, Sampled, Thermostat
from .models import Decay, Gain

pytestmark = pytest.mark.skipif(
    ac.compile(Gain()).simulate(0.1).stats.get("engine") != "native", reason="there is no C compiler"
)


class Ball(Component):
    """A ball that bounces and counts, in a wind."""

    u: Input = Input(start=0.0)
    h: Output = Output(start=1.0, fixed=True)
    v: Variable = Variable(start=0.0, fixed=True)
    bounces: ac.Discrete = ac.Discrete(start=0)

    def equations(self) -> Equations:
        yield der(self.h) == self.v
        yield der(self.v) == -9.81 + self.u
        yield ac.when(self.h < 0, ac.reinit(self.v, -0.8 * ac.pre(self.v)), {self.bounces: ac.pre(self.bounces) + 1})


class Wind(Component):
    """Blows against what comes near."""

    u: Input = Input()
    y: Output = Output(start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield 0.2 * der(self.y) == 1.0 - 0.5 * self.u - self.y


class Both(Component):
    """The ball in the wind, in one piece."""

    ball: Ball = Ball()
    wind: Wind = Wind()

    def equations(self) -> Equations:
        yield self.wind.u == self.ball.h
        yield self.ball.u == self.wind.y


@pytest.fixture(scope="module")
def ball():
    return ac.compile(Ball())


OPTIONS = {
    "jacobi": {},
    "gauss-seidel": {"method": "gauss-seidel", "order": 2},
    "adaptive": {"tolerance": 1e-3},
    "implicit": {"iterations": 10},
}


@pytest.mark.parametrize("name", OPTIONS)
def test_a_ball_in_the_wind(ball, name):
    ball = SystemParticipant(ball, outputs=["bounces"])
    links = [("ball.h", "wind.u"), ("wind.y", "ball.u")]
    with CoSimulation({"ball": ball, "wind": ac.compile(Wind())}, links, step=0.02, **OPTIONS[name]) as master:
        result = master.simulate(2.0)
    wanted = ac.compile(Both()).simulate(2.0, saveat=result.t, rtol=1e-10)
    np.testing.assert_allclose(result["ball.h"], wanted["ball.h"], atol=2e-3)
    np.testing.assert_array_equal(result["ball.bounces"], wanted["ball.bounces"])
    assert result["ball.bounces"][-1] >= 2
    if name == "adaptive":
        assert result.stats["rejected"] > 0


@pytest.mark.parametrize(("solver", "dt"), [("rodas5p", None), ("rk4", 1e-3), ("adams", None)])
def test_a_step_over_a_bounce_is_taken_back(ball, solver, dt):
    """The counter, the mode of the condition and the velocity are as before; the same step leads to the same end."""
    part = SystemParticipant(ball, outputs=["bounces", "v"], solver=solver, dt=dt)
    still = constant([0.0])
    part.initialize(0.0, still)
    part.step(0.0, 0.4, still)
    before, saved = part.evaluate(0.4, still), part.save()
    part.step(0.4, 0.1, still)  # the ball falls for sqrt(2/9.81) = 0.4515 s
    after = part.evaluate(0.5, still)
    assert before[0, 1] == 0 and after[0, 1] == 1 and before[0, 2] < 0 < after[0, 2]
    part.restore(saved)
    np.testing.assert_array_equal(part.evaluate(0.4, still), before)
    part.step(0.4, 0.1, still)
    np.testing.assert_array_equal(part.evaluate(0.5, still)[0], after[0])
    drop = np.sqrt(2 / 9.81)
    up, s = 0.8 * 9.81 * drop, 0.5 - drop
    np.testing.assert_allclose(after[0, [0, 2]], [up * s - 4.905 * s * s, up - 9.81 * s], rtol=1e-5)


class StickSlip(Component):
    """A block with dry friction, pulled by a spring whose other end is a mass that a motor moves on at 0.1 m/s."""

    block: tr.MassWithStopAndFriction = tr.MassWithStopAndFriction(
        m=1.0, L=0.0, F_prop=0.1, F_Coulomb=1.0, F_Stribeck=1.0, fexp=50.0, s=start(0.0, fixed=True),
        v=start(0.0, fixed=True),
    )  # fmt: skip
    spring: tr.SpringDamper = tr.SpringDamper(c=20.0, d=0.2)
    hand: tr.Mass = tr.Mass(m=0.5, s=start(0.0, fixed=True), v=start(0.1, fixed=True))
    pull: tr.SpringDamper = tr.SpringDamper(c=500.0, d=5.0)
    drive: tr.ConstantSpeed = tr.ConstantSpeed(v_fixed=0.1, s=start(0.0, fixed=True))

    def equations(self) -> Equations:
        yield connect(self.drive.flange, self.pull.flange_a)
        yield connect(self.pull.flange_b, self.hand.flange_a)
        yield connect(self.hand.flange_b, self.spring.flange_a)
        yield connect(self.spring.flange_b, self.block.flange_a)


class Relief(Component):
    """A pump fills a volume until the relief valve behind a line opens (a kink, which needs no event)."""

    oil: hy.Oil = ac.inner(hy.Oil(B=1e9))
    tank: hy.Tank = hy.Tank(p=1e5)
    sump: hy.Tank = hy.Tank(p=1e5)
    pump: hy.FixedPump = hy.FixedPump(V_disp=1e-5, omega=20.0)
    volume: hy.ControlVolume = hy.ControlVolume(V=1e-3, p=start(1e5, fixed=True))
    line: hy.LaminarRestriction = hy.LaminarRestriction(G=1e-10)
    valve: hy.ControlVolume = hy.ControlVolume(V=1e-3, p=start(1e5, fixed=True))
    relief: hy.ReliefValve = hy.ReliefValve(p_set=2e6, dp_open=5e5)

    def equations(self) -> Equations:
        yield connect(self.tank.port, self.pump.port_a)
        yield connect(self.sump.port, self.relief.port_b)
        yield connect(self.pump.port_b, self.volume.port, self.line.port_a)
        yield connect(self.line.port_b, self.valve.port, self.relief.port_a)


@pytest.mark.slow
def test_stick_and_slip_split_from_the_drive():
    cut = split(StickSlip(), "spring.flange_a", names=("block", "drive"))
    record = ["block.s", "block.v", "block.mode"]
    with cut.cosimulation(record=record, step=0.002, method="gauss-seidel", order=2) as master:
        result = master.simulate(6.0)
    assert master.participants["block"].system.hybrid is not None
    wanted = cut.whole.simulate(6.0, saveat=result.t, rtol=1e-9)
    np.testing.assert_allclose(result["block.s"], wanted["block.s"], atol=2e-4)
    stuck = np.asarray(wanted["block.mode"]) == 0.0
    assert 0.2 < stuck.mean() < 0.95 and np.diff(stuck.astype(int)).clip(min=0).sum() >= 2
    assert (np.asarray(result["block.mode"]) == 0.0)[stuck].mean() > 0.98


def test_a_relief_valve_split_from_its_pump():
    cut = split(Relief(), "line.port_b", names=("pump", "relief"))
    record = ["relief.opening", "valve.p"]
    with cut.cosimulation(record=record, step=1e-3, order=1) as master:
        result = master.simulate(2.0)
    wanted = cut.whole.simulate(2.0, saveat=result.t, rtol=1e-9)
    opening = np.asarray(wanted["relief.opening"])
    assert opening[1] == 0.0 and 0.02 < opening[-1] < 1.0
    np.testing.assert_allclose(result["valve.p"], wanted["valve.p"], atol=5e-3 * 2e6)


# ---- inputs that jump -----------------------------------------------------------------------------
def test_an_input_that_jumps_switches_at_once():
    """The outputs at the communication point are those after the switch, and looking at them changes nothing."""

    class Switch(Component):
        u: Input = Input()
        y: Output = Output()
        x: Variable = Variable(start=0.0, fixed=True)
        count: ac.Discrete = ac.Discrete(start=0)

        def equations(self) -> Equations:
            on = self.u >= 1.0
            yield self.y == ac.where(on, 5.0, self.u)
            yield der(self.x) == self.y
            yield ac.when(on, {self.count: ac.pre(self.count) + 1})

    part = SystemParticipant(ac.compile(Switch()), outputs=["count", "x"])
    low, high = constant([0.25]), constant([1.0])
    part.initialize(0.0, low)
    part.step(0.0, 1.0, low)
    for _ in range(2):
        np.testing.assert_allclose(part.evaluate(1.0, high)[0], [5.0, 1.0, 0.25], rtol=1e-9)
        np.testing.assert_allclose(part.evaluate(1.0, low)[0], [0.25, 0.0, 0.25], rtol=1e-9)
    part.step(1.0, 1.0, high)
    np.testing.assert_allclose(part.evaluate(2.0, high)[0], [5.0, 1.0, 5.25], rtol=1e-9)
    part.step(2.0, 1.0, low)
    np.testing.assert_allclose(part.evaluate(3.0, low)[0], [0.25, 1.0, 5.5], rtol=1e-9)


def test_a_threshold_within_a_step():
    """A thermostat in a room that warms on its own: switches in the middle of long steps."""
    heat = {"t.u": lambda t: 0.2 * np.sin(t)}
    thermostat = SystemParticipant(ac.compile(Thermostat()), outputs=["T", "on"])
    with CoSimulation({"t": thermostat}, [], inputs=heat, step=0.5) as master:
        result = master.simulate(20.0)
    times = np.linspace(0.0, 20.0, 4001)
    wanted = ac.compile(Thermostat()).simulate(
        20.0, saveat=result.t, rtol=1e-9, inputs={"u": (times, 0.2 * np.sin(times))}
    )
    np.testing.assert_allclose(result["T"], wanted["T"], atol=2e-3)
    np.testing.assert_array_equal(result["on"], wanted["on"])
    assert 2 <= np.abs(np.diff(result["on"])).sum()


def test_samples_are_taken_in_and_at_the_ends_of_steps():
    for step in (0.25, 0.1):
        part = SystemParticipant(ac.compile(Sampled()), outputs=["x", "u"])
        with CoSimulation({"s": part}, [], step=step) as master:
            result = master.simulate(2.0)
        wanted = ac.compile(Sampled()).simulate(2.0, saveat=result.t, rtol=1e-9)
        np.testing.assert_allclose(result["x"], wanted["x"], atol=1e-6)
        assert len(set(np.round(result["u"], 9))) > 6


# ---- ends and errors ------------------------------------------------------------------------------
def test_a_model_that_ends_the_simulation():
    part = SystemParticipant(ac.compile(Ends()), outputs=["x"], name="e")
    with CoSimulation({"e": part, "d": ac.compile(Decay())}, [], step=0.05) as master:
        with pytest.warns(UserWarning, match="x is large"):
            result = master.simulate(2.0, throw=False)
    assert result.t[-1] == pytest.approx(0.75)
    assert result.result == "participant `e` ends the simulation at t = 0.8 s: x has reached 0.8"


def test_an_assertion_that_fails():
    class Limited(Component):
        u: Input = Input()
        x: Output = Output(start=0.0, fixed=True)

        def equations(self) -> Equations:
            yield der(self.x) == self.u
            yield ac.assert_(self.x < 0.5, "the tank is full")

    with CoSimulation({"tank": ac.compile(Limited())}, [], inputs={"tank.u": 1.0}, step=0.1) as master:
        message = r"participant `tank`: At t = 0\.5.* does not hold: the tank is full"
        with pytest.raises(CoSimulationError, match=message):
            master.simulate(1.0)


def test_what_needs_generated_code(ball):
    with pytest.raises(CoSimulationError, match=r"participant `ball` has `when` statements .* solver='rodas5p'"):
        SystemParticipant(ball, solver=diffrax.Tsit5(), name="ball")
