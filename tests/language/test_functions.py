"""Functions in equations: elementary ones, user JAX functions, tables."""

from __future__ import annotations

import math
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal import Component, Equations, Parameter, Variable, der, start


class Driven(Component):
    """dx/dt = f(x, y) with any function of two arguments given by the subclass."""

    x: Variable = Variable(start=0.3, fixed=True)
    y: Variable = Variable(start=0.5, fixed=True)
    k: Parameter = Parameter(2.0)


def rate(f: Any, x: float = 0.3, y: float = 0.5) -> float:
    """Value that the compiled model gives to `f(x, y)`."""

    class Model(Driven):
        def equations(self) -> Equations:
            yield der(self.x) == f(self.x, self.y)
            yield der(self.y) == 1

    system = ac.compile(Model())
    order = [system.states.index(n) for n in ("x", "y")]
    state = np.zeros(2)
    state[order] = x, y
    return float(system.vector_field(0.0, state)[order[0]])


def test_elementary_functions_in_one_model() -> None:
    pairs = [
        (ac.sin, math.sin), (ac.cos, math.cos), (ac.tan, math.tan), (ac.asin, math.asin), (ac.acos, math.acos),
        (ac.atan, math.atan), (ac.sinh, math.sinh), (ac.cosh, math.cosh), (ac.tanh, math.tanh), (ac.asinh, math.asinh),
        (ac.sqrt, math.sqrt), (ac.exp, math.exp), (ac.log, math.log), (ac.log10, math.log10), (ac.abs, abs),
        (ac.floor, math.floor), (ac.ceil, math.ceil),
    ]  # fmt: skip
    got = rate(lambda x, y: sum((ours(x) for ours, _ in pairs), y))
    assert got == pytest.approx(0.5 + sum(theirs(0.3) for _, theirs in pairs), rel=1e-14)
    for ours, theirs in pairs:
        constant = ours(0.3)
        assert constant.op == "const"
        assert constant.value == theirs(0.3)


def test_functions_of_two_and_more() -> None:
    got = rate(lambda x, y: ac.atan2(x, y) + ac.min(x, y, 0.1) + 10 * ac.max(x, y, 0.4) + ac.mod(7 * y, x))
    assert got == pytest.approx(math.atan2(0.3, 0.5) + 0.1 + 5.0 + math.fmod(3.5, 0.3))
    assert rate(lambda x, y: ac.clip(x, 0.4, y)) == pytest.approx(0.4)
    assert rate(lambda x, y: ac.where((x > 0) & ~(y > x) | (y >= 0.5), 1.0, 2.0)) == 1.0
    assert rate(lambda x, y: ac.where((x > 0) & (y < x), 1.0, ac.where(y <= 0.5, 3.0, 4.0))) == 3.0
    assert rate(lambda x, y: ac.sign(x - y) + 2**x + y ** (-1)) == pytest.approx(-1 + 2**0.3 + 2.0)


def test_a_user_function_and_its_derivative() -> None:
    drag = ac.function(lambda v, c: c * v * jnp.abs(v), name="drag")
    assert rate(lambda x, y: drag(x, y) + 1) == pytest.approx(0.5 * 0.09 + 1)

    class Body(Component):
        v: Variable = Variable(start=2.0, fixed=True)
        f: Variable = Variable()
        fdot: Variable = Variable()
        c: Parameter = Parameter(3.0)

        def equations(self) -> Equations:
            yield self.f == drag(self.v, self.c)
            yield der(self.v) == -self.f
            yield self.fdot == der(self.f)

    system = ac.compile(Body())
    values = system.lowered.observe(0.0, jnp.array([2.0]), jnp.zeros(0), system.parameter_vector())
    assert float(values[int(system.index_of("f"))]) == pytest.approx(12.0)
    assert float(values[int(system.index_of("fdot"))]) == pytest.approx(3.0 * 2 * 2.0 * -12.0)
    gradient = jax.grad(lambda c: system.vector_field(0.0, jnp.array([2.0]), {"c": c})[0])(3.0)
    assert float(gradient) == pytest.approx(-4.0)


def test_a_user_function_must_return_one_number() -> None:
    class Bad(Component):
        x: Variable = Variable(start=1.0, fixed=True)

        def equations(self) -> Equations:
            yield der(self.x) == ac.function(lambda v: jnp.array([v, v]), name="twice")(self.x)

    with pytest.raises(TypeError, match="`twice` must return one scalar"):
        ac.compile(Bad()).vector_field(0.0, np.array([1.0]))


def test_tables() -> None:
    table = ac.table([0.0, 1.0, 3.0], [0.0, 2.0, 0.0])
    assert rate(lambda x, y: table(x)) == pytest.approx(0.6)
    assert rate(lambda x, y: table(4 * y)) == pytest.approx(1.0)
    assert rate(lambda x, y: table(-x) + table(10 * y)) == pytest.approx(0.0)
    for x, y, words in (
        ([0.0], [0.0], "at least two points"),
        ([0.0, 1.0], [0.0], "as many y as x"),
        ([0.0, 0.0], [0.0, 1.0], "increase"),
    ):
        with pytest.raises(ac.DeclarationError, match=words):
            ac.table(x, y)


def test_numbers_of_numpy_and_jax_are_numbers() -> None:
    for number in (np.float64(2.0), np.int64(2), jnp.array(2.0), 2, True + True):
        assert str(ac.time * number) == "2*time"
        assert str(number * ac.time) == "2*time"


def test_a_symbol_is_not_a_number() -> None:
    for wrong in (lambda: math.sin(ac.time), lambda: np.sin(ac.time), lambda: float(ac.time), lambda: list(ac.time)):
        with pytest.raises(TypeError):
            wrong()
    with pytest.raises(TypeError, match=r"acausal\.sin"):
        math.sin(ac.time)


def test_start_values_by_function() -> None:
    class Model(Component):
        a: Parameter = Parameter(4.0)
        x: Variable = Variable(start=ac.sqrt(a) + 1, fixed=True)

        def equations(self) -> Equations:
            yield der(self.x) == 0

    x0, _, _ = ac.compile(Model()).initialize()
    assert float(x0[0]) == 3.0
    assert float(ac.compile(Model(x=start(7.0))).initialize()[0][0]) == 7.0
