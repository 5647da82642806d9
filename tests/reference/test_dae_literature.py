"""DAEs that the literature on structural analysis and on integration methods argues with, against their solutions."""

from __future__ import annotations

from functools import cache
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy.integrate import solve_ivp

import acausal as ac
from acausal import Array, Component, Equations, Parameter, Variable, cos, der, exp, sin
from acausal.errors import StructureError

ENGINES = ("native", "diffrax")


def agrees(system: ac.System, exact: Any, t1: float, engine: Any = "native", tol: float = 1e-7) -> None:
    """Compare with `exact`, time to values by name."""
    solution = system.simulate(t1, rtol=1e-9, saveat=11, engine=engine)
    t = np.asarray(solution.t)
    for name, wanted in exact(t).items():
        np.testing.assert_allclose(solution[name], wanted, rtol=tol, atol=tol, err_msg=name)


# ---- linear, with coefficients that vary: pencils say nothing -------------------------------------------------------


class RegularPencil(Component):
    """Every matrix pencil is regular, and yet ``t y`` for any y solves the equations of x and y.

    Source: Kunkel and Mehrmann (2006), Differential-Algebraic Equations, example 3.1.
    """

    x: Variable = Variable()
    y: Variable = Variable()

    def equations(self) -> Equations:
        t = ac.time
        yield -t * der(self.x) + t**2 * der(self.y) == -self.x
        yield -der(self.x) + t * der(self.y) == -self.y


class SingularPencil(Component):
    """Every matrix pencil is singular, and yet the solution is unique.

    Source: Kunkel and Mehrmann (2006), example 3.2.
    """

    x: Variable = Variable()
    y: Variable = Variable()

    def equations(self) -> Equations:
        t = ac.time
        yield self.x == t * self.y + exp(t)
        yield der(self.x) - t * der(self.y) == cos(t)


def test_pencils_say_nothing() -> None:
    with pytest.raises(StructureError, match="one of these equations follows from the others") as caught:
        ac.compile(RegularPencil())
    assert len(caught.value.equations) == 2
    system = ac.compile(SingularPencil())
    assert system.report().structural_index == 2
    agrees(system, lambda t: {"y": np.cos(t) - np.exp(t), "x": t * np.cos(t) + (1 - t) * np.exp(t)}, 2.0)


class Turning(Component):
    """Index 3, its unknowns turned and its equations mixed by matrices that vary with time."""

    a: Variable = Variable()
    b: Variable = Variable()
    c: Variable = Variable()

    def equations(self) -> Equations:
        t, s, a, b, c = ac.time, exp(-ac.time), self.a, self.b, self.c
        one = cos(t) * b - sin(t) * a + der(c) - exp(-t)
        two = cos(t) * der(b) - sin(t) * der(a) - sin(2 * t)
        three = c - cos(3 * t)
        yield one + t * two + s * three == 0
        yield two - s * one + three == 0
        yield 3 * three + t * one + two == 0


def turning(t: Any) -> dict[str, Any]:
    """``across = cos(t) b - sin(t) a`` from the first row, ``along`` from ``across' + along = sin(2 t)``."""
    across = np.exp(-t) + 3 * np.sin(3 * t)
    along = np.sin(2 * t) + np.exp(-t) - 9 * np.cos(3 * t)
    return {
        "a": np.cos(t) * along - np.sin(t) * across, "b": np.sin(t) * along + np.cos(t) * across, "c": np.cos(3 * t)
    }  # fmt: skip


def test_nothing_is_divided_by_what_vanishes_at_the_start() -> None:
    """Combinations of the equations need pivots; sin(t) and t are as good as others anywhere but here."""
    system = ac.compile(Turning())
    assert system.report().index == system.report().structural_index == 3
    agrees(system, turning, 2.0)


# ---- index 1 of high structural index ---------------------------------------------------------------------------


class Cell(Component):
    """One unknown."""

    x: Variable = Variable(start=0.5)


class Reissig(Component):
    """Index 1, though structural analysis differentiates the last equation n times.

    Source: Reissig, Martinson and Barton (2000), Differential-algebraic equations of index 1 may have an arbitrarily
    high structural index, SIAM J. Sci. Comput. 21, 1987-1990.
    """

    n: int = 3
    even: Array[Cell] = Array(Cell(), "n")
    odd: Array[Cell] = Array(Cell(), "n")
    last: Cell = Cell()

    def equations(self) -> Equations:
        for i in range(self.n):
            below = self.even[i + 1].x if i < self.n - 1 else self.last.x
            rate = der(self.odd[i].x) + der(below)
            yield rate + self.even[i].x == sin(ac.time * (2 * i + 1) / 3)
            yield rate + self.odd[i].x == sin(ac.time * (2 * i + 2) / 3)
        yield self.last.x == sin(ac.time * (2 * self.n + 1) / 3)


