"""Connection graphs of overdetermined connectors: roots, loops, and what is said of wrong ones."""

from __future__ import annotations

import re

import numpy as np
import pytest

import acausal as ac
from acausal import (
    Component,
    Connector,
    Equations,
    Expr,
    Flow,
    Overdetermined,
    Parameter,
    Potential,
    Variable,
    Vector,
    branch,
    choose,
    connect,
    defining,
    der,
    derivative_rule,
    is_root,
    potential_root,
    root,
    rooted,
    vector,
)


class Direction(Overdetermined):
    """A direction in the plane: two elements of one degree of freedom."""

    e: Vector = Vector(Potential(), size=2)
    w: Potential = Potential()

    def equations(self) -> Equations:
        yield derivative_rule(self.e, vector(-self.w * self.e[1], self.w * self.e[0]))

    def equality_constraint(self, other: Direction) -> Vector:
        return vector(self.e[0] * other.e[1] - self.e[1] * other.e[0])


class Port(Connector):
    R: Direction = Direction()
    t: Flow = Flow()


class Ground(Component):
    """Holds its direction."""

    port: Port = Port()

    def equations(self) -> Equations:
        yield root(self.port.R)
        yield defining(self.port.R.e == (1.0, 0.0))
        yield self.port.R.w == 0


def turned(e: Vector, c: Expr, s: Expr) -> Vector:
    return vector(c * e[0] - s * e[1], s * e[0] + c * e[1])


class Hinge(Component):
    """Turns b against a by an angle."""

    a: Port = Port()
    b: Port = Port()
    phi: Variable = Variable(state_select="prefer")
    w: Variable = Variable(state_select="prefer")
    tau: Parameter = Parameter(0.0)

    def equations(self) -> Equations:
        a, b, c, s = self.a, self.b, ac.cos(self.phi), ac.sin(self.phi)
        yield branch(a.R, b.R)
        yield der(self.phi) == self.w
        yield choose(
            rooted(a.R),
            [defining(b.R.e == turned(a.R.e, c, s)), b.R.w == a.R.w + self.w],
            [defining(a.R.e == turned(b.R.e, c, -s)), a.R.w == b.R.w - self.w],
        )
        yield a.t + b.t == 0
        yield b.t == -self.tau


class Wheel(Component):
    """Has inertia, and its angle as a state if nothing else fixes it."""

    port: Port = Port()
    J: Parameter = Parameter(2.0)
    phi: Variable = Variable()

    def equations(self) -> Equations:
        R = self.port.R
        yield potential_root(R)
        yield choose(is_root(R), [defining(R.e == vector(ac.cos(self.phi), ac.sin(self.phi))), der(self.phi) == R.w],
                     [self.phi == 0])  # fmt: skip
        yield self.J * der(R.w) == self.port.t


class Rotor(Component):
    """Ground, hinge, wheel."""

    ground: Ground = Ground()
    hinge: Hinge = Hinge(tau=3.0)
    wheel: Wheel = Wheel()

    def equations(self) -> Equations:
        yield connect(self.ground.port, self.hinge.a)
        yield connect(self.hinge.b, self.wheel.port)


def test_a_tree_has_the_states_of_its_joint() -> None:
    system = ac.compile(Rotor())
    assert system.states[0] == "hinge.phi" and len(system.states) == 2
    solution = system.simulate(t1=2.0, rtol=1e-9)
    phi = 0.75 * solution.t**2
    assert np.allclose(solution["hinge.phi"], phi)
    assert np.allclose(solution["wheel.port.R.e[2]"], np.sin(phi), atol=1e-7)


class Free(Component):
    """Nothing is fixed: one wheel is the root."""

    hinge: Hinge = Hinge(tau=3.0)
    left: Wheel = Wheel()
    right: Wheel = Wheel()

    def equations(self) -> Equations:
        yield connect(self.left.port, self.hinge.b)
        yield connect(self.hinge.a, self.right.port)


