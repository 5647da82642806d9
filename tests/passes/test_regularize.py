"""Systems whose structure looks regular although equations hide a dependence."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Array, Component, Connector, Equations, Flow, Parameter, Potential, Variable, connect, der
from acausal.errors import StructureError
from acausal.symbolic.equation import Equation


class Coupled(Component):
    """A capacitor between two nodes, with its current written at both (the transistor amplifier in small)."""

    C: Parameter = Parameter(1e-3)
    a: Variable = Variable(start=1.0)
    b: Variable = Variable(start=0.0)

    def equations(self) -> Equations:
        yield self.C * (der(self.a) - der(self.b)) == -self.a + ac.sin(ac.time)
        yield self.C * (der(self.b) - der(self.a)) == -2 * self.b


def test_coupled_derivatives_become_a_constraint() -> None:
    system = ac.compile(Coupled())
    report = system.report()
    assert report.structural_index == 1
    assert report.states == 1
    solution = system.simulate(1.0, rtol=1e-9)
    t = np.asarray(solution.t)
    assert np.allclose(solution["a"] + 2 * solution["b"], np.sin(t), atol=1e-12)


def test_same_order_of_different_equations() -> None:
    class Mixed(Component):
        """``x' + y' = -x`` and ``x + y = sin t``: the second, differentiated, has the derivatives of the first."""

        x: Variable = Variable(start=1.0)
        y: Variable = Variable(start=0.0)

        def equations(self) -> Equations:
            yield der(self.x) + der(self.y) == -self.x
            yield self.x + self.y == ac.sin(ac.time)

    system = ac.compile(Mixed())
    assert system.report().states == 0
    solution = system.simulate(2.0)
    t = np.asarray(solution.t)
    assert np.allclose(solution["x"], -np.cos(t), atol=1e-12)
    assert np.allclose(solution["y"], np.sin(t) + np.cos(t), atol=1e-12)


def test_coefficients_that_depend_on_time() -> None:
    class Varying(Component):
        """``x' + t y' = 0`` and ``x + t y = sin t``: y = cos t / -1 (Tan, Nedialkov and Pryce 2017, example 1)."""

        x: Variable = Variable(start=0.0)
        y: Variable = Variable(start=1.0)

        def equations(self) -> Equations:
            yield der(self.x) + ac.time * der(self.y) == 0
            yield self.x + ac.time * self.y == ac.sin(ac.time)

    system = ac.compile(Varying())
    assert system.report().states == 0
    solution = system.simulate(2.0)
    t = np.asarray(solution.t)
    assert np.allclose(solution["y"], np.cos(t), atol=1e-12)
    assert np.allclose(solution["x"], np.sin(t) - t * np.cos(t), atol=1e-12)


def test_coefficients_that_depend_on_variables() -> None:
    class Product(Component):
        """Both equations hold the derivative of x*y, with different factors."""

        x: Variable = Variable(start=2.0, fixed=True)
        y: Variable = Variable(start=1.0)

        def equations(self) -> Equations:
            yield self.y * der(self.x) + self.x * der(self.y) == 0
            yield self.x * self.y * der(self.x) + self.x**2 * der(self.y) == self.x - 2 * self.y

    system = ac.compile(Product())
    report = system.report()
    assert report.states == 1
    solution = system.simulate(1.0)
    assert np.allclose(solution["x"], 2 * solution["y"], atol=1e-8)
    assert np.allclose(solution["x"], 2.0, atol=1e-8)


def test_different_orders() -> None:
    class Robot(Component):
        """The first equation is met by the second derivative of the third."""

        x: Variable = Variable(start=0.0)
        y: Variable = Variable(start=1.0)
        z: Variable = Variable(start=0.0)

        def equations(self) -> Equations:
            yield der(der(self.x)) + der(der(self.y)) == -self.z
            yield der(self.z) == self.x
            yield self.x + self.y == ac.cos(ac.time)

    system = ac.compile(Robot())
    assert system.report().states == 0
    solution = system.simulate(1.0)
    t = np.asarray(solution.t)
    assert np.allclose(solution["z"], np.cos(t), atol=1e-12)
    assert np.allclose(solution["x"], -np.sin(t), atol=1e-12)


class Pin(Connector):
    """An electrical pin."""

    v: Potential = Potential()
    i: Flow = Flow()


class NodeCapacitor(Component):
    """A capacitor that differentiates the potentials of its pins."""

    C: Parameter = Parameter(1e-6)
    p: Pin = Pin()
    n: Pin = Pin()

    def equations(self) -> Equations:
        yield self.p.i == self.C * (der(self.p.v) - der(self.n.v))
        yield self.p.i + self.n.i == 0


class NodeResistor(Component):
    """A resistor."""

    R: Parameter = Parameter(1e3)
    p: Pin = Pin()
    n: Pin = Pin()

    def equations(self) -> Equations:
        yield self.p.v - self.n.v == self.R * self.p.i
        yield self.p.i + self.n.i == 0


class Ground(Component):
    """Potential zero."""

    p: Pin = Pin()

    def equations(self) -> Equations:
        yield self.p.v == 0


class Source(Component):
    """A potential given over time."""

    p: Pin = Pin()

    def equations(self) -> Equations:
        yield self.p.v == ac.sin(ac.time)


class Stage(Component):
    """A coupling capacitor into a divider: neither end of the capacitor is held."""

    C: Parameter = Parameter(1e-6)
    c: NodeCapacitor = NodeCapacitor(C=C)
    r1: NodeResistor = NodeResistor()
    r2: NodeResistor = NodeResistor()
    input: Pin = Pin()
    g: Pin = Pin()

    def equations(self) -> Equations:
        yield connect(self.input, self.r1.p)
        yield connect(self.r1.n, self.c.p)
        yield connect(self.c.n, self.r2.p)
        yield connect(self.r2.n, self.g)


class Stages(Component):
    """Many such stages in parallel, fed by one source."""

    n: int = 3
    stage: Array[Stage] = Array(Stage(), "n")
    ground: Ground = Ground()
    source: Source = Source()

    def equations(self) -> Equations:
        yield connect(self.source.p, self.stage.input)
        yield connect(self.ground.p, self.stage.g)


@pytest.mark.parametrize("n", [1, 5, 2000])
def test_many_equal_blocks(n: int) -> None:
    system = ac.compile(Stages(n=n))
    report = system.report()
    assert report.states == n
    assert report.seconds["index reduction"] < 10


def test_dependent_parameters_do_not_hide_the_dependence() -> None:
    class Part(Component):
        """A quantity stored."""

        C: Parameter = Parameter(1.0)

    class Bound(Component):
        """The capacitance reaches the two equations over different parameters."""

        C: Parameter = Parameter(2.0)
        one: Part = Part(C=C)
        two: Part = Part(C=C)
        a: Variable = Variable(start=1.0)
        b: Variable = Variable(start=0.0)

        def equations(self) -> Equations:
            yield self.one.C * (der(self.a) - der(self.b)) == -self.a
            yield self.two.C * (der(self.b) - der(self.a)) == -2 * self.b

    assert ac.compile(Bound()).report().states == 1


@pytest.mark.parametrize("n", [4, 12])
def test_a_floating_network_of_capacitors(n: int) -> None:
    class Node(Component):
        """A node with a leak."""

        G: Parameter = Parameter(1.0)
        v: Variable = Variable(start=1.0)
        i: Variable = Variable()

        def equations(self) -> Equations:
            yield self.i == self.G * self.v

    class Network(Component):
        """A ring of capacitors over n nodes: the sum of all charges is not held by any of them."""

        n: int = 4
        node: Array[Node] = Array(Node(), "n")

        def equations(self) -> Equations:
            for k in range(self.n):
                a, b, c = self.node[k], self.node[(k + 1) % self.n], self.node[k - 1 if k else self.n - 1]
                yield (1 + k) * (der(a.v) - der(b.v)) + (k or self.n) * (der(a.v) - der(c.v)) == -a.i + ac.sin(
                    ac.time + k
                )

    system = ac.compile(Network(n=n))
    assert system.report().states == n - 1
    solution = system.simulate(0.5, rtol=1e-8)
    t = np.asarray(solution.t)
    total = np.sum([solution[f"node[{k}].v"] for k in range(n)], axis=0)
    assert np.allclose(total, np.sum([np.sin(t + k) for k in range(n)], axis=0), atol=1e-9)


def test_a_repeated_equation_is_named() -> None:
    class Twice(Component):
        """The second equation is the first one, multiplied."""

        x: Variable = Variable()
        y: Variable = Variable()

        def equations(self) -> Equations:
            yield self.x + 2 * self.y == 3
            yield 2 * self.x + 4 * self.y == 6

    with pytest.raises(StructureError, match="follows from") as info:
        ac.compile(Twice())
    assert len(info.value.equations) == 2
    assert "test_regularize.py" in str(info.value)


def test_a_contradiction_is_named() -> None:
    class Contradiction(Component):
        """The left sides are dependent, the right sides are not."""

        x: Variable = Variable()
        y: Variable = Variable()

        def equations(self) -> Equations:
            yield self.x + 2 * self.y == 3
            yield 2 * self.x + 4 * self.y == ac.time

    with pytest.raises(StructureError, match="combination") as info:
        ac.compile(Contradiction())
    assert "x + 2*y" in str(info.value)


def test_coefficients_with_the_derivatives_themselves() -> None:
    class Nonlinear(Component):
        """Two functions of one combination of derivatives."""

        x: Variable = Variable(start=1.0)
        y: Variable = Variable(start=1.0)

        def equations(self) -> Equations:
            yield (der(self.x) + der(self.y)) ** 2 + self.x == 2
            yield ac.sin(der(self.x) + der(self.y)) + self.y == 1

    with pytest.raises(StructureError, match="new variable"):
        ac.compile(Nonlinear())


def test_saturation_is_not_singular() -> None:
    class Saturated(Component):
        """The slope of the limiter is zero at the start, which is no dependence."""

        x: Variable = Variable(start=5.0)
        y: Variable = Variable(start=5.0)

        def equations(self) -> Equations:
            yield ac.clip(self.x, -1, 1) + self.y == 2.5
            yield ac.where(self.y > 1, self.y, 0.1 * self.x) + 0.5 * self.x == 3

    assert ac.compile(Saturated()).report().unknowns == 2


def test_a_dependence_behind_exponentials_is_found() -> None:
    """Ring modulator without the small capacitors: the currents of four diodes add up to nothing (index 2).

    Source: Mazzia and Magherini 2008, Test Set for IVP Solvers, Ring modulator, Cs = 0. The exponentials are so large
    at arbitrary values that a rank in floating-point numbers says nothing.
    """

    class Diodes(Component):
        a: Variable = Variable(start=0.0, fixed=True)
        b: Variable = Variable(start=0.0)
        u: Variable = Variable()
        v: Variable = Variable()

        def equations(self) -> Equations:
            forward = 1e-9 * (ac.exp(400 * (self.u + 2 * ac.sin(1e4 * ac.time))) - 1)
            backward = 1e-9 * (ac.exp(-400 * (self.v - ac.cos(3e3 * ac.time))) - 1)
            yield 1e-3 * der(self.a) == ac.sin(ac.time) - self.u - self.a
            yield 1e-3 * der(self.b) == self.v - 2 * self.b
            yield self.a + forward == backward
            yield self.b + forward == backward + 0.25 * self.a

    system = ac.compile(Diodes())
    assert system.report().structural_index == 2
    assert len(system.states) == 1
    assert system.report().invariants == 0


class Hidden(Component):
    """The derivative of x cancels in the first equation, which so is a constraint: x = cos t, index 1."""

    x: Variable = Variable(start=1.0)
    y: Variable = Variable(start=0.0, fixed=True)

    def equations(self) -> Equations:
        dx, dy = der(self.x), der(self.y)
        yield (dx + dy) * (dx - dy) - dx**2 + dy**2 + self.x == ac.cos(ac.time)
        yield dy == self.x


@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_a_derivative_that_cancels_in_a_single_equation(engine: Any) -> None:
    system = ac.compile(Hidden())
    assert system.report().structural_index == 1
    assert system.states == ("y",)
    solution = system.simulate(1.0, rtol=1e-9, engine=engine)
    t = np.asarray(solution.t)
    assert np.allclose(solution["x"], np.cos(t), atol=1e-12)
    assert np.allclose(solution["y"], np.sin(t), atol=1e-8)


class Ends(Component):
    """Up to one equation: x decays."""

    x: Variable = Variable(start=1.0)
    y: Variable = Variable(start=0.0)

    def last(self) -> Equation:
        raise NotImplementedError

    def equations(self) -> Equations:
        yield der(self.x) == -self.x
        yield self.last()


def test_a_single_equation_that_says_nothing_is_named() -> None:
    class Nothing(Ends):
        def last(self) -> Equation:
            return (self.x + self.y) ** 2 == self.x**2 + self.y**2 + 2 * self.x * self.y

    with pytest.raises(StructureError, match="everything cancels") as info:
        ac.compile(Nothing())
    assert "(x + y)**2" in info.value.equations[0]
    assert "test_regularize.py" in str(info.value)


def test_a_single_equation_that_has_lost_its_unknown_is_named() -> None:
    class Lost(Ends):
        def last(self) -> Equation:
            return (self.x + self.y) ** 2 - ac.exp(-ac.time) == self.x**2 + self.y**2 + 2 * self.x * self.y - self.x

    with pytest.raises(StructureError, match="cannot be paired") as info:
        ac.compile(Lost())
    assert "y" in info.value.unknowns
    assert "(x + y)**2" in str(info.value)


def test_an_equation_of_steps_does_not_determine_its_argument() -> None:
    class Steps(Ends):
        def last(self) -> Equation:
            return self.x == ac.sign(self.y)

    with pytest.raises(StructureError, match="does not determine `y`") as info:
        ac.compile(Steps())
    assert "sign(y)" in info.value.equations[0]


def test_a_saturated_equation_is_not_singular() -> None:
    """tanh is 1 to rounding nearly everywhere here, and still determines its argument."""

    class Saturated(Ends):
        def last(self) -> Equation:
            return 0.5 * self.x == ac.tanh(1e3 * self.y)

    solution = ac.compile(Saturated()).simulate(1.0)
    assert np.allclose(solution["y"], np.arctanh(0.5 * np.asarray(solution["x"])) / 1e3, atol=1e-6)


class Varying(Component):
    """``x' + eta t y' + (1 + eta) y = cos t``, ``x + eta t y = exp(-t)``: index 2, y = cos t + exp(-t).

    Source: Brenan, Campbell and Petzold (1996), Numerical Solution of Initial-Value Problems in DAEs, section 2.5;
    backward differences fail on it for eta <= -1/2.
    """

    eta: Parameter = Parameter(-1.0)
    x: Variable = Variable(start=1.0)
    y: Variable = Variable(start=2.0)

    def equations(self) -> Equations:
        t = ac.time
        yield der(self.x) + self.eta * t * der(self.y) + (1 + self.eta) * self.y == ac.cos(t)
        yield self.x + self.eta * t * self.y == ac.exp(-t)


@pytest.mark.parametrize("eta", [-2.0, -0.5, 0.0, 1.0])
def test_the_index_counts_what_combinations_have_differentiated(eta: float) -> None:
    system = ac.compile(Varying(eta=eta))
    assert system.report().structural_index == 2
    solution = system.simulate(1.0)
    t = np.asarray(solution.t)
    assert np.allclose(solution["y"], np.cos(t) + np.exp(-t), atol=1e-12)


@pytest.mark.parametrize("n", [2, 3, 4, 5])
def test_index_of_a_chain_of_derivatives(n: int) -> None:
    """x1 = sin t, x1' = x2, x2' = x3, ...: index n, though the last of them is but a name for a derivative."""

    class Link(Component):
        x: Variable = Variable()

    class Chain(Component):
        n: int = 2
        link: Array[Link] = Array(Link(), "n")

        def equations(self) -> Equations:
            yield self.link[0].x == ac.sin(ac.time)
            for k in range(self.n - 1):
                yield der(self.link[k].x) == self.link[k + 1].x

    system = ac.compile(Chain(n=n))
    assert system.report().structural_index == n
    solution = system.simulate(1.0)
    t = np.asarray(solution.t)
    assert np.allclose(solution[f"link[{n - 1}].x"], np.sin(t + (n - 1) * np.pi / 2), atol=1e-12)


def test_algebraic_variables_beside_a_constraint_do_not_raise_the_index() -> None:
    class Beside(Component):
        """``x = sin t``, ``y' = x'``: index 1; z has nothing to do with it."""

        x: Variable = Variable()
        y: Variable = Variable(start=0.0, fixed=True)
        z: Variable = Variable()

        def equations(self) -> Equations:
            yield self.x == ac.sin(ac.time)
            yield der(self.y) == der(self.x)
            yield self.z == 2 * ac.cos(ac.time)

    assert ac.compile(Beside()).report().structural_index == 1


def test_a_name_for_a_derivative_is_an_algebraic_variable() -> None:
    class Semi(Component):
        """``x' = z``, ``z^3 + z = -x``: semi-explicit, of index 1, whatever alias elimination makes of it."""

        x: Variable = Variable(start=1.0, fixed=True)
        z: Variable = Variable(start=-0.5)

        def equations(self) -> Equations:
            yield der(self.x) == self.z
            yield self.z**3 + self.z == -self.x

    assert ac.compile(Semi()).report().structural_index == 1


