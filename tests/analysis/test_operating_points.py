"""Steady states and linearization about them, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

import acausal as ac
from acausal import Component, Discrete, Equations, Input, Output, Parameter, Variable, connect, der, sin, start, when
from acausal.components import blocks, electrical, rotational


class Pendulum(Component):
    """Driven by a torque; hangs at 0 and stands at pi."""

    tau: Input = Input(unit="1/s2")
    tip: Output = Output()
    w0: Parameter = Parameter(3.0, unit="1/s")
    d: Parameter = Parameter(0.1, unit="1/s")
    phi: Variable = Variable(start=0.1, fixed=True)
    w: Variable = Variable(unit="1/s", start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.phi) == self.w
        yield der(self.w) == self.tau - self.w0**2 * sin(self.phi) - self.d * self.w
        yield self.tip == 2.0 * sin(self.phi)


@pytest.fixture(scope="module")
def pendulum() -> ac.System:
    return ac.compile(Pendulum(), inputs=["tau"], outputs=["tip"])


def test_where_a_pendulum_rests(pendulum: ac.System) -> None:
    assert abs(pendulum.steady_state()["phi"]) < 1e-9
    assert_allclose(pendulum.steady_state(guess={"phi": 3.0})["phi"], np.pi)
    assert_allclose(pendulum.steady_state(guess=[3.0, 0.0])["phi"], np.pi)
    held = pendulum.steady_state(inputs={"tau": 4.5})
    assert_allclose([held["phi"], held["tau"], held["tip"]], [np.pi / 6.0, 4.5, 1.0], atol=1e-9)


def test_linear_about_an_operating_point(pendulum: ac.System) -> None:
    """The stiffness is ``w0^2 cos(phi)``; standing, one pole is positive."""
    held = pendulum.steady_state(inputs={"tau": 4.5})
    about = pendulum.linearize(x=held)
    stiffness = 9.0 * np.cos(np.pi / 6.0)
    assert_allclose(about.A, [[0.0, 1.0], [-stiffness, -0.1]], atol=1e-9)
    assert_allclose(about.B, [[0.0], [1.0]])
    assert_allclose(about.C, [[2.0 * np.cos(np.pi / 6.0), 0.0]])
    assert (about.states, about.inputs, about.outputs) == (("phi", "w"), ("tau",), ("tip",))
    standing = pendulum.linearize(x={"phi": np.pi}, outputs=["w"])
    assert_allclose(standing.poles, [-0.05 - np.sqrt(9.0025), -0.05 + np.sqrt(9.0025)])
    assert_allclose(standing.C, [[0.0, 1.0]])


def test_names_that_the_model_does_not_have(pendulum: ac.System) -> None:
    with pytest.raises(ac.UnknownNameError, match=r"no input `tua`. Did you mean `tau`"):
        pendulum.steady_state(inputs={"tua": 1.0})
    with pytest.raises(ac.UnknownNameError, match=r"no input `x`"):
        pendulum.linearize(inputs={"x": 1.0})
    with pytest.raises(ac.UnknownNameError, match=r"no variable `ph`. Did you mean `phi`"):
        pendulum.steady_state(guess={"ph": 3.0})


def test_what_turns_for_ever_has_no_steady_state() -> None:
    class Clock(Component):
        x: Variable = Variable(start=0.0, fixed=True)

        def equations(self) -> Equations:
            yield der(self.x) == 1.0

    with pytest.raises(ac.SimulationError, match=r"`Clock` has no steady state near the given start: `x`"):
        ac.compile(Clock()).steady_state()


class Motor(Component):
    """A motor from the libraries, with a torque on its shaft."""

    v: Input = Input(unit="V")
    load: Input = Input(unit="N.m")
    source: electrical.SignalVoltage = electrical.SignalVoltage()
    R: electrical.Resistor = electrical.Resistor(R=0.5)
    L: electrical.Inductor = electrical.Inductor(L=4.5e-3)
    emf: electrical.RotationalEMF = electrical.RotationalEMF(k=0.5)
    ground: electrical.Ground = electrical.Ground()
    rotor: rotational.Inertia = rotational.Inertia(J=0.02, w=start(0.0, fixed=True))
    bearing: rotational.Damper = rotational.Damper(d=0.01)
    wall: rotational.Fixed = rotational.Fixed()
    torque: rotational.Torque = rotational.Torque()

    def equations(self) -> Equations:
        yield self.source.v == self.v
        yield self.torque.tau == self.load
        yield connect(self.source.p, self.R.p)
        yield connect(self.R.n, self.L.p)
        yield connect(self.L.n, self.emf.p)
        yield connect(self.emf.n, self.source.n, self.ground.p)
        yield connect(self.emf.flange, self.rotor.flange_a, self.bearing.flange_a)
        yield connect(self.bearing.flange_b, self.wall.flange)
        yield connect(self.rotor.flange_b, self.torque.flange)


def test_the_gain_of_a_motor() -> None:
    """``w = (k v + R tau)/(k^2 + R d)`` at rest of the currents; the angle is left out: it goes on."""
    motor = ac.compile(Motor())
    about = motor.linearize(outputs=["rotor.w", "L.i"])
    keep = [k for k, name in enumerate(about.states) if "phi" not in name]
    a, b, c = about.A[np.ix_(keep, keep)], about.B[keep], about.C[:, keep]
    assert len(keep) == 2
    assert_allclose(np.poly(a), [1.0, 0.5 / 4.5e-3 + 0.5, (0.5 * 0.01 + 0.25) / (4.5e-3 * 0.02)])
    gain = -c @ np.linalg.solve(a, b)
    expected = np.array([[0.5, 0.5], [0.01, -0.5]]) / 0.255
    order = [about.inputs.index("v"), about.inputs.index("load")]
    assert_allclose(gain[:, order], expected, atol=1e-9)
    assert_allclose(motor.linearize(x={"emf.n.i": -4.0}, outputs=["L.i"]).x, [4.0, 0.0, 0.0])  # by any of their names
    with pytest.raises(ac.UnknownNameError, match=r"`rotor.a` follows from the states .*they are `L.i`"):
        motor.linearize(x={"rotor.a": 3.0})


class Amplifier(Component):
    """A transistor in common emitter circuit, with its charges and a capacitor at the emitter."""

    supply: electrical.ConstantVoltage = electrical.ConstantVoltage(V=12.0)
    Rc: electrical.Resistor = electrical.Resistor(R=2.2e3)
    R1: electrical.Resistor = electrical.Resistor(R=47e3)
    R2: electrical.Resistor = electrical.Resistor(R=10e3)
    Re: electrical.Resistor = electrical.Resistor(R=1e3)
    Ce: electrical.Capacitor = electrical.Capacitor(C=1e-4)
    T: electrical.NPN = electrical.NPN()
    ground: electrical.Ground = electrical.Ground()

    def equations(self) -> Equations:
        yield connect(self.supply.p, self.Rc.p, self.R1.p)
        yield connect(self.R1.n, self.R2.p, self.T.B)
        yield connect(self.Rc.n, self.T.C)
        yield connect(self.T.E, self.Re.p, self.Ce.p)
        yield connect(self.supply.n, self.R2.n, self.Re.n, self.Ce.n, self.ground.p)


@pytest.mark.slow
def test_the_bias_of_a_transistor() -> None:
    """From nothing charged, Newton's method alone does not find it: exponentials of 27 thermal voltages."""
    bias = ac.compile(Amplifier()).steady_state()
    vb, vc, ve = bias["T.B.v"], bias["T.C.v"], bias["T.E.v"]
    ib, ic = bias["T.B.i"], bias["T.C.i"]
    assert_allclose([(12.0 - vb) / 47e3 - vb / 10e3, (12.0 - vc) / 2.2e3, ve / 1e3], [ib, ic, ib + ic], rtol=1e-9)
    assert_allclose(ic / ib, 50.0 * (1.0 + 0.02 * (vc - vb)), rtol=1e-6)
    assert 0.7 < vb - ve < 0.8