def test_a_potential_root_is_taken_and_the_hinge_is_rooted_at_either_end() -> None:
    system = ac.compile(Free())
    assert "left.phi" in system.states and "right.phi" not in system.states
    solution = system.simulate(t1=1.0, rtol=1e-9)
    assert solution["left.port.R.w"][-1] == pytest.approx(1.5)
    assert solution["right.port.R.w"][-1] == pytest.approx(-1.5)
    assert solution["hinge.phi"][-1] == pytest.approx(1.5)


class Spring(Component):
    """A hinge whose torque is left to the others: it only measures its angle."""

    a: Port = Port()
    b: Port = Port()
    phi: Variable = Variable()

    def equations(self) -> Equations:
        a, b, c, s = self.a, self.b, ac.cos(self.phi), ac.sin(self.phi)
        yield branch(a.R, b.R)
        yield choose(
            rooted(a.R),
            [defining(b.R.e == turned(a.R.e, c, s)), b.R.w == a.R.w + der(self.phi)],
            [defining(a.R.e == turned(b.R.e, c, -s)), a.R.w == b.R.w - der(self.phi)],
        )
        yield a.t + b.t == 0


class Loop(Component):
    """Two hinges side by side hold one wheel: a closed loop that nobody cuts."""

    ground: Ground = Ground()
    first: Hinge = Hinge(tau=3.0)
    second: Spring = Spring()
    wheel: Wheel = Wheel()

    def equations(self) -> Equations:
        yield connect(self.ground.port, self.first.a, self.second.a)
        yield connect(self.first.b, self.wheel.port)
        yield connect(self.second.b, self.wheel.port)
        yield connect(self.ground.port, self.second.a)  # says what is known
        yield self.second.b.t == 0


def test_a_loop_is_closed_by_the_equality_constraint() -> None:
    system = ac.compile(Loop())
    solution = system.simulate(t1=1.0, rtol=1e-9)
    assert np.allclose(solution["second.phi"], 0.75 * solution.t**2, atol=1e-7)
    assert np.allclose(solution["second.b.R.e"], solution["wheel.port.R.e"], atol=1e-9)


def message(model: Component) -> str:
    with pytest.raises(ac.ConnectError) as error:
        ac.compile(model)
    return str(error.value)


class Lost(Component):
    """A hinge that hangs in the air."""

    hinge: Hinge = Hinge()


def test_no_root_names_the_connectors() -> None:
    assert "nothing gives `hinge.a.R`, `hinge.b.R`: the connections lead to no root" in message(Lost())


class TwoRoots(Component):
    """Two grounds, joined rigidly."""

    first: Ground = Ground()
    second: Ground = Ground()

    def equations(self) -> Equations:
        yield connect(self.first.port, self.second.port)


def test_two_roots_joined_rigidly_name_both_and_the_line() -> None:
    text = message(TwoRoots())
    assert "`first.port.R` and `second.port.R` both fix what is joined rigidly" in text
    assert re.search(r"test_overdetermined.py:\d+ \(TwoRoots\)", text)
    assert "the first is a root by (`first`, " in text and "(Ground)" in text


class BranchLoop(Component):
    """Branches that close a loop within a component."""

    a: Port = Port()
    b: Port = Port()

    def equations(self) -> Equations:
        yield root(self.a.R)
        yield branch(self.a.R, self.b.R)
        yield branch(self.b.R, self.a.R)
        yield self.a.R.e == (1.0, 0.0)


def test_a_loop_of_branches_is_refused() -> None:
    assert "the branches of the components close a loop at `a.b.R` and `a.a.R`" in message(Holder())


class Holder(Component):
    a: BranchLoop = BranchLoop()


def test_statements_are_about_overdetermined_connectors() -> None:
    with pytest.raises(ac.DeclarationError, match=r"root\(\) is about an overdetermined connector"):
        root(Port())  # type: ignore[arg-type]
    with pytest.raises(ac.DeclarationError, match=r"choose\(\) asks the connection graph"):
        choose(True, [])  # type: ignore[arg-type]
    with pytest.raises(ac.DeclarationError, match=r"choose\(\) takes lists of equations"):
        choose(is_root(Direction()), [1.0])  # type: ignore[list-item]