class Held(Component):
    """``x = sin t``, hidden in a combination without the derivatives of x and v; z is a name for ``der(v)``."""

    x: Variable = Variable(start=0.0)
    v: Variable = Variable(start=1.0)
    z: Variable = Variable()

    def equations(self) -> Equations:
        t = ac.time
        yield 2 * der(self.x) == 2 * self.v + ac.exp(-t)
        yield der(self.v) == self.z
        yield self.x - ac.sin(t) + ac.cos(t) * (der(self.x) - self.v - 0.5 * ac.exp(-t)) == 0


def test_a_derivative_that_a_variable_stands_for_is_not_lost() -> None:
    system = ac.compile(Held())
    assert system.report().structural_index == 3
    solution = system.simulate(1.0)
    t = np.asarray(solution.t)
    assert np.allclose(solution["z"], 0.5 * np.exp(-t) - np.sin(t), atol=1e-12)


def test_a_derivative_in_a_condition_is_not_lost() -> None:
    class Watched(Component):
        """``x = -cos t``, of which no equation needs the derivative."""

        x: Variable = Variable(start=1.0)
        y: Variable = Variable(start=0.0)
        n: ac.Discrete = ac.Discrete(start=0)

        def equations(self) -> Equations:
            yield der(self.x) + der(self.y) == -self.x
            yield self.x + self.y == ac.sin(ac.time)
            yield ac.when(der(self.x) > 0.5, {self.n: 1})

    solution = ac.compile(Watched()).simulate(1.0)
    assert [event.t for event in solution.events] == [pytest.approx(np.arcsin(0.5), abs=1e-9)]
