"""Problems of the literature with known solutions whose index is above one, or changes on the way."""

from __future__ import annotations

from functools import cache
from math import log
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal import Component, Equations, Parameter, Variable, cos, der, exp, sin
from acausal.errors import SimulationError

ENGINES = ("native", "diffrax")


class AscherPetzold(Component):
    """Linear, index 2 in Hessenberg form, with an unstable mode for many methods where `stiffness` is large.

    Source: Ascher and Petzold (1991), Projected implicit Runge-Kutta methods for differential-algebraic equations,
    SIAM J. Numer. Anal. 28, 1097-1120.
    """

    stiffness: Parameter = Parameter(10.0)
    x: Variable = Variable(start=1.0, fixed=True)
    y: Variable = Variable()
    z: Variable = Variable()

    def equations(self) -> Equations:
        t, k, x, z = ac.time, self.stiffness, self.x, self.z
        yield der(x) == (k - 1 / (2 - t)) * x + (2 - t) * k * z + (3 - t) / (2 - t) * exp(t)
        yield der(self.y) == (1 - k) / (t - 2) * x - self.y + (k - 1) * z + 2 * exp(t)
        yield (t + 2) * x + (t**2 - 4) * self.y == (t**2 + t - 2) * exp(t)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("stiffness", [10.0, 50.0])
def test_hessenberg_index_2(engine: Any, stiffness: float) -> None:
    system = ac.compile(AscherPetzold())
    assert system.report().structural_index == 2
    solution = system.simulate(1.0, rtol=1e-9, parameters={"stiffness": stiffness}, engine=engine)
    t = np.asarray(solution.t)
    for name, exact in (("x", np.exp(t)), ("y", np.exp(t)), ("z", -np.exp(t) / (2 - t))):
        np.testing.assert_allclose(solution[name], exact, rtol=1e-6, err_msg=name)


class MovingKernel(Component):
    """Linear, index 2; the direction that its derivatives do not see turns with time.

    Source: Petzold and Gear (1982), ODE methods for the solution of differential/algebraic systems, Sandia Report
    SAND82-8051: BDF methods are unstable for `eta < -0.5`, and the implicit Euler method fails at -1.
    """

    eta: Parameter = Parameter(-1.0)
    x: Variable = Variable()
    y: Variable = Variable()

    def equations(self) -> Equations:
        drift = self.eta * ac.time
        yield self.x + drift * self.y == exp(-ac.time)
        yield der(self.x) + drift * der(self.y) + (1 + self.eta) * self.y == 0


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("eta", [-1.0, -0.5, 3.0])
def test_moving_kernel(engine: Any, eta: float) -> None:
    system = ac.compile(MovingKernel())
    assert system.report().structural_index == 2
    solution = system.simulate(3.0, rtol=1e-9, parameters={"eta": eta}, engine=engine)
    t = np.asarray(solution.t)
    np.testing.assert_allclose(solution["y"], np.exp(-t), rtol=1e-6)
    np.testing.assert_allclose(solution["x"], (1 - eta * t) * np.exp(-t), rtol=1e-6, atol=1e-9)