@pytest.mark.slow
@pytest.mark.parametrize("engine", ENGINES)
def test_index_1_of_high_structural_index(engine: Any) -> None:
    n = 3
    system = ac.compile(Reissig(n=n))
    assert (system.report().index, system.report().structural_index) == (1, n + 1)
    solution = system.simulate(2.0, rtol=1e-9, saveat=11, engine=engine)
    t = np.asarray(solution.t)

    def source(i: int, t: Any, slope: bool = False) -> Any:
        return (i + 1) / 3 * np.cos(t * (i + 1) / 3) if slope else np.sin(t * (i + 1) / 3)

    def rate(t: float, y: Any) -> Any:
        """Of the odd ones, from the last pair up: each pair gives the rate that the one above needs."""
        out, above = np.zeros(n), source(2 * n, t, slope=True)
        for i in reversed(range(n)):
            out[i] = source(2 * i + 1, t) - y[i] - above
            above = source(2 * i, t, slope=True) - source(2 * i + 1, t, slope=True) + out[i]
        return out

    begin = [float(solution[f"odd[{i}].x"][0]) for i in range(n)]
    exact = solve_ivp(rate, (0, 2), begin, method="DOP853", rtol=1e-12, atol=1e-12, t_eval=t).y
    for i in range(n):
        np.testing.assert_allclose(solution[f"odd[{i}].x"], exact[i], atol=1e-8)
        wanted = source(2 * i, t) - source(2 * i + 1, t) + exact[i]
        np.testing.assert_allclose(solution[f"even[{i}].x"], wanted, atol=1e-8)


# ---- mechanisms ----------------------------------------------------------------------------------------------------


class RobotArm(Component):
    """Two links with an elastic joint along a given path: index 5, of which structural analysis sees 3.

    Source: Campbell and Griepentrog (1995), Solvability of general differential algebraic equations, SIAM J. Sci.
    Comput. 16, 257-270.
    """

    x1: Variable = Variable(start=0.0)
    x2: Variable = Variable()
    x3: Variable = Variable(start=1.0)
    u1: Variable = Variable()
    u2: Variable = Variable()

    def equations(self) -> Equations:
        x1, x2, x3, u1, u2, t = self.x1, self.x2, self.x3, self.u1, self.u2, ac.time
        a, b, c, d = arm(x3, sin, cos)
        turn, both, w = der(x1) ** 2, (der(x1) + der(x3)) ** 2, 2 * x3 - x2
        yield der(der(x1)) == 2 * c * both + turn * d + w * (a + 2 * b) + a * (u1 - u2)
        yield der(der(x2)) == -2 * c * both - turn * d + w * (1 - 3 * a - 2 * b) - a * u1 + (a + 1) * u2
        yield der(der(x3)) == (
            -2 * c * both - turn * d + w * (a - 9 * b) - 2 * turn * c - d * both - (a + b) * (u1 - u2)
        )
        yield cos(x1) + cos(x1 + x3) == cos(1 - exp(t)) + cos(1 - t)
        yield sin(x1) + sin(x1 + x3) == sin(1 - exp(t)) + sin(1 - t)


def arm(s: Any, sin: Any, cos: Any) -> Any:
    """The coefficients a, b, c and d of the arm."""
    under = 2 - cos(s) ** 2
    return 2 / under, cos(s) / under, sin(s) / under, sin(s) * cos(s) / under


