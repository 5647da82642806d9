"""Vectors and matrices of quantities: names, modification, arithmetic, errors."""

from __future__ import annotations

import re

import numpy as np
import pytest

import acausal as ac
from acausal import (
    Component,
    Connector,
    Equations,
    Input,
    Matrix,
    Output,
    Parameter,
    Potential,
    Variable,
    Vector,
    connect,
    cross,
    der,
    dot,
    inner,
    matrix,
    norm,
    outer,
    start,
    vector,
)


class Particle(Component):
    """A particle that is pulled to the point `a`; `half` is a dependent vector of parameters."""

    a: Vector = Vector(Parameter(unit="m"), (1.0, 2.0, 3.0))
    half: Vector = Vector(Parameter(unit="m"), a / 2)
    x: Vector = Vector(Variable(unit="m"), (0.0, 0.0, 0.0))
    tau: Parameter = Parameter(1.0, unit="s", evaluate=True)
    T: Matrix = Matrix(Variable())

    def equations(self) -> Equations:
        yield der(self.x) == (self.a - self.x) / self.tau
        yield self.T == matrix(self.x, self.half, cross(self.x, self.half))


def test_names_count_from_one_and_python_from_zero() -> None:
    model = Particle(x=start((1.0, 0.0, 0.0), fixed=True))
    system = ac.compile(model)
    assert system.states == ("x[1]", "x[2]", "x[3]")
    assert list(system.parameters) == ["a[1]", "a[2]", "a[3]"]
    solution = system.simulate(t1=1.0, parameters={"a[2]": 4.0})
    assert np.allclose(solution["x"][-1], [1.0, 4.0 * (1 - np.exp(-1.0)), 3.0 * (1 - np.exp(-1.0))], rtol=1e-5)
    assert np.allclose(solution[model.x], solution["x"]) and np.allclose(solution[model.x[1]], solution["x[2]"])
    assert np.allclose(solution["T"][-1][3:6], [0.5, 2.0, 1.5])
    assert np.allclose(solution["T[2,3]"], 1.5)


def test_modification_of_all_and_of_one_element() -> None:
    assert ac.compile(Particle(a=(5.0, 6.0, 7.0))).parameters["a[3]"] == 7.0
    changed = ac.modify(ac.modify(Particle(), {"a": (5.0, 6.0, 7.0)}), {"a[1]": 0.0})
    assert list(ac.compile(changed).parameters.values()) == [0.0, 6.0, 7.0]


class Pair(Component):
    """Binds a vector of its own to one of a part."""

    b: Vector = Vector(Parameter(unit="m"), (1.0, 1.0, 1.0))
    particle: Particle = Particle(a=b * 3)


def test_binding_to_the_vector_of_the_owner() -> None:
    system = ac.compile(Pair(b=(1.0, 2.0, 3.0)))
    assert system.simulate(t1=0.1)["particle.T[2,3]"][-1] == pytest.approx(4.5)


class Source(Component):
    y: Vector = Vector(Output())

    def equations(self) -> Equations:
        yield self.y == (1.0, ac.time, 3.0)


class Gain(Component):
    u: Vector = Vector(Input())
    y: Variable = Variable()

    def equations(self) -> Equations:
        yield self.y == dot(self.u, vector(1, 2, 3)) + norm(vector(3, 4, 0))


class Wired(Component):
    source: Source = Source()
    gain: Gain = Gain()

    def equations(self) -> Equations:
        yield connect(self.source.y, self.gain.u)


def test_vectors_of_signals_are_connected_element_by_element() -> None:
    assert ac.compile(Wired()).simulate(t1=1.0)["gain.y"][-1] == pytest.approx(1 + 2 + 9 + 5)


def test_arithmetic() -> None:
    a, b = vector(1, 2, 3), vector(-1, 0, 2)
    values = [e.value for e in a + b * 2 - (0, 0, 1)]
    assert values == [-1, 2, 6]
    assert [e.value for e in cross(a, b)] == [4, -5, 2]
    turn = matrix((0, 1, 0), (-1, 0, 0), (0, 0, 1))
    assert [e.value for e in turn @ a] == [2, -1, 3]
    assert [e.value for row in (turn @ turn.transpose()).rows() for e in row] == [1, 0, 0, 0, 1, 0, 0, 0, 1]


class Decay(Component):
    """Scalars multiply from both sides, expressions of them too."""

    k: Parameter = Parameter(2.0)
    to: Vector = Vector(Parameter(), (1.0, 2.0))
    twice: Vector = Vector(Parameter(), k * to)
    x: Vector = Vector(Variable(), (0.0, 0.0))
    R: Matrix = Matrix(Variable(), shape=(2, 2))

    def equations(self) -> Equations:
        yield der(self.x) == -self.k * self.x + 0.5 * self.k * self.twice
        yield self.R == ac.sin(ac.time) * matrix((1, 2), (3, 4))