class Crane(Component):
    """Trolley and winch that carry a load along a given path: index 5.

    Source: Campbell (1995), High-index differential algebraic equations, Mech. Struct. Mach. 23, 199-222.
    """

    trolley: Parameter = Parameter(30.0, unit="kg")
    load: Parameter = Parameter(10.0, unit="kg")
    J: Parameter = Parameter(2.0, unit="kg.m2")
    radius: Parameter = Parameter(0.2, unit="m")
    g: Parameter = Parameter(9.81, unit="m/s2")
    d: Variable = Variable(unit="m", doc="position of the trolley")
    r: Variable = Variable(unit="m", doc="length of the rope", start=5.0)
    x: Variable = Variable(unit="m", doc="position of the load")
    z: Variable = Variable(unit="m", doc="depth of the load")
    theta: Variable = Variable(unit="rad", doc="angle of the rope to the vertical")
    tension: Variable = Variable(unit="N", start=100.0)
    force: Variable = Variable(unit="N", doc="on the trolley")
    torque: Variable = Variable(unit="N.m", doc="of the winch, against the rope")
    v_d: Variable = Variable(unit="m/s")
    v_r: Variable = Variable(unit="m/s")
    v_x: Variable = Variable(unit="m/s")
    v_z: Variable = Variable(unit="m/s")

    def equations(self) -> Equations:
        for position, speed in ((self.d, self.v_d), (self.r, self.v_r), (self.x, self.v_x), (self.z, self.v_z)):
            yield der(position) == speed
        yield self.load * der(self.v_x) == -self.tension * sin(self.theta)
        yield self.load * der(self.v_z) == -self.tension * cos(self.theta) + self.load * self.g
        yield self.trolley * der(self.v_d) == self.force + self.tension * sin(self.theta)
        yield self.J / self.radius * der(self.v_r) == self.tension * self.radius - self.torque
        yield self.x == self.d + self.r * sin(self.theta)
        yield self.z == self.r * cos(self.theta)
        yield self.x == 2 * sin(0.8 * ac.time)
        yield self.z == 5 + cos(0.6 * ac.time)


def crane_exactly(t: Any) -> dict[str, Any]:
    """From the path upwards: its accelerations give the rope's direction, this gives trolley and winch."""
    second = lambda f: jax.jacfwd(jax.jacfwd(f))  # noqa: E731
    x, z = lambda t: 2 * jnp.sin(0.8 * t), lambda t: 5 + jnp.cos(0.6 * t)
    across, down = lambda t: -10.0 * second(x)(t), lambda t: 10.0 * (9.81 - second(z)(t))
    tension = lambda t: jnp.hypot(across(t), down(t))  # noqa: E731
    d = lambda t: x(t) - z(t) * across(t) / down(t)  # noqa: E731
    r = lambda t: z(t) * tension(t) / down(t)  # noqa: E731
    force, torque = 30.0 * second(d)(t) - across(t), 0.2 * tension(t) - 10.0 * second(r)(t)
    return {"d": d(t), "r": r(t), "tension": tension(t), "force": force, "torque": torque}


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.slow_case("diffrax")
def test_crane_along_a_path(engine: Any) -> None:
    system = ac.compile(Crane())
    assert system.report().structural_index == 5
    assert system.states == ()
    solution = system.simulate(5.0, rtol=1e-9, engine=engine)
    for name, exact in jax.vmap(crane_exactly)(jnp.asarray(solution.t)).items():
        np.testing.assert_allclose(solution[name], exact, rtol=1e-9, atol=1e-7, err_msg=name)


class VanDerPolLimit(Component):
    """The slow motion of the van der Pol oscillator: index 1, but for its ends at x = 1 and -1.

    Source: Hairer and Wanner (1996), Solving Ordinary Differential Equations II, section VI.1.
    """

    x: Variable = Variable(start=2.0)
    y: Variable = Variable(start=2.0 / 3.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.y) == -self.x
        yield self.y == self.x**3 / 3 - self.x


@cache
def van_der_pol() -> ac.System:
    return ac.compile(VanDerPolLimit())


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.slow_case("diffrax")
def test_up_to_the_impasse(engine: Any) -> None:
    """log(x) - x^2/2 falls as t grows."""
    assert van_der_pol().report().structural_index == 1
    solution = van_der_pol().simulate(0.8, rtol=1e-9, engine=engine)
    x = np.asarray(solution["x"])
    np.testing.assert_allclose(log(2) - 2 - (np.log(x) - x**2 / 2), -np.asarray(solution.t), atol=1e-7)
    with pytest.raises(SimulationError, match=r"(?s)stopped at t = 0\.80685.*do not determine `der\(y\)`"):
        van_der_pol().simulate(1.0, rtol=1e-6, engine=engine)