def arm_exactly(t: Any) -> dict[str, Any]:
    """``x1 = 1 - e^t``, ``x3 = e^t - t``; first and third equation give x2 and u1 - u2, the second u2."""
    x1, x3 = lambda t: 1 - jnp.exp(t), lambda t: jnp.exp(t) - t
    rate = jax.grad

    def elastic(t: Any) -> Any:
        a, b, c, d = arm(x3(t), jnp.sin, jnp.cos)
        turn, both = rate(x1)(t) ** 2, (rate(x1)(t) + rate(x3)(t)) ** 2
        matrix = jnp.array([[a + 2 * b, a], [a - 9 * b, -a - b]])
        first = rate(rate(x1))(t) - 2 * c * both - turn * d
        third = rate(rate(x3))(t) + 2 * c * both + turn * d + 2 * turn * c + d * both
        return jnp.linalg.solve(matrix, jnp.array([first, third]))

    x2 = lambda t: 2 * x3(t) - elastic(t)[0]  # noqa: E731

    def u2(t: Any) -> Any:
        a, b, c, d = arm(x3(t), jnp.sin, jnp.cos)
        turn, both, (w, apart) = rate(x1)(t) ** 2, (rate(x1)(t) + rate(x3)(t)) ** 2, elastic(t)
        return rate(rate(x2))(t) + 2 * c * both + turn * d - w * (1 - 3 * a - 2 * b) + a * apart

    each = jax.vmap(lambda t: (x1(t), x2(t), x3(t), u2(t) + elastic(t)[1], u2(t)))(jnp.asarray(t))
    return dict(zip(("x1", "x2", "x3", "u1", "u2"), each, strict=True))


@pytest.mark.slow
@pytest.mark.parametrize("engine", ENGINES)
def test_robot_arm(engine: Any) -> None:
    system = ac.compile(RobotArm())
    assert system.report().index == system.report().structural_index == 5
    assert system.states == ()
    agrees(system, arm_exactly, 1.0, engine, tol=1e-9)


class Pendula(Component):
    """The tension of a pendulum sets the length of the next one: index ``2 n + 1``.

    Source: Nedialkov and Pryce (2005), Solving differential-algebraic equations by Taylor series (I), BIT 45, 561-591.
    """

    n: int = 2
    x: Array[Cell] = Array(Cell(x=ac.start(0.6)), "n")
    y: Array[Cell] = Array(Cell(x=ac.start(0.8)), "n")
    tension: Array[Cell] = Array(Cell(), "n")

    def equations(self) -> Equations:
        length: Any = 1.0
        for k in range(self.n):
            x, y, tension = self.x[k].x, self.y[k].x, self.tension[k].x
            yield der(der(x)) == -tension * x
            yield der(der(y)) == -tension * y + 9.81
            yield x**2 + y**2 == length**2
            length = 1 + 0.1 * tension


@cache
def pendula(n: int) -> ac.System:
    return ac.compile(Pendula(n=n))


@pytest.mark.slow
@pytest.mark.parametrize("n", [1, 2, 3, 4])
def test_index_of_a_chain_of_pendula(n: int) -> None:
    assert pendula(n).report().index == pendula(n).report().structural_index == 2 * n + 1


@pytest.mark.slow
@pytest.mark.parametrize("engine", ENGINES)
def test_two_pendula(engine: Any) -> None:
    """In angles, ``phi1'' = -g sin(phi1)`` and ``(R^2 phi2')' = -g R sin(phi2)`` with ``R = 1 + 0.1 tension``."""
    t = np.linspace(0, 2, 21)
    initial = {"der(x[0].x)": 0.8, "der(x[1].x)": 0.5}
    found = pendula(2).simulate(2.0, rtol=1e-9, saveat=t, engine=engine, initial=initial)
    g, begin = 9.81, {name: float(found[name][0]) for name in ("x[0].x", "y[0].x", "x[1].x", "y[1].x")}
    angles = [float(np.arctan2(begin[f"x[{k}].x"], begin[f"y[{k}].x"])) for k in range(2)]
    speed = 0.8 / np.cos(angles[0])

    def length(phi: Any, w: Any) -> Any:
        return 1 + 0.1 * (w**2 + g * np.cos(phi))

    def rates(_: float, s: Any) -> Any:
        phi, w, psi, momentum = s
        R = length(phi, w)
        return [w, -g * np.sin(phi), momentum / R**2, -g * R * np.sin(psi)]

    R, stretch = length(angles[0], speed), -0.3 * g * np.sin(angles[0]) * speed
    turn = (0.5 - stretch * np.sin(angles[1])) / (R * np.cos(angles[1]))
    exact = solve_ivp(
        rates, (0, 2), [angles[0], speed, angles[1], R**2 * turn], method="DOP853", rtol=1e-12, atol=1e-12, t_eval=t
    ).y
    np.testing.assert_allclose(found["x[0].x"], np.sin(exact[0]), atol=1e-7)
    np.testing.assert_allclose(found["x[1].x"], length(exact[0], exact[1]) * np.sin(exact[2]), atol=1e-7)