def test_a_scalar_on_the_left() -> None:
    solution = ac.compile(Decay()).simulate(t1=1.0, rtol=1e-8)
    np.testing.assert_allclose(solution["x"][-1], np.array([1.0, 2.0]) * (1 - np.exp(-2.0)), rtol=1e-6)
    np.testing.assert_allclose(solution["R"][-1], np.sin(1.0) * np.arange(1, 5))


def test_values_give_the_size() -> None:
    class Plane(Component):
        v: Vector = Vector(Parameter(), (3.0, 2.0))
        M: Matrix = Matrix(Parameter(), ((1.0, 2.0, 3.0), (4.0, 5.0, 6.0)))
        y: Variable = Variable()

        def equations(self) -> Equations:
            yield self.y == self.v[1] * self.M[1, 2] + self.M[0][1]

    assert Plane.v.size == 2 and Plane.M.shape == (2, 3)
    assert ac.compile(Plane()).simulate(t1=1.0)["y"][-1] == 14.0
    with pytest.raises(ac.DeclarationError, match="rows of the same length"):
        Matrix(Parameter(), ((1.0,), (2.0, 3.0)))


def test_wrong_numbers_of_elements_are_named() -> None:
    with pytest.raises(ac.DeclarationError, match=re.escape("`Particle(a=...)`: `a` has 3 elements, not 2: (1.0,")):
        Particle(a=(1.0, 2.0))
    with pytest.raises(ac.DeclarationError, match=re.escape("`a` has 3 elements, not 2")):
        Particle.a.__add__((1.0, 2.0))
    with pytest.raises(ac.DeclarationError, match="takes a sequence with a value for each element, not"):
        Particle(a=2.0)  # type: ignore[arg-type]
    with pytest.raises(ac.UnknownNameError, match=re.escape("no variable `x[4]`")):
        ac.compile(Particle()).simulate(t1=0.1)["x[4]"]
    with pytest.raises(TypeError, match="neither true nor false"):
        bool(vector(1, 2, 3) == vector(1, 2, 3))


class Axis(Component):
    """The rate depends on the direction of `n`, which is built in."""

    n: Vector = Vector(Parameter(evaluate=True), (0.0, 0.0, 2.0))
    scale: Parameter = Parameter(1.0)
    x: Vector = Vector(Variable())

    def equations(self) -> Equations:
        yield self.x == self.n / norm(self.n) * self.scale


def test_evaluated_parameters_are_numbers_in_the_equations() -> None:
    system = ac.compile(Axis())
    assert list(system.parameters) == ["scale"]
    text = str(system.equations("sorted"))
    assert "n[" not in text and "sqrt" not in text
    assert system.simulate(t1=1.0, parameters={"scale": 3.0})["x"][-1].tolist() == [0.0, 0.0, 3.0]
    assert ac.compile(Axis(n=(3.0, 4.0, 0.0))).simulate(t1=1.0)["x"][-1].tolist() == pytest.approx([0.6, 0.8, 0.0])


def test_evaluated_parameters_cannot_be_changed() -> None:
    with pytest.raises(ac.DeclarationError, match=re.escape("`n[1]` is built into the equations")):
        ac.compile(Axis()).simulate(t1=1.0, parameters={"n[1]": 1.0})


class Bound(Component):
    slope: Parameter = Parameter(2.0)
    axis: Axis = Axis(n=(slope, 0.0, 0.0))


def test_what_an_evaluated_parameter_is_computed_from_is_evaluated_too() -> None:
    system = ac.compile(Bound())
    assert list(system.parameters) == ["axis.scale"]
    with pytest.raises(ac.DeclarationError, match=re.escape("`slope` is built into the equations")):
        system.simulate(t1=1.0, parameters={"slope": 1.0})


class Port(Connector):
    r: Vector = Vector(Potential(unit="m"))


class Place(Component):
    at: Vector = Vector(Parameter(unit="m"), (1.0, 2.0, 3.0))
    port: Port = Port()

    def equations(self) -> Equations:
        yield self.port.r == self.at


class Far(Component):
    home: Place = outer(Place())
    d: Vector = Vector(Variable(unit="m"))

    def equations(self) -> Equations:
        yield self.d == self.home.port.r * 2


class Both(Component):
    home: Place = inner(Place(at=(4.0, 5.0, 6.0)))
    far: Far = Far()


def test_vectors_in_connectors_and_shared_components() -> None:
    assert ac.compile(Both()).simulate(t1=1.0)["far.d"][-1].tolist() == [8.0, 10.0, 12.0]
