"""The integrators that the component examples are held against, on equations whose solutions are known."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("casadi")

from numpy.typing import NDArray
from scipy.special import ellipj, ellipk

from acausal import Component, Equations, Parameter, Variable, der, time

from .flat_equations import FlatEquations
from .independent import AGREES, FLOOR, NODES, Integrators, Stretch

Floats = NDArray[np.float64]
G = 9.81


class Pendulum(Component):
    """A point mass on a rod of 1 m, in Cartesian coordinates: index 3."""

    m: Parameter = Parameter(2.0, unit="kg")
    x: Variable = Variable(unit="m")
    y: Variable = Variable(unit="m")
    vx: Variable = Variable(unit="m/s")
    vy: Variable = Variable(unit="m/s")
    tension: Variable = Variable(unit="N")

    def equations(self) -> Equations:
        yield der(self.x) == self.vx
        yield der(self.y) == self.vy
        yield self.m * der(self.vx) == -self.tension * self.x
        yield self.m * der(self.vy) == -self.tension * self.y - self.m * G
        yield self.x**2 + self.y**2 == 1


def swing(amplitude: float, g: float = G) -> dict[str, Floats]:
    """A swing of `Pendulum`, let go at rest, by elliptic functions (Landau and Lifshitz, Mechanics, section 11)."""
    k, omega = np.sin(amplitude / 2), np.sqrt(g)
    sn, cn, dn, _ = ellipj(omega * NODES, k**2)
    phi = 2 * np.arcsin(k * cn / dn)
    w, z = -2 * k * omega * np.sqrt(1 - k**2) * sn / dn, -g * np.sin(phi)
    x, y = np.sin(phi), -np.cos(phi)
    vx, vy, ax, ay = -w * y, w * x, -z * y - w**2 * x, z * x - w**2 * y
    return {
        "x": x, "y": y, "vx": vx, "vy": vy, "tension": 2.0 * (w**2 + g * np.cos(phi)),
        "der(x)": vx, "der(y)": vy, "der(vx)": ax, "der(vy)": ay,
    }  # fmt: skip


def disagreement(model: Component, values: dict[str, Floats]) -> float:
    equations = FlatEquations(model)
    v = np.array([values[name] for name in equations.names])
    integrators = Integrators(equations, np.maximum(np.abs(v).max(axis=1), FLOOR))
    assert not integrators.regular
    return integrators.disagreement(Stretch(NODES, v, np.zeros(0)))


@pytest.mark.parametrize("amplitude", [0.1, 1.5, 3.0])
def test_pendulum_of_index_3(amplitude: float) -> None:
    values = swing(amplitude)
    assert 4 * ellipk(np.sin(amplitude / 2) ** 2) / np.sqrt(G) > NODES[-1], "within the first period"
    assert disagreement(Pendulum(), values) <= AGREES


@pytest.mark.parametrize("name", ["x", "vy", "der(vx)", "tension"])
def test_a_wrong_variable_is_seen(name: str) -> None:
    values = swing(1.5)
    values[name] = values[name] + 3 * AGREES * np.max(np.abs(values[name])) * (NODES > 0)
    assert disagreement(Pendulum(), values) > AGREES


def test_another_motion_is_seen() -> None:
    assert disagreement(Pendulum(), swing(1.5, g=G * 1.0001)) > AGREES


class Sliding(Component):
    """The speed of something whose place a constraint gives, as long as it can."""

    x: Variable = Variable(unit="m")
    v: Variable = Variable(unit="m/s")

    def equations(self) -> Equations:
        yield der(self.x) == self.v
        yield self.x**2 == 1 - time


def test_where_newton_does_not_converge_nothing_agrees() -> None:
    """There is no solution after 1 s."""
    for end, solved in ((0.9, True), (1.1, False)):
        t = end * NODES
        x = np.sqrt(np.maximum(1 - t, 0.01))
        v = np.array([x, -0.5 / x, -0.5 / x])
        equations = FlatEquations(Sliding())
        assert equations.names == ["x", "v", "der(x)"]
        integrators = Integrators(equations, np.abs(v).max(axis=1))
        found = [integrators.collocate(elements, Stretch(t, v, np.zeros(0))) for elements in (8, 32)]
        assert [bool(np.isfinite(v).all()) for v in found] == [solved, solved]
        assert (integrators.disagreement(Stretch(t, v, np.zeros(0))) <= AGREES) == solved