class KnifeEdge(Component):
    """A skate on an inclined plane, with a constraint of velocities only: index 2. It drifts sideways, not down.

    Source: Neimark and Fufaev (1972), Dynamics of Nonholonomic Systems, chapter III.
    """

    slope: Parameter = Parameter(2.0, unit="m/s2", doc="acceleration down the plane")
    x: Variable = Variable(start=0.0, fixed=True)
    y: Variable = Variable(start=0.0, fixed=True)
    phi: Variable = Variable(start=0.0, fixed=True)
    u: Variable = Variable(start=0.0)
    v: Variable = Variable(start=0.0)
    w: Variable = Variable(start=0.7, fixed=True)
    side: Variable = Variable()

    def equations(self) -> Equations:
        yield der(self.x) == self.u
        yield der(self.y) == self.v
        yield der(self.phi) == self.w
        yield der(self.u) == self.side * sin(self.phi) + self.slope
        yield der(self.v) == -self.side * cos(self.phi)
        yield der(self.w) == 0
        yield self.u * sin(self.phi) == self.v * cos(self.phi)


@pytest.mark.slow
@pytest.mark.parametrize("engine", ENGINES)
def test_knife_edge(engine: Any) -> None:
    system = ac.compile(KnifeEdge())
    assert system.report().structural_index == 2

    def exact(t: Any) -> dict[str, Any]:
        phi, a = 0.7 * t, 2.0 / (2 * 0.7**2)
        u = 1.4 * a * np.sin(phi) * np.cos(phi)
        return {"x": a * np.sin(phi) ** 2, "y": a * (phi - 0.5 * np.sin(2 * phi)), "u": u}

    agrees(system, exact, 8.0, engine)


# ---- nonlinear, in Hessenberg form -----------------------------------------------------------------------------


class Index2(Component):
    """``y1 = e^t``, ``y2 = e^(-2 t)``, ``z = e^(2 t)``.

    Source: Hairer, Lubich and Roche (1989), The Numerical Solution of Differential-Algebraic Systems by Runge-Kutta
    Methods, section 7.
    """

    y1: Variable = Variable(start=1.0, fixed=True)
    y2: Variable = Variable(start=1.0)
    z: Variable = Variable(start=1.0)

    def equations(self) -> Equations:
        y1, y2, z = self.y1, self.y2, self.z
        yield der(y1) == y1 * y2**2 * z**2
        yield der(y2) == y1**2 * y2**2 - 3 * y2**2 * z
        yield y1**2 * y2 == 1


class Index3(Component):
    """``y1 = z1 = e^(2 t)``, ``y2 = z2 = e^(-t)``, ``u = e^t``; with `power` 2 the multiplier is not linear.

    Source: Hairer, Lubich and Roche (1989), section 7; Jay (1995), Convergence of Runge-Kutta methods for
    differential-algebraic systems of index 3, Appl. Numer. Math. 17, 97-118.
    """

    power: int = 1
    y1: Variable = Variable(start=1.0, fixed=True)
    y2: Variable = Variable(start=1.0)
    z1: Variable = Variable(start=1.0)
    z2: Variable = Variable(start=1.0, fixed=True)
    u: Variable = Variable(start=1.0)

    def equations(self) -> Equations:
        y1, y2, z1, z2, u = self.y1, self.y2, self.z1, self.z2, self.u
        yield der(y1) == 2 * y1 * y2 * z1 * z2
        yield der(y2) == -y1 * y2 * z2**2
        yield der(z1) == (y1 * y2 + z1 * z2) * u
        yield der(z2) == -y1 * y2**2 * z2 ** (1 + self.power) * u**self.power
        yield y1 * y2**2 == 1


@pytest.mark.slow
@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize(("model", "index"), [(Index2(), 2), (Index3(), 3), (Index3(power=2), 3)], ids=str)
def test_hessenberg_forms(model: Any, index: int, engine: Any) -> None:
    system = ac.compile(model)
    assert system.report().structural_index == index

    def exact(t: Any) -> dict[str, Any]:
        if index == 2:
            return {"y1": np.exp(t), "y2": np.exp(-2 * t), "z": np.exp(2 * t)}
        return {"y1": np.exp(2 * t), "y2": np.exp(-t), "z1": np.exp(2 * t), "z2": np.exp(-t), "u": np.exp(t)}

    agrees(system, exact, 0.5, engine)
