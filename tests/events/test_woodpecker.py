"""The woodpecker toy against a hand-written automaton: a sleeve on a rod and a bird on a spring; impacts, locks.

Source: Glocker and Pfeiffer, *Multiple impacts with friction in rigid multibody systems*, Nonlinear Dynamics 7 (1995);
with rigid impacts and a beak that bounces, as in Eich-Soellner and Führer, *Numerical Methods in Multibody Dynamics*
(1998).
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

import acausal as ac
from acausal import Component, Discrete, Equations, Parameter, Variable, der, pre, reinit, when, where

from .hand_written import Exit, Mode, State, follow

M_S, J_S, M_B, J_B = 3e-4, 5e-9, 4.5e-3, 7e-7
R_0, R_S, H_S, L_S, L_G, H_B, L_B = 2.5e-3, 3.1e-3, 5.8e-3, 1e-2, 1.5e-2, 2e-2, 2.01e-2
C_P, G = 5.6e-3, 9.81
MASS = np.array(
    [
        [M_S + M_B, M_B * L_S, M_B * L_G],
        [M_B * L_S, J_S + M_B * L_S**2, M_B * L_S * L_G],
        [M_B * L_G, M_B * L_S * L_G, J_B + M_B * L_G**2],
    ]
)
TILT, BEAK = (R_S - R_0) / H_S, (L_S + L_G - L_B - R_0) / H_B
"""Angles of the sleeve at which it locks, and of the bird at which its beak hits the rod."""
STATES = ("z", "phi_S", "phi_B", "v", "w_S", "w_B")


class Woodpecker(Component):
    """Height of the sleeve, angles of sleeve and bird. Modes: free (0), locked at the lower edge (1) or the upper (2).

    A lock is left where its force, once it has pressed, would pull.
    """

    z: Variable = Variable(start=0.0, fixed=True, unit="m")
    phi_S: Variable = Variable(start=-TILT, fixed=True)
    phi_B: Variable = Variable(start=-0.65, fixed=True)
    v: Variable = Variable(start=0.0, fixed=True, unit="m/s")
    w_S: Variable = Variable(start=0.0, fixed=True)
    w_B: Variable = Variable(start=0.0, fixed=True)
    edge: Variable = Variable()
    rod: Variable = Variable()
    c: Parameter = Parameter(C_P)
    mode: Discrete = Discrete(start=1)
    pressed: Discrete = Discrete(start=1)
    pecks: Discrete = Discrete(start=0)

    def equations(self) -> Equations:
        q, w = (self.z, self.phi_S, self.phi_B), (self.v, self.w_S, self.w_B)
        spring = self.c * (self.phi_B - self.phi_S)
        towards = where(self.mode > 1.5, -H_S, H_S)
        forces = (
            -(M_S + M_B) * G - self.rod,
            spring - M_B * L_S * G - towards * self.edge - R_S * self.rod,
            -spring - M_B * L_G * G,
        )
        for k in range(3):
            yield der(q[k]) == w[k]
            yield sum(float(MASS[k, j]) * der(w[j]) for j in range(3)) == forces[k]
        yield where(self.mode > 0.5, der(self.w_S), self.edge) == 0.0
        yield where(self.mode > 0.5, der(self.v) + R_S * der(self.w_S), self.rod) == 0.0

        bird = sum(float(MASS[2, j] / MASS[2, 2]) * pre(w[j]) for j in range(3))
        stop = (reinit(self.v, 0.0), reinit(self.w_S, 0.0), reinit(self.w_B, bird))
        free = pre(self.mode) < 0.5
        yield when(free & (self.phi_S < -TILT) & (self.w_B < 0.0), {self.mode: 1}, *stop).elsewhen(
            free & (self.phi_S > TILT) & (self.w_B > 0.0), {self.mode: 2}, *stop
        ).elsewhen((pre(self.pressed) > 0.5) & (self.edge > 0.0), {self.mode: 0})
        yield when(~free & (self.edge < 0.0), {self.pressed: 1}).elsewhen(free, {self.pressed: 0})
        yield when((self.phi_B > BEAK) & (pre(self.mode) > 1.5), {self.pecks: pre(self.pecks) + 1},
                   reinit(self.w_B, -self.w_B))  # fmt: skip


def accelerations(x: State, towards: float) -> State:
    """Of the three coordinates, and the forces of the edge and the rod; free where `towards` is 0."""
    spring = C_P * (x[2] - x[1])
    forces = [-(M_S + M_B) * G, spring - M_B * L_S * G, -spring - M_B * L_G * G, 0.0, 0.0]
    lock = np.array([[0.0, towards, 0.0], [1.0, R_S, 0.0]]) if towards else np.zeros((2, 3))
    held = np.zeros((2, 2)) if towards else np.eye(2)
    return np.linalg.solve(np.block([[MASS, lock.T], [lock, held]]), forces)


def automaton() -> dict[str, Mode]:
    def rate(towards: float) -> Any:
        return lambda t, x: [*x[3:], *accelerations(x, towards)[:3]]

    def locked(t: float, x: State) -> list[float]:
        return [*x[:3], 0.0, 0.0, float(MASS[2] @ x[3:]) / MASS[2, 2]]

    def pecked(t: float, x: State) -> list[float]:
        return [*x[:5], -x[5]]

    def pulls(towards: float) -> Any:
        return lambda t, x: -accelerations(x, towards)[3]

    def presses(towards: float) -> Any:
        return lambda t, x: accelerations(x, towards)[3]

    lower = Exit(lambda t, x: x[1] + TILT if x[5] < 0.0 else 1.0, "lower, pulled", locked)
    upper = Exit(lambda t, x: TILT - x[1] if x[5] > 0.0 else 1.0, "upper, pulled", locked)
    peck = Exit(lambda t, x: BEAK - x[2], "upper, pressed", pecked)
    return {
        "free": Mode(rate(0.0), (lower, upper), {"mode": 0.0, "pressed": 0.0}),
        "lower, pulled": Mode(rate(H_S), (Exit(presses(H_S), "lower"),), {"mode": 1.0, "pressed": 0.0}),
        "lower": Mode(rate(H_S), (Exit(pulls(H_S), "free"),), {"mode": 1.0, "pressed": 1.0}),
        "upper, pulled": Mode(rate(-H_S), (Exit(presses(-H_S), "upper"),), {"mode": 2.0, "pressed": 0.0}),
        "upper": Mode(rate(-H_S), (peck, Exit(pulls(-H_S), "free")), {"mode": 2.0, "pressed": 1.0}),
        "upper, pressed": Mode(rate(-H_S), (Exit(pulls(-H_S), "free"),), {"mode": 2.0, "pressed": 1.0}),
    }


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_the_woodpecker_goes_down_its_rod(engine: Any) -> None:
    t = np.linspace(0.0, 1.0, 201)
    modes = automaton()
    path = follow(modes, "lower", [0.0, -TILT, -0.65, 0.0, 0.0, 0.0], t)
    solution = ac.compile(Woodpecker()).simulate(1.0, saveat=t, engine=engine, rtol=1e-9, atol=1e-11)
    assert len(path.times) == 77 and solution["pecks"][-1] == 11
    assert_allclose([e.t for e in solution.events], path.times, atol=1e-8)
    for k, name in enumerate(STATES):
        assert_allclose(solution[name], path.x[k], atol=1e-6 * np.abs(path.x[k]).max(), err_msg=name)
    for name in ("mode", "pressed"):
        assert_allclose(solution[name], [modes[m].shows[name] for m in path.modes])