class Stepped(Component):
    """A lag whose wanted value is a discrete variable, and one from the library."""

    x: Variable = Variable(start=0.0, fixed=True)
    wanted: Discrete = Discrete(start=2.0)
    lag: blocks.FirstOrder = blocks.FirstOrder(T=0.5, k=3.0)

    def equations(self) -> Equations:
        yield der(self.x) == self.wanted - self.x
        yield when(self.x > 10.0, {self.wanted: 0.0})
        yield self.lag.u == self.x


def test_discrete_variables_are_as_at_the_start() -> None:
    system = ac.compile(Stepped())
    found = system.steady_state()
    assert_allclose([found["x"], found["wanted"], found["lag.y"]], [2.0, 2.0, 6.0], atol=1e-9)
    assert_allclose(system.linearize(x=found).poles, [-2.0, -1.0])


class Cartesian(Component):
    """A pendulum of 2 m in coordinates that a constraint binds, index 3, with friction in proportion to its speed."""

    d: Parameter = Parameter(0.3)
    x: Variable = Variable(start=0.1, fixed=True)
    y: Variable = Variable(start=-2.0)
    u: Variable = Variable(start=0.0, fixed=True)
    v: Variable = Variable()
    tension: Variable = Variable()

    def equations(self) -> Equations:
        yield der(self.x) == self.u
        yield der(self.y) == self.v
        yield der(self.u) == -self.tension * self.x - self.d * self.u
        yield der(self.v) == -self.tension * self.y - self.d * self.v - 9.81
        yield self.x**2 + self.y**2 == 4.0


@pytest.mark.parametrize("up", [-1.0, 1.0])
def test_poles_are_those_of_what_the_constraints_leave_free(up: float) -> None:
    system = ac.compile(Cartesian())
    assert len(system.states) == 4
    about = system.linearize(x={"x": 0.0, "y": 2.0 * up, "u": 0.0, "v": 0.0, "tension": -up * 9.81 / 2.0})
    root = np.sqrt(complex(0.15**2 + up * 9.81 / 2.0))
    assert_allclose(about.poles, [-0.15 - root, -0.15 + root], atol=1e-9)
